#include "cnem/quadrature.hpp"

namespace cnem::scni {
namespace {

struct OnFaces {
  voronoi::NaturalNeighbours neighbours;
  voronoi::Functions functions;

  void evaluate(const Vec2& x, const std::array<SimplexIndex, 2>& simplex) {
    neighbours.evaluate_on_facet(functions, x, simplex);
  }
  auto nodes() const { return neighbours.nodes(); }
  auto values() const { return neighbours.values(); }
};

} // namespace

FaceMeans face_means(const Cloud<2>& cloud, const voronoi::Triangulation& triangulation,
                     const voronoi::Circumcircles& circles, const voronoi::Cells& cells,
                     voronoi::Functions functions, int gauss_points, Space space) {
  return face_means<2>(cloud, cells, gauss_points, space, [&] {
    return OnFaces{voronoi::NaturalNeighbours(cloud, triangulation, circles), functions};
  });
}

} // namespace cnem::scni
