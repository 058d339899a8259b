// Stereolithography files, ASCII and binary. A binary file whose header says "solid" is told by its size or,
// where it has bytes to spare, by not being text. Normals are skipped: the corners' order is what counts.
// Vertices are not shared; building the mesh welds them.
#include <algorithm>

#include "mesh/io/cursor.h"
#include "mesh/io/formats.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kHeaderBytes = 80, kFacetBytes = 50;

std::uint32_t binary_count(std::span<const std::byte> bytes) {
  ByteCursor cursor(bytes, {}, std::endian::little);
  cursor.skip(kHeaderBytes);
  return cursor.remaining() < 4 ? 0 : cursor.read<std::uint32_t>();
}

/// Whether it can be text: no control characters but blanks and ends of lines near its beginning.
bool looks_like_text(std::span<const std::byte> bytes) {
  return std::ranges::all_of(bytes.first(std::min<std::size_t>(bytes.size(), 1024)), [](std::byte b) {
    const auto c = static_cast<unsigned char>(b);
    return c >= ' ' || (c >= '\t' && c <= '\r');
  });
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return lower;
}

/// Whether all facets that a binary file states fit in it; bytes to spare are allowed.
bool has_room_for_binary_stl(std::span<const std::byte> bytes) {
  return bytes.size() >= kHeaderBytes + 4 && binary_count(bytes) > 0 &&
         binary_count(bytes) <= (bytes.size() - kHeaderBytes - 4) / kFacetBytes;
}

PolygonSoup read_binary(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.size() < kHeaderBytes + 4) {
    fail_reading(name, "", "neither text that begins with 'solid' nor long enough for a binary STL file",
                 "it is truncated or not STL");
  }
  ByteCursor cursor(bytes, name, std::endian::little);
  cursor.skip(kHeaderBytes);
  const auto facets = cursor.read<std::uint32_t>();
  if (facets > cursor.remaining() / kFacetBytes) {
    cursor.fail("the header promises " + std::to_string(facets) + " facets, but there is room for only " +
                    std::to_string(cursor.remaining() / kFacetBytes),
                "it is truncated or corrupt; copy or export it again");
  }
  SoupBuilder<ByteCursor> soup(cursor);
  soup.reserve(3 * std::size_t{facets}, facets);
  for (std::uint32_t f = 0; f < facets; ++f) {
    cursor.skip(12);  // normal
    for (int k = 0; k < 3; ++k) {
      const double x = cursor.read<float>(), y = cursor.read<float>(), z = cursor.read<float>();
      soup.add_corner(static_cast<std::int64_t>(soup.vertex_count()));
      soup.add_vertex({x, y, z});
    }
    soup.end_polygon();
    cursor.skip(2);  // attribute
  }
  return std::move(soup).take();
}

void read_vertex(TextCursor& cursor, SoupBuilder<TextCursor>& soup) {
  const std::string what = "a coordinate of vertex " + std::to_string(soup.vertex_count());
  const double x = cursor.number(what), y = cursor.number(what), z = cursor.number(what);
  soup.add_corner(static_cast<std::int64_t>(soup.vertex_count()));
  soup.add_vertex({x, y, z});
}

void expect(TextCursor& cursor, const char* word) {
  if (const std::string_view token = cursor.token(); lower_case(token) != word) {
    cursor.fail("expected " + quote(word) + ", found " + quote(token), "it is truncated or not ASCII STL");
  }
}

PolygonSoup read_ascii(std::span<const std::byte> bytes, const std::string& name) {
  TextCursor cursor(as_text(bytes), name, 0);
  SoupBuilder<TextCursor> soup(cursor);
  expect(cursor, "solid");
  cursor.skip_line();
  bool is_open = true;
  for (std::string_view token = cursor.token(); !token.empty(); token = cursor.token()) {
    const std::string word = lower_case(token);
    if (word == "vertex") {
      read_vertex(cursor, soup);
    } else if (word == "facet") {
      expect(cursor, "normal");
      cursor.token(), cursor.token(), cursor.token();
    } else if (word == "outer") {
      expect(cursor, "loop");
    } else if (word == "endloop") {
      soup.end_polygon();
    } else if (word == "solid" || word == "endsolid") {
      is_open = word == "solid";
      cursor.skip_line();
    } else if (word != "endfacet") {
      cursor.fail("unknown word " + quote(token), "it is corrupt or not ASCII STL; export it again");
    }
  }
  if (is_open || soup.open_corners() != 0) {
    cursor.fail_truncated("'endsolid'");
  }
  return std::move(soup).take();
}

}  // namespace

bool begins_like_stl(std::span<const std::byte> bytes) {
  return without_mark(as_text(bytes)).starts_with("solid");
}

bool has_binary_stl_size(std::span<const std::byte> bytes) {
  return bytes.size() >= kHeaderBytes + 4 &&
         (bytes.size() - kHeaderBytes - 4) / kFacetBytes == binary_count(bytes) &&
         (bytes.size() - kHeaderBytes - 4) % kFacetBytes == 0;
}

PolygonSoup read_stl(std::span<const std::byte> bytes, const std::string& name) {
  TextCursor start(as_text(bytes), name, 0);
  const bool says_solid = lower_case(start.token().substr(0, 6)) == "solid";
  const bool is_text = says_solid && !has_binary_stl_size(bytes) &&
                       (looks_like_text(bytes) || !has_room_for_binary_stl(bytes));
  return is_text ? read_ascii(bytes, name) : read_binary(bytes, name);
}

}  // namespace penumbra::detail
