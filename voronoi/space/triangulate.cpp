#include "voronoi/space/triangulate.hpp"

#include "voronoi/space/filling.hpp"
#include "voronoi/space/surface.hpp"

namespace cnem::voronoi {

Tetrahedra triangulate(const Cloud<3>& cloud) {
  surface_edges(cloud);
  return filling(cloud, delaunay(cloud));
}

} // namespace cnem::voronoi
