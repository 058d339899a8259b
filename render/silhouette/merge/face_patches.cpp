#include "render/silhouette/merge/face_patches.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numeric>

#include "mesh/vectors.h"
#include "render/support/kd_order.h"

namespace penumbra::detail {
namespace {

// Accuracy.
/// The most that normals of a patch differ from their mean. Held by the test
/// FacePatches.NoClosedSurfaceIsWithinOne.
constexpr double kMostTilt = 0.5;
/// An error or a thickness that is rounding, over the radius of the patch. Held by the test
/// FacePatches.AFlatSideIsOne.
constexpr double kNothing = 0x1p-36;
/// The difference of unit normals of neighboring faces that lie in one plane, but for rounding to float.
/// Held by the test FacePatches.AFlatSideIsOne.
constexpr double kFlat = 1e-4;

// Speed.
/// The largest patch has 2^(kLevels - 1) times as many flats as the smallest. Seen in the benchmark `growth`.
constexpr std::size_t kLevels = 12;

using Corners = std::array<Vec3, 3>;

Corners corners_of(const TriangleMesh& mesh, std::size_t face) {
  const auto& [a, b, c] = mesh.triangles()[face];
  return {mesh.positions()[a], mesh.positions()[b], mesh.positions()[c]};
}

/// The area as a vector along the normal.
Vec3 area_of(const Corners& c) {
  return 0.5 * glm::cross(c[1] - c[0], c[2] - c[0]);
}

/// Sets of faces that hang together.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The lower number is that of both.
  void join(std::uint32_t i, std::uint32_t j) {
    i = find(i), j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Numbers flats from 0 up, writes its flat's number for each face, and returns how many flats there are.
std::uint32_t number_flats(const TriangleMesh& mesh, std::vector<std::uint32_t>& out) {
  std::vector<Vec3> normals(out.size());
  tbb::parallel_for(std::size_t{0}, out.size(),
                    [&](std::size_t i) { normals[i] = unit(area_of(corners_of(mesh, i))); });
  Sets sets(out.size());
  for (const Edge& e : mesh.edges()) {
    if (e.is_boundary()) continue;
    const Vec3 apart = normals[index(e.left)] - normals[index(e.right)];
    if (glm::dot(apart, apart) < kFlat * kFlat)
      sets.join(static_cast<std::uint32_t>(index(e.left)), static_cast<std::uint32_t>(index(e.right)));
  }
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < out.size(); ++i) {
    const std::uint32_t set = sets.find(i);
    out[i] = set == i ? count++ : out[set];
  }
  return count;
}

struct Placed {
  /// The middle of the flat, and its normal times a length.
  std::array<float, 6> at{};
  std::uint32_t flat = 0;
};

/// Sums over faces that tell the error of a patch: Σ a_f |n_f - m|² = Σ a_f - |Σ a_f n_f|² / Σ a_f.
struct Sums {
  Vec3 areas{0.0};
  double area = 0.0;
  Sums operator+(const Sums& o) const { return {areas + o.areas, area + o.area}; }
  /// Without the part that comes from where the faces lie.
  float error() const {
    const double apart = area > 0.0 ? area - glm::dot(areas, areas) / area : 0.0;
    return static_cast<float>(0.5 * std::sqrt(std::max(0.0, apart)));
  }
};

/// Flats in an order in which every `group` in a row lie close together. The normal counts as a part of the
/// place: flats on two sides of a crease are parted before flats along the surface, unless those lie
/// farther apart than a quarter of the mesh.
std::vector<Placed> placed_flats(const TriangleMesh& mesh, std::uint32_t count,
                                 const std::vector<std::uint32_t>& flat, std::size_t group) {
  // The middle and the normal of each flat.
  std::vector<Vec3> middles(count, Vec3(0.0)), areas(count, Vec3(0.0));
  std::vector<double> weights(count, 0.0);
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const Corners c = corners_of(mesh, i);
    const Vec3 area = area_of(c);
    const double weight = std::max(glm::length(area), std::numeric_limits<double>::min());
    areas[flat[i]] += area;
    middles[flat[i]] += weight / 3.0 * (c[0] + c[1] + c[2]);
    weights[flat[i]] += weight;
  }

  // Sort by both.
  const Bounds box = bounds_of(mesh.positions());
  const double length = 0.25 * box.radius();
  std::vector<Placed> out(count);
  tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t i) {
    const Vec3 middle = middles[i] / weights[i] - box.low, turned = length * unit(areas[i]);
    for (int k = 0; k < 3; ++k) {
      out[i].at[k] = static_cast<float>(middle[k]);
      out[i].at[3 + k] = static_cast<float>(turned[k]);
    }
    out[i].flat = i;
  });
  order_by_place(out.data(), out.data() + out.size(), group);
  return out;
}

}  // namespace

FacePatches::FacePatches(const TriangleMesh& mesh) : corners_(mesh.triangles().size()) {
  // Faces, flat by flat.
  const std::size_t count = mesh.triangles().size();
  std::vector<std::uint32_t> flat(count);
  const std::vector<Placed> placed = placed_flats(mesh, number_flats(mesh, flat), flat, kFewest);
  std::vector<std::uint32_t> sizes(placed.size(), 0), next(placed.size());
  for (const std::uint32_t f : flat) ++sizes[f];
  begins_.push_back(0);
  for (const Placed& p : placed) {
    next[p.flat] = begins_.back();
    begins_.push_back(begins_.back() + sizes[p.flat]);
  }
  order_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) order_[next[flat[i]]++] = i;

  // Lower bounds of the errors of runs of flats, level by level.
  std::vector<Sums> sums((flats() + kFewest - 1) / kFewest);
  tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t node) {
    for (std::size_t i = begins_[node * kFewest]; i < begins_[last_of(0, node)]; ++i) {
      corners_[i] = corners_of(mesh, order_[i]);
      const Vec3 area = area_of(corners_[i]);
      sums[node] = sums[node] + Sums{area, glm::length(area)};
    }
  });
  while (errors_.size() < kLevels) {
    std::vector<float>& errors = errors_.emplace_back();
    for (const Sums& s : sums) errors.push_back(s.error());
    if (sums.size() < 2) break;
    for (std::size_t i = 0; i < sums.size(); i += 2)
      sums[i / 2] = i + 1 < sums.size() ? sums[i] + sums[i + 1] : sums[i];
    sums.resize((sums.size() + 1) / 2);
  }
}

std::size_t FacePatches::last_of(std::size_t level, std::size_t node) const {
  return std::min(((node + 1) * kFewest) << level, flats());
}

FacePatch FacePatches::patch(std::size_t first, std::size_t last) const {
  FacePatch out;
  out.first = FaceId{order_[first]};

  // The mean plane, and the center on it.
  Vec3 sum(0.0), middle(0.0);
  double area = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    const Vec3 face = area_of(corners_[i]);
    const double a = glm::length(face);
    sum += face;
    area += a;
    middle += (a / 3.0) * (corners_[i][0] + corners_[i][1] + corners_[i][2]);
  }
  const double length = glm::length(sum);
  if (!(length > 0.0) || !std::isfinite(area)) return out;
  out.normal = sum / length;
  middle /= area;
  double height = 0.0;  // of the mean plane over the middle
  for (std::size_t i = first; i < last; ++i)
    height += glm::dot(area_of(corners_[i]), corners_[i][0] - middle);
  out.center = middle + (height / length) * out.normal;

  for (std::size_t i = first; i < last; ++i)
    for (const Vec3& p : corners_[i]) {
      out.radius = std::max(out.radius, glm::distance(out.center, p));
      out.thick = std::max(out.thick, std::abs(glm::dot(out.normal, p - out.center)));
    }

  // How far the faces are from it.
  const Vec3 mean = sum / area;
  double errors = 0.0, shifts = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    const Vec3 face = area_of(corners_[i]);
    const double a = glm::length(face);
    if (!(a > 0.0)) continue;
    const Vec3 normal = face / a, turn = normal - mean;
    const double tilt = glm::distance(normal, out.normal);
    const double off = std::abs(glm::dot(normal, corners_[i][0] - out.center));
    if (!(tilt < kMostTilt)) return out;
    out.tilt = std::max(out.tilt, tilt);
    out.spread = std::max(out.spread, off);
    out.turned += (area * a) * glm::outerProduct(turn, turn);
    shifts += a * off * off;
    const double apart = glm::length(turn) + off / out.radius;
    errors += a * apart * apart;
  }
  out.area = length;
  out.shifted = std::sqrt(area * shifts);
  out.error = 0.5 * std::sqrt(errors);
  if (std::max(out.error, out.thick) <= kNothing * out.radius) out.error = 0.0;
  return out;
}

bool FacePatches::add_patch(std::size_t first, std::size_t last, double tolerance, Partition& out,
                            std::vector<FacePatch>& patches) const {
  const FacePatch whole = patch(begins_[first], begins_[last]);
  if (!(whole.error <= tolerance)) return false;
  const auto number = static_cast<std::uint32_t>(order_.size() + patches.size());
  for (std::size_t i = begins_[first]; i < begins_[last]; ++i) out.side[order_[i]] = number;
  patches.push_back(whole);
  return true;
}

void FacePatches::add(std::size_t level, std::size_t node, double tolerance, Partition& out,
                      std::vector<FacePatch>& patches) const {
  const std::size_t first = (node * kFewest) << level, last = last_of(level, node);
  if (first >= last) return;
  if (errors_[level][node] <= tolerance && add_patch(first, last, tolerance, out, patches)) return;
  if (level > 0) {
    add(level - 1, 2 * node, tolerance, out, patches);
    return add(level - 1, 2 * node + 1, tolerance, out, patches);
  }
  for (std::size_t flat = first; flat < last; ++flat) {
    if (begins_[flat + 1] - begins_[flat] > 1 && add_patch(flat, flat + 1, tolerance, out, patches)) continue;
    for (std::size_t i = begins_[flat]; i < begins_[flat + 1]; ++i) out.side[order_[i]] = order_[i];
  }
}

FacePatches::Partition FacePatches::partition(double tolerance) const {
  // The patches of each node of the top level, numbered from 0.
  Partition out;
  out.side.resize(order_.size());
  const std::size_t top = errors_.size() - 1, nodes = errors_[top].size();
  std::vector<std::vector<FacePatch>> patches(nodes);
  tbb::parallel_for(std::size_t{0}, nodes,
                    [&](std::size_t node) { add(top, node, tolerance, out, patches[node]); });

  // All of them in a row.
  for (std::size_t node = 0; node < nodes; ++node) {
    const auto before = static_cast<std::uint32_t>(out.patches.size());
    for (std::size_t i = begins_[(node * kFewest) << top]; i < begins_[last_of(top, node)]; ++i)
      if (out.side[order_[i]] >= order_.size()) out.side[order_[i]] += before;
    out.patches.insert(out.patches.end(), patches[node].begin(), patches[node].end());
  }
  return out;
}

std::size_t FacePatches::count_parts(std::size_t level, std::size_t node, double tolerance) const {
  const std::size_t first = (node * kFewest) << level, last = last_of(level, node);
  if (first >= last) return 0;
  if (errors_[level][node] <= tolerance) return 1;
  if (level == 0) return last - first;
  return count_parts(level - 1, 2 * node, tolerance) + count_parts(level - 1, 2 * node + 1, tolerance);
}

std::size_t FacePatches::count_parts(double tolerance) const {
  const std::size_t top = errors_.size() - 1;
  std::size_t sum = 0;
  for (std::size_t node = 0; node < errors_[top].size(); ++node) sum += count_parts(top, node, tolerance);
  return sum;
}

}  // namespace penumbra::detail
