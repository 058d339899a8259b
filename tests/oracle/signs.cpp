#include "tests/oracle/signs.h"

#include <gmpxx.h>

#include <cmath>

namespace penumbra::oracle {
namespace {

constexpr double kUnit = 0x1p-53;
// Added to every error: more than all products of a term can lose by underflow, which is 2^-1074 each.
constexpr double kUnderflow = 0x1p-1000;
constexpr int kCoplanarRoundings = 4;

// The same formulas for bounded and for exact numbers.
template <class Number>
struct Vector {
  Number x, y, z;
};
template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return Number(Number(a.x * b.x + a.y * b.y) + a.z * b.z);
}
template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {Number(a.y * b.z - a.z * b.y), Number(a.z * b.x - a.x * b.z), Number(a.x * b.y - a.y * b.x)};
}
template <class Number>
Vector<Number> sum(const Vector<Number>& a, const Vector<Number>& b) {
  return {Number(a.x + b.x), Number(a.y + b.y), Number(a.z + b.z)};
}
template <class Number>
Vector<Number> magnitudes(const Vector<Number>& a) {
  return {Number(abs(a.x)), Number(abs(a.y)), Number(abs(a.z))};
}

template <class Number>
struct Make;
template <>
struct Make<Bounded> {
  static Bounded number(double a) { return {a, 0.0}; }
  static Bounded minus(double a, double b) { return difference(a, b); }
};
template <>
struct Make<mpq_class> {
  static mpq_class number(double a) { return mpq_class(a); }
  static mpq_class minus(double a, double b) { return mpq_class(a) - mpq_class(b); }
};
template <class Number>
Vector<Number> vector(const Vec3& a) {
  return {Make<Number>::number(a.x), Make<Number>::number(a.y), Make<Number>::number(a.z)};
}
template <class Number>
Vector<Number> minus(const Vec3& a, const Vec3& b) {
  return {Make<Number>::minus(a.x, b.x), Make<Number>::minus(a.y, b.y), Make<Number>::minus(a.z, b.z)};
}

template <class Number>
Vector<Number> direction(const Ray& ray) {
  return ray.endless ? vector<Number>(ray.q) : minus<Number>(ray.q, ray.x);
}

std::optional<int> sign_of(const Bounded& a) {
  return a.sign();
}
std::optional<int> sign_of(const mpq_class& a) {
  return sgn(a);
}

template <class Number>
std::optional<int> side_of_face_by(const Vec3& x, const Corners& face) {
  const auto a = minus<Number>(face.a, x), b = minus<Number>(face.b, x), c = minus<Number>(face.c, x);
  const auto bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const Number d = dot(a, bc);
  const auto from = [](const Vector<Number>& derivative, const Vec3& p) {
    return dot(magnitudes(derivative), magnitudes(vector<Number>(p)));
  };
  const Number size =
      Number(from(bc, face.a) + from(ca, face.b)) + Number(from(ab, face.c) + from(sum(sum(ab, bc), ca), x));
  const auto outside =
      sign_of(Number(Number(abs(d)) - Make<Number>::number(kCoplanarRoundings * kUnit) * size));
  if (!outside) return {};
  return *outside > 0 ? sign_of(d) : 0;
}

template <class Number>
std::optional<int> light_minus_hit(const Ray& ray, const Corners& face) {
  const auto a = minus<Number>(face.a, ray.x), d = direction<Number>(ray);
  const auto n = cross(minus<Number>(face.b, face.a), minus<Number>(face.c, face.a));
  const auto m = vector<Number>(ray.normal);
  return sign_of(Number(Number(abs(dot(m, minus<Number>(ray.center, ray.x)))) * Number(abs(dot(d, n))) -
                        Number(abs(dot(a, n))) * Number(abs(dot(m, d)))));
}

}  // namespace

std::optional<int> Bounded::sign() const {
  if (value > error) return 1;
  if (value < -error) return -1;
  if (value == 0.0 && error == 0.0) return 0;
  return {};
}

// The errors below are sums and products of non-negative numbers, a few roundings each: the factor 1 + 8u
// makes up for these.
Bounded operator+(const Bounded& a, const Bounded& b) {
  const double value = a.value + b.value;
  return {value, (a.error + b.error + kUnit * std::abs(value)) * (1 + 8 * kUnit)};
}
Bounded operator-(const Bounded& a, const Bounded& b) {
  return a + Bounded{-b.value, b.error};
}
Bounded operator*(const Bounded& a, const Bounded& b) {
  const bool zero = (a.value == 0.0 && a.error == 0.0) || (b.value == 0.0 && b.error == 0.0);
  if (zero) return {};
  const double value = a.value * b.value;
  const double inherited = std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error;
  return {value, (inherited + kUnit * std::abs(value)) * (1 + 8 * kUnit) + kUnderflow};
}
// ||a| - |t|| ≤ |a - t|.
Bounded abs(const Bounded& a) {
  return {std::abs(a.value), a.error};
}
// Two numbers of which the difference is 0 are equal: gradual underflow.
Bounded difference(double a, double b) {
  const double value = a - b;
  return {value, kUnit * (1 + 8 * kUnit) * std::abs(value)};
}

// Every one of the six terms is rounded at most eight times: three differences, two products, one
// subtraction, two additions. So the error is at most 8u(1 + O(u)) of the sum of their sizes, which itself is
// computed with at most seven roundings: 10u is enough.
Bounded determinant(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int i = 0; i < 3; ++i)
    if (a[i] == 0.0 && b[i] == 0.0 && c[i] == 0.0) return {};
  const double value =
      a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
  const double ax = std::abs(a.x), ay = std::abs(a.y), az = std::abs(a.z);
  const double size = ax * (std::abs(b.y * c.z) + std::abs(b.z * c.y)) +
                      ay * (std::abs(b.z * c.x) + std::abs(b.x * c.z)) +
                      az * (std::abs(b.x * c.y) + std::abs(b.y * c.x));
  return {value, 10 * kUnit * size + kUnderflow * (1 + ax + ay + az)};
}

int sign_of_dot(const Vec3& n, const Vec3& p, const Vec3& q) {
  if (const auto sign = dot(vector<Bounded>(n), minus<Bounded>(p, q)).sign()) return *sign;
  return sgn(dot(vector<mpq_class>(n), minus<mpq_class>(p, q)));
}

int side_of_edge(const Ray& ray, const Vec3& a, const Vec3& b) {
  const Vec3 d = ray.endless ? ray.q : ray.q - ray.x;
  if (const auto sign = determinant(d, a - ray.x, b - ray.x).sign()) return *sign;
  return sgn(dot(direction<mpq_class>(ray), cross(minus<mpq_class>(a, ray.x), minus<mpq_class>(b, ray.x))));
}

int side_of_face(const Vec3& x, const Corners& face) {
  if (const auto side = side_of_face_by<Bounded>(x, face)) return *side;
  return *side_of_face_by<mpq_class>(x, face);
}

bool is_before_light(const Ray& ray, const Corners& face) {
  if (ray.endless) return true;
  if (const auto sign = light_minus_hit<Bounded>(ray, face)) return *sign > 0;
  return *light_minus_hit<mpq_class>(ray, face) > 0;
}

}  // namespace penumbra::oracle
