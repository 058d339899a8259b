#include "penumbra/mesh/triangle_mesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/topology/cavities.h"
#include "mesh/topology/disjoint_sets.h"
#include "mesh/topology/manifold_pieces.h"

namespace penumbra {

struct TriangleMesh::Data {
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;
  std::vector<Edge> edges;
  std::vector<std::array<EdgeId, 3>> face_edges;
  std::vector<std::uint32_t> source_triangles;
  std::vector<Component> components;
  BuildReport report;
  Bounds bounds;
  double longest_edge = 0.0;
};

namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

/// Edges are numbered as the faces first name them, and half-edge 0 of an edge belongs to the face that did.
///
/// The links are set directly rather than by add_face, which would search round a vertex for every edge:
/// quadratic at the apex of a large fan. At a boundary vertex there is one fan, so one boundary half-edge
/// leaves it.
HalfEdgeMesh link_half_edges(const detail::ManifoldPieces& pieces) {
  HalfEdgeMesh mesh;
  const std::size_t half_edge_count = pieces.opposite.size();
  mesh.reserve(pieces.positions.size(), half_edge_count / 2 + half_edge_count / 8, pieces.triangles.size());
  for (const Vec3& p : pieces.positions) {
    mesh.add_vertex({p.x, p.y, p.z});
  }
  const auto vertex = [&](std::size_t f, std::size_t k) {
    return OpenMesh::VertexHandle(static_cast<int>(pieces.triangles[f][k % 3]));
  };
  std::vector<OpenMesh::HalfedgeHandle> handle(half_edge_count);
  std::vector<OpenMesh::HalfedgeHandle> boundary;
  for (std::size_t h = 0; h < half_edge_count; ++h) {
    const std::uint32_t opposite = pieces.opposite[h];
    if (opposite != detail::kNoHalfEdge && opposite < h) {
      handle[h] = mesh.opposite_halfedge_handle(handle[opposite]);
      continue;
    }
    handle[h] = mesh.new_edge(vertex(h / 3, h % 3), vertex(h / 3, h % 3 + 1));
    if (opposite == detail::kNoHalfEdge) {
      boundary.push_back(mesh.opposite_halfedge_handle(handle[h]));
    }
  }
  for (std::size_t f = 0; f < pieces.triangles.size(); ++f) {
    const OpenMesh::FaceHandle face = mesh.new_face();
    mesh.set_halfedge_handle(face, handle[3 * f]);
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.set_face_handle(handle[3 * f + k], face);
      mesh.set_next_halfedge_handle(handle[3 * f + k], handle[3 * f + (k + 1) % 3]);
      mesh.set_halfedge_handle(vertex(f, k), handle[3 * f + k]);
    }
  }
  for (const OpenMesh::HalfedgeHandle h : boundary) {
    mesh.set_boundary(h);
    mesh.set_halfedge_handle(mesh.from_vertex_handle(h), h);
  }
  for (const OpenMesh::HalfedgeHandle h : boundary) {
    mesh.set_next_halfedge_handle(h, mesh.halfedge_handle(mesh.to_vertex_handle(h)));
  }
  return mesh;
}

template <class Id, class Handle>
Id to_id(Handle handle) {
  return handle.is_valid() ? Id{static_cast<std::uint32_t>(handle.idx())} : kNone<Id>;
}

std::vector<Edge> read_edges(const HalfEdgeMesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(mesh.n_edges());
  const auto apex = [&](OpenMesh::HalfedgeHandle h) {
    return mesh.is_boundary(h) ? kNone<VertexId>
                               : to_id<VertexId>(mesh.to_vertex_handle(mesh.next_halfedge_handle(h)));
  };
  for (const auto e : mesh.edges()) {
    const OpenMesh::HalfedgeHandle left = mesh.halfedge_handle(e, 0), right = mesh.halfedge_handle(e, 1);
    edges.push_back({to_id<VertexId>(mesh.from_vertex_handle(left)),
                     to_id<VertexId>(mesh.to_vertex_handle(left)), to_id<FaceId>(mesh.face_handle(left)),
                     to_id<FaceId>(mesh.face_handle(right)), apex(left), apex(right)});
  }
  return edges;
}

std::vector<std::array<EdgeId, 3>> read_face_edges(const HalfEdgeMesh& mesh) {
  std::vector<std::array<EdgeId, 3>> face_edges;
  face_edges.reserve(mesh.n_faces());
  for (const auto f : mesh.faces()) {
    const OpenMesh::HalfedgeHandle h0 = mesh.halfedge_handle(f);
    const OpenMesh::HalfedgeHandle h1 = mesh.next_halfedge_handle(h0), h2 = mesh.next_halfedge_handle(h1);
    face_edges.push_back({to_id<EdgeId>(mesh.edge_handle(h0)), to_id<EdgeId>(mesh.edge_handle(h1)),
                          to_id<EdgeId>(mesh.edge_handle(h2))});
  }
  return face_edges;
}

/// Components in the order of their lowest faces, each with its faces in ascending order.
std::vector<Component> find_components(const std::vector<Edge>& edges, std::size_t face_count) {
  detail::DisjointSets sets(face_count);
  for (const Edge& e : edges)
    if (!e.is_boundary()) sets.join(static_cast<std::uint32_t>(e.left), static_cast<std::uint32_t>(e.right));
  std::vector<Component> components;
  std::vector<std::uint32_t> component_of(face_count);
  for (std::uint32_t f = 0; f < face_count; ++f) {
    if (const std::uint32_t first = sets.find(f); first == f) {
      component_of[f] = static_cast<std::uint32_t>(components.size());
      components.push_back({.faces = {}, .closed = true, .signed_volume = 0.0});
    } else {
      component_of[f] = component_of[first];
    }
    components[component_of[f]].faces.push_back(FaceId{f});
  }
  for (const Edge& e : edges) {
    if (e.is_boundary()) {
      components[component_of[index(e.left)]].closed = false;
    }
  }
  return components;
}

/// Sum of tetrahedra over the center of the component's bounds, which keeps the terms small far from the
/// origin.
double signed_volume(const Component& component, const std::vector<Vec3>& positions,
                     const std::vector<IndexedTriangle>& triangles) {
  Bounds bounds;
  for (const FaceId f : component.faces) {
    for (const std::uint32_t v : triangles[index(f)]) {
      bounds.add(positions[v]);
    }
  }
  const Vec3 o = bounds.center();
  double six_volumes = 0.0;
  for (const FaceId f : component.faces) {
    const auto& [a, b, c] = triangles[index(f)];
    six_volumes += glm::dot(positions[a] - o, glm::cross(positions[b] - o, positions[c] - o));
  }
  return six_volumes / 6.0;
}

double longest(const std::vector<Edge>& edges, const std::vector<Vec3>& positions) {
  double most = 0.0;
  for (const Edge& e : edges)
    most = std::max(most, glm::length(positions[index(e.to)] - positions[index(e.from)]));
  return most;
}

}  // namespace

TriangleMesh::TriangleMesh() : data_(std::make_shared<const Data>()) {}

TriangleMesh TriangleMesh::build(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                                 const BuildOptions& options) {
  detail::ManifoldPieces pieces = detail::cut_to_manifold(positions, triangles, options.weld);
  auto data = std::make_shared<Data>();
  {
    const HalfEdgeMesh mesh = link_half_edges(pieces);
    data->edges = read_edges(mesh);
    data->face_edges = read_face_edges(mesh);
  }
  data->positions = std::move(pieces.positions);
  data->triangles = std::move(pieces.triangles);
  data->source_triangles = std::move(pieces.source_triangles);
  data->report = std::move(pieces.report);
  data->components = find_components(data->edges, data->triangles.size());

  for (Component& component : data->components)
    component.signed_volume = signed_volume(component, data->positions, data->triangles);
  const std::vector<bool> is_cavity =
      detail::find_cavities(data->components, data->positions, data->triangles);
  std::vector<std::uint8_t> flipped(data->triangles.size(), 0);
  for (std::size_t i = 0; i < data->components.size(); ++i) {
    Component& component = data->components[i];
    if (!options.flip_inside_out || !component.closed || !(component.signed_volume < 0.0) || is_cavity[i]) {
      continue;
    }
    component.signed_volume = -component.signed_volume;
    ++data->report.flipped_components;
    data->report.flipped_faces += component.faces.size();
    for (const FaceId f : component.faces) {
      flipped[index(f)] = 1;
      std::swap(data->triangles[index(f)][1], data->triangles[index(f)][2]);
      std::swap(data->face_edges[index(f)][0], data->face_edges[index(f)][2]);
    }
  }
  for (Edge& e : data->edges) {
    if (flipped[index(e.left)]) {
      std::swap(e.from, e.to);
    }
  }
  data->bounds = bounds_of(data->positions);
  data->longest_edge = longest(data->edges, data->positions);
  TriangleMesh result;
  result.data_ = std::move(data);
  return result;
}

std::span<const Vec3> TriangleMesh::positions() const {
  return data_->positions;
}

std::span<const IndexedTriangle> TriangleMesh::triangles() const {
  return data_->triangles;
}

std::span<const Edge> TriangleMesh::edges() const {
  return data_->edges;
}

std::span<const std::array<EdgeId, 3>> TriangleMesh::face_edges() const {
  return data_->face_edges;
}

std::span<const std::uint32_t> TriangleMesh::source_triangles() const {
  return data_->source_triangles;
}

const Bounds& TriangleMesh::bounds() const {
  return data_->bounds;
}

double TriangleMesh::longest_edge() const {
  return data_->longest_edge;
}

std::span<const Component> TriangleMesh::components() const {
  return data_->components;
}

const BuildReport& TriangleMesh::report() const {
  return data_->report;
}

bool TriangleMesh::is_closed() const {
  return !empty() && std::ranges::all_of(components(), [](const Component& c) { return c.closed; });
}

void Bounds::add(const Vec3& p) {
  low = glm::min(low, p);
  high = glm::max(high, p);
}

void Bounds::add(const Bounds& b) {
  low = glm::min(low, b.low);
  high = glm::max(high, b.high);
}

double Bounds::radius() const {
  if (empty()) {
    return 0.0;
  }
  const Vec3 half = 0.5 * high - 0.5 * low;
  return std::hypot(half.x, half.y, half.z);
}

Bounds bounds_of(std::span<const Vec3> positions) {
  Bounds bounds;
  for (const Vec3& p : positions) {
    bounds.add(p);
  }
  return bounds;
}

}  // namespace penumbra
