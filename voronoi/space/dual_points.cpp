#include "voronoi/space/dual_points.hpp"

#include "core/geometry/facets.hpp"
#include "core/machine/parallel.hpp"
#include "voronoi/space/walk.hpp"

namespace cnem::voronoi {
namespace {

/// Coordinates of the point of a facet.
std::array<double, 2> place_on(const std::array<Vec<3>, 3>& x) {
  const std::array<double, 3> squared{(x[2] - x[1]).squaredNorm(), (x[0] - x[2]).squaredNorm(),
                                      (x[1] - x[0]).squaredNorm()};
  std::array<double, 3> weight;
  for (std::size_t k = 0; k < 3; ++k) {
    const double beside = squared[(k + 1) % 3] + squared[(k + 2) % 3] - squared[k];
    if (beside <= 0.0) { // obtuse there
      constexpr std::array<std::array<double, 2>, 3> middle{{{0.5, 0.5}, {0.0, 0.5}, {0.5, 0.0}}};
      return middle[k];
    }
    weight[k] = squared[k] * beside;
  }
  const double sum = weight[0] + weight[1] + weight[2];
  return {weight[1] / sum, weight[2] / sum};
}

} // namespace

DualPoints dual_points(const Cloud<3>& cloud, const Tetrahedra& mesh, const Circumspheres& spheres) {
  const std::size_t count = mesh.node.size(), facets = cloud.facets.size();
  DualPoints points;
  points.place.resize(count + facets);
  points.on_facet.resize(facets);
  points.holder.resize(count);
  points.wall.resize(count);
  for_each_block(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto t = as<SimplexIndex>(k);
      const SpaceWalkEnd reached = walk(cloud, mesh, t, spheres.centre[t]);
      points.place[dual_point_of(t)] = reached.place;
      points.holder[t] = reached.tetrahedron;
      points.wall[t] = reached.facet;
    }
  });
  for (const CloudFacetIndex f : cloud.facets.indices()) {
    const auto corner = corners_of<3>(cloud.facets[f], cloud.position);
    points.on_facet[f] = place_on(corner);
    points.place[dual_point_of(mesh, f)] = point_on<3>(corner, points.on_facet[f]);
  }
  return points;
}

void draw_in(const Cloud<3>& cloud, const Tetrahedra& mesh, DualPoints& points, SimplexIndex tetrahedron) {
  Vec<3> centroid = Vec<3>::Zero();
  for (const NodeIndex i : mesh.node[tetrahedron]) centroid += 0.25 * cloud.position[i];
  Vec<3>& place = points.place[dual_point_of(tetrahedron)];
  place = 0.5 * (place + centroid);
  points.holder[tetrahedron] = walk(cloud, mesh, tetrahedron, place).tetrahedron;
  points.wall[tetrahedron] = CloudFacetIndex::none;
}

void draw_in(const Cloud<3>& cloud, const Tetrahedra& mesh, DualPoints& points, CloudFacetIndex facet) {
  for (double& t : points.on_facet[facet]) t = 0.5 * (t + 1.0 / 3.0);
  points.place[dual_point_of(mesh, facet)] =
      point_on<3>(corners_of<3>(cloud.facets[facet], cloud.position), points.on_facet[facet]);
}

} // namespace cnem::voronoi
