#include "apps/python/arrays.h"

#include <cmath>
#include <cstring>

namespace penumbra::python {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double), "points are read as they lie in memory");

constexpr int kInOrder = py::array::c_style | py::array::forcecast | py::detail::npy_api::NPY_ARRAY_ALIGNED_;
template <class T>
using InOrder = py::array_t<T, kInOrder>;

py::array array_of(const py::object& object, const char* name, const char* kinds, const char* wanted) {
  py::array array = py::array::ensure(object);
  if (!array)
    throw py::type_error(std::string(name) + " is no array; give " + wanted + " in rows of one length");
  if (std::strchr(kinds, array.dtype().kind()) == nullptr)
    throw py::type_error(std::string(name) + " has the type " + std::string(py::str(array.dtype())) +
                         "; give " + wanted);
  return array;
}

py::array real_array(const py::object& object, const char* name) {
  return array_of(object, name, "fiu", "real numbers (float64 is not copied)");
}

py::array integer_array(const py::object& object, const char* name) {
  return array_of(object, name, "iu", "integers");
}

bool is_finite(const Vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

}  // namespace

Shape shape_of(const py::array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

std::size_t count_of(const Shape& shape) {
  std::size_t count = 1;
  for (const py::ssize_t n : shape) count *= static_cast<std::size_t>(n);
  return count;
}

std::string text_of(const Shape& shape) {
  std::string text = "(";
  for (std::size_t k = 0; k < shape.size(); ++k)
    text += std::to_string(shape[k]) + (k + 1 < shape.size() ? ", " : shape.size() == 1 ? "," : "");
  return text + ")";
}

std::string place_of(const char* name, const Shape& shape, std::size_t i) {
  if (shape.empty()) return name;
  std::string text;
  for (std::size_t k = shape.size(); k-- > 0;) {
    const auto n = static_cast<std::size_t>(shape[k]);
    text.insert(0, std::to_string(i % n) + (text.empty() ? "" : ", "));
    i /= n;
  }
  return std::string(name) + "[" + text + "]";
}

PointArray points_of(const py::object& object, const char* name) {
  const py::array given = real_array(object, name);
  Shape shape = shape_of(given);
  if (shape.empty() || shape.back() != 3)
    throw py::value_error(std::string(name) + " has shape " + text_of(shape) +
                          "; the last axis must have length 3: x, y, z");
  InOrder<double> array(given);
  shape.pop_back();
  const auto* first = reinterpret_cast<const Vec3*>(array.data());
  return {array, {first, count_of(shape)}, shape};
}

PointArray rows_of(const py::object& object, const char* name) {
  PointArray rows = points_of(object, name);
  if (rows.shape.size() != 1)
    throw py::value_error(std::string(name) + " has shape " + text_of(shape_of(rows.array)) +
                          "; give (n, 3): one row a vertex");
  return rows;
}

Vec3 vector_of(const py::object& object, const char* name) {
  const PointArray points = points_of(object, name);
  if (!points.shape.empty())
    throw py::value_error(std::string(name) + " has shape " + text_of(shape_of(points.array)) +
                          "; give three numbers");
  return points.points.front();
}

py::tuple tuple_of(const Vec3& v) {
  return py::make_tuple(v.x, v.y, v.z);
}

void require_finite(const PointArray& points, const char* name) {
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    const Vec3& p = points.points[i];
    if (is_finite(p)) continue;
    throw py::value_error(place_of(name, points.shape, i) + " is (" + std::to_string(p.x) + ", " +
                          std::to_string(p.y) + ", " + std::to_string(p.z) +
                          "); all numbers must be finite: leave it out");
  }
}

std::vector<IndexedTriangle> triangles_of(const py::object& object, const char* name, std::size_t vertices) {
  const py::array given = integer_array(object, name);
  const Shape shape = shape_of(given);
  if (shape.size() != 2 || shape[1] != 3)
    throw py::value_error(std::string(name) + " has shape " + text_of(shape) +
                          "; give (m, 3): three vertices a triangle");
  const InOrder<std::int64_t> array(given);
  std::vector<IndexedTriangle> triangles(static_cast<std::size_t>(shape[0]));
  const std::int64_t* next = array.data();
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::uint32_t& corner : triangles[f]) {
      if (*next < 0 || static_cast<std::uint64_t>(*next) >= vertices)
        throw py::value_error(std::string(name) + "[" + std::to_string(f) + "] names vertex " +
                              std::to_string(*next) + ", but there are " + std::to_string(vertices) +
                              " vertices, numbered from 0");
      corner = static_cast<std::uint32_t>(*next++);
    }
  return triangles;
}

std::vector<std::int64_t> integers_of(const py::object& object, const char* name, const Shape& shape) {
  py::object given = integer_array(object, name);
  const Shape own = shape_of(py::array(given));
  if (own.empty()) {  // one for all
    return std::vector<std::int64_t>(count_of(shape), given.cast<std::int64_t>());
  }
  if (own != shape)
    throw py::value_error(std::string(name) + " has shape " + text_of(own) + ", but the points have " +
                          text_of(shape) + "; give one for each point");
  const InOrder<std::int64_t> array(given);
  return {array.data(), array.data() + array.size()};
}

}  // namespace penumbra::python
