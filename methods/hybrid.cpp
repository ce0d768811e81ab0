#include "methods/hybrid.hpp"

#include <algorithm>
#include <utility>

namespace cnem::methods {
namespace {

/// Functions on the faces of cells, by the triangles beside the face.
struct OnFaces {
  voronoi::NaturalNeighbours functions;
  const IndexedVector<SimplexIndex, bool>& zone;

  void evaluate(const Vec2& x, const InnerFace<2>& face) {
    const bool natural = std::any_of(face.simplex.begin(), face.simplex.end(),
                                     [&](SimplexIndex t) { return exists(t) && zone[t]; });
    functions.evaluate_on_facet(natural ? voronoi::Functions::sibson : voronoi::Functions::linear, x,
                                face.simplex);
  }
  auto nodes() const { return functions.nodes(); }
  auto values() const { return functions.values(); }
};

} // namespace

IndexedVector<SimplexIndex, bool> natural_zone(const Cloud<2>& cloud,
                                               const voronoi::Triangulation& triangulation, double spacing) {
  IndexedVector<SimplexIndex, bool> zone(triangulation.node.size(), false);
  for (const SimplexIndex t : zone.indices()) {
    const auto& corner = triangulation.node[t];
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      longest =
          std::max(longest, (cloud.position[corner[(k + 1) % 3]] - cloud.position[corner[k]]).squaredNorm());
    zone[t] = longest <= spacing * spacing;
  }
  return zone;
}

Hybrid::Hybrid(double zone_spacing, int gauss_points, Space space)
    : zone_spacing_(zone_spacing), gauss_points_(gauss_points), space_(space) {
  scni::check_gauss_points(gauss_points);
}

Approximation<2> Hybrid::rebuild(const Cloud<2>& cloud) {
  const scni::Diagram diagram(cloud);
  const auto zone = natural_zone(cloud, diagram.triangulation, zone_spacing_);
  scni::FaceMeans means = scni::face_means<2>(cloud, diagram.cells, gauss_points_, space_, [&] {
    return OnFaces{voronoi::NaturalNeighbours(cloud, diagram.triangulation, diagram.circles), zone};
  });
  return scni::integrate_at_nodes(cloud, diagram, std::move(means), voronoi::Functions::sibson, space_);
}

} // namespace cnem::methods
