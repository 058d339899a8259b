#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <ostream>
#include <string>

#include "mesh/io/formats.h"
#include "mesh/io/little_endian.h"
#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"
#include "penumbra/mesh/io/polygon_soup.h"

namespace penumbra {
namespace {

using detail::append_little_endian;

/// The shortest decimals that read back as exactly the same double.
void append_number(std::string& text, double value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void append_point(std::string& text, const Vec3& p) {
  append_number(text, p.x);
  append_number(text += ' ', p.y);
  append_number(text += ' ', p.z);
  text += '\n';
}

/// Collects small pieces and hands them on in large ones.
class Buffered {
 public:
  explicit Buffered(std::ostream& out) : out_(out) {}
  Buffered(const Buffered&) = delete;
  Buffered& operator=(const Buffered&) = delete;
  void pass_on(std::size_t least = 1u << 20) {
    if (text.size() > least) {
      out_ << text;
      text.clear();
    }
  }
  void finish() { pass_on(0); }
  std::string text;

 private:
  std::ostream& out_;
};

void write_text(std::ostream& out, const TriangleMesh& mesh, const char* vertex, const char* face,
                std::uint32_t first_index) {
  Buffered buffer(out);
  for (const Vec3& p : mesh.positions()) {
    append_point(buffer.text += vertex, p);
    buffer.pass_on();
  }
  for (const auto& [a, b, c] : mesh.triangles()) {
    buffer.text.append(face).append(std::to_string(a + first_index)).append(" ");
    buffer.text.append(std::to_string(b + first_index)).append(" ");
    buffer.text.append(std::to_string(c + first_index)).append("\n");
    buffer.pass_on();
  }
  buffer.finish();
}

void append_floats(std::string& bytes, const Vec3& p) {
  for (const double x : {p.x, p.y, p.z}) {
    append_little_endian(bytes, static_cast<float>(x));
  }
}

}  // namespace

void detail::write_ply(std::ostream& out, const TriangleMesh& mesh) {
  Buffered buffer(out);
  buffer.text +=
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.positions().size()) +
      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
      std::to_string(mesh.triangles().size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : mesh.positions()) {
    append_little_endian(buffer.text, p.x);
    append_little_endian(buffer.text, p.y);
    append_little_endian(buffer.text, p.z);
    buffer.pass_on();
  }
  for (const IndexedTriangle& triangle : mesh.triangles()) {
    buffer.text += '\3';
    for (const std::uint32_t v : triangle) {
      append_little_endian(buffer.text, v);
    }
    buffer.pass_on();
  }
  buffer.finish();
}

void detail::write_obj(std::ostream& out, const TriangleMesh& mesh) {
  write_text(out, mesh, "v ", "f ", 1);
}

void detail::write_off(std::ostream& out, const TriangleMesh& mesh) {
  out << "OFF\n"
      << mesh.positions().size() << ' ' << mesh.triangles().size() << ' ' << mesh.edges().size() << '\n';
  write_text(out, mesh, "", "3 ", 0);
}

void detail::write_stl(std::ostream& out, const TriangleMesh& mesh) {
  const Bounds bounds = bounds_of(mesh.positions());
  const Vec3 furthest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  if (!mesh.empty() && std::max({furthest.x, furthest.y, furthest.z}) > std::numeric_limits<float>::max()) {
    throw UsageError(
        "STL: a coordinate is too large for its single precision; write PLY instead, which has double "
        "precision");
  }
  Buffered buffer(out);
  buffer.text.assign(80, ' ');  // does not begin with "solid"
  append_little_endian(buffer.text, static_cast<std::uint32_t>(mesh.triangles().size()));
  for (const auto& [a, b, c] : mesh.triangles()) {
    const Vec3 &p = mesh.positions()[a], &q = mesh.positions()[b], &r = mesh.positions()[c];
    const Vec3 normal = glm::cross(q - p, r - p);
    const double length = glm::length(normal);
    append_floats(buffer.text, length > 0.0 && std::isfinite(length) ? normal / length : Vec3(0.0));
    append_floats(buffer.text, p);
    append_floats(buffer.text, q);
    append_floats(buffer.text, r);
    buffer.text.append(2, '\0');
    buffer.pass_on();
  }
  buffer.finish();
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
  const detail::MeshFormat& format = detail::format_to_write(path);
  write_file(path, [&](std::ostream& out) { format.write(out, mesh); });
}

}  // namespace penumbra
