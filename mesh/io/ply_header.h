// The header of a PLY file: its elements and their properties.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/io/cursor.h"

namespace penumbra::detail {

enum class PlyScalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kInt64, kUint64, kFloat32, kFloat64 };

/// In bytes.
std::size_t size_of(PlyScalar type);
bool is_integer(PlyScalar type);

struct PlyProperty {
  std::string name;
  PlyScalar type;
  std::optional<PlyScalar> count_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::size_t count;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  enum class Format { kAscii, kLittleEndian, kBigEndian } format = Format::kAscii;
  std::vector<PlyElement> elements;

  bool has(std::string_view element) const;
};

/// Leaves the cursor behind "end_header". Throws MeshError.
PlyHeader read_ply_header(TextCursor& cursor);

}  // namespace penumbra::detail
