#include "penumbra/render/bake/texture_atlas.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "penumbra/mesh/error.h"
#include "render/bake/charts.h"

namespace penumbra {
namespace {

using detail::Chart;

constexpr int kMostSide = 16'384;

/// Charts as rectangles of whole texels, in rows from the top, the highest first.
class Rows {
 public:
  struct Place {
    int x = 0, y = 0, width = 1, height = 1;
  };

  /// `width`: texels of a row; nothing is higher than `most` rows.
  Rows(const std::vector<Chart>& charts, double texel, int padding, int width) : places_(charts.size()) {
    std::vector<std::size_t> order(charts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = 0; i < charts.size(); ++i) {
      places_[i].width = texels(charts[i].extent.x, texel);
      places_[i].height = texels(charts[i].extent.y, texel);
    }
    std::ranges::stable_sort(order, [&](std::size_t i, std::size_t j) {
      const Place &a = places_[i], &b = places_[j];
      return a.height != b.height ? a.height > b.height : a.width > b.width;
    });
    const int edge = (padding + 1) / 2;
    std::int64_t x = edge, y = edge, row = 0;
    for (const std::size_t i : order) {
      Place& place = places_[i];
      if (x > edge && x + place.width + edge > width) {
        x = edge;
        y += row + padding;
        row = 0;
      }
      fits_ = fits_ && x + place.width + edge <= width && y + place.height + edge <= kMostSide;
      if (!fits_) return;
      place.x = static_cast<int>(x), place.y = static_cast<int>(y);
      x += place.width + padding;
      row = std::max<std::int64_t>(row, place.height);
    }
    height_ = static_cast<int>(y + row + edge);
  }

  bool fits(int height) const { return fits_ && height_ <= height; }
  int height() const { return height_; }
  const std::vector<Place>& places() const { return places_; }

 private:
  static int texels(double length, double texel) {
    return static_cast<int>(std::clamp(std::ceil(length / texel), 1.0, 2.0 * kMostSide));
  }

  std::vector<Place> places_;
  int height_ = 0;
  bool fits_ = true;
};

double area_of(const std::vector<Chart>& charts) {
  double area = 0.0;
  for (const Chart& chart : charts) area += chart.extent.x * chart.extent.y;
  return area;
}

double longest_of(const std::vector<Chart>& charts) {
  double longest = 0.0;
  for (const Chart& chart : charts) longest = std::max({longest, chart.extent.x, chart.extent.y});
  return longest;
}

void require_area(const std::vector<Chart>& charts) {
  const double area = area_of(charts);
  if (area > 0.0 && std::isfinite(area)) return;  // of what has no normal, for it is too small, it is neither
  throw UsageError("no face is large enough to be put in charts; use another unit of length");
}

/// The least side of texels, to 1 part in a thousand, with which all charts fit into the square.
double finest_texel(const std::vector<Chart>& charts, const AtlasOptions& options) {
  const auto fits = [&](double texel) {
    return Rows(charts, texel, options.padding, options.size).fits(options.size);
  };
  double low = std::sqrt(area_of(charts)) / options.size, high = low;
  while (!fits(high)) {
    if (high > longest_of(charts))
      throw UsageError("a texture of " + std::to_string(options.size) + "x" + std::to_string(options.size) +
                       " texels has no room for " + std::to_string(charts.size()) +
                       " charts; make it larger, or the charts larger by a greater angle");
    low = high;
    high *= 2.0;
  }
  while (high > low * 1.001) {
    const double middle = std::sqrt(low * high);
    (fits(middle) ? high : low) = middle;
  }
  return high;
}

/// Of a texture about as wide as it is high, a multiple of four.
int width_for(const std::vector<Chart>& charts, const AtlasOptions& options) {
  double area = 0.0, widest = 0.0;
  for (const Chart& chart : charts) {
    const double width = std::ceil(chart.extent.x / options.texel) + options.padding;
    area += width * (std::ceil(chart.extent.y / options.texel) + options.padding);
    widest = std::max(widest, width);
  }
  const double width = 4.0 * std::ceil(std::max(widest + 1.0, std::sqrt(area)) / 4.0);
  if (!(width <= kMostSide))
    throw UsageError("texels of " + std::to_string(options.texel) + " make a texture of more than " +
                     std::to_string(kMostSide) + " texels a side; take larger ones");
  return static_cast<int>(width);
}

std::vector<Chart> charts_of(const std::vector<SceneObject>& objects, const AtlasOptions& options) {
  std::vector<Chart> charts;
  const auto add = [&](std::size_t object) {
    std::vector<Chart> more =
        detail::make_charts(objects[object].mesh, static_cast<std::uint32_t>(object), options.chart_degrees);
    std::ranges::move(more, std::back_inserter(charts));
  };
  if (options.objects.empty())
    for (std::size_t i = 0; i < objects.size(); ++i) add(i);
  for (const std::size_t i : options.objects) add(i);
  if (charts.empty()) throw UsageError("no face has an area; there is nothing to bake");
  return charts;
}

}  // namespace

TextureAtlas make_atlas(const std::vector<SceneObject>& objects, const AtlasOptions& options) {
  if (!(options.texel >= 0.0)) throw UsageError("the side of a texel is no number from 0 on");
  if (!(options.chart_degrees >= 0.0 && options.chart_degrees <= 90.0))
    throw UsageError("the angle of charts is not from 0 to 90 degrees");
  const std::vector<Chart> charts = charts_of(objects, options);
  require_area(charts);
  const bool is_square = !(options.texel > 0.0);
  const double texel = is_square ? finest_texel(charts, options) : options.texel;
  const int width = is_square ? options.size : width_for(charts, options);
  const Rows rows(charts, texel, options.padding, width);
  if (!rows.fits(is_square ? options.size : kMostSide))
    throw UsageError("texels of " + std::to_string(texel) + " make a texture of more than " +
                     std::to_string(kMostSide) + " texels a side; take larger ones");
  TextureAtlas atlas{.width = width,
                     .height = is_square ? options.size : rows.height(),
                     .uv = std::vector<std::vector<FaceUv>>(objects.size()),
                     .charts = charts.size(),
                     .texel = texel};
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const Chart& chart = charts[i];
    const Rows::Place& place = rows.places()[i];
    std::vector<FaceUv>& uv = atlas.uv[chart.object];
    if (uv.empty()) uv.resize(objects[chart.object].mesh.triangles().size());
    const glm::dvec2 corner(place.x, place.y),
        scale(place.width / chart.extent.x, place.height / chart.extent.y);
    for (std::size_t k = 0; k < chart.faces.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) uv[chart.faces[k]][c] = corner + chart.uv[k][c] * scale;
  }
  return atlas;
}

}  // namespace penumbra
