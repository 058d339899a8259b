// Pictures made of pictures: side by side, with captions and a signed difference.
#pragma once

#include <string>
#include <vector>

namespace penumbra::apps {

/// 8-bit sRGB. Everything drawn outside is cut off.
class Picture {
 public:
  struct Color {
    unsigned char r, g, b;
  };

  Picture(int width, int height, Color background);

  int width() const { return width_; }
  int height() const { return height_; }
  const std::vector<unsigned char>& rgb() const { return rgb_; }

  void set(int x, int y, Color color);
  void fill(int x, int y, int width, int height, Color color);
  void draw(int x, int y, const Picture& other);
  /// Capitals are 14 pixels high; (x, y) is the top left corner.
  void write(int x, int y, const std::string& text, Color color);
  static int width_of(const std::string& text);

 private:
  int width_, height_;
  std::vector<unsigned char> rgb_;
};

/// White at 0, blue at -1 (too dark) and beyond, red at 1 (too bright).
Picture::Color signed_color(double value);

}  // namespace penumbra::apps
