// Object File Format (Geomview): OFF, COFF, NOFF, STOFF and combinations, or no header word at all in a file
// named .off. The first count may be glued to the header word. Each vertex and each face ends its line:
// normals are read, colors and texture coordinates behind them are skipped.
#include "mesh/io/cursor.h"
#include "mesh/io/formats.h"

namespace penumbra::detail {
namespace {

/// The header word, and what is glued to it ("OFF4": the number of vertices).
struct Keyword {
  std::string_view word, glued;
};

/// An empty word where the token is none.
Keyword split_keyword(std::string_view token) {
  std::string_view rest = token;
  for (const std::string_view prefix : {"ST", "C", "N", "4", "n"}) {
    if (rest.starts_with(prefix)) {
      rest.remove_prefix(prefix.size());
    }
  }
  if (!rest.starts_with("OFF")) return {};
  rest.remove_prefix(3);
  std::int64_t count = 0;
  if (!rest.empty() && !parse_number(rest, count)) return {};
  return {token.substr(0, token.size() - rest.size()), rest};
}

struct Counts {
  std::size_t vertices = 0;
  bool has_normals = false;
};

Counts read_header(TextCursor& cursor, SoupBuilder<TextCursor>& soup) {
  Counts counts;
  std::string_view token = cursor.token();
  const Keyword keyword = split_keyword(token);
  if (!keyword.word.empty()) {
    if (keyword.word.find_first_of("4n") != std::string_view::npos) {
      cursor.fail("vertices of other than three dimensions (" + quote(keyword.word) + ")",
                  "save it as plain OFF");
    }
    if (keyword.word.starts_with("ST")) soup.ignore("texture coordinates");
    if (keyword.word.find('C') != std::string_view::npos) soup.ignore("colors");
    if (keyword.word.find('N') != std::string_view::npos) counts.has_normals = true;
    token = keyword.glued.empty() ? cursor.token() : keyword.glued;
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
  counts.vertices = static_cast<std::size_t>(count);
  return counts;
}

/// The numbers behind a vertex, on its line.
void read_normal(TextCursor& cursor, SoupBuilder<TextCursor>& soup) {
  Vec3 n(0.0);
  for (int k = 0; k < 3; ++k)
    if (!parse_number(cursor.token_of_line(), n[k])) n = Vec3(0.0);
  soup.add_normal(n);
}

/// The number of edges means nothing. It may be missing, or stand on a line of its own.
void skip_edge_count(TextCursor& cursor) {
  const bool on_this_line = !cursor.token_of_line().empty();
  cursor.skip_line();
  if (on_this_line) return;
  TextCursor ahead = cursor;
  std::int64_t edges = 0;
  if (!parse_number(ahead.token(), edges) || !ahead.token_of_line().empty()) return;
  ahead.skip_line();
  cursor = ahead;
}

void check_count(const TextCursor& cursor, std::size_t count, std::size_t bytes_each, const char* what) {
  if (count > (cursor.remaining() + 1) / bytes_each) {
    cursor.fail("the header promises " + std::to_string(count) + " " + what + ", more than the file can hold",
                "it is truncated or corrupt; export it again");
  }
}

}  // namespace

bool begins_like_off(std::span<const std::byte> bytes) {
  return !split_keyword(TextCursor(as_text(bytes), {}, '#').token()).word.empty();
}

PolygonSoup read_off(std::span<const std::byte> bytes, const std::string& name) {
  TextCursor cursor(as_text(bytes), name, '#');
  SoupBuilder<TextCursor> soup(cursor);
  const auto [vertices, has_normals] = read_header(cursor, soup);
  if (has_normals) soup.give_vertices_normals();
  const std::int64_t face_count = cursor.integer("the number of faces");
  if (face_count < 0) {
    cursor.fail("the number of faces is negative", "correct the header");
  }
  const auto faces = static_cast<std::size_t>(face_count);
  skip_edge_count(cursor);
  check_count(cursor, vertices, 6, "vertices");
  check_count(cursor, faces, 2, "faces");
  soup.reserve(vertices, 0);
  while (soup.vertex_count() < vertices) {
    const std::string what = "a coordinate of vertex " + std::to_string(soup.vertex_count());
    const double x = cursor.number(what), y = cursor.number(what), z = cursor.number(what);
    soup.add_vertex({x, y, z});
    if (has_normals) read_normal(cursor, soup);
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
