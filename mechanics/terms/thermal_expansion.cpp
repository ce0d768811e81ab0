// What heat gives to the stored energy: metal that is warmed under pressure expands against it.
#include "mechanics/terms/list.hpp"

#include <algorithm>
#include <cmath>

namespace cnem {

namespace {

/// dψ = τ:dε − p 3α dT + …: a free energy of strain and temperature loses what the stress does as the strain
/// without stress grows. Pressures are those of Hencky's law, whose expansion it is, also where an equation
/// of state has made others of them.
template<int dim> class ThermalExpansion : public Term<dim> {
public:
  std::vector<Energy*> energies() override { return {&given_}; }

  void begin_stress(const Body<dim>& body, const DuePoints& due) override {
    const PointState<dim>& point = body.state.point;
    temperature_.resize(point.size());
    pressure_.resize(point.size());
    sums_.assign(due.ranges.size(), 0.0);
    for_each_range(due.ranges, [&](const LevelRange& range) {
      for (std::size_t p = range.begin; p < range.end; ++p) {
        temperature_[p] = point.temperature[p];
        pressure_[p] = pressure(body, p);
      }
    });
  }

  void after_stress(const Body<dim>& body, const DuePoints& due, const LevelRange& range) override {
    const PointState<dim>& point = body.state.point;
    double sum = 0.0;
    for (std::size_t p = range.begin; p < range.end; ++p) {
      const double expanded = 3.0 * body.material_of(p).expansion * (point.temperature[p] - temperature_[p]);
      if (expanded != 0.0)
        sum += body.operators().volume[p] * point.stress_free[p] * 0.5 * (pressure_[p] + pressure(body, p)) *
               expanded;
    }
    sums_[due.index(range)] = sum;
  }

  void end_stress(const Body<dim>&, const DuePoints&) override {
    for (const double sum : sums_) given_.value += sum;
  }

private:
  Field temperature_, pressure_; ///< [point] K, Pa: before the step
  std::vector<double> sums_;     ///< [range] J/m^(3−dim)
  Energy given_{"thermal_expansion", EnergyKind::received};

  static double pressure(const Body<dim>& body, std::size_t p) {
    const PointState<dim>& point = body.state.point;
    const plasticity::Material& material = body.material_of(p);
    if (material.equation_of_state)
      if (const double volume = jacobian<dim>(point.deformation, p) / point.stress_free[p]; volume < 1.0)
        return material.elasticity.kappa() *
               (3.0 * material.thermal_strain(point.temperature[p]) - std::log(volume));
    return point.pressure[p];
  }
};

} // namespace

template<int dim> std::unique_ptr<Term<dim>> thermal_expansion(const Model<dim>& model) {
  if (!model.thermal ||
      std::none_of(model.materials.begin(), model.materials.end(),
                   [](const plasticity::Material& material) { return material.expansion != 0.0; }))
    return nullptr;
  return std::make_unique<ThermalExpansion<dim>>();
}

template std::unique_ptr<Term<2>> thermal_expansion(const Model<2>&);
template std::unique_ptr<Term<3>> thermal_expansion(const Model<3>&);

} // namespace cnem
