// The interaction integral on exact tip fields sampled at the stress points.
#include "cracked_square.hpp"
#include "fracture/enrichment.hpp"
#include "fracture/interaction_integral.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

using namespace fracture;

/// K_I and K_II that the integral finds in the exact field of (1, 0.5) at the last tip.
StressIntensity measured(const CrackedSquare& model, const EnrichedOperators& enriched, const Ring& ring) {
  const CrackTip& tip = model.tips.back();
  const PlaneElasticity elastic = PlaneElasticity::plane_strain(1.0, 0.3);
  Mat2 frame;
  frame.row(0) = tip.direction.transpose();
  frame.row(1) = left_normal(tip.direction).transpose();
  const auto points = static_cast<std::size_t>(enriched.operators.points);
  Fields<5> gradient;
  Fields<4> stress;
  resize_all(gradient, points);
  resize_all(stress, points);
  for (std::size_t p = 0; p < points; ++p) {
    const Vec2 x = enriched.position[p];
    const double r = (x - tip.position).norm(), theta = tip.angle(x);
    const TipField one = tip_field(0, elastic, r, theta), two = tip_field(1, elastic, r, theta);
    const Mat2 g = frame.transpose() * (one.gradient + 0.5 * two.gradient) * frame;
    const Mat2 s = frame.transpose() * (one.stress + 0.5 * two.stress) * frame;
    for (std::size_t k = 0; k < 4; ++k)
      gradient[k][p] = g(static_cast<Eigen::Index>(k / 2), static_cast<Eigen::Index>(k % 2));
    stress[0][p] = s(0, 0);
    stress[1][p] = s(1, 1);
    stress[3][p] = s(0, 1);
  }
  return stress_intensity(tip, ring, elastic,
                          {enriched.operators, model.cloud.position, enriched.position, gradient, stress},
                          {});
}

TEST(InteractionIntegral, finds_both_modes_of_an_exact_field) {
  for (const double angle : {0.0, 0.7}) {
    const CrackedSquare model = cracked_square(0.05, angle);
    ASSERT_EQ(model.tips.size(), 2U);
    for (const double radius : {0.0, 0.25}) {
      const EnrichedOperators enriched =
          enrich(model.cloud, model.approximation, model.tips, {0.0, radius}, voronoi::Functions::sibson);
      for (const double outer : {0.15, 0.2, 0.25}) {
        const StressIntensity k = measured(model, enriched, {0.5 * outer, outer});
        // Three spacings wide, the ring of single points is too coarse to ask for more.
        const double tolerance = radius > 0.0 ? 5e-3 : outer < 0.2 ? 2e-2 : 3e-3;
        EXPECT_NEAR(k.K_I, 1.0, tolerance);
        EXPECT_NEAR(k.K_II, 0.5, tolerance);
      }
    }
  }
}

} // namespace
} // namespace cnem::testing
