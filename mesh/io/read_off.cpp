// Object File Format (Geomview): OFF, COFF, NOFF, STOFF and combinations, or no header word at all in a file
// named .off. Each vertex and each face ends its line: normals, colors and texture coordinates after them
// are skipped.
#include "mesh/io/cursor.h"
#include "mesh/io/formats.h"

namespace penumbra::detail {
namespace {

bool is_off_keyword(std::string_view token) {
  for (const std::string_view prefix : {"ST", "C", "N", "4", "n"}) {
    if (token.starts_with(prefix)) {
      token.remove_prefix(prefix.size());
    }
  }
  return token == "OFF";
}

/// Returns the first token of the counts, if the header's line was read over.
std::size_t read_header(TextCursor& cursor) {
  std::string_view token = cursor.token();
  if (is_off_keyword(token)) {
    if (token.find_first_of("4n") != std::string_view::npos) {
      cursor.fail("vertices of other than three dimensions (" + quote(token) + ")", "save it as plain OFF");
    }
    token = cursor.token();
  }
  if (token == "BINARY") {
    cursor.fail("binary OFF is not read", "save it as text, or as PLY");
  }
  std::int64_t count = 0;
  if (token.empty()) {
    cursor.fail_truncated("the number of vertices");
  }
  if (!parse_number(token, count) || count < 0) {
    cursor.fail("the number of vertices is " + quote(token), "an OFF file begins with OFF and three counts");
  }
  return static_cast<std::size_t>(count);
}

void check_count(const TextCursor& cursor, std::size_t count, std::size_t bytes_each, const char* what) {
  if (count > (cursor.remaining() + 1) / bytes_each) {
    cursor.fail("the header promises " + std::to_string(count) + " " + what + ", more than the file can hold",
                "it is truncated or corrupt; export it again");
  }
}

}  // namespace

bool begins_like_off(std::span<const std::byte> bytes) {
  return is_off_keyword(TextCursor(as_text(bytes), {}, '#').token());
}

PolygonSoup read_off(std::span<const std::byte> bytes, const std::string& name) {
  TextCursor cursor(as_text(bytes), name, '#');
  SoupBuilder<TextCursor> soup(cursor);
  const std::size_t vertices = read_header(cursor);
  const std::int64_t face_count = cursor.integer("the number of faces");
  if (face_count < 0) {
    cursor.fail("the number of faces is negative", "correct the header");
  }
  const auto faces = static_cast<std::size_t>(face_count);
  cursor.skip_line();  // the number of edges, if given, means nothing
  check_count(cursor, vertices, 6, "vertices");
  check_count(cursor, faces, 2, "faces");
  soup.reserve(vertices, 0);
  while (soup.vertex_count() < vertices) {
    const std::string what = "a coordinate of vertex " + std::to_string(soup.vertex_count());
    const double x = cursor.number(what), y = cursor.number(what), z = cursor.number(what);
    soup.add_vertex({x, y, z});
    cursor.skip_line();
  }
  while (soup.polygon_count() < faces) {
    const std::string face = "face " + std::to_string(soup.polygon_count());
    const std::int64_t corners = cursor.integer("the number of corners of " + face);
    if (corners < 0) {
      cursor.fail("the number of corners of " + face + " is negative", "correct that line");
    }
    check_count(cursor, static_cast<std::size_t>(corners), 2, "corners of one face");
    const std::string what = "a corner of " + face;
    for (std::int64_t k = 0; k < corners; ++k) {
      soup.add_corner(cursor.integer(what));
    }
    soup.end_polygon();
    cursor.skip_line();
  }
  return std::move(soup).take();
}

}  // namespace penumbra::detail
