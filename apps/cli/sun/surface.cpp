#include "apps/cli/sun/surface.h"

#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <string_view>

#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

bool is_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// The name of the heightfield that it is a tile of, whose own is NAME[ROW,COLUMN]; else its name.
std::string name_without_tile(const std::string& name) {
  // Not by std::regex, which takes a stack frame for every letter.
  const std::size_t open = name.rfind('[');
  if (open == std::string::npos || open == 0 || name.back() != ']') return name;
  const std::string_view tile = std::string_view(name).substr(open + 1, name.size() - open - 2);
  const std::size_t comma = tile.find(',');
  if (comma == std::string_view::npos) return name;
  return is_number(tile.substr(0, comma)) && is_number(tile.substr(comma + 1)) ? name.substr(0, open) : name;
}

/// Adds meshes; a vertex on the boundary of one is the same as that of another at the same place.
class Joiner {
 public:
  void add(const TriangleMesh& mesh, std::size_t object) {
    std::vector<bool> at_boundary(mesh.positions().size(), false);
    for (const Edge& e : mesh.edges())
      if (e.is_boundary()) at_boundary[index(e.from)] = at_boundary[index(e.to)] = true;
    std::vector<std::uint32_t> number(mesh.positions().size());
    for (std::size_t v = 0; v < number.size(); ++v) number[v] = vertex(mesh.positions()[v], at_boundary[v]);
    for (std::uint32_t f = 0; f < mesh.triangles().size(); ++f) {
      const auto& [a, b, c] = mesh.triangles()[f];
      out_.triangles.push_back({number[a], number[b], number[c]});
      out_.objects.push_back(static_cast<std::int32_t>(object));
      out_.faces.push_back(f);
    }
  }
  Surface take() && { return std::move(out_); }

 private:
  std::uint32_t vertex(const Vec3& p, bool at_boundary) {
    const auto next = static_cast<std::uint32_t>(out_.positions.size());
    if (at_boundary) {
      const auto [known, is_new] = borders_.try_emplace({p.x, p.y, p.z}, next);
      if (!is_new) return known->second;
    }
    out_.positions.push_back(p);
    return next;
  }

  Surface out_;
  std::map<std::array<double, 3>, std::uint32_t> borders_;
};

}  // namespace

std::vector<std::size_t> objects_named(const Scene& scene, const std::string& name) {
  std::vector<std::size_t> found;
  std::string known, before;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const std::string& own = scene.objects[i].name;
    if (found.empty() && (own == name || std::to_string(i) == name)) return {i};
    const std::string shared = name_without_tile(own);
    if (shared == name)
      found.push_back(i);
    else if (!found.empty())
      break;
    if (shared == own || shared != before) known += (i > 0 ? ", " : "") + std::to_string(i) + " " + shared;
    before = shared;
  }
  if (found.empty()) throw UsageError("there is no object \"" + name + "\"; the scene has " + known);
  return found;
}

Vec3 Surface::cross(std::size_t triangle) const {
  const auto& [a, b, c] = triangles[triangle];
  return glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
}

Surface surface_of(const Scene& scene, const std::string& name) {
  const std::vector<std::size_t> objects = objects_named(scene, name);
  if (objects.size() > 1) {
    Joiner joiner;
    for (const std::size_t i : objects) joiner.add(scene.objects[i].mesh, i);
    return std::move(joiner).take();
  }
  // As it is: vertices that its mesh has apart stay apart.
  const TriangleMesh& mesh = scene.objects[objects[0]].mesh;
  Surface out{.positions = {mesh.positions().begin(), mesh.positions().end()},
              .triangles = {mesh.triangles().begin(), mesh.triangles().end()}};
  out.objects.assign(out.triangles.size(), static_cast<std::int32_t>(objects[0]));
  for (std::uint32_t f = 0; f < out.triangles.size(); ++f) out.faces.push_back(f);
  return out;
}

}  // namespace penumbra::apps
