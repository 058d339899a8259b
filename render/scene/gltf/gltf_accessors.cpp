#include "render/scene/gltf/gltf_accessors.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace penumbra::detail {
namespace {

constexpr const char* kAdvice = "it is truncated or corrupt; copy or export it again";

std::string numbered(const char* name, long long i) {
  return std::string(name) + "[" + std::to_string(i) + "]";
}

std::size_t bytes_of(int component) {
  const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component));
  return size > 0 ? static_cast<std::size_t>(size) : 0;
}

template <class T>
double number_at(const unsigned char* at, bool normalized) {
  T value;
  std::memcpy(&value, at, sizeof value);
  if constexpr (std::numeric_limits<T>::is_integer)
    if (normalized)
      return std::max(static_cast<double>(value) / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
  return static_cast<double>(value);
}

double number_at(const unsigned char* at, int component, bool normalized) {
  switch (component) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return number_at<std::int8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return number_at<std::uint8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return number_at<std::int16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return number_at<std::uint16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return number_at<std::uint32_t>(at, normalized);
    default:
      return number_at<float>(at, normalized);
  }
}

bool is_known(int component) {
  return (component >= TINYGLTF_COMPONENT_TYPE_BYTE && component <= TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) ||
         component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT || component == TINYGLTF_COMPONENT_TYPE_FLOAT;
}

/// The bytes of a view from `offset` on, of which `needed` are looked at.
const unsigned char* bytes_at(const GltfFile& file, int view, std::size_t offset, std::size_t needed) {
  const auto& views = file.model.bufferViews;
  if (view < 0 || static_cast<std::size_t>(view) >= views.size())
    file.fail(numbered("bufferViews", view), "does not exist", kAdvice);
  const tinygltf::BufferView& v = views[static_cast<std::size_t>(view)];
  if (v.buffer < 0 || static_cast<std::size_t>(v.buffer) >= file.model.buffers.size())
    file.fail(numbered("bufferViews", view), "is of a buffer that does not exist", kAdvice);
  const auto& data = file.model.buffers[static_cast<std::size_t>(v.buffer)].data;
  if (v.byteOffset > data.size() || v.byteLength > data.size() - v.byteOffset)
    file.fail(numbered("bufferViews", view),
              "leaves its buffer, which has " + std::to_string(data.size()) + " bytes", kAdvice);
  if (offset > v.byteLength || needed > v.byteLength - offset)
    file.fail(numbered("bufferViews", view),
              "has " + std::to_string(v.byteLength) + " bytes, fewer than its accessors need", kAdvice);
  return data.data() + v.byteOffset + offset;
}

/// count · stride without overflow; what no buffer has is refused.
std::size_t extent_of(const GltfFile& file, const std::string& where, std::size_t count, std::size_t stride,
                      std::size_t element) {
  constexpr std::size_t kMost = std::size_t{1} << 40;
  if (count > kMost / std::max<std::size_t>(stride, 1)) file.fail(where, "has too many elements", kAdvice);
  return count == 0 ? 0 : (count - 1) * stride + element;
}

void put_sparse(const GltfFile& file, const tinygltf::Accessor& a, const std::string& where, int components,
                std::vector<double>& out) {
  const auto n = static_cast<std::size_t>(std::max(a.sparse.count, 0));
  const std::size_t index_size = bytes_of(a.sparse.indices.componentType), size = bytes_of(a.componentType);
  const auto per = static_cast<std::size_t>(components);
  if (!is_known(a.sparse.indices.componentType) || a.sparse.indices.byteOffset < 0 ||
      a.sparse.values.byteOffset < 0)
    file.fail(where, "has sparse values without indices", kAdvice);
  const unsigned char* indices =
      bytes_at(file, a.sparse.indices.bufferView, static_cast<std::size_t>(a.sparse.indices.byteOffset),
               extent_of(file, where, n, index_size, index_size));
  const unsigned char* values =
      bytes_at(file, a.sparse.values.bufferView, static_cast<std::size_t>(a.sparse.values.byteOffset),
               extent_of(file, where, n * per, size, size));
  for (std::size_t i = 0; i < n; ++i) {
    const double index = number_at(indices + i * index_size, a.sparse.indices.componentType, false);
    if (!(index >= 0.0 && index < static_cast<double>(a.count)))
      file.fail(where, "has a sparse value for an element that does not exist", kAdvice);
    for (std::size_t k = 0; k < per; ++k)
      out[static_cast<std::size_t>(index) * per + k] =
          number_at(values + (i * per + k) * size, a.componentType, a.normalized);
  }
}

}  // namespace

std::vector<double> read_numbers(const GltfFile& file, int accessor, int components,
                                 const std::string& what) {
  const std::string where = numbered("accessors", accessor) + ", " + what;
  if (accessor < 0 || static_cast<std::size_t>(accessor) >= file.model.accessors.size())
    file.fail(where, "does not exist", kAdvice);
  const tinygltf::Accessor& a = file.model.accessors[static_cast<std::size_t>(accessor)];
  if (!is_known(a.componentType) ||
      tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type)) != components)
    file.fail(where, "is not of " + std::to_string(components) + " numbers an element", "export it again");
  const std::size_t size = bytes_of(a.componentType), per = static_cast<std::size_t>(components);
  std::vector<double> out;
  if (a.bufferView < 0) {  // zeros
    constexpr std::size_t kMostZeros = 1u << 24;
    if (!a.sparse.isSparse || a.count > kMostZeros)
      file.fail(where, "has no data", "export it without compression");
    out.assign(a.count * per, 0.0);
  } else {
    std::size_t stride = size * per;
    if (static_cast<std::size_t>(a.bufferView) < file.model.bufferViews.size())
      if (const std::size_t given = file.model.bufferViews[static_cast<std::size_t>(a.bufferView)].byteStride)
        stride = given;
    const unsigned char* at =
        bytes_at(file, a.bufferView, a.byteOffset, extent_of(file, where, a.count, stride, size * per));
    // A stride of less than an element would make more of a file than it holds.
    if (stride < size * per) file.fail(where, "has elements that overlap", kAdvice);
    out.reserve(a.count * per);
    for (std::size_t i = 0; i < a.count; ++i)
      for (std::size_t k = 0; k < per; ++k)
        out.push_back(number_at(at + i * stride + k * size, a.componentType, a.normalized));
  }
  if (a.sparse.isSparse) put_sparse(file, a, where, components, out);
  return out;
}

std::vector<Vec3> read_vectors(const GltfFile& file, int accessor, const std::string& what) {
  const std::vector<double> numbers = read_numbers(file, accessor, 3, what);
  std::vector<Vec3> out;
  out.reserve(numbers.size() / 3);
  for (std::size_t i = 0; i < numbers.size(); i += 3)
    out.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  return out;
}

std::vector<std::uint32_t> read_indices(const GltfFile& file, int accessor, std::size_t limit,
                                        const std::string& what) {
  std::vector<std::uint32_t> out;
  for (const double index : read_numbers(file, accessor, 1, what)) {
    if (!(index >= 0.0 && index < static_cast<double>(limit)))
      file.fail(numbered("accessors", accessor) + ", " + what,
                "names a vertex that does not exist; there are " + std::to_string(limit), kAdvice);
    out.push_back(static_cast<std::uint32_t>(index));
  }
  return out;
}

}  // namespace penumbra::detail
