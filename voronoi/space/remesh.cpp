#include "voronoi/space/remesh.hpp"

#include "core/index.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <algorithm>

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

} // namespace

std::vector<std::array<CloudFacetIndex, 2>> crossing_facets(const Cloud<3>& surface, std::size_t limit) {
  const Mesh mesh = mesh_of(surface);
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(pairs));
  std::vector<std::array<CloudFacetIndex, 2>> found;
  for (const auto& [one, other] : pairs) {
    const auto a = as<CloudFacetIndex>(one.idx()), b = as<CloudFacetIndex>(other.idx());
    found.push_back({std::min(a, b), std::max(a, b)});
  }
  std::ranges::sort(found);
  if (found.size() > limit) found.resize(limit);
  return found;
}

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
                           CGAL::parameters::number_of_iterations(8)
                               .number_of_relaxation_steps(3)
                               .relax_constraints(true)
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
