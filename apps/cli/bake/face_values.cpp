#include "apps/cli/bake/face_values.h"

#include <algorithm>
#include <ostream>

#include "apps/common/outputs.h"
#include "mesh/io/little_endian.h"
#include "mesh/io/npy.h"
#include "mesh/io/write_file.h"

namespace penumbra::apps {
namespace {

using Values = std::vector<std::vector<float>>;

void write(std::ostream& out, const std::string& bytes) {
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string properties_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::string name : names) {
    std::ranges::replace(name, '.', '_');
    text += "property float " + name + "\n";
  }
  return text;
}

void append(std::string& bytes, const Values& values, std::size_t i) {
  for (const std::vector<float>& channel : values) detail::append_little_endian(bytes, channel[i]);
}

void write_ply(std::ostream& out, const TriangleMesh& mesh, bool of_vertices,
               const std::vector<std::string>& names, const Values& values) {
  const std::string properties = properties_of(names);
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.positions().size()
      << "\nproperty double x\nproperty double y\nproperty double z\n"
      << (of_vertices ? properties : "") << "element face " << mesh.triangles().size()
      << "\nproperty list uchar int vertex_indices\n"
      << (of_vertices ? "" : properties) << "end_header\n";
  std::string bytes;
  for (std::size_t v = 0; v < mesh.positions().size(); ++v) {
    for (int k = 0; k < 3; ++k) detail::append_little_endian(bytes, mesh.positions()[v][k]);
    if (of_vertices) append(bytes, values, v);
  }
  for (std::size_t f = 0; f < mesh.triangles().size(); ++f) {
    detail::append_little_endian(bytes, std::uint8_t{3});
    for (const std::uint32_t v : mesh.triangles()[f])
      detail::append_little_endian(bytes, static_cast<std::int32_t>(v));
    if (!of_vertices) append(bytes, values, f);
  }
  write(out, bytes);
}

void write_npy(std::ostream& out, const Values& values) {
  const std::size_t count = values[0].size();
  if (values.size() == 1)
    detail::write_npy_header(out, {count});
  else
    detail::write_npy_header(out, {count, values.size()});
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) append(bytes, values, i);
  write(out, bytes);
}

}  // namespace

void write_values(const std::filesystem::path& path, const TriangleMesh& mesh, bool of_vertices,
                  const std::vector<std::string>& names, const Values& values) {
  write_file(path, [&](std::ostream& out) {
    if (extension_of(path) == ".ply") return write_ply(out, mesh, of_vertices, names, values);
    write_npy(out, values);
  });
}

}  // namespace penumbra::apps
