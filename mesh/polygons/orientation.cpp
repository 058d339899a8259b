#include "mesh/polygons/orientation.h"

#include <array>
#include <cmath>

namespace penumbra::detail {
namespace {

constexpr double kEpsilon = 0x1p-53;

/// A sum of doubles that do not overlap, the largest last.
class Expansion {
 public:
  void add(double value) {
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = value + terms_[i], part = sum - value;
      terms_[i] = (value - (sum - part)) + (terms_[i] - part);
      value = sum;
    }
    terms_[size_++] = value;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  int sign() const {
    for (std::size_t i = size_; i > 0; --i)
      if (terms_[i - 1] != 0.0) return terms_[i - 1] > 0.0 ? 1 : -1;
    return 0;
  }

 private:
  std::array<double, 12> terms_{};
  std::size_t size_ = 0;
};

int exact_orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  Expansion sum;
  sum.add_product(a.x, b.y);
  sum.add_product(-a.y, b.x);
  sum.add_product(b.x, c.y);
  sum.add_product(-b.y, c.x);
  sum.add_product(c.x, a.y);
  sum.add_product(-c.y, a.x);
  return sum.sign();
}

}  // namespace

int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  const double bound = (3.0 + 16.0 * kEpsilon) * kEpsilon * (std::abs(left) + std::abs(right));
  if (std::abs(determinant) > bound) return determinant > 0.0 ? 1 : -1;
  return exact_orientation(a, b, c);
}

bool is_inside_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 u = a - d, v = b - d, w = c - d;
  const auto lift = [](const Vec2& p) { return p.x * p.x + p.y * p.y; };
  const auto size = [](const Vec2& p, const Vec2& q) { return std::abs(p.x * q.y) + std::abs(p.y * q.x); };
  const auto cross = [](const Vec2& p, const Vec2& q) { return p.x * q.y - p.y * q.x; };
  const double determinant = lift(u) * cross(v, w) + lift(v) * cross(w, u) + lift(w) * cross(u, v);
  const double permanent = lift(u) * size(v, w) + lift(v) * size(w, u) + lift(w) * size(u, v);
  return determinant > (10.0 + 96.0 * kEpsilon) * kEpsilon * permanent;
}

}  // namespace penumbra::detail
