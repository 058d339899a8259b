// Polygon File Format (Turk, "The PLY Polygon File Format", 1994): ASCII and binary of either byte order.
// Wanted are x, y, z and nx, ny, nz of element `vertex` and the list `vertex_indices` (or `vertex_index`) of
// elements `face` and `tristrips`; all else is skipped.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

#include "mesh/io/cursor.h"
#include "mesh/io/formats.h"
#include "mesh/io/ply_header.h"

namespace penumbra::detail {
namespace {

/// The header's lines end like its first one; this matters where binary data begin with a byte that looks
/// like \n.
std::size_t data_offset(std::string_view text, std::size_t after_end_header) {
  const std::size_t first_end = text.find_first_of("\r\n");
  const std::size_t at = std::min(text.find_first_of("\r\n", after_end_header), text.size());
  const bool two = text.substr(first_end).starts_with("\r\n") && text.substr(at).starts_with("\r\n");
  return std::min(at + (two ? 2 : 1), text.size());
}

/// Values in text: types play no part, and every value takes a digit and, but for the last, a separator.
struct AsciiSource : TextCursor {
  explicit AsciiSource(const TextCursor& cursor) : TextCursor(cursor) {}
  double value(PlyScalar) { return number("a value"); }
  void skip_value(PlyScalar) {
    if (token().empty()) fail_truncated("a value");
  }
  std::size_t most_values(std::size_t) const { return (remaining() + 1) / 2; }
};

struct BinarySource : ByteCursor {
  using ByteCursor::ByteCursor;
  double value(PlyScalar type) {
    switch (type) {
      case PlyScalar::kInt8:
        return read<std::int8_t>();
      case PlyScalar::kUint8:
        return read<std::uint8_t>();
      case PlyScalar::kInt16:
        return read<std::int16_t>();
      case PlyScalar::kUint16:
        return read<std::uint16_t>();
      case PlyScalar::kInt32:
        return read<std::int32_t>();
      case PlyScalar::kUint32:
        return read<std::uint32_t>();
      case PlyScalar::kInt64:
        return static_cast<double>(read<std::int64_t>());
      case PlyScalar::kUint64:
        return static_cast<double>(read<std::uint64_t>());
      case PlyScalar::kFloat32:
        return read<float>();
      case PlyScalar::kFloat64:
        return read<double>();
    }
    return 0.0;
  }
  void skip_value(PlyScalar type) { value(type); }
  std::size_t most_values(std::size_t bytes_each) const { return remaining() / bytes_each; }
};

/// Reads the elements one after another from either source.
template <class Source>
class ElementReader {
 public:
  ElementReader(Source& source, const PlyHeader& header) : source_(source), header_(header), soup_(source) {}

  PolygonSoup read() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) {
        continue;  // takes no room, whatever its count
      }
      check_count(element);
      name_ignored(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else if (element.name == "tristrips") {
        read_strips(element);
      } else {
        skip(element);
      }
    }
    if (soup_.polygon_count() == 0 && header_.has("range_grid")) {
      source_.fail("its surface is a 'range_grid', which is not read", "export it with faces");
    }
    return std::move(soup_).take();
  }

 private:
  void check_count(const PlyElement& element) const {
    std::size_t bytes = 0, values = element.properties.size();
    for (const PlyProperty& property : element.properties) {
      bytes += size_of(property.count_type.value_or(property.type));
    }
    const std::size_t most =
        std::is_same_v<Source, BinarySource> ? source_.most_values(bytes) : source_.most_values(0) / values;
    if (element.count > most) {
      source_.fail("the header promises " + std::to_string(element.count) + " of element " +
                       quote(element.name) + ", but there is room for only " + std::to_string(most),
                   "it is truncated or corrupt; copy or export it again");
    }
  }

  std::size_t read_list_size(const PlyProperty& property) {
    const double size = source_.value(*property.count_type);
    if (!(size >= 0.0) || size != std::floor(size) ||
        size > static_cast<double>(source_.most_values(size_of(property.type)))) {
      source_.fail("a list " + quote(property.name) + " is longer than the file or its length is no count",
                   "it is truncated or corrupt; copy or export it again");
    }
    return static_cast<std::size_t>(size);
  }

  void skip(const PlyProperty& property) {
    const std::size_t size = property.count_type ? read_list_size(property) : 1;
    for (std::size_t i = 0; i < size; ++i) {
      source_.skip_value(property.type);
    }
  }

  void skip(const PlyElement& element) {
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        skip(property);
      }
    }
  }

  /// What people may miss of what is skipped.
  void name_ignored(const PlyElement& element) {
    static constexpr std::pair<std::string_view, const char*> kKnown[] = {
        {"red", "colors"},
        {"diffuse_red", "colors"},
        {"r", "colors"},
        {"s", "texture coordinates"},
        {"u", "texture coordinates"},
        {"texture_u", "texture coordinates"},
        {"texcoord", "texture coordinates"}};
    for (const PlyProperty& property : element.properties)
      for (const auto& [name, what] : kKnown)
        if (property.name == name) soup_.ignore(what);
  }

  /// For each property which of x, y, z, nx, ny and nz it is; -1 for others.
  static std::vector<int> slots_of(const PlyElement& element) {
    static constexpr std::array<std::string_view, 6> kNames = {"x", "y", "z", "nx", "ny", "nz"};
    std::vector<int> slots;
    for (const PlyProperty& property : element.properties) {
      const auto* named = std::ranges::find(kNames, property.name);
      const bool known = named != kNames.end() && !property.count_type;
      slots.push_back(known ? static_cast<int>(named - kNames.begin()) : -1);
    }
    return slots;
  }

  void read_vertices(const PlyElement& element) {
    const std::vector<int> slots = slots_of(element);
    const auto has = [&](int slot) { return std::ranges::find(slots, slot) != slots.end(); };
    if (!(has(0) && has(1) && has(2))) {
      source_.fail("element 'vertex' lacks the property x, y or z", "export it with vertex positions");
    }
    const bool has_normals = has(3) && has(4) && has(5);
    if (has_normals) soup_.give_vertices_normals();
    soup_.reserve(element.count, 0);
    for (std::size_t i = 0; i < element.count; ++i) {
      std::array<double, 6> values{};
      for (std::size_t k = 0; k < slots.size(); ++k) {
        if (const int slot = slots[k]; slot >= 0) {
          values[static_cast<std::size_t>(slot)] = source_.value(element.properties[k].type);
        } else {
          skip(element.properties[k]);
        }
      }
      soup_.add_vertex({values[0], values[1], values[2]});
      if (has_normals) soup_.add_normal({values[3], values[4], values[5]});
    }
  }

  /// The list of vertices of a face or a strip.
  const PlyProperty& corners_of(const PlyElement& element) const {
    for (const PlyProperty& property : element.properties) {
      const bool named = property.name == "vertex_indices" || property.name == "vertex_index";
      if (named && property.count_type && is_integer(property.type)) return property;
    }
    source_.fail("element " + quote(element.name) + " lacks a list of whole numbers 'vertex_indices'",
                 "export it with faces");
  }

  void read_faces(const PlyElement& element) {
    const PlyProperty& wanted = corners_of(element);
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (&property == &wanted) {
          read_corners(property);
        } else {
          skip(property);
        }
      }
    }
  }

  void read_corners(const PlyProperty& property) {
    const std::size_t size = read_list_size(property);
    for (std::size_t i = 0; i < size; ++i) soup_.add_corner(read_vertex_number(property));
    soup_.end_polygon();
  }

  void read_strips(const PlyElement& element) {
    const PlyProperty& wanted = corners_of(element);
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (&property == &wanted) {
          read_strip(property);
        } else {
          skip(property);
        }
      }
    }
  }

  /// Each vertex after the second one makes a triangle with the two before it, every other one turned round;
  /// -1 begins anew.
  void read_strip(const PlyProperty& property) {
    const std::size_t size = read_list_size(property);
    std::array<std::int64_t, 2> before{};
    for (std::size_t i = 0, known = 0; i < size; ++i) {
      const std::int64_t vertex = read_vertex_number(property);
      if (vertex == -1) {
        known = 0;
        continue;
      }
      if (known >= 2) {
        const bool turned = known % 2 == 1;
        soup_.add_corner(before[turned ? 1 : 0]);
        soup_.add_corner(before[turned ? 0 : 1]);
        soup_.add_corner(vertex);
        soup_.end_polygon();
      }
      before = {before[1], vertex};
      ++known;
    }
  }

  /// -2 for what cannot be one.
  std::int64_t read_vertex_number(const PlyProperty& property) {
    const double vertex = source_.value(property.type);
    const bool fits = vertex >= -0x1p62 && vertex <= 0x1p62 && vertex == std::floor(vertex);
    return fits ? static_cast<std::int64_t>(vertex) : -2;
  }

  Source& source_;
  const PlyHeader& header_;
  SoupBuilder<Source> soup_;
};

}  // namespace

bool begins_like_ply(std::span<const std::byte> bytes) {
  const std::string_view text = without_mark(as_text(bytes));
  return text.starts_with("ply\n") || text.starts_with("ply\r") || text.starts_with("ply ");
}

PolygonSoup read_ply(std::span<const std::byte> bytes, const std::string& name) {
  TextCursor cursor(as_text(bytes), name, 0);
  const PlyHeader header = read_ply_header(cursor);
  if (header.format == PlyHeader::Format::kAscii) {
    cursor.skip_line();
    AsciiSource source(cursor);
    return ElementReader<AsciiSource>(source, header).read();
  }
  const bool little = header.format == PlyHeader::Format::kLittleEndian;
  BinarySource source(bytes, name, little ? std::endian::little : std::endian::big);
  source.skip(data_offset(as_text(bytes), cursor.offset()));
  return ElementReader<BinarySource>(source, header).read();
}

}  // namespace penumbra::detail
