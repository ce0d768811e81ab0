#pragma once
// Damage of the stress points of a solver: what the pass of plasticity/damage.hpp needs beside the state.
#include "core/archive.hpp"
#include "core/operators.hpp"
#include "core/state.hpp"
#include "plasticity/damage.hpp"

#include <vector>

namespace cnem {

/// D, ω and the strain at initiation are fields of the points; here is what belongs to their cells.
template<int dim> class PointDamage {
public:
  PointDamage() = default;
  explicit PointDamage(const std::vector<plasticity::Material>& materials);

  /// Whether any material has a damage law.
  bool active() const { return active_; }

  /// Undamaged points.
  void start(PointState<dim>& point);

  /// Measures the cells of a new reference. The length ℓ of a point is `band` √A of its material, A the
  /// stress-free area of its cell in the plane (the cube root of its volume in 3D).
  void measure(const DiscreteOperators<dim>& operators, const std::vector<plasticity::Material>& materials,
               const PointState<dim>& point);

  /// Factor on the flow stress, strength and share left at ω, for the return map: of all points, and of
  /// [begin, end).
  void weaken(const PointState<dim>& point);
  void weaken(const PointState<dim>& point, std::size_t begin, std::size_t end);
  const Field& flow_factor() const { return flow_factor_; }

  /// update_damage of the points [begin, end). Returns the energy let go, J/m^(3−dim).
  double update(const DiscreteOperators<dim>& operators, const std::vector<plasticity::Material>& materials,
                PointState<dim>& point, std::size_t begin, std::size_t end, double dt) const;

  /// Brings the wave moduli of points that soften up to date, Pa per present volume: (κ + 4μ/3)/J_e, J_e ≥ 1
  /// the dilatation from the stress-free state, or where they stand open, so that they bear in tension alone
  /// until they have closed, ((1 − ω) κ + 4μ/3)/J_e. The others keep λ + 2μ. jacobian [point] det F.
  void wave_moduli(const std::vector<plasticity::Material>& materials, const PointState<dim>& point,
                   const Field& jacobian, Field& wave_modulus) const;

  /// [point] –, the dilatation that the gaps of broken matter in a point take without tension. 0 but for
  /// points that resampling mixed of broken and sound ones.
  Field& opening() { return opening_; }

  /// Carries lengths and openings out or in.
  void archive(Archive& archive, std::size_t points);

private:
  bool active_ = false;
  std::vector<plasticity::JohnsonCookDamage> law_; ///< [material]; none: never softens
  Field length_;                                   ///< [point] ℓ, m
  Field opening_;                                  ///< [point] –
  Field flow_factor_;                              ///< [point] –
};

extern template class PointDamage<2>;

} // namespace cnem
