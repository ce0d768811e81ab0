#pragma once
// Stress points to try the return map on: states, deformation gradients in and stresses out as 3×3 matrices.
#include "plasticity/hardening_laws.hpp"
#include "plasticity/return_map.hpp"

#include <Eigen/Dense>

namespace cnem::plasticity::test {

using Mat3 = Eigen::Matrix3d;

/// n points at rest: F = 1, C_p⁻¹ = 1.
template<int dim> PointState<dim> points_at_rest(std::size_t n, double temperature) {
  PointState<dim> s;
  resize_all(s.deformation, n);
  resize_all(s.inverse_plastic_cauchy_green, n);
  resize_all(s.piola, n);
  for (Field* f : {&s.plastic_strain, &s.plastic_rate, &s.equivalent_stress, &s.pressure, &s.stored_energy,
                   &s.plastic_work, &s.dissipation})
    f->assign(n, 0.0);
  s.stress_free.assign(n, 1.0);
  s.strength.assign(n, 1.0);
  s.temperature.assign(n, temperature);
  s.material.assign(n, 0);
  for (int c : {0, 1, 2}) s.inverse_plastic_cauchy_green[static_cast<std::size_t>(c)].assign(n, 1.0);
  for (std::size_t c = 0; c < s.deformation.size(); ++c)
    if (dim == 2 ? (c == 0 || c == 3 || c == 4) : c % 4 == 0) s.deformation[c].assign(n, 1.0);
  return s;
}

/// Lets the points know the axes of their material, which are where they were at the start.
template<int dim> void keep_axes(PointState<dim>& s) {
  s.oriented.switch_on(true);
  s.oriented.rest(s.size());
}

template<int dim> void set_deformation(PointState<dim>& s, std::size_t i, const Mat3& f) {
  if constexpr (dim == 2) {
    const double c[] = {f(0, 0), f(0, 1), f(1, 0), f(1, 1), f(2, 2)};
    for (std::size_t k = 0; k < 5; ++k) s.deformation[k][i] = c[k];
  } else {
    for (std::size_t k = 0; k < 9; ++k)
      s.deformation[k][i] = f(static_cast<int>(k / 3), static_cast<int>(k % 3));
  }
}

template<int dim> Mat3 general(const Fields<tensor_size<dim>>& field, std::size_t i) {
  Mat3 a = Mat3::Zero();
  if constexpr (dim == 2)
    a << field[0][i], field[1][i], 0, field[2][i], field[3][i], 0, 0, 0, field[4][i];
  else
    for (std::size_t k = 0; k < 9; ++k) a(static_cast<int>(k / 3), static_cast<int>(k % 3)) = field[k][i];
  return a;
}

template<int dim> Mat3 symmetric(const Fields<symmetric_size<dim>>& field, std::size_t i) {
  Mat3 a = Mat3::Zero();
  if constexpr (dim == 2)
    a << field[0][i], field[3][i], 0, field[3][i], field[1][i], 0, 0, 0, field[2][i];
  else
    a << field[0][i], field[3][i], field[5][i], field[3][i], field[1][i], field[4][i], field[5][i],
        field[4][i], field[2][i];
  return a;
}

/// τ = P Fᵀ / (V_stress-free/V_reference).
template<int dim> Mat3 kirchhoff(const PointState<dim>& s, std::size_t i) {
  return general<dim>(s.piola, i) * general<dim>(s.deformation, i).transpose() / s.stress_free[i];
}

template<int dim> std::ptrdiff_t update(const Material& material, PointState<dim>& s, double dt) {
  return update_stress(material, stress_points(s), 0, static_cast<std::ptrdiff_t>(s.size()), dt);
}

/// The 304L of paper 004.
inline Material steel() {
  Material m;
  m.name = "304L";
  m.density = 7850.0;
  m.elasticity = {210e9, 0.33};
  m.hardening = JohnsonCook{253e6, 685e6, 0.312, 0.0973, 1.0, 2.044, 296.0, 1698.0};
  m.specific_heat = 500.0;
  m.conductivity = 5.86;
  return m;
}

/// The same as sheet.
inline Material sheet(const Hill48& law) {
  Material m = steel();
  m.anisotropy = law;
  return m;
}

} // namespace cnem::plasticity::test
