// Wavefront OBJ: v, vn and f (v, v/vt, v//vn, v/vt/vn, negative indices count back from the last vertex so
// far), usemtl and mtllib; everything else is skipped. A backslash at the end of a line continues it.
#include <utility>

#include "mesh/io/cursor.h"
#include "mesh/io/formats.h"

namespace penumbra::detail {
namespace {

void read_vertex(TextCursor& cursor, SoupBuilder<TextCursor>& soup) {
  Vec3 p(0.0);
  for (int k = 0; k < 3; ++k) {
    const std::string_view token = cursor.token_of_line();
    if (token.empty() || !parse_number(token, p[k])) {
      cursor.fail(
          "vertex " + std::to_string(soup.vertex_count()) + " needs three numbers, found " + quote(token),
          "correct that line");
    }
  }
  soup.add_vertex(p);  // w and colors may follow
}

void read_normal(TextCursor& cursor, SoupBuilder<TextCursor>& soup) {
  Vec3 n(0.0);
  for (int k = 0; k < 3; ++k)
    if (!parse_number(cursor.token_of_line(), n[k])) n = Vec3(0.0);
  soup.add_normal(n);
}

/// The third number of v//vn and v/vt/vn, if there is one.
void read_corner_normal(std::string_view token, SoupBuilder<TextCursor>& soup) {
  const std::size_t first = token.find('/'), second = token.find('/', first + 1);
  std::int64_t number = 0;
  if (first == token.npos || second == token.npos || !parse_number(token.substr(second + 1), number) ||
      number == 0)
    return;
  soup.give_corner_normal(number > 0 ? number - 1 : static_cast<std::int64_t>(soup.normal_count()) + number);
}

/// What people may miss of what is skipped.
void name_ignored(std::string_view keyword, SoupBuilder<TextCursor>& soup) {
  static constexpr std::pair<std::string_view, const char*> kKnown[] = {{"vt", "texture coordinates"},
                                                                        {"l", "lines"},
                                                                        {"p", "points"},
                                                                        {"curv", "free-form curves"},
                                                                        {"curv2", "free-form curves"},
                                                                        {"surf", "free-form surfaces"}};
  for (const auto& [name, what] : kKnown)
    if (keyword == name) soup.ignore(what);
}

void read_face(TextCursor& cursor, SoupBuilder<TextCursor>& soup) {
  for (std::string_view token = cursor.token_of_line(); !token.empty(); token = cursor.token_of_line()) {
    std::int64_t number = 0;
    if (!parse_number(token.substr(0, token.find('/')), number) || number == 0) {
      cursor.fail("face " + std::to_string(soup.polygon_count()) + " has the corner " + quote(token) +
                      ", whose vertex is not a number other than 0",
                  "write v, v/vt, v//vn or v/vt/vn, counted from 1");
    }
    soup.add_corner(number > 0 ? number - 1 : static_cast<std::int64_t>(soup.vertex_count()) + number);
    read_corner_normal(token, soup);
  }
  soup.end_polygon();
}

}  // namespace

PolygonSoup read_obj(std::span<const std::byte> bytes, const std::string& name) {
  TextCursor cursor(as_text(bytes), name, '#', true);
  SoupBuilder<TextCursor> soup(cursor);
  while (!cursor.at_end()) {
    const std::string_view keyword = cursor.token_of_line();
    if (keyword == "v") {
      read_vertex(cursor, soup);
    } else if (keyword == "vn") {
      read_normal(cursor, soup);
    } else if (keyword == "f") {
      read_face(cursor, soup);
    } else if (keyword == "usemtl") {
      soup.use_material(cursor.name_of_line());
    } else if (keyword == "mtllib") {
      soup.name_material_file(cursor.name_of_line());
    } else {
      name_ignored(keyword, soup);
    }
    cursor.rest_of_line();  // not skip_line: what is skipped may be continued
    cursor.skip_line();
  }
  return std::move(soup).take();
}

}  // namespace penumbra::detail
