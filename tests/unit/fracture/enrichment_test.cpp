// Tip fields and the operators that carry them.
#include "cracked_square.hpp"
#include "fracture/enrichment.hpp"
#include "fracture/williams.hpp"
#include "mechanics/statics/statics.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <numbers>
#include <set>

namespace cnem::testing {
namespace {

using namespace fracture;

Vec2 polar(double r, double theta) { return {r * std::cos(theta), r * std::sin(theta)}; }

TEST(TipField, gradients_are_the_derivatives_and_the_stress_is_in_equilibrium) {
  const PlaneElasticity elastic = PlaneElasticity::plane_stress(2.0, 0.3);
  constexpr double h = 1e-5;
  for (const double theta : {-3.0, -1.2, 0.0, 0.4, 2.5})
    for (int mode = 0; mode < 2; ++mode) {
      const Vec2 x = polar(0.7, theta);
      const auto at = [&](const Vec2& y) {
        return tip_field(mode, elastic, y.norm(), std::atan2(y.y(), y.x()));
      };
      Vec2 force = Vec2::Zero();
      for (Eigen::Index j = 0; j < 2; ++j) {
        const Vec2 step = h * Vec2::Unit(j);
        const TipField up = at(x + step), down = at(x - step);
        const Vec2 slope = (up.displacement - down.displacement) / (2 * h);
        EXPECT_LT((slope - at(x).gradient.col(j)).norm(), 1e-8);
        force += (up.stress.col(j) - down.stress.col(j)) / (2 * h);
      }
      EXPECT_LT(force.norm(), 1e-8);
    }
  // K_I is the strength of σ_yy ahead of the tip, K_II of σ_xy; the faces are free.
  const double r = 0.01, unit = 1.0 / std::sqrt(2.0 * std::numbers::pi * r);
  EXPECT_NEAR(tip_field(0, elastic, r, 0.0).stress(1, 1), unit, 1e-12 * unit);
  EXPECT_NEAR(tip_field(1, elastic, r, 0.0).stress(0, 1), unit, 1e-12 * unit);
  for (int mode = 0; mode < 2; ++mode)
    EXPECT_LT(tip_field(mode, elastic, r, std::numbers::pi).stress.col(1).norm(), 1e-12 * unit);
}

TEST(Branch, functions_span_the_displacement_of_both_modes) {
  const PlaneElasticity elastic = PlaneElasticity::plane_strain(1.0, 0.3);
  constexpr int samples = 40;
  Eigen::MatrixXd functions(samples, branch_count);
  Eigen::MatrixXd wanted(samples, 4);
  for (int s = 0; s < samples; ++s) {
    const double theta = (-1.0 + 2.0 * (s + 0.5) / samples) * std::numbers::pi;
    const auto f = branch(1.0, theta);
    for (std::size_t k = 0; k < branch_count; ++k) functions(s, static_cast<Eigen::Index>(k)) = f[k];
    for (int mode = 0; mode < 2; ++mode)
      wanted.row(s).segment<2>(2 * mode) = tip_field(mode, elastic, 1.0, theta).displacement.transpose();
  }
  const Eigen::MatrixXd found = functions.colPivHouseholderQr().solve(wanted);
  EXPECT_LT((functions * found - wanted).norm(), 1e-12 * wanted.norm());
}

TEST(CrackTips, know_their_frame_faces_and_room) {
  const CrackedSquare model = cracked_square(0.1, 0.0);
  ASSERT_EQ(model.tips.size(), 2U);
  const CrackTip &first = model.tips[0], &last = model.tips[1];
  EXPECT_EQ(first.name, "first");
  EXPECT_LT((last.direction - Vec2(1, 0)).norm(), 1e-12);
  EXPECT_LT((first.direction - Vec2(-1, 0)).norm(), 1e-12);
  EXPECT_NEAR(last.half_length, 0.3, 1e-12);
  EXPECT_NEAR(last.clearance, 0.7, 1e-12);
  // A node of the upper face: θ = +π seen from the last tip, −π from the first.
  for (std::size_t i = 0; i < model.cloud.position.size(); ++i) {
    if (last.face[i] == 0 || as<NodeIndex>(i) == first.node) continue;
    EXPECT_EQ(last.face[i], -first.face[i]);
    const double theta = last.angle_of_node(as<NodeIndex>(i), model.cloud.position[i]);
    EXPECT_NEAR(std::abs(theta), std::numbers::pi, 1e-9);
    EXPECT_EQ(theta > 0, last.face[i] > 0);
  }
}

TEST(CrackTips, an_end_on_the_boundary_is_no_tip) {
  clouds::DomainShape shape = square_shape();
  shape.cracks.push_back({"edge", {Vec2(-1, 0), Vec2(0.2, 0.1)}});
  const Cloud<2> cloud = clouds::generate_cloud(shape, {0.15, {}}, {}).cloud;
  const auto tips = find_tips(cloud, {{"edge", shape.cracks[0].path, {"left", "right"}}});
  ASSERT_EQ(tips.size(), 1U);
  EXPECT_EQ(tips[0].name, "right");
  EXPECT_NEAR(tips[0].half_length, (Vec2(0.2, 0.1) - Vec2(-1, 0)).norm(), 1e-12);
}

class Enriched : public ::testing::TestWithParam<double> {};

TEST_P(Enriched, operators_keep_sums_volume_and_linear_fields) {
  const CrackedSquare model = cracked_square(0.1, GetParam());
  const EnrichedOperators enriched =
      enrich(model.cloud, model.approximation, model.tips, {0.15, 0.15}, voronoi::Functions::sibson);
  const DiscreteOperators<2>& op = enriched.operators;
  ASSERT_GT(op.nodes, model.cloud.nodes());
  EXPECT_EQ((op.nodes - model.cloud.nodes()) % static_cast<int>(branch_count), 0);
  double volume = 0.0;
  for (std::size_t p = 0; p < static_cast<std::size_t>(op.points); ++p) {
    volume += op.volume[p];
    Vec2 sum = Vec2::Zero();
    Mat2 linear = Mat2::Zero();
    double size = 0.0;
    for (auto e = static_cast<std::size_t>(op.row_begin[p]);
         e < static_cast<std::size_t>(op.row_begin[p + 1]); ++e) {
      const auto i = static_cast<std::size_t>(op.node[e]);
      if (i >= model.cloud.position.size()) continue;
      const Vec2 b(op.gradient[0][e], op.gradient[1][e]);
      size += b.norm();
      sum += b;
      linear += model.cloud.position[i] * b.transpose();
    }
    // Gradients of stolen areas lose digits close to nodes, where the Gauss points of a tip reach.
    EXPECT_LT(sum.norm(), 1e-9 * size);
    EXPECT_LT((linear - Mat2::Identity()).norm(), 1e-9 * (1.0 + size));
  }
  EXPECT_NEAR(volume, 4.0, 1e-11);
}

TEST_P(Enriched, patch_linear_displacement_is_solved_exactly) {
  const CrackedSquare model = cracked_square(0.1, GetParam());
  const EnrichedOperators enriched =
      enrich(model.cloud, model.approximation, model.tips, {0.15, 0.15}, voronoi::Functions::sibson);
  // A strain that leaves the faces without traction: uniaxial along the crack. Then no function is needed.
  const double nu = 0.3;
  const Vec2 t = model.tips[1].direction, n = left_normal(t);
  const Mat2 strain = t * t.transpose() - nu * n * n.transpose();
  std::vector<Support<2>> supports;
  std::set<NodeIndex> held;
  for (const Facet<2>& facet : model.cloud.facets)
    if (model.cloud.piece_names[facet.piece] == "side") held.insert(facet.node.begin(), facet.node.end());
  for (const NodeIndex i : held)
    for (Eigen::Index k = 0; k < 2; ++k)
      supports.push_back({"side",
                          Support<2>::Kind::displacement,
                          Vec2::Unit(k),
                          TimeTable(strain.row(k).dot(model.cloud.position[static_cast<std::size_t>(i)])),
                          {i}});
  const auto nodes = model.cloud.position.size();
  const Supports<2> all(supports, nodes);
  Fields<2> force;
  resize_all(force, nodes);
  const StaticSolution<2> solution = solve_statics<2>({.operators = enriched.operators,
                                                       .position = model.cloud.position,
                                                       .links = enriched.links,
                                                       .link_points = model.approximation.mechanics,
                                                       .elasticity = {1.0, nu},
                                                       .out_of_plane = OutOfPlane::stress_free,
                                                       .supports = all,
                                                       .force = force});
  for (std::size_t i = 0; i < nodes; ++i) {
    const Vec2 exact = strain * model.cloud.position[i];
    EXPECT_NEAR(solution.displacement[0][i], exact.x(), 1e-9);
    EXPECT_NEAR(solution.displacement[1][i], exact.y(), 1e-9);
  }
  const Mat2 stress = t * t.transpose();
  for (std::size_t p = 0; p < enriched.position.size(); ++p) {
    Mat2 found;
    found << solution.stress[0][p], solution.stress[3][p], solution.stress[3][p], solution.stress[1][p];
    // 1/√r of what rounding leaves of the functions.
    EXPECT_LT((found - stress).norm(), 1e-6) << enriched.position[p].transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, Enriched, ::testing::Values(0.0, 0.5, 1.3));

TEST(Enrichment, without_a_radius_leaves_the_operators_as_they_are) {
  const CrackedSquare model = cracked_square(0.15, 0.3);
  const EnrichedOperators plain =
      enrich(model.cloud, model.approximation, model.tips, {0.0, 0.0}, voronoi::Functions::sibson);
  EXPECT_EQ(plain.operators.node, model.approximation.mechanics.node);
  EXPECT_EQ(plain.position.size(), static_cast<std::size_t>(plain.operators.points));
  EXPECT_EQ(plain.enriched_nodes(), 0);
}

} // namespace
} // namespace cnem::testing
