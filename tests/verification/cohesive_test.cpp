// Cohesive interfaces in whole runs, against beam theory and balances.
#include "input/case_reader.hpp"
#include "tests/finished_run.hpp"
#include "tests/solver_of.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

using Texts = std::vector<std::string>;

/// What beam theory says of a double cantilever beam per thickness (shared reference: composites.md; Williams
/// 1989).
struct Beam {
  double modulus, shear, height, energy; ///< along the arms in plane strain, Pa; Pa; m; J/m²

  double inertia() const { return height * height * height / 12.0; }
  double chi() const {
    const double ratio = 1.18 * modulus / shear, share = ratio / (1.0 + ratio);
    return std::sqrt(modulus / (11.0 * shear) * (3.0 - 2.0 * share * share));
  }
  double greatest_load(double crack) const {
    return std::sqrt(energy * modulus * inertia()) / (crack + chi() * height);
  }
  double growth() const { // P √δ
    return std::sqrt(2.0 / 3.0) * std::pow(energy, 0.75) * std::pow(modulus * inertia(), 0.25);
  }
};

TEST(Cohesive, double_cantilever_beam_opens_as_beams_do) {
  const input::Case input =
      input::read_case(std::string(CNEM_SOURCE_DIR) + "/cases/verification/double_cantilever/case.toml",
                       Texts{"output.pictures=\"\""});
  const FinishedRun done = finish(input);
  const double young = 34.28e9, poisson = 0.3;
  const Beam beam{young / (1.0 - poisson * poisson), young / (2.0 + 2.0 * poisson), 1e-3, 300.0};
  const std::vector<double>&load = done.of("support.up.force_y"), &place = done.of("probe.up.displacement_y"),
        &broken = done.of("cohesive.joint.broken");
  EXPECT_NEAR(*std::max_element(load.begin(), load.end()), beam.greatest_load(10e-3),
              0.06 * beam.greatest_load(10e-3));
  double sum = 0.0;
  int rows = 0;
  for (std::size_t r = 0; r < load.size(); ++r)
    if (broken[r] > 10.5e-3 && broken[r] < 14e-3) {
      sum += load[r] * std::sqrt(2.0 * place[r]);
      ++rows;
    }
  ASSERT_GT(rows, 30);
  EXPECT_NEAR(sum / rows, beam.growth(), 0.04 * beam.growth());
  EXPECT_LT(done.status.energy_residual, 1e-3);
}

} // namespace
} // namespace cnem::testing
