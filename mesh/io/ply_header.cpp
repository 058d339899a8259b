#include "mesh/io/ply_header.h"

#include <algorithm>
#include <array>
#include <utility>

namespace penumbra::detail {
namespace {

std::optional<PlyScalar> scalar_named(std::string_view name) {
  static constexpr std::pair<std::string_view, PlyScalar> kNames[] = {
      {"char", PlyScalar::kInt8},       {"int8", PlyScalar::kInt8},      {"uchar", PlyScalar::kUint8},
      {"uint8", PlyScalar::kUint8},     {"short", PlyScalar::kInt16},    {"int16", PlyScalar::kInt16},
      {"ushort", PlyScalar::kUint16},   {"uint16", PlyScalar::kUint16},  {"int", PlyScalar::kInt32},
      {"int32", PlyScalar::kInt32},     {"uint", PlyScalar::kUint32},    {"uint32", PlyScalar::kUint32},
      {"int64", PlyScalar::kInt64},     {"uint64", PlyScalar::kUint64},  {"float", PlyScalar::kFloat32},
      {"float32", PlyScalar::kFloat32}, {"double", PlyScalar::kFloat64}, {"float64", PlyScalar::kFloat64}};
  for (const auto& [known, type] : kNames) {
    if (known == name) {
      return type;
    }
  }
  return std::nullopt;
}

PlyHeader::Format read_format(TextCursor& cursor) {
  const std::string_view format = cursor.token_of_line();
  if (format == "ascii") {
    return PlyHeader::Format::kAscii;
  }
  if (format == "binary_little_endian") {
    return PlyHeader::Format::kLittleEndian;
  }
  if (format == "binary_big_endian") {
    return PlyHeader::Format::kBigEndian;
  }
  cursor.fail("unknown format " + quote(format),
              "save it as ascii, binary_little_endian or binary_big_endian");
}

PlyElement read_element(TextCursor& cursor, const std::vector<PlyElement>& earlier) {
  PlyElement element{std::string(cursor.token_of_line()), 0, {}};
  const std::string_view count_text = cursor.token_of_line();
  std::int64_t count = 0;
  if (!parse_number(count_text, count) || count < 0) {
    cursor.fail("the number of elements " + quote(element.name) + " is " + quote(count_text),
                "correct the header");
  }
  for (const PlyElement& other : earlier) {
    if (other.name == element.name) {
      cursor.fail("element " + quote(element.name) + " is declared twice", "correct the header");
    }
  }
  element.count = static_cast<std::size_t>(count);
  return element;
}

PlyScalar read_type(TextCursor& cursor) {
  const std::string_view name = cursor.token_of_line();
  const std::optional<PlyScalar> type = scalar_named(name);
  if (!type) {
    cursor.fail("unknown type " + quote(name), "use char, uchar, short, ushort, int, uint, float or double");
  }
  return *type;
}

PlyProperty read_property(TextCursor& cursor) {
  PlyProperty property{};
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

}  // namespace

std::size_t size_of(PlyScalar type) {
  static constexpr std::array<std::size_t, 10> kSizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool is_integer(PlyScalar type) {
  return type < PlyScalar::kFloat32;
}

bool PlyHeader::has(std::string_view element) const {
  return std::ranges::any_of(elements, [&](const PlyElement& e) { return e.name == element; });
}

PlyHeader read_ply_header(TextCursor& cursor) {
  PlyHeader header;
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

}  // namespace penumbra::detail
