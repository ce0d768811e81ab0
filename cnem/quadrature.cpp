#include "cnem/quadrature.hpp"

#include "cnem/moving_least_squares.hpp"

namespace cnem::scni {
namespace {

struct OnFaces {
  voronoi::NaturalNeighbours neighbours;
  voronoi::Functions functions;

  void evaluate(const Vec2& x, const InnerFace<2>& face) {
    neighbours.evaluate_on_facet(functions, x, face.simplex);
  }
  auto nodes() const { return neighbours.nodes(); }
  auto values() const { return neighbours.values(); }
};

struct LeastSquaresOnFaces {
  MovingLeastSquares functions;

  void evaluate(const Vec2& x, const InnerFace<2>& face) { functions.evaluate(x, face.cell[0]); }
  auto nodes() const { return functions.nodes(); }
  auto values() const { return functions.values(); }
};

/// [cell] how far the ends of its faces lie from its node, m.
Field reach_of_cells(const Cloud<2>& cloud, const CellComplex<2>& cells) {
  Field reach(cells.cells(), 0.0);
  for (const InnerFace<2>& face : cells.interior)
    for (const NodeIndex i : face.cell)
      for (const Vec2& corner : face.corner)
        reach[index_of(i)] = std::max(reach[index_of(i)], (corner - cloud.position[i]).norm());
  return reach;
}

} // namespace

FaceMeans face_means(const Cloud<2>& cloud, const voronoi::Triangulation& triangulation,
                     const voronoi::Circumcircles& circles, const voronoi::Cells& cells,
                     voronoi::Functions functions, int gauss_points, Space space) {
  return face_means<2>(cloud, cells, gauss_points, space, [&] {
    return OnFaces{voronoi::NaturalNeighbours(cloud, triangulation, circles), functions};
  });
}

FaceMeans face_means(const Cloud<2>& cloud, const voronoi::Cells& cells, double support, int gauss_points,
                     Space space) {
  const Supports reached = supports(cloud, cells.neighbours, reach_of_cells(cloud, cells), support);
  return face_means<2>(cloud, cells, gauss_points, space,
                       [&] { return LeastSquaresOnFaces{MovingLeastSquares(cloud, reached)}; });
}

} // namespace cnem::scni
