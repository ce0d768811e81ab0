#pragma once
// Moving least squares: functions at any point that reproduce linear fields and all but interpolate (paper
// 000, (10)–(19), (21)).
#include "core/fields/aligned.hpp"
#include "core/geometry/cell_complex.hpp"
#include "core/geometry/cloud.hpp"

#include <span>
#include <utility>
#include <vector>

namespace cnem::scni {

/// The regularised weight w (–) and dw/d(d²) (1/m²) at the squared distance d² (m²) of a node with the
/// support D (m):
///   w = [((d/D)² + ω)⁻² − (1 + ω)⁻²]/[ω⁻² − (1 + ω)⁻²],  ω = 1e-5,  0 for d >= D
/// (paper 000, (21), after Most 2005). It is 1 at the node and less than 1e-7 beyond 0.18 D, which is what
/// makes functions all but interpolate; to divide it by the sum over all nodes, (20), would not change them.
struct RegularisedWeight {
  double value, slope;
};
RegularisedWeight regularised_weight(double distance2, double support);

/// What the functions of nodes reach, found once for a cloud.
struct Supports {
  /// [node] D_J = `size` × mean distance to the ends of its edges, m, and at least 1.1 of the longest of
  /// these, so that each point of a triangle has its corners.
  Field radius;
  IndexedVector<NodeIndex, std::array<NodeIndex, 2>>
      beside;                       ///< along the boundary, before and after; none: inside
  CellLists<NodeIndex> around;      ///< of node i, those that reach a point within reach of i
  CellLists<CloudFacetIndex> walls; ///< of node i, facets that may stand between the one and the other
};

/// `edges`: the other ends of the edges at each node. reach: [node] how far from it points lie that will be
/// looked at beside it, m: cells within reach of their nodes have to fill the domain. `size`: –, 1.5 to 5,
/// checked by check_support(). Cost O(N).
Supports supports(const Cloud<2>& cloud, const CellLists<NodeIndex>& edges, const Field& reach, double size);

/// Throws InputError unless it is 1.5 to 5.
void check_support(double size);

/// Evaluates functions of one cloud. Cheap to construct; holds references and scratch memory, so use one per
/// thread.
///
/// With p = (1, x, y) and A = Σ_J w_J p_J p_Jᵀ of the nodes that see x
///   φ_J = pᵀA⁻¹ w_J p_J,  ∂_i φ_J = [p_,iᵀA⁻¹ − pᵀA⁻¹A_,iA⁻¹] w_J p_J + pᵀA⁻¹ w_J,i p_J
/// (paper 000, (17); (18) as corrected). A node sees x unless the way between them leaves the domain
/// (visibility criterion; Belytschko, Lu, Gu 1994).
///
/// As weights span eight decades p is counted from the nearest node, and A taken apart into W = Σ w_J, the
/// mean place μ, and the moments S about it: with ξ from that node
///   φ_J = w_J [1/W + a·(ξ_J − μ)],  a = S⁻¹(ξ − μ).
/// What rounding leaves of 1 − Σφ_J and x − Σφ_J x_J is put back once, likewise for gradients.
///
/// Properties: Σφ = 1, Σφ x_J = x to rounding; φ_J(x_I) = δ_IJ to 1e-7 where no two nodes are nearer than
/// 0.2 D. φ may be negative.
class MovingLeastSquares {
public:
  MovingLeastSquares(const Cloud<2>& cloud, const Supports& supports);

  /// Functions at x in the domain, within reach of the node `near`, which sees it. Throws GeometryError where
  /// the nodes that see x lie in one line.
  void evaluate(const Vec2& x, NodeIndex near);
  /// With their gradients.
  void evaluate_with_gradients(const Vec2& x, NodeIndex near);

  // Results of the last evaluation; nodes in increasing order.
  std::span<const NodeIndex> nodes() const { return node_; }
  std::span<const double> values() const { return value_; }     ///< φ
  std::span<const Vec2> gradients() const { return gradient_; } ///< ∇φ, 1/m

private:
  /// A facet that faces x, from there.
  struct Wall {
    Vec2 a, b;
  };
  struct Moments {
    double total;  ///< W
    Vec2 mean;     ///< μ, m from the origin
    Mat2 inverse;  ///< S⁻¹, 1/m²
    Vec2 place, a; ///< ξ − μ, a
  };

  void collect(const Vec2& x, NodeIndex near);
  bool hidden(NodeIndex node, const Vec2& way) const;
  Moments moments(const Vec2& x) const;
  void values(const Moments& m);
  void gradients(const Moments& m);

  const Cloud<2>& cloud_;
  const Supports& supports_;
  std::vector<Wall> wall_;
  std::vector<NodeIndex> node_;
  std::vector<Vec2> place_; ///< ξ_J, m from the nearest node
  std::vector<double> weight_;
  std::vector<Vec2> weight_gradient_; ///< 1/m
  Vec2 at_ = Vec2::Zero();            ///< ξ of the point, m
  std::vector<double> value_;
  std::vector<Vec2> gradient_;
};

} // namespace cnem::scni
