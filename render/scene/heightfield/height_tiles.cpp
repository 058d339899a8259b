#include "render/scene/heightfield/height_tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "mesh/vectors.h"
#include "penumbra/mesh/error.h"
#include "render/scene/scene_limits.h"
#include "render/scene/scene_node.h"

namespace penumbra::detail {
namespace {

struct Post {
  std::size_t row, column;
};
using PostTriangle = std::array<Post, 3>;

/// Makes one tile after the other. Refers to the grid.
class TileMaker {
 public:
  TileMaker(const HeightGrid& grid, const Transform& transform, const TileOptions& options)
      : grid_(grid), transform_(transform), options_(options) {
    const double turn = grid.across[0] * grid.down[1] - grid.across[1] * grid.down[0];
    turned_ = (turn > 0.0) != transform.mirrors();
  }

  std::size_t rows() const { return (grid_.rows - 2) / options_.side + 1; }
  std::size_t columns() const { return (grid_.columns - 2) / options_.side + 1; }

  HeightTile make(std::size_t row, std::size_t column) const {
    const Post first{row * options_.side, column * options_.side};
    const Post last{std::min(first.row + options_.side, grid_.rows - 1),
                    std::min(first.column + options_.side, grid_.columns - 1)};
    std::vector<PostTriangle> faces;
    for (std::size_t r = first.row; r < last.row; ++r)
      for (std::size_t c = first.column; c < last.column; ++c) add_square({r, c}, faces);
    HeightTile tile{.row = row, .column = column};
    if (faces.empty()) return tile;
    tile.mesh = mesh_of(first, last, faces);
    if (options_.smooth)
      for (const std::uint32_t source : tile.mesh.source_triangles())
        tile.corner_normals.push_back(
            {normal(faces[source][0]), normal(faces[source][1]), normal(faces[source][2])});
    return tile;
  }

 private:
  bool is_gap(const Post& p) const { return std::isnan(grid_.height(p.row, p.column)); }

  /// Of the square whose first post it is; seen from above they run counterclockwise.
  void add_square(const Post& p, std::vector<PostTriangle>& out) const {
    const Post right{p.row, p.column + 1}, below{p.row + 1, p.column}, across{p.row + 1, p.column + 1};
    for (PostTriangle t : {PostTriangle{p, below, right}, PostTriangle{right, below, across}}) {
      if (std::ranges::any_of(t, [this](const Post& corner) { return is_gap(corner); })) continue;
      if (turned_) std::swap(t[1], t[2]);
      out.push_back(t);
    }
  }

  Vec3 place(const Post& p) const {
    const auto c = static_cast<double>(p.column), r = static_cast<double>(p.row);
    const double east = grid_.origin[0] + c * grid_.across[0] + r * grid_.down[0];
    const double north = grid_.origin[1] + c * grid_.across[1] + r * grid_.down[1];
    const Vec3 world = transform_.apply({east, grid_.height(p.row, p.column), -north});
    if (!(largest_component(world) <= kMostNumber))
      throw MeshError("a post lies beyond " + to_text(kMostNumber) + "; use another unit of length");
    return world;
  }

  TriangleMesh mesh_of(const Post& first, const Post& last, const std::vector<PostTriangle>& faces) const {
    const std::size_t width = last.column - first.column + 1;
    std::vector<Vec3> positions(width * (last.row - first.row + 1));
    std::vector<IndexedTriangle> triangles;
    triangles.reserve(faces.size());
    for (const PostTriangle& face : faces) {
      IndexedTriangle& t = triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = (face[k].row - first.row) * width + face[k].column - first.column;
        positions[at] = place(face[k]);
        t[k] = static_cast<std::uint32_t>(at);
      }
    }
    return TriangleMesh::build(positions, triangles, {.weld = false, .flip_inside_out = false});
  }

  /// Over all triangles around, of this tile or of another.
  glm::vec3 normal(const Post& p) const {
    std::vector<PostTriangle> around;
    for (std::size_t r = p.row - std::min<std::size_t>(p.row, 1); r <= p.row && r + 1 < grid_.rows; ++r)
      for (std::size_t c = p.column - std::min<std::size_t>(p.column, 1);
           c <= p.column && c + 1 < grid_.columns; ++c)
        add_square({r, c}, around);
    Vec3 sum(0.0);
    for (const PostTriangle& t : around)
      if (std::ranges::any_of(t, [&](const Post& q) { return q.row == p.row && q.column == p.column; }))
        sum += glm::cross(place(t[1]) - place(t[0]), place(t[2]) - place(t[0]));
    return glm::vec3(unit(sum));
  }

  const HeightGrid& grid_;
  Transform transform_;
  TileOptions options_;
  bool turned_ = false;
};

}  // namespace

std::vector<HeightTile> make_tiles(const HeightGrid& grid, const Transform& transform,
                                   const TileOptions& options) {
  const TileMaker maker(grid, transform, options);
  std::vector<HeightTile> tiles(maker.rows() * maker.columns());
  tbb::parallel_for(std::size_t{0}, tiles.size(),
                    [&](std::size_t i) { tiles[i] = maker.make(i / maker.columns(), i % maker.columns()); });
  std::erase_if(tiles, [](const HeightTile& tile) { return tile.mesh.empty(); });
  if (tiles.empty())
    throw MeshError("no three posts that meet have heights; nothing is left of the heightfield");
  return tiles;
}

}  // namespace penumbra::detail
