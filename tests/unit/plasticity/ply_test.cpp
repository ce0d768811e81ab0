// Orthotropic elasticity: engineering constants in any direction, the stress as the derivative of the energy,
// objectivity, step bound.
#include "tests/unit/plasticity/ply_points.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <complex>
#include <random>

namespace cnem::plasticity::test {
namespace {

Eigen::Matrix3d matrix(const PlaneStiffness& plane) {
  Eigen::Matrix3d D;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) D(i, j) = plane.D[i][j];
  return D;
}

TEST(Ply, engineering_constants_off_its_axes) {
  // Jones, Mechanics of Composite Materials, 2.97
  for (const double a : {0.0, 17.0, 30.0, 45.0, 60.0, 90.0, 133.0}) {
    const Orthotropic ply = *gfrp(a * degrees).ply;
    const Eigen::Matrix3d S = matrix(plane_stiffness(ply, true)).inverse();
    const double c = std::cos(a * degrees), s = std::sin(a * degrees);
    const double c2 = c * c, s2 = s * s, E1 = ply.E1, E2 = ply.E2, G = ply.G12, nu = ply.nu12;
    const double by_Ex = c2 * c2 / E1 + (1 / G - 2 * nu / E1) * s2 * c2 + s2 * s2 / E2;
    const double by_Ey = s2 * s2 / E1 + (1 / G - 2 * nu / E1) * s2 * c2 + c2 * c2 / E2;
    const double nu_x = nu / E1 * (s2 * s2 + c2 * c2) - (1 / E1 + 1 / E2 - 1 / G) * s2 * c2; // over Ex
    const double by_G = 2 * (2 / E1 + 2 / E2 + 4 * nu / E1 - 1 / G) * s2 * c2 + (s2 * s2 + c2 * c2) / G;
    const double shear =
        (2 / E1 + 2 * nu / E1 - 1 / G) * s * c2 * c - (2 / E2 + 2 * nu / E1 - 1 / G) * s2 * s * c;
    const double scale = 1 / ply.E2;
    EXPECT_NEAR(S(0, 0), by_Ex, 1e-12 * scale) << a;
    EXPECT_NEAR(S(1, 1), by_Ey, 1e-12 * scale) << a;
    EXPECT_NEAR(-S(0, 1), nu_x, 1e-12 * scale) << a;
    EXPECT_NEAR(S(2, 2), by_G, 1e-12 / G) << a;
    EXPECT_NEAR(S(2, 0), shear, 1e-12 / G) << a;
  }
  // worked out beside: 1/Ex of the GFRP at 30, 45, 60°
  for (const auto& [a, Ex] : {std::pair(30.0, 9.03978e9), {45.0, 6.78815e9}, {60.0, 7.18125e9}})
    EXPECT_NEAR(1.0 / matrix(plane_stiffness(*gfrp(a * degrees).ply, true)).inverse()(0, 0), Ex, 1e-6 * Ex);
}

/// E' of a crack along x for the compliance of εxx, εyy, γxy, by the roots of Lekhnitskii's polynomial.
double crack_modulus_by_eigenvalues(const Eigen::Matrix3d& S) {
  Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
  companion.block<3, 3>(1, 0).setIdentity();
  companion.col(3) << -S(1, 1), 2 * S(1, 2), -(2 * S(0, 1) + S(2, 2)), 2 * S(0, 2);
  companion.col(3) /= S(0, 0);
  std::complex<double> sum = 0.0, product = 1.0;
  const Eigen::Vector4cd roots = companion.eigenvalues();
  for (const std::complex<double>& root : roots)
    if (root.imag() > 0.0) sum += root, product *= root;
  return 2.0 / (S(1, 1) * std::abs((sum / product).imag()));
}

TEST(Ply, moduli_of_cracks) {
  const double E = 34e9, nu = 0.3;
  EXPECT_NEAR(crack_modulus({E, E, nu, 0.5 * E / (1 + nu), {0, 0}}, 0.4), E, 1e-6 * E) << "isotropic";

  for (const bool stress_free : {true, false}) {
    const Orthotropic ply = *gfrp(0.0).ply;
    const PlyConstants own = ply_constants(ply, stress_free);
    const double S11 = 1 / own.E1, S22 = 1 / own.E2, both = 1 / own.G12 - 2 * own.nu12 / own.E1;
    const double along = 1 / std::sqrt(0.5 * S11 * S22 * (std::sqrt(S22 / S11) + 0.5 * both / S11));
    const double across = 1 / std::sqrt(0.5 * S11 * S22 * (std::sqrt(S11 / S22) + 0.5 * both / S22));
    EXPECT_NEAR(crack_modulus(own, 0.0), along, 1e-9 * along) << "Sih, Paris and Irwin";
    EXPECT_NEAR(crack_modulus(own, 90 * degrees), across, 1e-9 * across);
    for (const double a : {17.0, 45.0, 80.0, 133.0}) { // of fibres that lie at −a to the crack
      const double expected = crack_modulus_by_eigenvalues(
          matrix(plane_stiffness(*gfrp(-a * degrees).ply, stress_free)).inverse());
      EXPECT_NEAR(crack_modulus(own, a * degrees), expected, 1e-9 * expected) << a;
      EXPECT_NEAR(crack_modulus(own, -a * degrees), expected, 1e-9 * expected) << a;
      EXPECT_NEAR(crack_modulus(own, (a + 180) * degrees), expected, 1e-9 * expected) << a;
    }
  }
}

/// Compliance of ε11, ε22, ε33, γ12.
Eigen::Matrix4d compliance(const Orthotropic& p) {
  Eigen::Matrix4d S = Eigen::Matrix4d::Zero();
  S.diagonal() << 1 / p.E1, 1 / p.E2, 1 / p.E3, 1 / p.G12;
  S(0, 1) = S(1, 0) = -p.nu12 / p.E1;
  S(0, 2) = S(2, 0) = -p.nu13 / p.E1;
  S(1, 2) = S(2, 1) = -p.nu23 / p.E2;
  return S;
}

TEST(Ply, plane_strain_condenses_the_compliance_of_three_axes) {
  Orthotropic ply = *gfrp(0.0).ply;
  ply.E3 = 9e9, ply.nu13 = 0.31, ply.nu23 = 0.37;
  const Eigen::Matrix4d C = compliance(ply).inverse(); // with ε33 = 0 its other rows and columns are Q
  const PlaneStiffness plane = plane_stiffness(ply, false);
  const int own[] = {0, 1, 3};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(plane.D[i][j], C(own[i], own[j]), 1e-12 * C(0, 0)) << i << j;
  for (int j = 0; j < 3; ++j) EXPECT_NEAR(plane.zz[j], C(2, own[j]), 1e-12 * C(0, 0)) << j;
  const PlyStiffness q = ply_constants(ply, false).stiffness();
  Eigen::Matrix3d mandel;
  mandel << q.Q11, q.Q12, 0, q.Q12, q.Q22, 0, 0, 0, 2 * q.Q66;
  const double largest = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(mandel).eigenvalues()[2];
  EXPECT_NEAR(q.largest_eigenvalue(), largest, 1e-12 * largest);
}

class RandomPlies {
public:
  Mat2 deformation(double size) {
    Mat2 F;
    do F = Mat2::Identity() + size * Mat2::NullaryExpr([&] { return uniform(-1.0, 1.0); });
    while (F.determinant() < 0.2);
    return turn(uniform(-3.0, 3.0)) * F;
  }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }

private:
  std::mt19937 generator_{18};
};

TEST(Ply, stress_is_the_derivative_of_the_energy) {
  RandomPlies random;
  for (const StrainMeasure measure : {StrainMeasure::logarithmic, StrainMeasure::green})
    for (const bool stress_free : {true, false})
      for (const bool damaged : {false, true})
        for (int trial = 0; trial < 20; ++trial) {
          Material material = gfrp(random.uniform(-2.0, 2.0));
          material.ply->measure = measure;
          if (damaged) material.failure = Failure{};
          PlyPoint point(material, stress_free);
          point.set_earlier(random.deformation(0.4));
          if (damaged)
            for (Field& left : point.state.ply_left) left[0] = random.uniform(0.1, 1.0);
          SCOPED_TRACE(trial);
          expect_derivative_of_energy(point, random.deformation(0.3));
        }
}

TEST(Ply, logarithmic_stress_against_the_logarithm_of_the_stretch) {
  // uniaxial along the fibres: τ = E1 ln λ, P = τ/λ
  PlyPoint point(gfrp(0.0), true);
  const double e = 0.3;
  ASSERT_TRUE(point.set(stretch({e, -0.24244 * e, 0.0}, 0.0), 0.0));
  EXPECT_NEAR(point.piola()(0, 0), 34.28e9 * e * std::exp(-e), 1e-3);
  EXPECT_NEAR(point.piola()(1, 1), 0.0, 1e-3);
  // Green: S = E1 ½ (λ² − 1), at rest below a stretch of 0.58 (its force is least at 1/√3)
  Material green = gfrp(0.0);
  green.ply->measure = StrainMeasure::green;
  green.ply->nu12 = 0.0;
  PlyPoint other(green, true);
  const auto force = [&](double stretch) {
    EXPECT_TRUE(other.set(Eigen::Vector2d(stretch, 1.0).asDiagonal(), 0.0));
    return other.piola()(0, 0);
  };
  EXPECT_NEAR(force(0.8), 34.28e9 * 0.5 * (0.64 - 1.0) * 0.8, 1e-3);
  EXPECT_GT(force(0.57), force(0.5774));
  EXPECT_GT(force(0.585), force(0.5774));
}

// Broken fibres have been seen to shear by e^18: there 1 − r of the eigenvalues' ratio is below rounding.
TEST(Ply, logarithmic_stress_of_any_stretch) {
  const auto mixed = [](double e) { // T12 over the strain, which is the same at all of them
    PlyPoint point(gfrp(0.5), true);
    EXPECT_TRUE(point.set(Eigen::Vector2d(std::exp(e), std::exp(-e)).asDiagonal(), 0.0));
    const double large = std::exp(2.0 * e), small = std::exp(-2.0 * e);
    return point.piola()(0, 1) * std::exp(-e) * (large - small) / (4.0 * e) / e;
  };
  const double first = mixed(0.1);
  ASSERT_GT(std::abs(first), 1e9);
  for (const double e : {0.004, 0.5, 1.5, 1.89, 1.91, 2.0, 5.0, 9.0, 18.0})
    EXPECT_NEAR(mixed(e), first, 1e-11 * std::abs(first)) << e;
}

TEST(Ply, turned_blocks_have_turned_stresses) {
  RandomPlies random;
  for (int trial = 0; trial < 20; ++trial) {
    const double angle = random.uniform(-2.0, 2.0), by = random.uniform(-3.0, 3.0);
    const Mat2 F = random.deformation(0.3), earlier = random.deformation(0.3), R = turn(by);
    PlyPoint one(gfrp(angle), false), moved(gfrp(angle), false), laid(gfrp(angle + by), false);
    for (PlyPoint* point : {&one, &moved}) point->set_earlier(earlier);
    ASSERT_TRUE(one.set(F, 0.0));
    ASSERT_TRUE(moved.set(R * F, 0.0)); // moved as a rigid body
    EXPECT_LT((moved.piola() - R * one.piola()).norm(), 1e-11 * one.piola().norm());
    laid.set_earlier(R * earlier * R.transpose()); // everything laid out in turned axes
    ASSERT_TRUE(laid.set(R * F * R.transpose(), 0.0));
    EXPECT_LT((laid.piola() - R * one.piola() * R.transpose()).norm(), 1e-11 * one.piola().norm());
    EXPECT_NEAR(laid.state.stored_energy[0], one.state.stored_energy[0], 1e-11 * one.state.stored_energy[0]);
    const Eigen::Vector2d fibre = F * earlier * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    EXPECT_NEAR(
        std::remainder(one.state.fibre_angle[0] - std::atan2(fibre[1], fibre[0]), 2 * std::numbers::pi), 0.0,
        1e-12);
  }
}

TEST(Ply, reports_what_means_nothing_and_leaves_it) {
  PlyPoint point(gfrp(0.3));
  ASSERT_TRUE(point.set(turn(0.2) * 1.01, 0.0));
  const Mat2 before = point.piola();
  EXPECT_FALSE(point.set(Eigen::Vector2d(-1.0, 1.0).asDiagonal(), 0.0));
  EXPECT_FALSE(point.set(Mat2::Constant(std::nan("")), 0.0));
  EXPECT_EQ(before, point.piola());
}

} // namespace
} // namespace cnem::plasticity::test
