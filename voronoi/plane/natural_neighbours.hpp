#pragma once
// Constrained natural neighbours: Sibson and Laplace functions at any point (paper 004, (66)-(69), (71)).
#include "voronoi/functions.hpp"
#include "voronoi/plane/circumcircles.hpp"
#include "voronoi/plane/locate.hpp"
#include "voronoi/plane/triangulation.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cnem::voronoi {

/// Evaluates shape functions on one triangulation. Cheap to construct; holds references and scratch memory,
/// so use one per thread. Nothing is allocated in an evaluation once the scratch has grown to the largest
/// stencil.
///
/// Properties: φ >= 0, Σφ = 1, Σφ x_i = x, φ_i(x_j) = δ_ij, linear on boundary facets, zero across walls.
class NaturalNeighbours {
public:
  NaturalNeighbours(const Cloud<2>& cloud, const Triangulation& mesh, const Circumcircles& circles);

  /// Functions at x in the domain. `hint`: a triangle near x. Throws GeometryError when x lies outside.
  void evaluate(Functions functions, const Vec2& x, SimplexIndex hint = {});

  /// Functions at a point of the facet between two cells: saves locating it.
  /// `triangle`: InnerFace::simplex of the cells (voronoi/plane/cells.hpp).
  void evaluate_on_facet(Functions functions, const Vec2& x, const std::array<SimplexIndex, 2>& triangle);

  /// Functions and their gradients at x. At nodes and on the boundary, where they have no (two-sided)
  /// gradient, those of linear interpolation over the triangle are given.
  void evaluate_with_gradients(Functions functions, const Vec2& x, SimplexIndex hint = {});

  // Results of the last evaluation.
  std::span<const NodeIndex> nodes() const {
    return node_;
  }                                                         ///< natural neighbours, counter-clockwise about x
  std::span<const double> values() const { return value_; } ///< φ
  std::span<const Vec2> gradients() const { return gradient_; } ///< ∇φ, 1/m

private:
  /// A natural neighbour during an evaluation; positions relative to x.
  struct Neighbour {
    NodeIndex node;
    double x, y;     ///< of the node
    double cx, cy;   ///< circumcentre of x, this and the next neighbour
    double stolen;   ///< twice the stolen area, less the part between `centre` and its predecessor
    double cot_next; ///< cotangent of the angle at the next neighbour in the triangle with x
    double cot_here; ///< cotangent of the angle here in the triangle with x and the next neighbour
    double area;     ///< twice the area of that triangle
  };
  /// A triangle of the cavity on the way down; its edges from `edge` on are still to be visited.
  struct Frame {
    SimplexIndex triangle;
    std::int32_t edge;
    std::int32_t left;
  };
  enum class Outcome { inside, on_node, on_wall, lost };

  Outcome collect(const Vec2& x, SimplexIndex start, bool located);
  Outcome degenerate_edge(const Neighbour& a, const Neighbour& b, bool wall, bool located) const;
  bool in_circle(SimplexIndex triangle, const Vec2& x) const;
  void weigh(Functions functions);
  void weigh_gradients(Functions functions);
  void linear_on(const Location& at);
  void linear_gradients_on(SimplexIndex triangle);
  bool finish(Outcome outcome, Functions functions);

  const Cloud<2>& cloud_;
  const Triangulation& mesh_;
  const Circumcircles& circles_;
  std::vector<Frame> frame_;
  std::vector<Neighbour> ring_; ///< the first `count_` are in use
  std::size_t count_ = 0;
  std::vector<NodeIndex> node_;
  std::vector<double> value_;
  std::vector<Vec2> gradient_;
};

} // namespace cnem::voronoi
