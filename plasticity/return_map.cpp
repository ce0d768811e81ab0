#include "plasticity/return_map.hpp"

#include "core/machine/isa.hpp"
#include "plasticity/hardening_laws.hpp"
#include "plasticity/plane_stress.hpp"
#include "plasticity/ply_update.hpp"
#include "plasticity/return_map_parameters.hpp"

namespace cnem::plasticity {

ReturnMapParameters return_map_parameters(const Material& material, double dt) {
  static const Hardening none = Perfect{};
  const double mu = material.elasticity.mu();
  ReturnMapParameters p{};
  p.kappa = material.elasticity.kappa();
  p.two_mu = 2.0 * mu;
  p.three_mu = 3.0 * mu;
  p.by_mu = 1.0 / mu;
  p.by_three_mu = 1.0 / (3.0 * mu);
  p.by_six_mu = 1.0 / (6.0 * mu);
  p.three_expansion = 3.0 * material.expansion;
  p.reference = material.expansion_reference;
  p.dt = dt;
  p.by_dt = 1.0 / dt;
  p.plastic = material.hardening.has_value() && dt > 0.0;
  p.hardening = (material.hardening ? *material.hardening : none).view();
  return p;
}

namespace {

template<int dim> PlyPoints ply_points(PointState<dim>& state) {
  PlyPoints p{};
  p.fibre_angle = state.fibre_angle.data();
  if (state.flowing.on())
    for (std::size_t k = 0; k < 3; ++k) p.flow[k] = state.ply_flow[k].data();
  if (!state.failing.on()) return p;
  Field* const damage[] = {&state.fibre_tension_damage, &state.fibre_compression_damage,
                           &state.matrix_tension_damage, &state.matrix_compression_damage,
                           &state.shear_damage};
  Field* const index[] = {&state.fibre_tension_index, &state.fibre_compression_index,
                          &state.matrix_tension_index, &state.matrix_compression_index, &state.shear_index};
  for (std::size_t k = 0; k < ply_modes; ++k) {
    p.damage[k] = damage[k]->data();
    p.index[k] = index[k]->data();
    p.onset_strain[k] = state.onset_strain[k].data();
    p.onset_stress[k] = state.onset_stress[k].data();
    p.begun[k] = state.begun[k].data();
    p.left[k] = state.ply_left[k].data();
  }
  for (std::size_t k = 0; k < 3; ++k) p.strain[k] = state.ply_strain[k].data();
  p.release = state.failure_release.data();
  p.length = state.failure_length.data();
  return p;
}

} // namespace

template<int dim> StressPoints<dim> stress_points(PointState<dim>& state) {
  StressPoints<dim> p{};
  for (std::size_t c = 0; c < state.deformation.size(); ++c) {
    p.deformation[c] = state.deformation[c].data();
    p.piola[c] = state.piola[c].data();
  }
  for (std::size_t c = 0; c < state.inverse_plastic_cauchy_green.size(); ++c)
    p.inverse_plastic_cauchy_green[c] = state.inverse_plastic_cauchy_green[c].data();
  if (state.oriented.on())
    for (std::size_t c = 0; c < state.earlier_deformation.size(); ++c)
      p.earlier_deformation[c] = state.earlier_deformation[c].data();
  p.temperature = state.temperature.data();
  p.strength = state.damaged.on() ? state.flow_factor.data() : state.strength.data();
  p.plastic_strain = state.plastic_strain.data();
  p.plastic_rate = state.plastic_rate.data();
  p.equivalent_stress = state.equivalent_stress.data();
  p.plastic_work = state.plastic_work.data();
  p.pressure = state.pressure.data();
  p.stored_energy = state.stored_energy.data();
  p.dissipation = state.dissipation.data();
  p.stress_free = state.stress_free.data();
  if (state.thin.on()) p.thickness = state.thickness.data();
  if (state.damaged.on()) p.softening = state.softening.data();
  if (state.fibrous.on()) p.ply = ply_points(state);
  return p;
}

namespace {

/// The return map of the yield function that a material has.
template<int dim>
std::ptrdiff_t return_to_yield(const Material& material, const StressPoints<dim>& points,
                               std::ptrdiff_t begin, std::ptrdiff_t end, double dt) {
  const ReturnMapParameters parameters = return_map_parameters(material, dt);
  if (material.anisotropy) {
    const HillForm form = material.anisotropy->form();
    CNEM_ON_ACTIVE_ISA(hill_return_map(parameters, form, points, begin, end));
  }
  CNEM_ON_ACTIVE_ISA(return_map(parameters, points, begin, end));
}

} // namespace

template<int dim>
std::ptrdiff_t update_stress(const Material& material, const StressPoints<dim>& points, std::ptrdiff_t begin,
                             std::ptrdiff_t end, double dt) {
  if constexpr (dim == 2) {
    if (material.ply) return update_plies(material, points, begin, end, dt);
    if (points.thickness) return update_plane_stress(return_to_yield<2>, material, points, begin, end, dt);
  }
  return return_to_yield(material, points, begin, end, dt);
}

template<int dim>
std::ptrdiff_t update_stress(const std::vector<Material>& materials,
                             const std::vector<std::int32_t>& material, const StressPoints<dim>& points,
                             std::ptrdiff_t begin, std::ptrdiff_t end, double dt) {
  std::ptrdiff_t first_bad = -1;
  for_each_run(materials, material, begin, end,
               [&](const Material& own, std::ptrdiff_t p, std::ptrdiff_t stop) {
                 const std::ptrdiff_t bad = update_stress(own, points, p, stop, dt);
                 if (first_bad < 0) first_bad = bad;
               });
  return first_bad;
}

template StressPoints<2> stress_points(PointState<2>&);
template StressPoints<3> stress_points(PointState<3>&);
template std::ptrdiff_t update_stress(const Material&, const StressPoints<2>&, std::ptrdiff_t, std::ptrdiff_t,
                                      double);
template std::ptrdiff_t update_stress(const Material&, const StressPoints<3>&, std::ptrdiff_t, std::ptrdiff_t,
                                      double);

template std::ptrdiff_t update_stress(const std::vector<Material>&, const std::vector<std::int32_t>&,
                                      const StressPoints<2>&, std::ptrdiff_t, std::ptrdiff_t, double);
template std::ptrdiff_t update_stress(const std::vector<Material>&, const std::vector<std::int32_t>&,
                                      const StressPoints<3>&, std::ptrdiff_t, std::ptrdiff_t, double);

} // namespace cnem::plasticity
