#include "render/center_view/shadow_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

namespace penumbra::detail {
namespace {

/// The part of a triangle in front of the light, in local coordinates: up to four corners.
std::size_t clip_at_light(const Vec3* corners, const LightProjection& projection, std::array<Vec3, 4>& out) {
  std::size_t count = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &p = corners[i], &q = corners[(i + 1) % 3];
    const double at_p = projection.weight(p) - kLeastWeight, at_q = projection.weight(q) - kLeastWeight;
    if (at_p >= 0.0) out[count++] = p;
    if ((at_p >= 0.0) != (at_q >= 0.0)) out[count++] = p + (at_p / (at_p - at_q)) * (q - p);
  }
  return count;
}

/// Calls `part(places, heights, corners)` with what is in front of the light of every face of a mesh from
/// `first` to `last`.
template <class Part>
void for_each_part(const TriangleMesh& mesh, const LightProjection& projection, std::size_t first,
                   std::size_t last, const Part& part) {
  for (std::size_t i = first; i < last; ++i) {
    const IndexedTriangle& t = mesh.triangles()[i];
    const std::array<Vec3, 3> local{projection.local(mesh.positions()[t[0]]),
                                    projection.local(mesh.positions()[t[1]]),
                                    projection.local(mesh.positions()[t[2]])};
    std::array<Vec3, 4> corners;
    const std::size_t count = clip_at_light(local.data(), projection, corners);
    if (count < 3) continue;
    std::array<glm::dvec2, 4> q;
    std::array<double, 4> h;
    for (std::size_t k = 0; k < count; ++k) {
      const double weight = projection.weight(corners[k]);
      q[k] = projection.place(corners[k]) / weight;
      h[k] = -corners[k].z / weight;
    }
    part(q, h, count);
  }
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

void MapWindow::add(const glm::dvec2& q) {
  low = {std::min(low.x, q.x), std::min(low.y, q.y)};
  high = {std::max(high.x, q.x), std::max(high.y, q.y)};
}

CasterReach reach_of_casters(const Scene& scene, const LightProjection& projection) {
  CasterReach out;
  for (const SceneObject& object : scene.objects)
    if (object.casts)
      for_each_part(object.mesh, projection, 0, object.mesh.triangles().size(),
                    [&](const auto& q, const auto& h, std::size_t count) {
                      for (std::size_t k = 0; k < count; ++k) {
                        out.window.add(q[k]);
                        out.top = std::max(out.top, h[k]);
                        out.bottom = std::min(out.bottom, h[k]);
                      }
                    });
  return out;
}

ShadowMap::ShadowMap(const Scene& scene, const LightProjection& projection, const MapWindow& window, int size,
                     tbb::task_arena& threads, Drawn drawn, const ShadowMap* above)
    : window_(window),
      size_(size),
      above_(above),
      per_texel_(size / (window.high.x - window.low.x), size / (window.high.y - window.low.y)),
      texels_(std::make_unique<std::uint32_t[]>(static_cast<std::size_t>(size) *
                                                static_cast<std::size_t>(size))) {
  threads.execute([&] {
    for (const SceneObject& object : scene.objects)
      if (object.casts || drawn == Drawn::kAll) fill_mesh(object.mesh, projection);
  });
  above_ = nullptr;
}

void ShadowMap::raise_empty(const glm::dvec2& q, double height) {
  const glm::dvec2 p = texels_to(q);
  if (!(p.x >= 0.0 && p.y >= 0.0 && p.x < size_ && p.y < size_)) return;
  std::uint32_t& texel = texels_[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(size_) +
                                 static_cast<std::size_t>(p.x)];
  if (texel == 0) texel = encoded(static_cast<float>(height));
}

TexelRange ShadowMap::texels_in(const glm::dvec2& low, const glm::dvec2& high) const {
  const auto texel_at = [&](double x) {
    return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(size_)));
  };
  const glm::dvec2 from = texels_to(low), to = texels_to(high);
  return {texel_at(from.x), std::min(size_, texel_at(to.x) + 1), texel_at(from.y),
          std::min(size_, texel_at(to.y) + 1)};
}

void ShadowMap::fill_mesh(const TriangleMesh& mesh, const LightProjection& projection) {
  constexpr std::size_t kFacesPerTask = 256;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.triangles().size(), kFacesPerTask),
                    [&](const auto& range) {
                      for_each_part(mesh, projection, range.begin(), range.end(),
                                    [&](const auto& q, const auto& h, std::size_t count) {
                                      for (std::size_t k = 2; k < count; ++k) {
                                        const glm::dvec2 places[3] = {q[0], q[k - 1], q[k]};
                                        const double heights[3] = {h[0], h[k - 1], h[k]};
                                        fill(places, heights);
                                      }
                                    });
                    });
}

/// Texels whose centers lie in the triangle; a center on a side belongs to both of its faces.
void ShadowMap::fill(const glm::dvec2* q, const double* h) {
  const glm::dvec2 a = (q[0] - window_.low) * per_texel_, b = (q[1] - window_.low) * per_texel_,
                   c = (q[2] - window_.low) * per_texel_;
  const double area = cross(b - a, c - a);
  if (area == 0.0 || !std::isfinite(area)) return;
  const auto texel_at = [&](double x) {
    return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(size_)));
  };
  const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
  const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
  const int end_x = std::min(size_, texel_at(high_x) + 1), end_y = std::min(size_, texel_at(high_y) + 1);
  for (int y = texel_at(low_y); y < end_y; ++y)
    for (int x = texel_at(low_x); x < end_x; ++x) {
      const glm::dvec2 p(x + 0.5, y + 0.5);
      const double of_a = cross(b - p, c - p) / area, of_b = cross(c - p, a - p) / area,
                   of_c = cross(a - p, b - p) / area;
      if (!(of_a >= 0.0 && of_b >= 0.0 && of_c >= 0.0)) continue;
      raise(static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(x),
            static_cast<float>(of_a * h[0] + of_b * h[1] + of_c * h[2]));
    }
}

void ShadowMap::raise(std::size_t texel, float height) {
  if (above_ && !(height < decoded(above_->texels_[texel]) - kSameSurface * this->texel())) return;
  const std::atomic_ref<std::uint32_t> at(texels_[texel]);
  const std::uint32_t code = encoded(height);
  std::uint32_t was = at.load(std::memory_order_relaxed);
  while (was < code && !at.compare_exchange_weak(was, code, std::memory_order_relaxed)) {
  }
}

std::uint32_t ShadowMap::encoded(float height) {
  const auto bits = std::bit_cast<std::uint32_t>(height);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

float ShadowMap::decoded(std::uint32_t code) {
  if (code == 0) return kNothing;
  return std::bit_cast<float>(code & 0x80000000u ? code & 0x7fffffffu : ~code);
}

double ShadowMap::texel() const {
  return std::max(1.0 / per_texel_.x, 1.0 / per_texel_.y);
}

TexturePicture ShadowMap::picture() const {
  TexturePicture out{.name = "shadow map, bright near the light", .size = size_, .values = {}};
  const std::size_t count = texels();
  float low = 3e38f, high = -3e38f;
  for (std::size_t i = 0; i < count; ++i)
    if (texels_[i] != 0) low = std::min(low, decoded(texels_[i])), high = std::max(high, decoded(texels_[i]));
  out.values.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    if (texels_[i] != 0)
      out.values[i] = static_cast<std::uint8_t>(
          high > low ? 40.0f + 215.0f * (decoded(texels_[i]) - low) / (high - low) : 255.0f);
  return out;
}

}  // namespace penumbra::detail
