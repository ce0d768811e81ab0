#include "voronoi/space/walk.hpp"

#include "core/index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace cnem::voronoi {

std::array<Vec<3>, 4> face_normals(const std::array<Vec<3>, 4>& x) {
  const Vec<3> a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
  const Vec<3> bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
  return {bc + ca + ab, -bc, -ca, -ab};
}

std::array<Vec<3>, 4> corners_of(const Cloud<3>& cloud, const Tetrahedra& mesh, SimplexIndex tetrahedron) {
  std::array<Vec<3>, 4> corner;
  for (std::size_t k = 0; k < 4; ++k) corner[k] = cloud.position[mesh.node[tetrahedron][k]];
  return corner;
}

SpaceWalkEnd walk(const Cloud<3>& cloud, const Tetrahedra& mesh, SimplexIndex from, const Vec<3>& x) {
  auto corner = corners_of(cloud, mesh, from);
  const Vec<3> start = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]), way = x - start;
  SimplexIndex at = from, before = SimplexIndex::none;
  // Among flat tetrahedra rounding may lead in a circle.
  for (std::size_t step = 0; step <= mesh.node.size(); ++step) {
    const auto normal = face_normals(corner);
    double first = std::numeric_limits<double>::infinity();
    std::size_t exit = 4;
    for (std::size_t k = 0; k < 4; ++k) {
      if (exists(before) && mesh.neighbour[at][k] == before) continue;
      const Vec<3>& on_face = corner[(k + 1) % 4];
      if (!(normal[k].dot(x - on_face) > 0.0)) continue;
      const double along = normal[k].dot(way);
      const double place = along > 0.0 ? normal[k].dot(on_face - start) / along : 1.0;
      if (place < first) {
        first = place;
        exit = k;
      }
    }
    if (exit == 4) break;
    if (!exists(mesh.neighbour[at][exit]))
      return {at, mesh.facet[at][exit], start + std::clamp(first, 0.0, 1.0) * way};
    before = at;
    at = mesh.neighbour[at][exit];
    corner = corners_of(cloud, mesh, at);
  }
  return {at, CloudFacetIndex::none, x};
}

} // namespace cnem::voronoi
