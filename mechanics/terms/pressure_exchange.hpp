#pragma once
// Smooths the oscillating pressure of nodal integration where the metal flows: neighbours trade volume.
#include "mechanics/terms/term.hpp"

#include <vector>

namespace cnem {

/// After the return map, on the links between two nodes that both flow and are whole:
///
///   Δp_ij = p_j − p_i − ½ (g_i + g_j)·X_ij,  g_i = Σ_k b_ik (p_k − p_i)
///   w_ij = min[α L_ij d_ij 3 min(Δγ_i, Δγ_j)/(σ_i + σ_j), ½ min(V_i/n_i, V_j/n_j)/κ]
///   δθ_i = −Σ_j w_ij Δp_ij / V_i,  b_e ← e^{2δθ/3} b_e,  p_i ← p_i − κ δθ_i
///
/// (Bochev and Dohrmann's projection with the plastic tangent viscosity; n_i is the number of links of node
/// i.) w_ij Δp_ij changes its sign alone when i and j are exchanged, so that Σ V δθ = 0; nodes do not move
/// and momenta are untouched, as are constant and linear pressures and elastic zones. What b_e's J and the
/// geometric one part by is Σ δθ of each node, `PointState::volume_drift`. Where it would grow at an end of a
/// link, w_ij is less by the smaller of both ends' 1 − |Σ δθ|/0.05 (0 beyond), so that corners, where
/// pressures are singular, do not drift on.
///
/// Softened points take no part: the volume of gaps is not shared with what is whole.
///
/// With local time steps a link exchanges when all points whose pressures enter are due, over the time since
/// they were due together: pressures of one time, and as much out of i as into j.
template<int dim> class PressureExchange : public Term<dim> {
public:
  explicit PressureExchange(double alpha) : alpha_(alpha), table_("solver/point", alpha > 0.0) {}

  bool active(const StabilisationLinks<dim>& links) const { return alpha_ > 0.0 && !links.neighbour.empty(); }

  /// Takes a new reference: the bulk moduli of its nodes, Pa.
  void reset(Field bulk_modulus);
  /// Keeps the pressures of points that are due, of the start of their step, for the energy of this step.
  void remember(const Field& pressure, const DuePoints& due);

  /// What an exchange has done to the energies of the body, J/m^(3−dim).
  struct Change {
    double dissipated =
        0.0; ///< −Σ V ½(τⁿ + τⁿ⁺¹) δθ, τ = −p, and stored energy of the volume that was traded
    double plastic = 0.0; ///< plastic work of the past counted in that volume, to be given back
  };
  /// One exchange of what is due, for a nodal method. `reference` [node · dim + component]; `stress` gets the
  /// change of P.
  Change apply(const DiscreteOperators<dim>& operators, const StabilisationLinks<dim>& links,
               const Field& reference, const DuePoints& due, PointState<dim>& point,
               ColumnStress<dim>& stress);

  FieldTable* fields() override { return &table_; }
  std::vector<Energy*> energies() override { return {&dissipated_}; }
  std::vector<Metric> metrics(const BodyView<dim>& body) const override;
  void attach(const Body<dim>& body) override;
  void set_levels(const Body<dim>& body) override;
  void begin_stress(const Body<dim>& body, const DuePoints& due) override;
  void end_stress(const Body<dim>& body, const DuePoints& due) override;

private:
  double alpha_;
  FieldTable table_;
  ScalarField bulk_modulus_{table_, {"bulk_modulus", "Pa"}};
  ScalarField before_{table_, {"pressure_before", "Pa"}};
  std::vector<std::int8_t> level_; ///< [node] of the coarsest point in its stencil; empty: one level
  Field record_;                   ///< [node] p, g, Δγ (0: no part in it), σ, V/n, Σ δθ
  Energy dissipated_{"pressure_exchange", EnergyKind::dissipated};
};

/// Root mean square of (p − mean of the neighbours' p)/σ_eq over interior nodes that flow and have not
/// melted; 0 when there is none.
template<int dim>
double pressure_noise(const StabilisationLinks<dim>& links, const std::vector<Facet<dim>>& facets,
                      const PointState<dim>& point);

extern template class PressureExchange<2>;
extern template class PressureExchange<3>;
extern template double pressure_noise<2>(const StabilisationLinks<2>&, const std::vector<Facet<2>>&,
                                         const PointState<2>&);

} // namespace cnem
