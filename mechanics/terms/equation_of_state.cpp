// Pressure of compressed metal from its equation of state, in the place of the logarithmic law of the return
// map: that leaves deviators alone, so that the mean stress may be another one afterwards.
#include "plasticity/equation_of_state.hpp"
#include "mechanics/terms/list.hpp"

#include <algorithm>
#include <optional>

namespace cnem {

namespace {

template<int dim> class EquationOfState : public Term<dim> {
public:
  explicit EquationOfState(const std::vector<plasticity::Material>& materials) {
    for (const plasticity::Material& material : materials) {
      curves_.emplace_back();
      if (material.equation_of_state)
        curves_.back().emplace(*material.equation_of_state, material.elasticity.kappa());
    }
  }

  void limit(const Body<dim>& body, StepLimit&) override {
    PointState<dim>& point = body.state.point;
    for (std::size_t p = 0; p < point.size(); ++p) {
      const plasticity::Material& material = body.material_of(p);
      if (!curve_of(point, p)) continue;
      const double kappa = material.elasticity.kappa(), shear = 4.0 / 3.0 * material.elasticity.mu();
      const double density = point.stress_free[p] / point.jacobian[p]; // over that at rest
      const double modulus =
          density > 1.0 ? curve_of(point, p)->at(density - 1.0, heat(point, material, p)).modulus : kappa;
      point.wave_modulus[p] = (std::max(modulus, kappa) + shear) * std::max(density, 1.0);
    }
  }

  void renew(const Body<dim>& body) override { update(body, 0, body.state.point.size()); }

  void after_stress(const Body<dim>& body, const DuePoints&, const LevelRange& range) override {
    update(body, range.begin, range.end);
  }

private:
  std::vector<std::optional<plasticity::CompressionCurve>> curves_; ///< [material]

  const std::optional<plasticity::CompressionCurve>& curve_of(const PointState<dim>& point,
                                                              std::size_t p) const {
    return curves_[index_of(point.material[p])];
  }

  /// ρ0 c (T − T0), J/m³.
  static double heat(const PointState<dim>& point, const plasticity::Material& material, std::size_t p) {
    return material.density * material.specific_heat * (point.temperature[p] - material.expansion_reference);
  }

  /// P, pressure and stored energy of the points [begin, end), which the return map has just written.
  void update(const Body<dim>& body, std::size_t begin, std::size_t end) const {
    PointState<dim>& point = body.state.point;
    for (std::size_t p = begin; p < end; ++p) {
      const auto& curve = curve_of(point, p);
      if (!curve) continue;
      const double volume = jacobian<dim>(point.deformation, p);
      const double mu = point.stress_free[p] / volume - 1.0;
      if (!(mu > 0.0)) continue;
      const plasticity::Material& material = body.material_of(p);
      const double held = heat(point, material, p), kappa = material.elasticity.kappa();
      const plasticity::CompressionCurve::Compressed compressed = curve->at(mu, held);
      const double before = point.pressure[p], scale = (before - compressed.pressure) * (1.0 + mu);
      const auto cofactor = cofactors<dim>(point.deformation, p);
      for (std::size_t c = 0; c < cofactor.size(); ++c) point.piola[c][p] += scale * cofactor[c];
      // Both energies from the same one at μ = 0, where heat presses against what holds the metal.
      const double pressed = material.equation_of_state->gamma0 * held;
      point.stored_energy[p] += compressed.energy + 0.5 * (pressed * pressed - before * before) / kappa;
      point.pressure[p] = compressed.pressure;
    }
  }
};

} // namespace

template<int dim> std::unique_ptr<Term<dim>> equation_of_state(const Model<dim>& model) {
  if (std::none_of(model.materials.begin(), model.materials.end(), [](const plasticity::Material& material) {
        return material.equation_of_state.has_value();
      }))
    return nullptr;
  return std::make_unique<EquationOfState<dim>>(model.materials);
}

template std::unique_ptr<Term<2>> equation_of_state(const Model<2>&);
template std::unique_ptr<Term<3>> equation_of_state(const Model<3>&);

} // namespace cnem
