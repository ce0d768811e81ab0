#include "voronoi/space/delaunay.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "voronoi/space/surface.hpp"
#include "voronoi/twins.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>
#include <fmt/format.h>

namespace cnem::voronoi {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SpaceVertexBase = CGAL::Triangulation_vertex_base_with_info_3<NodeIndex, Kernel>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<SimplexIndex, Kernel,
                                                           CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Mesh =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<SpaceVertexBase, CellBase>>;

/// Nodes in an order in which the next one is near.
std::vector<std::size_t> nearby_order(const std::vector<Kernel::Point_3>& points) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  using Traits =
      CGAL::Spatial_sort_traits_adapter_3<Kernel, CGAL::Pointer_property_map<Kernel::Point_3>::const_type>;
  CGAL::spatial_sort(order.begin(), order.end(), Traits(CGAL::make_property_map(points)));
  return order;
}

void refuse_undeclared(const Cloud<3>& cloud, const IndexedVector<NodeIndex, NodeIndex>& first) {
  const auto group = twin_groups(cloud);
  for (const NodeIndex i : first.indices())
    if (first[i] != i && (group.empty() || group[first[i]] != group[i]))
      throw GeometryError(fmt::format("{} coincides with node {}: expected distinct positions, or a declared "
                                      "pair of twins on the two faces of a slit",
                                      describe_node(cloud, i), index_of(first[i])));
}

} // namespace

Delaunay delaunay(const Cloud<3>& cloud) {
  std::vector<Kernel::Point_3> points;
  points.reserve(cloud.position.size());
  for (const Vec3& x : cloud.position) points.emplace_back(x.x(), x.y(), x.z());

  Mesh mesh;
  Mesh::Cell_handle near;
  IndexedVector<NodeIndex, Mesh::Vertex_handle> vertex(points.size());
  for (const std::size_t i : nearby_order(points)) {
    const std::size_t before = mesh.number_of_vertices();
    const Mesh::Vertex_handle v = vertex[i] = mesh.insert(points[i], near);
    near = v->cell();
    const auto node = as<NodeIndex>(i);
    v->info() = mesh.number_of_vertices() > before ? node : std::min(v->info(), node);
  }
  if (mesh.dimension() < 3)
    throw GeometryError(fmt::format("empty domain: the {} nodes lie on one plane", points.size()));

  Delaunay result;
  result.first.resize(points.size());
  for (const NodeIndex i : vertex.indices()) result.first[i] = vertex[i]->info();
  if (mesh.number_of_vertices() < points.size()) refuse_undeclared(cloud, result.first);
  result.coincident = mesh.number_of_vertices() < points.size();

  const std::size_t count = mesh.number_of_finite_cells();
  result.node.reserve(count);
  for (const Mesh::Cell_handle cell : mesh.all_cell_handles()) cell->info() = SimplexIndex::none;
  for (const Mesh::Cell_handle cell : mesh.finite_cell_handles()) {
    cell->info() = result.node.next();
    result.node.push_back(
        {cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(), cell->vertex(3)->info()});
  }
  result.neighbour.reserve(count);
  for (const Mesh::Cell_handle cell : mesh.finite_cell_handles())
    result.neighbour.push_back({cell->neighbor(0)->info(), cell->neighbor(1)->info(),
                                cell->neighbor(2)->info(), cell->neighbor(3)->info()});
  return result;
}

} // namespace cnem::voronoi
