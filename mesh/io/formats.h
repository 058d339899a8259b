// The one table of mesh formats. Reading, writing, help texts and messages know of formats from here alone.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>

#include "penumbra/mesh/io/polygon_soup.h"

namespace penumbra::detail {

/// How a format is called and told from others, and the functions that read and write it. Each reader takes
/// the bytes of a file and the name for its messages. It throws MeshError, and leaves to parse_polygon_soup
/// whether indices are in range.
struct MeshFormat {
  std::string_view name;       ///< for people
  std::string_view extension;  ///< lower case, with the dot
  /// What such a file begins with, for messages. Empty: nothing in particular.
  std::string_view magic;
  /// Whether the bytes begin so.
  bool (*has_magic)(std::span<const std::byte> bytes);
  /// True: a file is in this format if and only if it has the magic, whatever its extension.
  bool magic_decides;
  /// Whether the number of bytes is what a file of this format says it is. Asked last.
  bool (*has_size)(std::span<const std::byte> bytes);
  PolygonSoup (*read)(std::span<const std::byte> bytes, const std::string& name);
  void (*write)(std::ostream& out, const TriangleMesh& mesh);
};

std::span<const MeshFormat> mesh_formats();

/// The format that a file is in: by a magic that decides, then by extension, then by any magic, then by size.
/// Throws MeshError where none fits.
const MeshFormat& recognize_format(std::span<const std::byte> bytes, const std::string& name);

/// The format to write to a path: by extension; the first of the table for "-". Throws UsageError for another
/// extension.
const MeshFormat& format_to_write(const std::filesystem::path& path);

/// In lower case, with the dot.
std::string lower_extension(const std::filesystem::path& path);
/// "a", "a or b", "a, b or c".
std::string one_of(std::span<const std::string_view> names);

bool begins_like_ply(std::span<const std::byte> bytes);
PolygonSoup read_ply(std::span<const std::byte> bytes, const std::string& name);
void write_ply(std::ostream& out, const TriangleMesh& mesh);

PolygonSoup read_obj(std::span<const std::byte> bytes, const std::string& name);
void write_obj(std::ostream& out, const TriangleMesh& mesh);

/// True for OFF, COFF, NOFF, STOFF and their combinations; also for the variants that read_off refuses by
/// name (4OFF, nOFF).
bool begins_like_off(std::span<const std::byte> bytes);
PolygonSoup read_off(std::span<const std::byte> bytes, const std::string& name);
void write_off(std::ostream& out, const TriangleMesh& mesh);

bool begins_like_stl(std::span<const std::byte> bytes);
/// Whether there are exactly as many bytes as a binary STL file of the stated number of facets has.
bool has_binary_stl_size(std::span<const std::byte> bytes);
PolygonSoup read_stl(std::span<const std::byte> bytes, const std::string& name);
/// Throws UsageError where a coordinate is beyond the range of float.
void write_stl(std::ostream& out, const TriangleMesh& mesh);

}  // namespace penumbra::detail
