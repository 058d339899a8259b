// More than one sample a pixel: where they lie, and their mean.
#pragma once

#include <vector>

#include "render/rays/camera_rays.h"
#include "render/shading/shading.h"

namespace penumbra::detail {

/// The centers of n · n equal squares, row by row; the middle one of an odd number is the pixel's center.
std::vector<PointInPixel> samples_of_pixel(int n);

/// Sums of R G B A. In double, so that the mean of equal values is that value.
class ColorSums {
 public:
  explicit ColorSums(std::size_t pixels) : sums_(4 * pixels, 0.0) {}
  void add(const Colors& colors);
  /// R G B A of an image.
  void add(const Image& image);
  /// Writes the means over all that was added.
  void write_means(Image& image) const;

 private:
  void add(const std::vector<float>* const (&channels)[4]);

  std::vector<double> sums_;
  int count_ = 0;
};

}  // namespace penumbra::detail
