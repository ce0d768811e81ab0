// Chips of known thickness, curl and teeth, as outlines made by hand; the surface behind the tool.
#include "evaluate/chip.hpp"

#include "core/geometry/plane_section.hpp"
#include "evaluate/machined_surface.hpp"
#include "tests/clouds.hpp"
#include "tests/degree.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::evaluate {
namespace {

constexpr double feed = 0.3, rake = 17.5 * degree;

/// The workpiece from x = −3 to 6 and from y = −2 on, cut up to x = 0; its chip has the thickness of Lee and
/// Shaffer's for an angle φ, with a wave of teeth on its free side, and a curl of 1/curvature of its rake
/// side beyond `straight`.
struct Cut {
  double phi = 40.0 * degree, wave = 0.0, pitch = 0.5, curvature = 0.0, length = 4.0;
  bool mirrored = false;

  double thickness() const { return feed * std::cos(phi - rake) / std::sin(phi); }
  /// Centre line of nothing: the rake side at s and its normal to the free side.
  void rake_side(double s, Vec2& x, Vec2& across) const {
    const double straight = 1.0;
    x = Vec2(-std::sin(rake), std::cos(rake)) * std::min(s, straight);
    double turn = 0.0;
    if (s > straight && curvature > 0.0) { // clockwise, away from the tool
      turn = curvature * (s - straight);
      const Vec2 along(-std::sin(rake), std::cos(rake)), right = right_normal(along);
      x += (std::sin(turn) * along + (1.0 - std::cos(turn)) * right) / curvature;
    } else if (s > straight) {
      x += Vec2(-std::sin(rake), std::cos(rake)) * (s - straight);
    }
    across = Vec2(std::cos(rake - turn), std::sin(rake - turn));
  }

  /// Counter-clockwise, as boundaries of workpieces are.
  std::vector<Vec2> outline() const {
    const double h = 0.02;
    std::vector<Vec2> points;
    const auto side = [&](const Vec2& a, const Vec2& b) {
      const int n = static_cast<int>(std::ceil((b - a).norm() / h));
      for (int k = 0; k < n; ++k) points.push_back(a + (b - a) * (k / double(n)));
    };
    const Vec2 foot = Vec2(feed / std::tan(phi), feed);
    side({-3, -2}, {6, -2});
    side({6, -2}, {6, feed});
    side({6, feed}, foot);
    const double begin = foot.dot(Vec2(-std::sin(rake), std::cos(rake)));
    Vec2 x, across;
    for (double s = begin; s < length; s += h) {
      rake_side(s, x, across);
      points.push_back(
          x + (thickness() + 0.5 * wave * (1.0 - std::cos(2.0 * std::numbers::pi * (s - begin) / pitch))) *
                  across);
    }
    for (double s = length; s > 0.5 * h; s -= h) {
      rake_side(s, x, across);
      points.push_back(x);
    }
    side({0, 0}, {-3, 0});
    side({-3, 0}, {-3, -2});
    return points;
  }

  CutOutline loop() const {
    Cloud<2> cloud;
    std::vector<Vec2> points = outline();
    if (mirrored) std::reverse(points.begin(), points.end());
    testing::add_loop(cloud, points, 1.0);
    std::vector<Vec2> position(cloud.position.begin(), cloud.position.end());
    return cut_outline(cloud.facets, position);
  }
};

TEST(Chip, straight_one_has_its_thickness_shear_plane_and_angle) {
  const Cut cut;
  const Chip chip = measure_chip(cut.loop(), feed, rake);
  EXPECT_EQ(chip.note, "");
  EXPECT_NEAR(chip.thickness, cut.thickness(), 1e-6);
  EXPECT_NEAR(chip.peak - chip.valley, 0.0, 1e-6);
  EXPECT_NEAR(chip.shear_plane, feed / std::sin(cut.phi), 0.005);
  EXPECT_NEAR(chip.shear_plane_angle, cut.phi, 1.0 * degree);
  EXPECT_NEAR(shear_angle(feed, chip.thickness, rake), cut.phi, 1e-4);
  EXPECT_NEAR(chip.length, cut.length, 0.5 * cut.thickness());
  EXPECT_TRUE(std::isnan(curl_radius(chip, chip.measured)));
  EXPECT_NEAR(section_across(chip, 1.0).length(), cut.thickness(), 1e-6);
  EXPECT_NEAR((section_across(chip, 1.0).rake - chip.rake_side.front()).norm(), 1.0, 1e-9);
  EXPECT_TRUE(std::isnan(chip.tooth_spacing));
}

TEST(Chip, of_lee_and_shaffer_has_the_ratio_of_the_slip_line_field) {
  // Reference: t2/t1 = 0.797 at μ = 0 and rake 17.5°, φ = 45° + 17.5°.
  EXPECT_NEAR(Cut{.phi = 62.5 * degree}.thickness() / feed, 0.797, 5e-4);
  EXPECT_NEAR(shear_angle(feed, 0.797 * feed, rake), 62.5 * degree, 0.1 * degree);
}

TEST(Chip, outline_of_a_mirrored_frame_is_gone_along_the_same_way) {
  const Cut cut;
  const Chip chip = measure_chip(Cut{.mirrored = true}.loop(), feed, rake);
  EXPECT_NEAR(chip.thickness, cut.thickness(), 1e-6);
}

TEST(Chip, curled_one_has_its_radius_and_thickness) {
  const Cut cut{.curvature = 0.5, .length = 6.0};
  const Chip chip = measure_chip(cut.loop(), feed, rake);
  EXPECT_NEAR(chip.thickness, cut.thickness(), 0.002);
  EXPECT_NEAR(curl_radius(chip, {1.2, chip.measured.to}), 2.0, 0.04);
  EXPECT_NEAR(section_across(chip, 3.0).length(), cut.thickness(), 0.002);
}

TEST(Chip, one_that_comes_round_to_the_uncut_surface_is_measured_along_itself) {
  const Cut cut{.curvature = 1.0, .length = 4.3}; // three quarters of a turn
  const Chip chip = measure_chip(cut.loop(), feed, rake);
  EXPECT_EQ(chip.note, "");
  EXPECT_NEAR(chip.thickness, cut.thickness(), 0.005);
}

TEST(Chip, teeth_have_their_pitch_peaks_and_valleys) {
  const Cut cut{.wave = 0.15, .pitch = 0.4};
  const Chip chip = measure_chip(cut.loop(), feed, rake);
  EXPECT_GE(chip.teeth.size(), 5U);
  EXPECT_NEAR(chip.tooth_spacing, 0.4, 0.01);
  EXPECT_NEAR(chip.valley, cut.thickness(), 0.003);
  EXPECT_NEAR(chip.peak, cut.thickness() + 0.15, 0.003);
  EXPECT_NEAR(chip.thickness, cut.thickness() + 0.075, 0.01);
}

TEST(Chip, roughness_makes_no_teeth) {
  const Chip chip = measure_chip(Cut{.wave = 0.03, .pitch = 0.1}.loop(), feed, rake);
  EXPECT_TRUE(chip.teeth.empty());
}

TEST(Chip, is_not_there_before_the_cut_and_too_short_soon_after) {
  Cloud<2> cloud;
  testing::add_loop(cloud, {{0, -2}, {6, -2}, {6, feed}, {0, feed}}, 0.02);
  const std::vector<Vec2> position(cloud.position.begin(), cloud.position.end());
  EXPECT_EQ(measure_chip(cut_outline(cloud.facets, position), feed, rake).note,
            "no chip is found: there is none yet, or none any more");
  EXPECT_NE(measure_chip(Cut{.length = 0.55}.loop(), feed, rake).note.find("too short"), std::string::npos);
}

TEST(Chip, fresh_part_lies_between_shear_plane_and_half_a_feed_beyond) {
  const Cut cut;
  const Chip chip = measure_chip(cut.loop(), feed, rake);
  const std::vector<Vec2> fresh = fresh_chip(chip, feed);
  const Vec2 foot(feed / std::tan(cut.phi), feed), face(-std::sin(rake), std::cos(rake));
  EXPECT_TRUE(inside(fresh, 0.8 * foot + 0.3 * feed * face));
  EXPECT_FALSE(inside(fresh, 0.5 * foot)) << "in the shear plane";
  EXPECT_FALSE(inside(fresh, foot + 0.7 * feed * face)) << "beyond";
}

TEST(Surface, has_its_height_roughness_and_layers) {
  // A sawtooth of height 0.02 about −0.01; stress falls linearly with depth.
  Cloud<2> cloud;
  std::vector<Vec2> points{{-3, -2}, {6, -2}, {6, feed}, {0.3, feed}, {0, 0}};
  for (int k = 1; k < 150; ++k) points.emplace_back(-0.02 * k, k % 2 ? -0.02 : 0.0);
  testing::add_loop(cloud, points, 10.0);
  std::vector<Vec2> position(cloud.position.begin(), cloud.position.end());
  const SurfaceProfile profile = machined_profile(cloud.facets, position, feed);
  std::vector<double> volume(position.size(), 1e-4);
  for (double x = -2.9; x < 0.0; x += 0.02)
    for (double depth = 0.03; depth < 1.2; depth += 0.02) {
      position.emplace_back(x, -depth);
      volume.push_back(4e-4);
    }
  std::vector<double> along, away(position.size(), 2.0), left, across(position.size(), 3.0),
      strain(position.size(), 0.1), heat(position.size(), 300.0), ratio(position.size(), 0.5);
  for (const Vec2& x : position) {
    along.push_back(100.0 + 50.0 * x.y());
    left.push_back(10.0 + 20.0 * x.y());
    if (x.y() < -1.2) ratio[left.size() - 1] = 2.0; // deeper than what is looked at
  }
  const MachinedSurface surface = measure_surface(
      profile, position, {volume, {along, away, across}, {left, across, away}, strain, heat, ratio}, feed,
      3.0, feed);
  EXPECT_EQ(surface.note, "");
  EXPECT_NEAR(surface.height, -0.01, 1e-6);
  EXPECT_NEAR(surface.roughness, 0.01, 1e-6);
  EXPECT_NEAR(surface.Rz, 0.02, 1e-12);
  EXPECT_NEAR(surface.measured.to, -feed, 1e-12);
  EXPECT_NEAR(surface.layer, 0.02, 0.003);
  ASSERT_GT(surface.layers.size(), 20U);
  for (const DepthLayer& layer : surface.layers) {
    EXPECT_NEAR(layer.loaded.along.mean, 100.0 - 50.0 * (layer.depth + 0.01), 1e-9);
    EXPECT_EQ(layer.loaded.away.mean, 2.0);
    EXPECT_EQ(layer.loaded.away.spread, 0.0);
    EXPECT_NEAR(layer.loaded.across.mean, 3.0, 1e-12);
    EXPECT_NEAR(layer.residual.along.mean, 10.0 - 20.0 * (layer.depth + 0.01), 1e-9);
    EXPECT_NEAR(layer.residual.away.mean, 3.0, 1e-12);
    EXPECT_EQ(layer.residual.across.mean, 2.0);
  }
  EXPECT_EQ(surface.yield_ratio, 0.5);
}

TEST(Surface, behind_a_cut_that_has_hardly_begun_is_not_measured) {
  Cloud<2> cloud;
  testing::add_loop(cloud, {{-0.5, -2}, {6, -2}, {6, feed}, {0.3, feed}, {0, 0}, {-0.5, 0}}, 0.02);
  const std::vector<Vec2> position(cloud.position.begin(), cloud.position.end());
  const std::vector<double> none(position.size(), 1.0);
  const MachinedSurface surface =
      measure_surface(machined_profile(cloud.facets, position, feed), position,
                      {none, {none, none, none}, {none, none, none}, none, none, none}, feed, 3.0, feed);
  EXPECT_NE(surface.note.find("too short"), std::string::npos);
  EXPECT_TRUE(std::isnan(surface.roughness));
  EXPECT_TRUE(std::isnan(surface.Rz));
}

TEST(Surface, a_scratch_counts_in_one_of_five_lengths) {
  Cloud<2> cloud;
  std::vector<Vec2> points{{-3, -2}, {6, -2}, {6, feed}, {0.3, feed}, {0, 0}};
  for (int k = 1; k < 150; ++k) points.emplace_back(-0.02 * k, k == 80 ? -0.07 : k % 2 ? -0.02 : 0.0);
  testing::add_loop(cloud, points, 10.0);
  const std::vector<Vec2> position(cloud.position.begin(), cloud.position.end());
  const std::vector<double> none(position.size(), 1.0);
  const MachinedSurface surface =
      measure_surface(machined_profile(cloud.facets, position, feed), position,
                      {none, {none, none, none}, {none, none, none}, none, none, none}, feed, 3.0, feed);
  EXPECT_NEAR(surface.Rz, (4 * 0.02 + 0.07) / 5, 1e-12);
}

TEST(Surface, of_a_short_cut_is_measured_nearer_to_the_tool) {
  Cloud<2> cloud;
  std::vector<Vec2> points{{-0.6, -2}, {6, -2}, {6, feed}, {0.3, feed}, {0, 0}};
  for (int k = 1; k < 30; ++k) points.emplace_back(-0.02 * k, k % 2 ? -0.02 : 0.0);
  testing::add_loop(cloud, points, 10.0);
  const std::vector<Vec2> position(cloud.position.begin(), cloud.position.end());
  const std::vector<double> none(position.size(), 1.0);
  const DepthFields fields{none, {none, none, none}, {none, none, none}, none, none, none};
  const SurfaceProfile profile = machined_profile(cloud.facets, position, feed);
  EXPECT_TRUE(std::isnan(measure_surface(profile, position, fields, feed, 3.0, feed).roughness));
  const MachinedSurface surface = measure_surface(profile, position, fields, feed, 3.0, 0.25 * feed);
  EXPECT_NEAR(surface.roughness, 0.01, 1e-6);
  EXPECT_NEAR(surface.measured.to, -0.25 * feed, 1e-12);
}

TEST(Surface, of_several_bodies_is_what_is_seen_from_above) {
  // Two blocks with a gap between them that a chip lies over, the left one with a step up, the other with a
  // hole and a side that leans.
  Cloud<2> cloud;
  testing::add_loop(cloud, {{-3, -2}, {-1.499, -2}, {-1.499, 0}, {-2.501, 0}, {-2.501, 0.02}, {-3, 0.02}},
                    0.1);
  testing::add_loop(cloud, {{-1.2, -2}, {6, -2}, {6, feed}, {0.3, feed}, {0, 0}, {-1.2, 0}, {-1.3, -0.1}},
                    0.1);
  testing::add_loop(cloud, {{-1.0, -0.1}, {-0.8, -0.02}, {-0.6, -0.1}}, 0.1);
  testing::add_loop(cloud, {{-2.0, 0.01}, {-1.0, 0.01}, {-1.0, 0.05}, {-2.0, 0.05}}, 0.1);
  std::vector<Vec2> position(cloud.position.begin(), cloud.position.end());
  const SurfaceProfile profile = machined_profile(cloud.facets, position, feed);
  ASSERT_EQ(profile.size(), 2U) << "one stretch of each block";
  EXPECT_EQ(profile[0].size() + profile[1].size(), 468U) << "501 places, 33 of them in the gap";
  for (const std::vector<Vec2>& stretch : profile)
    for (const Vec2& x : stretch) {
      const double height = x.x() < -2.501 ? 0.02 : x.x() < -1.499 || x.x() > -1.2 ? 0.0 : x.x() + 1.2;
      EXPECT_NEAR(x.y(), height, 1e-12);
    }
  const std::vector<double> none(position.size(), 1.0);
  const MachinedSurface surface = measure_surface(
      profile, position, {none, {none, none, none}, {none, none, none}, none, none, none}, feed, 2.0, 0.1);
  // Five feeds from -0.1 m on: a wall of 0.1 by 0.1 m and 1.2 m at 0; the gap is no surface.
  EXPECT_NEAR(surface.height, -0.05 * std::sqrt(0.02) / (1.2 + std::sqrt(0.02)), 5e-4);

  for (Facet<2>& facet : cloud.facets)
    std::swap(facet.node[0], facet.node[1]); // of a tool that cuts towards -x
  EXPECT_EQ(machined_profile(cloud.facets, position, feed)[1].size(), profile[1].size());
}

TEST(Surface, is_that_of_the_workpiece_whatever_chips_lie_beside_it) {
  Cloud<2> alone;
  testing::add_loop(alone, {{-3, -2}, {6, -2}, {6, feed}, {0.3, feed}, {0, 0}, {-1, -0.01}}, 0.1);
  Cloud<2> beside = alone;
  testing::add_loop(beside, {{-0.01, 0.001}, {0.02, 0.02}, {-0.02, 0.02}}, 0.1);
  const auto profile = [](const Cloud<2>& cloud) {
    return machined_profile(cloud.facets, {cloud.position.begin(), cloud.position.end()}, feed);
  };
  EXPECT_EQ(profile(beside), profile(alone));
}

TEST(Surface, that_an_earlier_cut_has_left_is_not_measured) {
  Cloud<2> cloud;
  std::vector<Vec2> points{{-3, -2}, {6, -2}, {6, feed}, {0.3, feed}, {0, 0}};
  for (int k = 1; k < 150; ++k) points.emplace_back(-0.02 * k, k % 2 && k <= 50 ? -0.02 : 0.0);
  testing::add_loop(cloud, points, 10.0);
  const std::vector<Vec2> position(cloud.position.begin(), cloud.position.end());
  const std::vector<double> none(position.size(), 1.0);
  const DepthFields fields{none, {none, none, none}, {none, none, none}, none, none, none};
  const SurfaceProfile profile = machined_profile(cloud.facets, position, feed);
  const MachinedSurface surface = measure_surface(profile, position, fields, feed, 1.0, 0.2 * feed);
  EXPECT_NEAR(surface.measured.from, -1.0 + 0.2 * feed, 1e-12);
  EXPECT_NEAR(surface.roughness, 0.01, 1e-6);
  EXPECT_LT(measure_surface(profile, position, fields, feed, 3.0, 0.2 * feed).roughness, 0.0095);
}

} // namespace
} // namespace cnem::evaluate
