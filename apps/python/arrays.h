// NumPy arrays in and out. What lies in memory as the library has it is referred to, else it is converted
// once.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra::python {

namespace py = pybind11;

using Shape = std::vector<py::ssize_t>;

/// Points that a NumPy array holds: float64 in C order is not copied.
struct PointArray {
  /// Keeps the memory.
  py::array array;
  std::span<const Vec3> points;
  /// The array's without the last 3.
  Shape shape;
};

/// An array of shape (..., 3) of any real numbers. `name` stands in messages. Throws TypeError for what are
/// no numbers, ValueError for another shape.
PointArray points_of(const py::object& object, const char* name);
/// The same of shape (n, 3).
PointArray rows_of(const py::object& object, const char* name);
/// Three numbers.
Vec3 vector_of(const py::object& object, const char* name);
/// (x, y, z).
py::tuple tuple_of(const Vec3& v);
/// Of shape (m, 3), integers, each below `vertices`. Throws TypeError, ValueError.
std::vector<IndexedTriangle> triangles_of(const py::object& object, const char* name, std::size_t vertices);
/// Integers that are broadcast to the shape.
std::vector<std::int64_t> integers_of(const py::object& object, const char* name, const Shape& shape);

/// "(4, 3)".
std::string text_of(const Shape& shape);
Shape shape_of(const py::array& array);
/// "points[2, 7]": the place of the i-th element of an array of that shape.
std::string place_of(const char* name, const Shape& shape, std::size_t i);
/// Throws ValueError that names the first of the points that is not finite, if there is one.
void require_finite(const PointArray& points, const char* name);

std::size_t count_of(const Shape& shape);

/// An array that owns the vector's memory. Number is what T is made of.
template <class Number, class T>
py::array owned(std::vector<T>&& values, Shape shape) {
  auto* kept = new std::vector<T>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return py::array(py::dtype::of<Number>(), std::move(shape), kept->data(), owner);
}

template <class T>
py::array owned_rows(std::vector<T>&& values) {
  using Number = std::remove_cvref_t<decltype(values.front()[0])>;
  const auto rows = static_cast<py::ssize_t>(values.size());
  return owned<Number>(std::move(values), {rows, static_cast<py::ssize_t>(sizeof(T) / sizeof(Number))});
}

}  // namespace penumbra::python
