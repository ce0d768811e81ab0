#include "evaluate/material_point.hpp"

#include "core/error.hpp"
#include "plasticity/return_map.hpp"

#include <cmath>
#include <fmt/format.h>

namespace cnem::evaluate {
namespace {

/// F of a strain of a test, without change of volume.
void deform(PointState<2>& point, PointTest::Kind kind, double strain) {
  const double axial = kind == PointTest::Kind::compression ? -strain : strain;
  const bool shear = kind == PointTest::Kind::shear;
  const double along = shear ? 1.0 : std::exp(axial), across = shear ? 1.0 : std::exp(-0.5 * axial);
  const double f[] = {along, shear ? strain : 0.0, 0.0, across, across};
  for (std::size_t c = 0; c < 5; ++c) point.deformation[c][0] = f[c];
}

} // namespace

PointCurve point_curve(const plasticity::Material& material, const PointTest& test, int steps) {
  if (material.anisotropy || material.ply)
    throw InputError(fmt::format("material '{}' is anisotropic, expected an isotropic one for curves of a "
                                 "single point",
                                 material.name));
  PointState<2> point;
  point.table.rest(1);
  point.temperature[0] = test.temperature;
  const double step = test.strain / steps, dt = step / test.rate, kappa = material.elasticity.kappa();
  const bool shear = test.kind == PointTest::Kind::shear;
  const double per_equivalent = shear ? std::sqrt(3.0) : 1.0; // of strains; stresses the other way round
  PointCurve curve;
  curve.strain = {0.0};
  curve.stress = {0.0};
  curve.equivalent_strain = {0.0};
  curve.temperature = {test.temperature};
  for (int k = 1; k <= steps; ++k) {
    deform(point, test.kind, k * step);
    if (plasticity::update_stress<2>(material, plasticity::stress_points(point), 0, 1, dt) >= 0)
      throw InputError(
          fmt::format("material '{}' has no stress at a strain of {:.3g}, {:.3g} 1/s and {:.4g} K",
                      material.name, k * step, test.rate, point.temperature[0]));
    const double stress = point.equivalent_stress[0] / per_equivalent, flow = point.plastic_strain[0];
    if (test.adiabatic)
      point.temperature[0] =
          material.heat_curves.warmed(point.temperature[0], material.taylor_quinney * point.dissipation[0] /
                                                                (material.density * material.specific_heat));
    curve.stress.push_back(stress);
    const double volume = shear ? 0.0 : stress / (9.0 * kappa);
    curve.strain.push_back(test.plastic ? per_equivalent * flow : k * step + volume);
    curve.equivalent_strain.push_back(flow);
    curve.temperature.push_back(point.temperature[0]);
  }
  return curve;
}

double flow_stress_of(const plasticity::Material& material, double strain, double rate, double temperature) {
  return material.hardening ? material.hardening->flow_stress(strain, rate, temperature) : 0.0;
}

} // namespace cnem::evaluate
