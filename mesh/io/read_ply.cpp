// Polygon File Format (Turk, "The PLY Polygon File Format", 1994): ASCII and binary of either byte order.
// Wanted are x, y and z of element `vertex` and the list `vertex_indices` (or `vertex_index`) of element
// `face`; all else is skipped.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

#include "mesh/io/cursor.h"
#include "mesh/io/formats.h"

namespace penumbra::detail {
namespace {

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kInt64, kUint64, kFloat32, kFloat64 };

std::size_t size_of(Scalar type) {
  static constexpr std::array<std::size_t, 10> kSizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool is_integer(Scalar type) {
  return type < Scalar::kFloat32;
}

std::optional<Scalar> scalar_named(std::string_view name) {
  static constexpr std::pair<std::string_view, Scalar> kNames[] = {
      {"char", Scalar::kInt8},       {"int8", Scalar::kInt8},      {"uchar", Scalar::kUint8},
      {"uint8", Scalar::kUint8},     {"short", Scalar::kInt16},    {"int16", Scalar::kInt16},
      {"ushort", Scalar::kUint16},   {"uint16", Scalar::kUint16},  {"int", Scalar::kInt32},
      {"int32", Scalar::kInt32},     {"uint", Scalar::kUint32},    {"uint32", Scalar::kUint32},
      {"int64", Scalar::kInt64},     {"uint64", Scalar::kUint64},  {"float", Scalar::kFloat32},
      {"float32", Scalar::kFloat32}, {"double", Scalar::kFloat64}, {"float64", Scalar::kFloat64}};
  for (const auto& [known, type] : kNames) {
    if (known == name) {
      return type;
    }
  }
  return std::nullopt;
}

struct Property {
  std::string name;
  Scalar type;
  std::optional<Scalar> count_type;  ///< of a list
};

struct Element {
  std::string name;
  std::size_t count;
  std::vector<Property> properties;
};

struct Header {
  enum class Format { kAscii, kLittleEndian, kBigEndian } format = Format::kAscii;
  std::vector<Element> elements;
};

Header::Format read_format(TextCursor& cursor) {
  const std::string_view format = cursor.token_of_line();
  if (format == "ascii") {
    return Header::Format::kAscii;
  }
  if (format == "binary_little_endian") {
    return Header::Format::kLittleEndian;
  }
  if (format == "binary_big_endian") {
    return Header::Format::kBigEndian;
  }
  cursor.fail("unknown format " + quote(format),
              "save it as ascii, binary_little_endian or binary_big_endian");
}

Element read_element(TextCursor& cursor, const std::vector<Element>& earlier) {
  Element element{std::string(cursor.token_of_line()), 0, {}};
  const std::string_view count_text = cursor.token_of_line();
  std::int64_t count = 0;
  if (!parse_number(count_text, count) || count < 0) {
    cursor.fail("the number of elements " + quote(element.name) + " is " + quote(count_text),
                "correct the header");
  }
  for (const Element& other : earlier) {
    if (other.name == element.name) {
      cursor.fail("element " + quote(element.name) + " is declared twice", "correct the header");
    }
  }
  element.count = static_cast<std::size_t>(count);
  return element;
}

Scalar read_type(TextCursor& cursor) {
  const std::string_view name = cursor.token_of_line();
  const std::optional<Scalar> type = scalar_named(name);
  if (!type) {
    cursor.fail("unknown type " + quote(name), "use char, uchar, short, ushort, int, uint, float or double");
  }
  return *type;
}

Property read_property(TextCursor& cursor) {
  Property property{};
  TextCursor ahead = cursor;
  if (ahead.token_of_line() == "list") {
    cursor.token_of_line();
    property.count_type = read_type(cursor);
    if (!is_integer(*property.count_type)) {
      cursor.fail("a list's length has a floating-point type", "use uchar or int");
    }
  }
  property.type = read_type(cursor);
  property.name = cursor.token_of_line();
  return property;
}

/// Leaves the cursor at the first byte of the data.
Header read_header(TextCursor& cursor) {
  Header header;
  bool has_format = false;
  cursor.skip_line();  // "ply"
  for (;;) {
    const std::string_view keyword = cursor.token_of_line();
    if (keyword == "end_header") {
      break;
    }
    if (keyword.empty() && cursor.at_end()) {
      cursor.fail_truncated("'end_header'");
    }
    if (keyword == "format") {
      header.format = read_format(cursor);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(read_element(cursor, header.elements));
    } else if (keyword == "property") {
      if (header.elements.empty()) {
        cursor.fail("a property stands before the first element", "correct the header");
      }
      header.elements.back().properties.push_back(read_property(cursor));
    } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      cursor.fail("unknown header line " + quote(keyword), "it is corrupt; export it again");
    }
    cursor.skip_line();
  }
  if (!has_format) {
    cursor.fail("the header has no 'format' line", "export it again");
  }
  return header;
}

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
  double value(Scalar) { return number("a value"); }
  std::size_t most_values(std::size_t) const { return (remaining() + 1) / 2; }
};

struct BinarySource : ByteCursor {
  using ByteCursor::ByteCursor;
  double value(Scalar type) {
    switch (type) {
      case Scalar::kInt8:
        return read<std::int8_t>();
      case Scalar::kUint8:
        return read<std::uint8_t>();
      case Scalar::kInt16:
        return read<std::int16_t>();
      case Scalar::kUint16:
        return read<std::uint16_t>();
      case Scalar::kInt32:
        return read<std::int32_t>();
      case Scalar::kUint32:
        return read<std::uint32_t>();
      case Scalar::kInt64:
        return static_cast<double>(read<std::int64_t>());
      case Scalar::kUint64:
        return static_cast<double>(read<std::uint64_t>());
      case Scalar::kFloat32:
        return read<float>();
      case Scalar::kFloat64:
        return read<double>();
    }
    return 0.0;
  }
  std::size_t most_values(std::size_t bytes_each) const { return remaining() / bytes_each; }
};

/// Reads the elements one after another from either source.
template <class Source>
class ElementReader {
 public:
  ElementReader(Source& source, const Header& header) : source_(source), header_(header), soup_(source) {}

  PolygonSoup read() {
    for (const Element& element : header_.elements) {
      if (element.properties.empty()) {
        continue;  // takes no room, whatever its count
      }
      check_count(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        skip(element);
      }
    }
    return std::move(soup_).take();
  }

 private:
  void check_count(const Element& element) const {
    std::size_t bytes = 0, values = element.properties.size();
    for (const Property& property : element.properties) {
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

  std::size_t read_list_size(const Property& property) {
    const double size = source_.value(*property.count_type);
    if (!(size >= 0.0) || size != std::floor(size) ||
        size > static_cast<double>(source_.most_values(size_of(property.type)))) {
      source_.fail("a list " + quote(property.name) + " is longer than the file or its length is no count",
                   "it is truncated or corrupt; copy or export it again");
    }
    return static_cast<std::size_t>(size);
  }

  void skip(const Property& property) {
    const std::size_t size = property.count_type ? read_list_size(property) : 1;
    for (std::size_t i = 0; i < size; ++i) {
      source_.value(property.type);
    }
  }

  void skip(const Element& element) {
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const Property& property : element.properties) {
        skip(property);
      }
    }
  }

  void read_vertices(const Element& element) {
    std::array<bool, 3> found = {};
    for (const Property& property : element.properties) {
      if (const int axis = axis_of(property); axis >= 0) {
        found[static_cast<std::size_t>(axis)] = true;
      }
    }
    if (!(found[0] && found[1] && found[2])) {
      source_.fail("element 'vertex' lacks the property x, y or z", "export it with vertex positions");
    }
    soup_.reserve(element.count, 0);
    for (std::size_t i = 0; i < element.count; ++i) {
      Vec3 p(0.0);
      for (const Property& property : element.properties) {
        if (const int axis = axis_of(property); axis >= 0) {
          p[axis] = source_.value(property.type);
        } else {
          skip(property);
        }
      }
      soup_.add_vertex(p);
    }
  }

  static int axis_of(const Property& property) {
    const bool named = property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z';
    return named && !property.count_type ? property.name[0] - 'x' : -1;
  }

  void read_faces(const Element& element) {
    const Property* wanted = nullptr;
    for (const Property& property : element.properties) {
      const bool named = property.name == "vertex_indices" || property.name == "vertex_index";
      wanted = named && property.count_type && is_integer(property.type) && !wanted ? &property : wanted;
    }
    if (!wanted) {
      source_.fail("element 'face' lacks a list of whole numbers 'vertex_indices'", "export it with faces");
    }
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const Property& property : element.properties) {
        if (&property == wanted) {
          read_corners(property);
        } else {
          skip(property);
        }
      }
    }
  }

  void read_corners(const Property& property) {
    const std::size_t size = read_list_size(property);
    for (std::size_t i = 0; i < size; ++i) {
      const double vertex = source_.value(property.type);
      const bool fits = vertex >= -0x1p62 && vertex <= 0x1p62 && vertex == std::floor(vertex);
      soup_.add_corner(fits ? static_cast<std::int64_t>(vertex) : -1);
    }
    soup_.end_polygon();
  }

  Source& source_;
  const Header& header_;
  SoupBuilder<Source> soup_;
};

}  // namespace

bool begins_like_ply(std::span<const std::byte> bytes) {
  const std::string_view text = as_text(bytes);
  return text.starts_with("ply\n") || text.starts_with("ply\r") || text.starts_with("ply ");
}

PolygonSoup read_ply(std::span<const std::byte> bytes, const std::string& name) {
  TextCursor cursor(as_text(bytes), name, 0);
  const Header header = read_header(cursor);
  if (header.format == Header::Format::kAscii) {
    cursor.skip_line();
    AsciiSource source(cursor);
    return ElementReader<AsciiSource>(source, header).read();
  }
  const bool little = header.format == Header::Format::kLittleEndian;
  BinarySource source(bytes, name, little ? std::endian::little : std::endian::big);
  source.skip(data_offset(as_text(bytes), cursor.offset()));
  return ElementReader<BinarySource>(source, header).read();
}

}  // namespace penumbra::detail
