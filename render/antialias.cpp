#include "render/antialias.h"

namespace penumbra::detail {

std::vector<PointInPixel> samples_of_pixel(int n) {
  std::vector<PointInPixel> samples;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) samples.push_back({(x + 0.5) / n, (y + 0.5) / n});
  return samples;
}

void ColorSums::add(const Colors& colors) {
  add({&colors.r, &colors.g, &colors.b, &colors.a});
}

void ColorSums::add(const Image& image) {
  add({&image.at("R"), &image.at("G"), &image.at("B"), &image.at("A")});
}

void ColorSums::add(const std::vector<float>* const (&channels)[4]) {
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < channels[k]->size(); ++i)
      sums_[4 * i + k] += static_cast<double>((*channels[k])[i]);
  ++count_;
}

void ColorSums::write_means(Image& image) const {
  std::vector<float>* const channels[4] = {&image.channels.at("R"), &image.channels.at("G"),
                                           &image.channels.at("B"), &image.channels.at("A")};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < channels[k]->size(); ++i)
      (*channels[k])[i] = static_cast<float>(sums_[4 * i + k] / count_);
}

}  // namespace penumbra::detail
