// What broken points leave of the stiffness that limits the step.
#include "mechanics/terms/point_damage.hpp"
#include "tests/unit/plasticity/points.hpp"

#include <gtest/gtest.h>

namespace cnem {
namespace {

TEST(PointDamage, wave_moduli_of_broken_points_are_those_of_what_bears) {
  plasticity::Material steel;
  steel.elasticity = {.young = 210e9, .poisson = 0.3};
  steel.expansion = 1e-5;
  steel.expansion_reference = 300.0;
  steel.damage = plasticity::Damage{};
  const PointDamage<2> damage({steel});
  const double shear = 4.0 / 3.0 * steel.elasticity.mu(), full = steel.elasticity.kappa() + shear;

  struct Point {
    double softening, jacobian, stress_free, temperature, expected;
  };
  const std::vector<Point> points{
      {0.0, 1.2, 1.0, 300.0, full}, // sound
      {0.9, 1.0, 1.0, 300.0, full}, // not yet broken
      {0.9, 2.0, 1.0, 300.0, (0.1 * steel.elasticity.kappa() + shear) / 2.0},
      {1.0, 1.0, 1.0, 300.0, full},           // closed
      {1.0, 0.9, 1.0, 300.0, full},           // pressed together: Kirchhoff's modulus on less volume
      {1.0, 1.05, 1.0, 300.0, full / 1.05},   // about to close
      {1.0, 1.2, 1.0, 300.0, shear / 1.2},    // open
      {1.0, 1.2, 0.5, 300.0, shear / 2.4},    // since an earlier reference too
      {1.0, 1.2, 1.2, 300.0, full},           // closed since
      {1.0, 1.12, 1.0, 1300.0, full / 1.12}}; // of which 3% are the heat's
  PointState<2> state = plasticity::test::points_at_rest<2>(points.size(), 300.0);
  state.wave_modulus.assign(points.size(), full);
  state.jacobian.resize(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    state.softening.push_back(points[p].softening);
    state.stress_free[p] = points[p].stress_free;
    state.temperature[p] = points[p].temperature;
    state.jacobian[p] = points[p].jacobian;
  }
  damage.wave_moduli({steel}, state);
  for (std::size_t p = 0; p < points.size(); ++p)
    EXPECT_NEAR(state.wave_modulus[p], points[p].expected, 1e-9 * full) << p;
}

} // namespace
} // namespace cnem
