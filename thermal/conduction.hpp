#pragma once
// Explicit heat conduction on the deformed configuration, (57)–(61) with J F⁻¹ F⁻ᵀ in the kernel.
#include "core/fields/state.hpp"
#include "core/operators/operators.hpp"
#include "core/vec.hpp"

namespace cnem {

/// Conduction with any gradient operator. C-NEM hands over the one of its Delaunay triangles or tetrahedra:
/// the nodal one has weak modes that show as checkerboards (tests/unit/thermal). Of linear simplices it reads
/// the pattern alone, in space not even their volumes: they conduct as they stand. In space those are the
/// rows of four nodes that come before all others, where rows are not those of nodes.
template<int dim> class Conduction {
public:
  /// Operators must outlive this object. conductivity [point of `operators`] in W/(m K).
  void set_operators(const DiscreteOperators<dim>& operators, Field conductivity);

  /// flow_J += −Σ_p V_p k J (F⁻¹F⁻ᵀ ∇_X T)·b_pJ: heat that arrives at node J, W/m^(3−dim). The flows of all
  /// nodes add up to zero. Positions are the current ones, side by side (core/operators/side_by_side.hpp).
  void add_flow(const Field& position, const Field& temperature, Field& flow);

  /// The decay rate no mode exceeds without limits, 1/s: explicit steps are stable below 2 over it.
  double fastest_decay(const Field& position, const Field& heat_capacity);

  /// Lets points around light nodes conduct less from now on, so that these alone ask for no faster decay
  /// than `decay` (1/s) here; the others as before. A node is light that has less than a twentieth of the
  /// heat capacity of what conducts around it, by the median of all. The decay rate that no mode exceeds
  /// then, 1/s.
  double limit_decay(const Field& position, const Field& heat_capacity, double decay);
  void lift_limit();

private:
  void number_corners();
  double conducting_determinant(const Mat2& deformation, std::size_t row) const;
  void look_at_transfer(const Field& position);
  double decay_bound(const Field& heat_capacity) const;
  void add_simplex_flow(const Field& position, const Field& temperature, Field& flow);
  void heat_other_rows(const Field& position, const Field& temperature);

  const DiscreteOperators<dim>* operators_ = nullptr;
  std::vector<NodeIndex> triangle_;  ///< [3 · triangle + corner] node, counter-clockwise, in the plane
  std::vector<std::int32_t> corner_; ///< [column entry] row entry; empty: flux through columns
  std::size_t simplices_ = 0;        ///< rows that are linear simplices: in the plane all or none
  std::size_t unread_ = 0;           ///< entries of theirs whose gradients are not there
  Field conductivity_, given_;       ///< as limited, and without limits
  bool limited_ = false;
  Field flux_; ///< [row][k] k J F⁻¹F⁻ᵀ ∇_X T, pulled-back heat flux with its sign turned, of rows that are no
               ///< linear simplices
  Field heat_;                     ///< [row entry] into its node, where no flux goes through columns
  Field norm_, transfer_, around_; ///< [row entry], [node], [node]: while decay rates are looked at
};

extern template class Conduction<2>;
extern template class Conduction<3>;

} // namespace cnem
