#include "voronoi/space/remesh.hpp"

#include "core/index.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>
#include <algorithm>
#include <cmath>

namespace cnem::voronoi {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Faces are numbered as facets, vertices as nodes.
Mesh mesh_of(const Cloud<3>& surface) {
  Mesh mesh;
  for (const Vec3& x : surface.position) mesh.add_vertex(Kernel::Point_3(x.x(), x.y(), x.z()));
  const auto vertex = [](NodeIndex i) { return Mesh::Vertex_index(static_cast<std::uint32_t>(index_of(i))); };
  for (const Facet<3>& facet : surface.facets)
    mesh.add_face(vertex(facet.node[0]), vertex(facet.node[1]), vertex(facet.node[2]));
  return mesh;
}

using Kept = Mesh::Property_map<Mesh::Edge_index, bool>;

/// The next halfedge along a crease; null where it ends or forks.
Mesh::Halfedge_index next_on_crease(const Mesh& mesh, const Kept& kept, Mesh::Halfedge_index half) {
  Mesh::Halfedge_index next = Mesh::null_halfedge();
  int creases = 0;
  for (const Mesh::Halfedge_index arriving : mesh.halfedges_around_target(half)) {
    const Mesh::Halfedge_index leaving = mesh.opposite(arriving);
    if (!kept[mesh.edge(leaving)]) continue;
    ++creases;
    if (leaving != mesh.opposite(half)) next = leaving;
  }
  return creases == 2 ? next : Mesh::null_halfedge();
}

/// Collapsing leaves a short edge at the end of a crease that was finer than h: there nodes move along the
/// crease until its edges are equal. Whether any did.
bool share_out(Mesh& mesh, const Kept& kept, double h) {
  bool moved = false;
  for (const Mesh::Halfedge_index start : mesh.halfedges()) {
    if (!kept[mesh.edge(start)]) continue;
    if (next_on_crease(mesh, kept, mesh.opposite(start)) != Mesh::null_halfedge()) continue; // not its end
    std::vector<Kernel::Point_3> point{mesh.point(mesh.source(start))};
    std::vector<Mesh::Vertex_index> vertex{mesh.source(start)};
    std::vector<double> length{0.0};
    double least = h;
    for (Mesh::Halfedge_index at = start; at != Mesh::null_halfedge(); at = next_on_crease(mesh, kept, at)) {
      vertex.push_back(mesh.target(at));
      point.push_back(mesh.point(mesh.target(at)));
      const double edge = std::sqrt(CGAL::squared_distance(point[point.size() - 2], point.back()));
      least = std::min(least, edge);
      length.push_back(length.back() + edge);
    }
    if (least > 0.7 * h || vertex.size() < 3 || vertex.front() > vertex.back()) continue;
    moved = true;
    std::size_t k = 1;
    for (std::size_t i = 1; i + 1 < vertex.size(); ++i) {
      const double wanted = length.back() * static_cast<double>(i) / static_cast<double>(vertex.size() - 1);
      while (length[k] < wanted) ++k;
      const double share = (wanted - length[k - 1]) / (length[k] - length[k - 1]);
      mesh.point(vertex[i]) = point[k - 1] + share * (point[k] - point[k - 1]);
    }
  }
  return moved;
}

} // namespace

Cloud<3> remesh(const Cloud<3>& surface, double h) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  Mesh mesh = mesh_of(surface);
  auto piece = mesh.add_property_map<Mesh::Face_index, int>("f:piece").first;
  for (const CloudFacetIndex f : surface.facets.indices())
    piece[Mesh::Face_index(static_cast<std::uint32_t>(index_of(f)))] = as<int>(surface.facets[f].piece);
  auto kept = mesh.add_property_map<Mesh::Edge_index, bool>("e:kept", false).first;
  for (const Mesh::Edge_index e : mesh.edges()) {
    const auto half = mesh.halfedge(e);
    kept[e] = piece[mesh.face(half)] != piece[mesh.face(mesh.opposite(half))];
  }
  pmp::isotropic_remeshing(mesh.faces(), h, mesh,
                           CGAL::parameters::number_of_iterations(6)
                               .number_of_relaxation_steps(3)
                               .edge_is_constrained_map(kept)
                               .face_patch_map(piece));
  if (share_out(mesh, kept, h)) // what lies between follows
    pmp::isotropic_remeshing(mesh.faces(), h, mesh,
                             CGAL::parameters::number_of_iterations(4)
                                 .number_of_relaxation_steps(3)
                                 .protect_constraints(true)
                                 .edge_is_constrained_map(kept)
                                 .face_patch_map(piece));
  Cloud<3> result;
  result.piece_names = surface.piece_names;
  std::vector<NodeIndex> number(mesh.number_of_vertices() + mesh.number_of_removed_vertices(),
                                NodeIndex::none);
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    number[v.idx()] = result.position.next();
    const auto& x = mesh.point(v);
    result.position.push_back({x.x(), x.y(), x.z()});
  }
  for (const Mesh::Face_index f : mesh.faces()) {
    Facet<3> facet{{}, as<PieceIndex>(piece[f])};
    std::size_t k = 0;
    for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f)))
      facet.node[k++] = number[v.idx()];
    result.facets.push_back(facet);
  }
  return result;
}

} // namespace cnem::voronoi
