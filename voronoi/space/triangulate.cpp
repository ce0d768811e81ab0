#include "voronoi/space/triangulate.hpp"

#include "voronoi/space/bodies.hpp"
#include "voronoi/space/filling.hpp"
#include "voronoi/space/surface.hpp"

#include <cassert>

namespace cnem::voronoi {

namespace {

Tetrahedra of_one_body(const Cloud<3>& cloud) {
  surface_edges(cloud);
  return filling(cloud, delaunay(cloud)).tetrahedra;
}

Tetrahedra from_nothing(const Cloud<3>& cloud) {
  if (cloud.body.empty()) return of_one_body(cloud);
  const std::vector<SingleBody> bodies = single_bodies(cloud);
  std::vector<Tetrahedra> meshes;
  for (const SingleBody& body : bodies) meshes.push_back(of_one_body(body.cloud));
  return joined(cloud, bodies, meshes);
}

Tetrahedra brought(const Cloud<3>& cloud) {
  Delaunay inside{cloud.simplices, cloud.across, {}, false};
  inside.first.resize(cloud.position.size());
  for (const NodeIndex i : inside.first.indices()) inside.first[i] = i;
  return in_order(cloud, inside);
}

} // namespace

Tetrahedra triangulate(const Cloud<3>& cloud) {
  if (cloud.simplices.empty()) return from_nothing(cloud);
  Tetrahedra mesh = brought(cloud);
  assert(mesh.node == from_nothing(cloud).node);
  return mesh;
}

} // namespace cnem::voronoi
