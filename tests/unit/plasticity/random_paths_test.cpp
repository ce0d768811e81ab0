// The production kernel against Box 2 in its F^p form on random deformation paths.
#include "tests/each_isa.hpp"
#include "tests/unit/plasticity/box2_reference.hpp"
#include "tests/unit/plasticity/points.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

namespace cnem::plasticity::test {
namespace {

class RandomPaths {
public:
  explicit RandomPaths(unsigned seed) : generator(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }

  Material material() {
    Material m = steel();
    m.elasticity = {log_uniform(50e9, 300e9), uniform(0.1, 0.45)};
    const int kind = static_cast<int>(uniform(0.0, 9.0));
    if (kind == 0)
      m.hardening = Perfect{log_uniform(1e8, 1e9)};
    else if (kind == 1)
      m.hardening = Linear{log_uniform(1e8, 1e9), log_uniform(1e7, 1e9)};
    else if (kind == 2)
      m.hardening.reset();
    else if (kind == 8) {
      const double yield = log_uniform(1e8, 1e9);
      m.hardening = Voce{.yield = yield,
                         .hardening = uniform(0.0, 1.0) < 0.5 ? 0.0 : log_uniform(1e7, 1e9),
                         .saturation = yield + log_uniform(1e8, 1e9),
                         .exponent = log_uniform(1.0, 100.0)};
    } else
      m.hardening = JohnsonCook{log_uniform(1e8, 1e9),
                                log_uniform(1e8, 1e9),
                                uniform(0.15, 0.9),
                                kind < 5 ? 0.0 : log_uniform(1e-3, 0.1),
                                log_uniform(1e-3, 1e3),
                                uniform(0.6, 2.5),
                                296.0,
                                1698.0};
    return m;
  }

  /// Of laws that the return map evaluates by their formula; the last one falls with strain.
  Material material_by_formula() {
    Material m = steel();
    m.elasticity = {log_uniform(50e9, 300e9), uniform(0.1, 0.45)};
    const int kind = static_cast<int>(uniform(0.0, 8.0));
    const double yield = log_uniform(1e8, 1e9), n = uniform(0.15, 0.9);
    if (kind == 0)
      m.hardening = Swift{.K = log_uniform(1e8, 2e9), .strain0 = log_uniform(1e-4, 0.1), .n = n};
    else if (kind == 1)
      m.hardening = HockettSherby{.yield = yield,
                                  .saturation = yield + log_uniform(1e7, 1e9),
                                  .N = log_uniform(0.3, 30.0),
                                  .p = uniform(0.4, 1.5)};
    else if (kind == 2)
      m.hardening = Goijaerts{.yield = yield,
                              .rise = log_uniform(1e7, 1e9),
                              .rise_strain = log_uniform(1e-3, 1.0),
                              .root = log_uniform(1e7, 1e9),
                              .hardening = log_uniform(1e6, 1e9)};
    else if (kind == 3)
      m.hardening = ZerilliArmstrongFcc{.C0 = yield,
                                        .C2 = log_uniform(1e8, 1e9),
                                        .C3 = log_uniform(1e-3, 5e-3),
                                        .C4 = log_uniform(1e-5, 2e-4),
                                        .strain_exponent = n};
    else
      m.hardening = Calamaz{.A = yield,
                            .B = log_uniform(1e8, 1e9),
                            .n = n,
                            .a = uniform(0.8, 4.0),
                            .b = uniform(0.2, 5.0),
                            .c = log_uniform(0.5, 12.0),
                            .d = uniform(0.5, 2.0),
                            .C = kind < 6 ? 0.0 : log_uniform(1e-3, 0.1),
                            .rate0 = log_uniform(1e-3, 1e3),
                            .m = uniform(0.6, 2.5),
                            .T0 = 296.0,
                            .Tmelt = 1698.0};
    return m;
  }

  /// Strain up to `size` with little change of volume (elastic, hence a huge pressure), then a rotation.
  template<int dim> Mat3 increment(double size) {
    Mat3 l = Mat3::Zero();
    const int n = dim == 2 ? 2 : 3;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) l(i, j) = uniform(-size, size);
    l.diagonal().head(n).array() -= l.trace() / n - uniform(-2e-3, 2e-3);
    Mat3 f = Mat3::Identity() + l;
    if (dim == 2) f(2, 2) = 1.0 + uniform(-0.05, 0.05) * size;
    f /= std::cbrt(f.determinant() / (1.0 + uniform(-3e-3, 3e-3)));
    Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
    if (dim == 3) axis = Eigen::Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
    return Eigen::AngleAxisd(uniform(-3.1, 3.1), axis).toRotationMatrix() * f;
  }

private:
  std::mt19937 generator;
};

/// Largest difference in stress relative to |τ| (or to that of a strain of 1e-3 if it is smaller, as in
/// nearly molten points: b_e from a large F carries cond(F)² roundings), and in plastic strain.
template<int dim>
void compare(unsigned seed, int batches, std::size_t paths, int steps, Material (RandomPaths::*any)()) {
  RandomPaths random(seed);
  double worst_stress = 0.0, worst_strain = 0.0;
  std::size_t plastic = 0;
  for (int batch = 0; batch < batches; ++batch) {
    const Material material = (random.*any)();
    PointState<dim> s = points_at_rest<dim>(paths, 296.0);
    std::vector<Box2Reference> reference(paths);
    for (int step = 0; step < steps; ++step) {
      const double dt = random.log_uniform(1e-10, 1e-3);
      for (std::size_t i = 0; i < paths; ++i) {
        const Mat3 f = random.increment<dim>(random.log_uniform(1e-4, 0.25)) * general<dim>(s.deformation, i);
        set_deformation(s, i, f);
        s.temperature[i] = random.uniform(250.0, 1600.0);
      }
      ASSERT_EQ(update(material, s, dt), -1);
      for (std::size_t i = 0; i < paths; ++i) {
        reference[i].step(material, general<dim>(s.deformation, i), s.temperature[i], dt);
        const Mat3& tau = reference[i].kirchhoff;
        const double q = std::sqrt(1.5) * (tau - tau.trace() / 3.0 * Mat3::Identity()).norm();
        plastic += reference[i].increment > 0.0;
        const double scale = std::max(tau.norm(), 2e-3 * material.elasticity.mu());
        worst_stress = std::max(worst_stress, (kirchhoff(s, i) - tau).norm() / scale);
        worst_stress = std::max(worst_stress, std::abs(s.equivalent_stress[i] - q) / scale);
        worst_strain = std::max(worst_strain, std::abs(s.plastic_strain[i] - reference[i].plastic_strain));
      }
    }
  }
  EXPECT_GT(plastic, static_cast<std::size_t>(batches) * paths * static_cast<std::size_t>(steps) / 2);
  EXPECT_LT(worst_stress, 1e-10);
  EXPECT_LT(worst_strain, 1e-10);
  std::printf("largest relative difference in stress %.1e, difference in plastic strain %.1e\n", worst_stress,
              worst_strain);
}

TEST(random_paths, plane_equal_to_fp_form) { compare<2>(1, 200, 300, 4, &RandomPaths::material); }
TEST(random_paths, space_equal_to_fp_form) { compare<3>(2, 200, 200, 4, &RandomPaths::material); }

using Formula = cnem::testing::EachIsa;
INSTANTIATE_TEST_SUITE_P(each, Formula, cnem::testing::every_isa(), cnem::testing::name_of_isa);

TEST_P(Formula, plane_equal_to_fp_form) { compare<2>(3, 100, 150, 6, &RandomPaths::material_by_formula); }
TEST_P(Formula, space_equal_to_fp_form) { compare<3>(4, 100, 100, 6, &RandomPaths::material_by_formula); }

} // namespace
} // namespace cnem::plasticity::test
