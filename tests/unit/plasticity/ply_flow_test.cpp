// Plies that flow: yield in any direction, plastic strains, agreement with von Mises, consistency on random
// paths, the stress as the derivative of the energy.
#include "plasticity/ply_return.hpp"
#include "tests/unit/plasticity/ply_points.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace cnem::plasticity::test {
namespace {

using Eigen::Vector3d;

/// Flax fibre of paper 001, Table 1.
Material flax(double angle, const Hardening& law = Perfect{750e6}) {
  Material m;
  m.name = "flax";
  m.density = 1500.0;
  m.ply = Orthotropic{.E1 = 50e9,
                      .E2 = 12e9,
                      .nu12 = 0.178,
                      .G12 = 3.4e9,
                      .angle = angle,
                      .E3 = 12e9,
                      .nu13 = 0.2,
                      .nu23 = 0.2};
  const double shear = 20.0 * std::sqrt(3.0) / 750.0;
  m.anisotropy = HillRatios{.R22 = 0.2, .R33 = 0.2, .R12 = shear, .R13 = shear, .R23 = shear};
  m.hardening = law;
  return m;
}

/// Every ratio another.
Material odd(double angle, const Hardening& law = Perfect{300e6}) {
  Material m = flax(angle, law);
  m.ply->nu13 = 0.31, m.ply->nu23 = 0.36, m.ply->E3 = 9e9;
  m.anisotropy = HillRatios{.R11 = 1.1, .R22 = 0.8, .R33 = 0.9, .R12 = 0.7, .R13 = 0.6, .R23 = 0.5};
  return m;
}

/// A material like a metal, as a ply: elasticity and flow are the same all around.
Material isotropic_ply(double angle, const Hardening& law) {
  Material m;
  m.density = 7850.0;
  const double E = 210e9, nu = 0.3;
  m.ply = Orthotropic{.E1 = E,
                      .E2 = E,
                      .nu12 = nu,
                      .G12 = E / (2.0 * (1.0 + nu)),
                      .angle = angle,
                      .E3 = E,
                      .nu13 = nu,
                      .nu23 = nu};
  m.hardening = law;
  return m;
}
Material metal(const Hardening& law) {
  Material m;
  m.density = 7850.0;
  m.elasticity = {210e9, 0.3};
  m.hardening = law;
  return m;
}

/// Strains without stress out of the plane: ε11, ε22, γ12 over σ11, σ22, σ12.
Vector3d elastic_strain(const Orthotropic& p, const Vector3d& s) {
  return {s[0] / p.E1 - p.nu12 / p.E1 * s[1], s[1] / p.E2 - p.nu12 / p.E1 * s[0], s[2] / p.G12};
}

/// paper 001 (1)–(13) written out for plane stress, per stress.
struct Written {
  double F, G, H, N;
  explicit Written(const HillRatios& r) {
    const double a = std::pow(r.R11, -2), b = std::pow(r.R22, -2), c = std::pow(r.R33, -2);
    F = 0.5 * (b + c - a), G = 0.5 * (c + a - b), H = 0.5 * (a + b - c), N = 1.5 * std::pow(r.R12, -2);
  }
  double stress(const Vector3d& t) const {
    return std::sqrt((G + H) * t[0] * t[0] + (F + H) * t[1] * t[1] - 2 * H * t[0] * t[1] +
                     2 * N * t[2] * t[2]);
  }
  Vector3d direction(const Vector3d& t) const {
    return Vector3d((G + H) * t[0] - H * t[1], (F + H) * t[1] - H * t[0], 2 * N * t[2]) / stress(t);
  }
};

/// Of tension at an angle to the fibres.
Vector3d pull(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * c, s * s, -c * s};
}

TEST(PlyFlow, yields_in_any_direction_where_hill_does) {
  for (const Material& material : {flax(0.4), odd(-0.7)}) {
    const Written hill(std::get<HillRatios>(*material.anisotropy));
    const double flow = material.hardening->flow_stress(0.0, 0.0, 293.15);
    for (double a = 0.0; a < 180.0; a += 7.5) {
      const Vector3d unit = pull(a * degrees), yield = flow / hill.stress(unit) * unit;
      for (const double share : {1.0 - 1e-9, 1.0 + 1e-9}) {
        PlyPoint point(material);
        ASSERT_TRUE(
            point.set(stretch(share * elastic_strain(*material.ply, yield), material.ply->angle), 1e-9));
        EXPECT_EQ(point.state.plastic_strain[0] > 0.0, share > 1.0) << a << " " << share;
      }
    }
  }
}

TEST(PlyFlow, flax_has_the_yield_stresses_and_strain_ratios_of_the_paper) {
  // worked out beside: tension at 0, 45 and 90°, lateral over axial plastic strain
  const PlyReturn back(*flax(0.0).ply, flax(0.0).yield_coefficients(), true);
  for (const auto& [angle, stress, ratio] :
       {std::tuple(0.0, 750e6, -0.5), {45.0, 39.649e6, -0.96507}, {90.0, 150e6, -0.02}}) {
    const Vector3d unit = pull(angle * degrees), T = stress * unit;
    EXPECT_NEAR(back.yield_stress({T[0], T[1], T[2]}), 750e6, 2e-5 * 750e6) << angle;
    PlyPoint point(flax(0.0));
    const Written hill(std::get<HillRatios>(*flax(0.0).anisotropy));
    const Vector3d flow = 1e-3 * hill.direction(T), e = elastic_strain(*flax(0.0).ply, T) + flow;
    ASSERT_TRUE(point.set(stretch(e, 0.0), 1e-6));
    const Fields<3>& plastic = point.state.ply_flow;
    const double c = std::cos(angle * degrees), s = std::sin(angle * degrees);
    const double axial = c * c * plastic[0][0] + s * s * plastic[1][0] - c * s * plastic[2][0],
                 lateral = s * s * plastic[0][0] + c * c * plastic[1][0] + c * s * plastic[2][0];
    EXPECT_NEAR(lateral / axial, ratio, 1e-5) << angle;
  }
}

TEST(PlyFlow, a_way_that_ends_in_a_known_stress_finds_it_and_its_flow) {
  const Voce law{.yield = 300e6, .saturation = 700e6, .exponent = 40.0};
  std::mt19937 generator(18);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const Material& material : {flax(0.0, law), odd(0.0, law)}) {
    const Written hill(std::get<HillRatios>(*material.anisotropy));
    for (int trial = 0; trial < 50; ++trial) {
      const Vector3d direction(any(generator), any(generator), 0.1 * any(generator));
      const double increment = std::pow(10.0, -2.5 + 2.0 * any(generator));
      const double flow_stress = material.hardening->flow_stress(increment, 0.0, 293.15);
      const Vector3d T = flow_stress / hill.stress(direction) * direction;
      const Vector3d plastic = increment * hill.direction(T);
      const Vector3d e = elastic_strain(*material.ply, T) + plastic;
      PlyPoint point(material);
      ASSERT_TRUE(point.set(stretch(e, 0.0), 1e-6));
      EXPECT_NEAR(point.state.plastic_strain[0], increment, 1e-9 * increment);
      EXPECT_NEAR(point.state.equivalent_stress[0], flow_stress, 1e-10 * flow_stress);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(point.state.ply_flow[k][0], plastic[as<int>(k)], 1e-8 * plastic.norm()) << trial;
    }
  }
}

/// 30 points, as those of the paper.
Tabulated table() {
  Tabulated law;
  for (int i = 0; i < 30; ++i) {
    law.strain.value[law.strain.size++] = 0.01 * i;
    law.stress.value[law.stress.size++] = 300e6 + 450e6 * (1.0 - std::exp(-0.2 * i));
  }
  return law;
}

const Hardening flow_laws[] = {Perfect{400e6}, table(), Linear{400e6, 2e9},
                               Swift{.K = 900e6, .strain0 = 0.002, .n = 0.25},
                               JohnsonCook{253e6, 685e6, 0.312, 0.0973, 1.0, 2.044, 296.0, 1698.0}};

TEST(PlyFlow, ratios_of_one_are_von_mises) {
  // principal axes that stay: additive logarithmic strains and C_p⁻¹ are the same there
  for (const Hardening& law : flow_laws)
    for (const bool stress_free : {true, false}) {
      std::mt19937 generator(7);
      std::uniform_real_distribution<double> any(-1.0, 1.0);
      PlyPoint ply(isotropic_ply(0.6, law), stress_free);
      PointState<2> state = points_at_rest<2>(1, 293.15);
      state.thin.switch_on(stress_free);
      state.thin.rest(1);
      Vector3d e(0.0, 0.0, 0.0);
      for (int step = 0; step < 40; ++step) {
        e += 5e-3 * Vector3d(any(generator), any(generator), 0.0);
        const Mat2 F = turn(0.3) * stretch(e, 0.25);
        ASSERT_TRUE(ply.set(F, 1e-5));
        for (std::size_t k = 0; k < 4; ++k) state.deformation[k][0] = F(as<int>(k / 2), as<int>(k % 2));
        ASSERT_EQ(update(metal(law), state, 1e-5), -1);
        const Mat2 P =
            (Mat2() << state.piola[0][0], state.piola[1][0], state.piola[2][0], state.piola[3][0]).finished();
        EXPECT_LT((ply.piola() - P).norm(), 1e-8 * P.norm()) << step;
        EXPECT_NEAR(ply.state.plastic_strain[0], state.plastic_strain[0], 1e-10);
        EXPECT_NEAR(ply.state.plastic_work[0], state.plastic_work[0], 1e-8 * state.plastic_work[0] + 1e-3);
        EXPECT_NEAR(ply.state.stored_energy[0], state.stored_energy[0], 1e-8 * state.stored_energy[0] + 1e-3);
        EXPECT_NEAR(ply.state.pressure[0], state.pressure[0], 1e-8 * P.norm());
        EXPECT_NEAR(ply.state.piola[4][0], stress_free ? 0.0 : state.piola[4][0], 1e-8 * P.norm());
      }
    }
}

TEST(PlyFlow, random_paths_stay_within_the_yield_surface_and_dissipate) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  constexpr double dt = 1e-5;
  for (const Hardening& law : flow_laws)
    for (const bool stress_free : {true, false})
      for (Material material : {flax(0.8, law), odd(0.8, law)}) {
        PlyPoint point(material, stress_free);
        Vector3d e(0.0, 0.0, 0.0);
        for (int step = 0; step < 500; ++step) {
          const double last = point.state.plastic_strain[0], worked = point.state.plastic_work[0];
          e += std::pow(10.0, -2.6 + any(generator)) *
               Vector3d(any(generator), any(generator), 2.0 * any(generator));
          ASSERT_TRUE(point.set(turn(any(generator)) * stretch(e, 0.8), dt));
          const double now = point.state.plastic_strain[0], rate = (now - last) / dt;
          const double limit = law.flow_stress(now, rate, 293.15);
          EXPECT_LE(point.state.equivalent_stress[0], limit * (1.0 + 1e-10)) << step;
          if (now > last) { EXPECT_NEAR(point.state.equivalent_stress[0], limit, 1e-10 * limit) << step; }
          EXPECT_GE(now, last);
          EXPECT_GE(point.state.dissipation[0], 0.0);
          EXPECT_NEAR(point.state.plastic_work[0] - worked, point.state.dissipation[0], 1e-6);
          EXPECT_NEAR(point.state.plastic_rate[0], rate, 1e-9 + 1e-9 * rate);
        }
        EXPECT_GT(point.state.plastic_strain[0], 0.05);
      }
}

TEST(PlyFlow, stress_is_the_derivative_of_the_energy_at_a_plastic_strain) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto deformation = [&](double size) -> Mat2 {
    return turn(any(generator)) *
           (Mat2::Identity() + size * Mat2::NullaryExpr([&] { return any(generator); }));
  };
  for (const bool stress_free : {true, false})
    for (int trial = 0; trial < 20; ++trial) {
      PlyPoint point(odd(any(generator)), stress_free);
      point.set_earlier(deformation(0.3));
      for (Field& flow : point.state.ply_flow) flow[0] = 0.2 * any(generator);
      expect_derivative_of_energy(point, deformation(0.2));
      EXPECT_EQ(point.state.plastic_strain[0], 0.0);
    }
}

TEST(PlyFlow, new_references_and_turns_change_nothing) {
  for (const bool stress_free : {true, false}) {
    const Linear law{300e6, 1e9};
    PlyPoint one(odd(0.3, law), stress_free), other(odd(0.3, law), stress_free),
        turned(odd(0.3, law), stress_free);
    const Mat2 first = turn(0.4) * stretch({0.03, -0.01, 0.02}, 0.3),
               second = stretch({0.01, 0.04, -0.03}, 1.0);
    const Mat2 R = turn(2.0);
    for (PlyPoint* point : {&one, &other}) ASSERT_TRUE(point->set(first, 1e-6));
    ASSERT_TRUE(turned.set(R * first, 1e-6));
    ASSERT_TRUE(one.set(second * first, 1e-6));
    ASSERT_TRUE(turned.set(R * second * first, 1e-6));
    other.set_earlier(first); // a new reference
    ASSERT_TRUE(other.set(second, 1e-6));
    const Mat2 P = other.piola() * first.inverse().transpose() / other.state.stress_free[0];
    EXPECT_LT((one.piola() - P).norm(), 1e-11 * P.norm());
    EXPECT_LT((turned.piola() - R * one.piola()).norm(), 1e-11 * P.norm());
    EXPECT_GT(one.state.plastic_strain[0], 0.02);
    for (const PlyPoint* point : {&other, &turned})
      EXPECT_NEAR(one.state.plastic_strain[0], point->state.plastic_strain[0], 1e-13);
  }
}

TEST(PlyFlow, mixed_matter_is_drawn_back_to_its_yield_surface) {
  for (const bool stress_free : {true, false}) {
    PlyPoint point(odd(0.3), stress_free);
    point.set_earlier(stretch({0.02, 0.03, 0.05}, 0.3));
    draw_back(point.material, stress_points(point.state), 0, 0.5);
    ASSERT_TRUE(point.set(Mat2::Identity(), 0.0));
    EXPECT_NEAR(point.state.equivalent_stress[0], 150e6, 1e-10 * 150e6);
    EXPECT_EQ(point.state.plastic_strain[0], 0.0);
    EXPECT_EQ(point.state.plastic_work[0], 0.0);
    const double drawn = point.state.ply_flow[0][0];
    draw_back(point.material, stress_points(point.state), 0, 0.6);
    EXPECT_EQ(point.state.ply_flow[0][0], drawn); // within
  }
}

TEST(PlyFlow, ratios_need_a_convex_function_and_r_values_are_the_same_one) {
  EXPECT_FALSE((HillRatios{.R22 = 5.0, .R33 = 5.0}.coefficients().convex()));
  EXPECT_TRUE((HillRatios{.R22 = 0.2, .R33 = 0.2}.coefficients().convex()));
  const HillCoefficients one = HillRatios{}.coefficients(), same = Hill48{}.coefficients();
  EXPECT_EQ(one.F, same.F);
  EXPECT_EQ(one.G, same.G);
  EXPECT_EQ(one.H, same.H);
  EXPECT_EQ(one.L, same.L);
  EXPECT_EQ(one.M, same.M);
  EXPECT_EQ(one.N, same.N);
  // r-values written as ratios: 1/R22² = F + H, 1/R33² = F + G, 1/R12² = 2N/3
  const HillCoefficients sheet = Hill48{.r0 = 1.9, .r45 = 0.7, .r90 = 2.4, .L = 1.2, .M = 1.8}.coefficients();
  const auto ratio = [](double by_square) { return 1.0 / std::sqrt(by_square); };
  const HillCoefficients again = HillRatios{.R22 = ratio(sheet.F + sheet.H),
                                            .R33 = ratio(sheet.F + sheet.G),
                                            .R12 = ratio(sheet.N / 1.5),
                                            .R13 = ratio(sheet.M / 1.5),
                                            .R23 = ratio(sheet.L / 1.5)}
                                     .coefficients();
  EXPECT_NEAR(again.F, sheet.F, 1e-14);
  EXPECT_NEAR(again.G, sheet.G, 1e-14);
  EXPECT_NEAR(again.H, sheet.H, 1e-14);
  EXPECT_NEAR(again.L, sheet.L, 1e-14);
  EXPECT_NEAR(again.M, sheet.M, 1e-14);
  EXPECT_NEAR(again.N, sheet.N, 1e-14);
}

} // namespace
} // namespace cnem::plasticity::test
