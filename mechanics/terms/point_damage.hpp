#pragma once
// Damage of the stress points of a solver: what the pass of plasticity/damage.hpp needs beside the state.
#include "mechanics/terms/damage_average.hpp"
#include "mechanics/terms/term.hpp"
#include "plasticity/damage.hpp"

#include <vector>

namespace cnem {

/// D, ω and the strain at initiation are fields of the points; here is what belongs to their cells.
template<int dim> class PointDamage : public Term<dim> {
public:
  explicit PointDamage(const std::vector<plasticity::Material>& materials);

  /// Measures the cells of a new reference. The length ℓ of a point is `band` √A of its material, A the
  /// stress-free area of its cell in the plane (the cube root of its volume in 3D).
  void measure(const DiscreteOperators<dim>& operators, const std::vector<plasticity::Material>& materials,
               const PointState<dim>& point);

  /// Factor on the flow stress of the points [begin, end), strength and the share left at ω and the pressure
  /// of the last step, for the return map.
  void weaken(const std::vector<plasticity::Material>& materials, PointState<dim>& point, std::size_t begin,
              std::size_t end) const;

  /// update_damage of the points [begin, end). Returns the energy let go, J/m^(3−dim).
  double update(const DiscreteOperators<dim>& operators, const std::vector<plasticity::Material>& materials,
                PointState<dim>& point, std::size_t begin, std::size_t end, double dt) const;

  /// Brings the wave moduli of points that soften up to date, Pa per present volume: (κ + 4μ/3)/J_e, J_e ≥ 1
  /// the dilatation from the stress-free state, or where they stand open, so that they bear in tension alone
  /// until they have closed, ((1 − ω) κ + 4μ/3)/J_e. The others keep λ + 2μ.
  void wave_moduli(const std::vector<plasticity::Material>& materials, PointState<dim>& point) const;

  FieldTable* fields() override { return &table_; }
  std::vector<Energy*> energies() override { return {&released_}; }
  void limit(const Body<dim>& body, StepLimit& limit) override;
  void carried(const Body<dim>& body) override;
  void renew(const Body<dim>& body) override;
  void attach(const Body<dim>& body) override;
  void begin_stress(const Body<dim>& body, const DuePoints& due) override;
  void before_stress(const Body<dim>& body, const LevelRange& range) override;
  void after_stress(const Body<dim>& body, const DuePoints& due, const LevelRange& range) override;
  void end_stress(const Body<dim>& body, const DuePoints& due) override;

private:
  bool active_; ///< whether any material has a damage law
  DamageAverage<dim> average_;
  FieldTable table_;
  ScalarField length_{table_, {"damage_length", "m", Carry::renewed, Checkpoint::holds}}; ///< ℓ
  std::vector<double> sums_; ///< [range] J/m^(3−dim)
  Energy released_{"damage", EnergyKind::dissipated};
};

extern template class PointDamage<2>;
extern template class PointDamage<3>;

} // namespace cnem
