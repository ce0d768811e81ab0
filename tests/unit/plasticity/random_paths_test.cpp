// The production kernel against Box 2 in its F^p form on random deformation paths.
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
template<int dim> void compare(unsigned seed, int batches, std::size_t paths, int steps) {
  RandomPaths random(seed);
  double worst_stress = 0.0, worst_strain = 0.0;
  std::size_t plastic = 0;
  for (int batch = 0; batch < batches; ++batch) {
    const Material material = random.material();
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

TEST(random_paths, plane_equal_to_fp_form) { compare<2>(1, 200, 300, 4); }
TEST(random_paths, space_equal_to_fp_form) { compare<3>(2, 200, 200, 4); }

} // namespace
} // namespace cnem::plasticity::test
