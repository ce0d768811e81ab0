#include "voronoi/space/dual_points.hpp"

#include "core/geometry/facets.hpp"
#include "core/machine/parallel.hpp"
#include "voronoi/space/median_cells.hpp"
#include "voronoi/space/walk.hpp"

namespace cnem::voronoi {
DualPoints dual_points(const Cloud<3>& cloud, const Tetrahedra& mesh, const Circumspheres& spheres) {
  const std::size_t count = mesh.node.size(), facets = cloud.facets.size();
  DualPoints points;
  points.place.resize(count + facets);
  points.holder.resize(count);
  for_each_block(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto t = as<SimplexIndex>(k);
      const SpaceWalkEnd reached = walk(cloud, mesh, t, spheres.centre[t]);
      points.place[dual_point_of(t)] = reached.place;
      points.holder[t] = reached.tetrahedron;
    }
  });
  for (const CloudFacetIndex f : cloud.facets.indices())
    points.place[dual_point_of(mesh, f)] =
        point_on<3>(corners_of<3>(cloud.facets[f], cloud.position), facet_centroid);
  return points;
}

void draw_in(const Cloud<3>& cloud, const Tetrahedra& mesh, DualPoints& points, SimplexIndex tetrahedron) {
  Vec<3> centroid = Vec<3>::Zero();
  for (const NodeIndex i : mesh.node[tetrahedron]) centroid += 0.25 * cloud.position[i];
  Vec<3>& place = points.place[dual_point_of(tetrahedron)];
  place = 0.5 * (place + centroid);
  points.holder[tetrahedron] = walk(cloud, mesh, tetrahedron, place).tetrahedron;
}

} // namespace cnem::voronoi
