#include "apps/cli/sun/receiver_set.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>

#include "apps/cli/sun/surface.h"
#include "apps/common/outputs.h"
#include "mesh/io/cursor.h"
#include "mesh/io/formats.h"
#include "mesh/io/npy.h"
#include "mesh/io/read_file.h"
#include "mesh/vectors.h"
#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

/// Adds rows of three or of six numbers and checks them.
class RowTaker {
 public:
  explicit RowTaker(std::string name) : name_(std::move(name)) {}

  void take(std::span<const double> row, const std::string& where) {
    if (row.size() != 3 && row.size() != 6)
      detail::fail_reading(name_, where, "has " + std::to_string(row.size()) + " numbers",
                           "give x, y, z, or x, y, z and a normal");
    if (columns_ != 0 && row.size() != columns_)
      detail::fail_reading(
          name_, where,
          "has " + std::to_string(row.size()) + " numbers, the first point has " + std::to_string(columns_),
          "give normals to all points or to none");
    columns_ = row.size();
    if (!std::ranges::all_of(row, [](double x) { return std::isfinite(x); }))
      detail::fail_reading(name_, where, "has a number that is not finite", "give finite numbers");
    set_.points.emplace_back(row[0], row[1], row[2]);
    if (columns_ == 3) return;
    const Vec3 n(row[3], row[4], row[5]);
    if (!(glm::length(n) > 0.0 && std::isfinite(glm::length(n))))
      detail::fail_reading(name_, where, "has a normal of length 0 or too long", "give a direction");
    set_.normals.push_back(glm::normalize(n));
  }
  ReceiverSet finish() && {
    if (set_.points.empty()) detail::fail_reading(name_, "", "has no points", "give at least one");
    return std::move(set_);
  }

 private:
  std::string name_;
  std::size_t columns_ = 0;
  ReceiverSet set_;
};

/// The numbers of a line, with one comma or semicolon, or blanks, between two of them. False where something
/// is no number; `out` then has those before it.
bool numbers_of(std::string_view line, std::vector<double>& out) {
  out.clear();
  const auto skip_blanks = [&line] {
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
  };
  for (skip_blanks(); !line.empty(); skip_blanks()) {
    const std::size_t end = std::min(line.find_first_of(",; \t\r"), line.size());
    double value = 0.0;
    if (!detail::parse_number(line.substr(0, end), value)) return false;
    out.push_back(value);
    line.remove_prefix(end);
    skip_blanks();
    if (line.starts_with(',') || line.starts_with(';')) line.remove_prefix(1);
  }
  return true;
}

ReceiverSet read_csv(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = detail::read_bytes(path);
  std::string_view text = detail::without_mark(detail::as_text(bytes));
  RowTaker taker(path.string());
  std::vector<double> row;
  bool may_be_names = true;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view content = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const bool good = numbers_of(content, row);
    if (content.starts_with('#') || (good && row.empty())) continue;
    const std::string where = "line " + std::to_string(line);
    if (!good && !(may_be_names && row.empty()))
      detail::fail_reading(path.string(), where, detail::quote(content) + " has something that is no number",
                           "separate numbers by commas; begin comments with #");
    may_be_names = false;
    if (good) taker.take(row, where);
  }
  return std::move(taker).finish();
}

ReceiverSet read_npy(const std::filesystem::path& path) {
  const detail::NpyRows array = detail::read_npy_rows(
      path, "save it by numpy.save as an array of float32 or float64 of shape (n, 3) or (n, 6)");
  RowTaker taker(path.string());
  for (std::size_t i = 0; i < array.rows; ++i)
    taker.take(std::span(array.values).subspan(i * array.columns, array.columns), "row " + std::to_string(i));
  return std::move(taker).finish();
}

ReceiverSet read_ply(const std::filesystem::path& path) {
  const PolygonSoup soup = detail::read_ply(detail::read_bytes(path), path.string());
  const bool has_normals = soup.normals.size() == soup.positions.size();
  RowTaker taker(path.string());
  for (std::size_t i = 0; i < soup.positions.size(); ++i) {
    const Vec3& p = soup.positions[i];
    std::vector<double> row = {p.x, p.y, p.z};
    if (has_normals) row.insert(row.end(), {soup.normals[i].x, soup.normals[i].y, soup.normals[i].z});
    taker.take(row, "vertex " + std::to_string(i));
  }
  return std::move(taker).finish();
}

void add_faces(const Surface& surface, ReceiverSet& out) {
  const auto& p = surface.positions;
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    const IndexedTriangle& t = surface.triangles[f];
    const Vec3 n = surface.cross(f);
    if (n == Vec3(0.0)) continue;  // without area
    out.points.push_back((p[t[0]] + p[t[1]] + p[t[2]]) / 3.0);
    out.normals.push_back(detail::unit(n));
    out.objects.push_back(surface.objects[f]);
    out.faces.push_back(surface.faces[f]);
  }
}

void add_vertices(const Surface& surface, ReceiverSet& out) {
  std::vector<Vec3> sums(surface.positions.size(), Vec3(0.0));
  std::vector<std::uint32_t> last(surface.positions.size(), 0);
  for (std::uint32_t f = 0; f < surface.triangles.size(); ++f)
    for (const std::uint32_t v : surface.triangles[f]) {
      sums[v] += surface.cross(f);
      last[v] = f;
    }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    if (sums[v] == Vec3(0.0)) continue;
    out.points.push_back(surface.positions[v]);
    out.normals.push_back(detail::unit(sums[v]));
    out.objects.push_back(surface.objects[last[v]]);
    out.faces.push_back(surface.faces[last[v]]);
  }
}

}  // namespace

ReceiverSet read_receivers(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".csv" || extension == ".txt") return read_csv(path);
  if (extension == ".npy") return read_npy(path);
  if (extension == ".ply") return read_ply(path);
  throw UsageError(path.string() + ": points are read from .csv, .npy or .ply; choose one of these");
}

ReceiverSet receivers_on(const Scene& scene, const std::string& object, ReceiverPlace place) {
  ReceiverSet out;
  (place == ReceiverPlace::kFaces ? add_faces : add_vertices)(surface_of(scene, object), out);
  return out;
}

}  // namespace penumbra::apps
