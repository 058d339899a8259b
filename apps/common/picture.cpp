#include "apps/common/picture.h"

#include <stb_easy_font.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace penumbra::apps {
namespace {

constexpr int kTextScale = 2;

unsigned char mix(double from, double to, double t) {
  return static_cast<unsigned char>(std::lround(from + (to - from) * t));
}

}  // namespace

Picture::Picture(int width, int height, Color background)
    : width_(width),
      height_(height),
      rgb_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3) {
  fill(0, 0, width, height, background);
}

void Picture::set(int x, int y, Color color) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  unsigned char* pixel =
      &rgb_[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)) *
            3];
  pixel[0] = color.r;
  pixel[1] = color.g;
  pixel[2] = color.b;
}

void Picture::fill(int x, int y, int width, int height, Color color) {
  for (int row = y; row < y + height; ++row)
    for (int column = x; column < x + width; ++column) set(column, row, color);
}

void Picture::draw(int x, int y, const Picture& other) {
  for (int row = 0; row < other.height_; ++row)
    for (int column = 0; column < other.width_; ++column) {
      const unsigned char* pixel = &other.rgb_[static_cast<std::size_t>(row * other.width_ + column) * 3];
      set(x + column, y + row, {pixel[0], pixel[1], pixel[2]});
    }
}

namespace {

/// With ? for what the font does not have: all but ASCII. A character of UTF-8 is one.
std::string printable(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool continues = (static_cast<unsigned char>(c) & 0xc0) == 0x80;
    if (!continues) out += c >= 0x20 && c <= 0x7e ? c : '?';
  }
  return out;
}

}  // namespace

void Picture::write(int x, int y, const std::string& text, Color color) {
  // Four corners of 16 bytes (x, y, z as float, then a color) for each axis-parallel box that letters are
  // made of.
  struct Corner {
    float x, y, z;
    unsigned char color[4];
  };
  std::vector<std::array<Corner, 4>> boxes(text.size() * 20 + 1);
  std::string copy = printable(text);
  const int count = stb_easy_font_print(0, 0, copy.data(), nullptr, boxes.data(),
                                        static_cast<int>(boxes.size() * sizeof boxes[0]));
  for (int i = 0; i < count; ++i) {
    const auto& box = boxes[static_cast<std::size_t>(i)];
    const int left = static_cast<int>(box[0].x), top = static_cast<int>(box[0].y);
    const int right = static_cast<int>(box[2].x), bottom = static_cast<int>(box[2].y);
    fill(x + kTextScale * left, y + kTextScale * top, kTextScale * (right - left),
         kTextScale * (bottom - top), color);
  }
}

int Picture::width_of(const std::string& text) {
  std::string copy = printable(text);
  return kTextScale * stb_easy_font_width(copy.data());
}

Picture::Color signed_color(double value) {
  const double t = std::min(1.0, std::abs(value));
  if (value < 0.0) return {mix(255, 20, t), mix(255, 60, t), mix(255, 200, t)};
  return {mix(255, 200, t), mix(255, 30, t), mix(255, 20, t)};
}

}  // namespace penumbra::apps
