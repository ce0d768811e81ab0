// The physics of the return map at single points: exact solutions, objectivity, energy.
#include "tests/unit/plasticity/points.hpp"

#include <gtest/gtest.h>

namespace cnem::plasticity::test {
namespace {

template<class Dimension> struct Stress : ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
class DimensionName {
public:
  template<class Dimension> static std::string GetName(int) {
    return Dimension::value == 2 ? "plane" : "space";
  }
};
TYPED_TEST_SUITE(Stress, Dimensions, DimensionName);

Material elastic() {
  Material m = steel();
  m.hardening.reset();
  return m;
}

Mat3 simple_shear(double gamma) {
  Mat3 f = Mat3::Identity();
  f(0, 1) = gamma;
  return f;
}

Mat3 rotation(int dim, double angle) {
  const Eigen::Vector3d axis = dim == 2 ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(1, -2, 0.5).normalized();
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// A smooth path that stretches, shears and turns; s from 0 to 1.
Mat3 winding_path(int dim, double s) {
  Mat3 f = simple_shear(0.6 * s);
  f(0, 0) += 0.2 * std::sin(3.0 * s);
  f(1, 0) = 0.15 * s * s;
  f(2, 2) -= 0.1 * s;
  if (dim == 3) {
    f(1, 2) = 0.3 * std::sin(2.0 * s);
    f(2, 0) = -0.2 * s;
  }
  f /= std::cbrt(f.determinant() / (1.0 - 0.004 * s));
  return rotation(dim, 1.3 * s) * f;
}

TYPED_TEST(Stress, hencky_simple_shear) {
  constexpr int dim = TypeParam::value;
  const double mu = elastic().elasticity.mu();
  for (double gamma : {1e-9, 1e-3, 1.0, 2.0, 5.0, 10.0}) {
    PointState<dim> s = points_at_rest<dim>(1, 296.0);
    set_deformation(s, 0, simple_shear(gamma));
    ASSERT_EQ(update(elastic(), s, 1e-6), -1);
    const double a = std::asinh(gamma / 2) / std::sqrt(1 + gamma * gamma / 4);
    Mat3 exact = Mat3::Zero();
    exact(0, 0) = mu * gamma * a;
    exact(1, 1) = -exact(0, 0);
    exact(0, 1) = exact(1, 0) = 2 * mu * a;
    EXPECT_LT((kirchhoff(s, 0) - exact).norm(), 1e-8 * exact.norm() + 1e-15 * mu) << gamma;
    EXPECT_NEAR(s.stored_energy[0], 2 * mu * std::pow(std::asinh(gamma / 2), 2), 1e-8 * mu);
  }
}

TYPED_TEST(Stress, values_of_the_shear_benchmark) {
  constexpr int dim = TypeParam::value;
  const double mu = elastic().elasticity.mu();
  for (const auto& [gamma, shear, normal] :
       {std::array{1.0, 0.860818, 0.430409}, std::array{2.0, 1.246450, 1.246450},
        std::array{5.0, 1.223533, 3.058831}, std::array{10.0, 0.907013, 4.535065}}) {
    PointState<dim> s = points_at_rest<dim>(1, 296.0);
    set_deformation(s, 0, simple_shear(gamma));
    ASSERT_EQ(update(elastic(), s, 1e-6), -1);
    EXPECT_NEAR(kirchhoff(s, 0)(0, 1) / mu, shear, 1e-6);
    EXPECT_NEAR(kirchhoff(s, 0)(0, 0) / mu, normal, 1e-6);
  }
}

TYPED_TEST(Stress, pressure_is_bulk_modulus_times_logarithm_of_volume) {
  constexpr int dim = TypeParam::value;
  PointState<dim> s = points_at_rest<dim>(1, 296.0);
  for (double stretch : {0.5, 0.999, 1.0, 1.001, 1.8}) {
    set_deformation<dim>(s, 0, Mat3::Identity() * stretch);
    ASSERT_EQ(update(steel(), s, 1e-6), -1);
    const double kappa = steel().elasticity.kappa(), volume = 3.0 * std::log(stretch);
    EXPECT_NEAR(s.pressure[0], -kappa * volume, 1e-14 * kappa);
    EXPECT_NEAR(s.stored_energy[0], 0.5 * kappa * volume * volume, 1e-14 * kappa);
    EXPECT_EQ(s.plastic_strain[0], 0.0);
    EXPECT_LT((kirchhoff(s, 0) + s.pressure[0] * Mat3::Identity()).norm(), 1e-13 * kappa);
  }
}

TYPED_TEST(Stress, is_the_derivative_of_the_stored_energy) {
  constexpr int dim = TypeParam::value;
  const auto energy = [](const Mat3& f) {
    PointState<dim> s = points_at_rest<dim>(1, 296.0);
    set_deformation(s, 0, f);
    update(elastic(), s, 1e-6);
    return s.stored_energy[0];
  };
  const Mat3 f = winding_path(dim, 0.8);
  PointState<dim> s = points_at_rest<dim>(1, 296.0);
  set_deformation(s, 0, f);
  ASSERT_EQ(update(elastic(), s, 1e-6), -1);
  const Mat3 piola = general<dim>(s.piola, 0);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      if (dim == 2 && (i == 2) != (k == 2)) continue;
      Mat3 plus = f, minus = f;
      plus(i, k) += 1e-6;
      minus(i, k) -= 1e-6;
      EXPECT_NEAR(piola(i, k), (energy(plus) - energy(minus)) / 2e-6, 1e-8 * piola.norm());
    }
}

TYPED_TEST(Stress, elastic_loops_leave_no_trace) {
  constexpr int dim = TypeParam::value;
  PointState<dim> s = points_at_rest<dim>(1, 296.0);
  const Fields<symmetric_size<dim>> virgin = s.inverse_plastic_cauchy_green;
  for (int k = 0; k <= 200; ++k) { // below the yield strain of 1.2e-3
    const double a = 2.0 * M_PI * k / 200.0;
    Mat3 f = Mat3::Identity();
    f(0, 1) = 8e-4 * std::sin(a);
    f(0, 0) += 4e-4 * (std::cos(a) - 1.0);
    set_deformation<dim>(s, 0, rotation(dim, a) * f);
    ASSERT_EQ(update(steel(), s, 1e-6), -1);
  }
  EXPECT_EQ(s.inverse_plastic_cauchy_green, virgin);
  EXPECT_EQ(s.plastic_strain[0], 0.0);
  EXPECT_EQ(s.plastic_work[0], 0.0);
  EXPECT_EQ(s.stress_free[0], 1.0);
  EXPECT_LT(general<dim>(s.piola, 0).norm(), 1e-14 * steel().elasticity.young);
}

TYPED_TEST(Stress, plastic_flow_keeps_volume_and_stays_on_the_yield_surface) {
  constexpr int dim = TypeParam::value;
  const Material m = steel();
  PointState<dim> s = points_at_rest<dim>(1, 400.0);
  for (int k = 1; k <= 5000; ++k) {
    set_deformation<dim>(s, 0, winding_path(dim, k / 5000.0));
    ASSERT_EQ(update(m, s, 1e-8), -1);
    if (s.dissipation[0] > 0.0) {
      const double flow = m.hardening->flow_stress(s.plastic_strain[0], s.plastic_rate[0], 400.0);
      ASSERT_NEAR(s.equivalent_stress[0], flow, 1e-11 * flow);
    }
  }
  EXPECT_GT(s.plastic_strain[0], 0.3);
  EXPECT_NEAR(symmetric<dim>(s.inverse_plastic_cauchy_green, 0).determinant(), 1.0, 1e-13);
  EXPECT_NEAR(s.stress_free[0], 1.0, 1e-13);
  const Mat3 tau = kirchhoff(s, 0);
  EXPECT_LT((tau - tau.transpose()).norm(), 1e-12 * tau.norm());
  EXPECT_NEAR(std::sqrt(1.5) * (tau - tau.trace() / 3 * Mat3::Identity()).norm(), s.equivalent_stress[0],
              1e-12 * tau.norm());
}

TYPED_TEST(Stress, turns_with_a_superposed_rotation) {
  constexpr int dim = TypeParam::value;
  PointState<dim> s = points_at_rest<dim>(2, 350.0);
  const int steps = 400;
  for (int k = 1; k <= steps; ++k) {
    const Mat3 f = winding_path(dim, static_cast<double>(k) / steps);
    const Mat3 q = rotation(dim, 40.0 * k / steps);
    set_deformation<dim>(s, 0, f);
    set_deformation<dim>(s, 1, q * f);
    ASSERT_EQ(update(steel(), s, 1e-8), -1);
    const Mat3 piola = general<dim>(s.piola, 0);
    ASSERT_LT((q * piola - general<dim>(s.piola, 1)).norm(), 1e-11 * piola.norm());
    ASSERT_NEAR(s.plastic_strain[0], s.plastic_strain[1], 1e-13);
  }
}

/// The stress does not know the reference: C_p⁻¹ → A C_p⁻¹ Aᵀ, F → F A⁻¹.
TYPED_TEST(Stress, does_not_change_with_the_reference) {
  constexpr int dim = TypeParam::value;
  PointState<dim> s = points_at_rest<dim>(2, 350.0);
  const int steps = 300;
  Mat3 reference = Mat3::Identity();
  for (int k = 1; k <= steps; ++k) {
    const Mat3 f = winding_path(dim, static_cast<double>(k) / steps);
    set_deformation<dim>(s, 0, f);
    set_deformation<dim>(s, 1, f * reference.inverse());
    ASSERT_EQ(update(steel(), s, 1e-8), -1);
    const Mat3 tau = kirchhoff(s, 0);
    ASSERT_LT((tau - kirchhoff(s, 1)).norm(), 1e-11 * tau.norm());
    ASSERT_NEAR(s.plastic_work[0], s.plastic_work[1], 1e-11 * (s.plastic_work[0] + 1e3));
    if (k % 30 == 0 && k < steps) {
      const Mat3 a = general<dim>(s.deformation, 1);
      const Mat3 pushed = a * symmetric<dim>(s.inverse_plastic_cauchy_green, 1) * a.transpose();
      const int row[] = {0, 1, 2, 0, 1, 2}, column[] = {0, 1, 2, 1, 2, 0};
      for (std::size_t c = 0; c < s.inverse_plastic_cauchy_green.size(); ++c)
        s.inverse_plastic_cauchy_green[c][1] = pushed(row[c], column[c]);
      reference = f;
    }
  }
  EXPECT_NEAR(s.stress_free[1], s.stress_free[0] / reference.determinant(), 1e-12);
}

/// ½(P_n + P_{n+1}) : ΔF, the work of central differences, against stored energy and plastic work.
template<int dim> double energy_error(int steps, double& work) {
  PointState<dim> s = points_at_rest<dim>(1, 350.0);
  Mat3 f0 = Mat3::Identity(), p0 = Mat3::Zero();
  work = 0.0;
  for (int k = 1; k <= 2 * steps; ++k) { // there and back
    const double a = static_cast<double>(k <= steps ? k : 2 * steps - k) / steps;
    const Mat3 f = winding_path(dim, a);
    set_deformation<dim>(s, 0, f);
    update(steel(), s, 1e-5 / steps);
    const Mat3 p = general<dim>(s.piola, 0);
    work += 0.5 * (p0 + p).cwiseProduct(f - f0).sum();
    f0 = f;
    p0 = p;
  }
  return work - s.stress_free[0] * (s.stored_energy[0] + s.plastic_work[0]);
}

TYPED_TEST(Stress, work_is_stored_or_dissipated) {
  constexpr int dim = TypeParam::value;
  double work;
  const double coarse = energy_error<dim>(1000, work), fine = energy_error<dim>(2000, work);
  EXPECT_LT(std::abs(fine), 1e-5 * work);
  EXPECT_GT(std::abs(coarse / fine), 3.0) << "second order";
}

TYPED_TEST(Stress, free_expansion_is_free_of_stress) {
  constexpr int dim = TypeParam::value;
  Material m = steel();
  m.expansion = 17e-6;
  m.expansion_reference = 293.15;
  PointState<dim> s = points_at_rest<dim>(2, 893.15);
  set_deformation<dim>(s, 0, rotation(dim, 0.7) * std::exp(17e-6 * 600.0));
  ASSERT_EQ(update(m, s, 1e-6), -1);
  const double kappa = m.elasticity.kappa();
  EXPECT_LT(general<dim>(s.piola, 0).norm(), 1e-14 * kappa);
  EXPECT_LT(s.stored_energy[0], 1e-20 * kappa);
  EXPECT_NEAR(s.pressure[1], 3.0 * kappa * 17e-6 * 600.0, 1e-14 * kappa); // clamped
}

TYPED_TEST(Stress, no_time_no_flow) {
  constexpr int dim = TypeParam::value;
  PointState<dim> s = points_at_rest<dim>(1, 296.0);
  set_deformation<dim>(s, 0, simple_shear(0.05));
  ASSERT_EQ(update(steel(), s, 1e-7), -1);
  ASSERT_GT(s.plastic_strain[0], 0.0);
  const PointState<dim> before = s;
  ASSERT_EQ(update(steel(), s, 0.0), -1);
  EXPECT_EQ(s.plastic_strain, before.plastic_strain);
  EXPECT_EQ(s.plastic_rate, before.plastic_rate);
  EXPECT_EQ(s.inverse_plastic_cauchy_green, before.inverse_plastic_cauchy_green);
  EXPECT_EQ(s.dissipation[0], 0.0);
  EXPECT_NEAR(s.equivalent_stress[0], before.equivalent_stress[0], 1e-12 * before.equivalent_stress[0]);
}

} // namespace
} // namespace cnem::plasticity::test
