// Cursors over text and bytes that nobody vouches for. They never leave their buffer, and say where they are
// when something is wrong. Every failure is a MeshError of one line: "file: line 12: what; what to do".
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "penumbra/mesh/io/polygon_soup.h"

namespace penumbra::detail {

/// Throws MeshError. `where` may be empty ("line 12" or "byte 340" otherwise).
[[noreturn]] void fail_reading(const std::string& name, const std::string& where, const std::string& what,
                               const std::string& advice);
/// Text from a file, made fit for a message: printable, at most 32 characters, in quotes.
std::string quote(std::string_view text);
std::string_view as_text(std::span<const std::byte> bytes);
/// Without the byte order mark that some editors put before UTF-8.
std::string_view without_mark(std::string_view text);

/// A decimal number that takes up the whole token, a leading + allowed; infinite where it overflows, 0 where
/// it underflows. What Microsoft's libraries wrote for no number and for infinity counts (-1.#IND, 1.#QNAN,
/// 1.#INF). Returns false where the token is no number. The locale plays no part.
bool parse_number(std::string_view token, double& value);
bool parse_number(std::string_view token, std::int64_t& value);

/// Tokens and lines. Lines end in \n, \r\n or \r; a comment runs from `comment` (0 for none) to the end of
/// its line.
class TextCursor {
 public:
  TextCursor(std::string_view text, std::string name, char comment, bool joins_lines = false);

  /// The next token of this line; empty at its end.
  std::string_view token_of_line();
  /// The tokens that are left on this line, one blank between them.
  std::string rest_of_line();
  /// The same as a name, which may have the comment's character: a comment begins where blanks are around it.
  std::string name_of_line();
  /// The next token, on whichever line; empty at the end of the text.
  std::string_view token();
  void skip_line();
  bool at_end() const { return at_ == text_.size(); }

  /// Numbers, on whichever line. `what` names the value in the message ("a coordinate of vertex 3").
  double number(const std::string& what);
  std::int64_t integer(const std::string& what);

  /// Where the cursor is, for messages.
  static constexpr const char* kPlace = "line ";
  std::size_t place() const { return line_; }
  std::size_t offset() const { return at_; }
  std::size_t remaining() const { return text_.size() - at_; }
  const std::string& name() const { return name_; }
  [[noreturn]] void fail(const std::string& what, const std::string& advice) const;
  [[noreturn]] void fail_truncated(const std::string& expected) const;

 private:
  void skip_blanks();
  bool begins_comment(std::size_t token) const;
  std::string_view text_;
  std::string name_;
  char comment_;
  bool joins_lines_;  ///< a backslash at the end of a line continues it
  std::size_t at_ = 0, line_ = 1;
};

/// Numbers in binary.
class ByteCursor {
 public:
  ByteCursor(std::span<const std::byte> bytes, std::string name, std::endian order)
      : bytes_(bytes), name_(std::move(name)), swap_(order != std::endian::native) {}

  template <class T>
  T read() {
    if (remaining() < sizeof(T)) {
      fail("the file ends in the middle of the data", "it is truncated; copy or export it again");
    }
    std::byte raw[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      raw[swap_ ? sizeof(T) - 1 - i : i] = bytes_[at_ + i];
    }
    at_ += sizeof(T);
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }
  void skip(std::size_t count) { at_ += std::min(count, remaining()); }
  std::size_t remaining() const { return bytes_.size() - at_; }
  static constexpr const char* kPlace = "byte ";
  std::size_t place() const { return at_; }
  const std::string& name() const { return name_; }
  [[noreturn]] void fail(const std::string& what, const std::string& advice) const {
    fail_reading(name_, "byte " + std::to_string(at_), what, advice);
  }

 private:
  std::span<const std::byte> bytes_;
  std::string name_;
  bool swap_;
  std::size_t at_ = 0;
};

/// Collects a soup and checks each coordinate and index as it comes.
template <class Cursor>
class SoupBuilder {
 public:
  explicit SoupBuilder(const Cursor& cursor) : cursor_(cursor) { soup_.first_corner.push_back(0); }

  std::size_t vertex_count() const { return soup_.positions.size(); }
  std::size_t polygon_count() const { return soup_.polygon_count(); }
  /// Only for counts already checked against the size of the file.
  void reserve(std::size_t vertices, std::size_t polygons) {
    soup_.positions.reserve(vertices);
    soup_.first_corner.reserve(polygons + 1);
    soup_.corners.reserve(3 * polygons);
  }
  void add_vertex(const Vec3& p);
  /// `vertex` counts from 0. Whether there is such a vertex is checked at the end, since faces may come
  /// first.
  void add_corner(std::int64_t vertex);
  /// A normal that is not finite, or zero, counts as none.
  void add_normal(const Vec3& n) { soup_.normals.push_back(n); }
  std::size_t normal_count() const { return soup_.normals.size(); }
  /// Of the corner that was added last; from 0, in any range.
  void give_corner_normal(std::int64_t normal) {
    soup_.corner_normals.resize(soup_.corners.size() - 1, PolygonSoup::kNoNormal);
    soup_.corner_normals.push_back(normal >= 0 && normal < std::int64_t{PolygonSoup::kNoNormal}
                                       ? static_cast<std::uint32_t>(normal)
                                       : PolygonSoup::kNoNormal);
  }
  /// The normals are those of vertices, in their order.
  void give_vertices_normals() { vertices_have_normals_ = true; }
  void end_polygon() {
    soup_.first_corner.push_back(static_cast<std::uint32_t>(soup_.corners.size()));
    if (!soup_.materials.empty()) soup_.polygon_material.push_back(material_);
  }
  /// Of the polygons that follow.
  void use_material(const std::string& name);
  void name_material_file(const std::string& file) { soup_.material_files.push_back(file); }
  std::size_t open_corners() const { return soup_.corners.size() - soup_.first_corner.back(); }
  void ignore(const char* what) {
    if (std::ranges::find(soup_.ignored, what) == soup_.ignored.end()) soup_.ignored.emplace_back(what);
  }
  /// Fails where a face uses a vertex that is not finite; others of that kind become 0.
  PolygonSoup take() &&;

 private:
  struct Place {
    std::size_t vertex, place;
  };
  static constexpr std::size_t kMost = 0xFFFFFFFEu;
  void settle_normals();
  const Cursor& cursor_;
  PolygonSoup soup_;
  bool vertices_have_normals_ = false;
  std::vector<Place> not_finite_;
  std::map<std::string, std::uint32_t> material_numbers_;
  std::uint32_t material_ = PolygonSoup::kNoMaterial;
};

template <class Cursor>
void SoupBuilder<Cursor>::add_vertex(const Vec3& p) {
  if (vertex_count() >= kMost) {
    cursor_.fail("more vertices than can be numbered", "split the mesh");
  }
  // x - x is 0 for every finite x and NaN for any other.
  const bool finite = p.x - p.x == 0.0 && p.y - p.y == 0.0 && p.z - p.z == 0.0;
  if (!finite) not_finite_.push_back({vertex_count(), cursor_.place()});
  soup_.positions.push_back(finite ? p : Vec3(0.0));
}

template <class Cursor>
void SoupBuilder<Cursor>::add_corner(std::int64_t vertex) {
  if (vertex < 0 || vertex >= static_cast<std::int64_t>(kMost) || soup_.corners.size() >= kMost) {
    cursor_.fail("face " + std::to_string(polygon_count()) + " uses vertex " + std::to_string(vertex) +
                     ", which cannot exist",
                 "correct the indices");
  }
  soup_.corners.push_back(static_cast<std::uint32_t>(vertex));
}

template <class Cursor>
void SoupBuilder<Cursor>::use_material(const std::string& name) {
  if (soup_.materials.empty()) soup_.polygon_material.assign(polygon_count(), PolygonSoup::kNoMaterial);
  const auto number = static_cast<std::uint32_t>(soup_.materials.size());
  const auto [found, is_new] = material_numbers_.try_emplace(name, number);
  if (is_new) soup_.materials.push_back({.name = name});
  material_ = found->second;
}

template <class Cursor>
PolygonSoup SoupBuilder<Cursor>::take() && {
  std::vector<bool> used(not_finite_.empty() ? 0 : vertex_count(), false);
  for (const std::uint32_t vertex : soup_.corners)
    if (vertex < used.size()) used[vertex] = true;
  for (const auto& [vertex, place] : not_finite_)
    if (used[vertex])
      fail_reading(cursor_.name(), Cursor::kPlace + std::to_string(place),
                   "vertex " + std::to_string(vertex) + " has a coordinate that is not finite",
                   "export the mesh without NaN, infinity or overflow");
  settle_normals();
  return std::move(soup_);
}

template <class Cursor>
void SoupBuilder<Cursor>::settle_normals() {
  std::vector<std::uint32_t>& of_corners = soup_.corner_normals;
  if (vertices_have_normals_ && soup_.corners.empty()) return;  // points without faces keep theirs
  if (vertices_have_normals_) of_corners = soup_.corners;
  if (!of_corners.empty()) of_corners.resize(soup_.corners.size(), PolygonSoup::kNoNormal);
  const auto is_normal = [&](std::uint32_t i) {
    if (i >= soup_.normals.size()) return false;
    const double sum =
        std::abs(soup_.normals[i].x) + std::abs(soup_.normals[i].y) + std::abs(soup_.normals[i].z);
    return sum > 0.0 && sum - sum == 0.0;
  };
  for (std::uint32_t& i : of_corners)
    if (!is_normal(i)) i = PolygonSoup::kNoNormal;
  if (std::ranges::all_of(of_corners, [](std::uint32_t i) { return i == PolygonSoup::kNoNormal; })) {
    of_corners.clear();
    soup_.normals.clear();
  }
}

}  // namespace penumbra::detail
