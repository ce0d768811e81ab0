// Sheared faces with known heights and angles.
#include "tests/unit/evaluate/drawn_profile.hpp"

#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace cnem::evaluate {
namespace {

TEST(ShearedFace, heights_and_angle_of_a_drawn_profile) {
  const Profile p;
  const ShearedFace face = measure_face(p.outline(), rules());
  EXPECT_TRUE(face.parted);
  EXPECT_TRUE(face.found());
  EXPECT_EQ(face.note, "");
  expect_heights(face, p, 0.005); // a quarter of the chord
  EXPECT_NEAR(face.fracture_angle, p.angle, 1e-6);
  EXPECT_NEAR(face.rollover_width, p.width, 0.02);
  EXPECT_NEAR(face.tilt, 0.0, 1e-9);
  EXPECT_NEAR(length_of(face, Zone::rollover), std::hypot(p.width, p.rollover), 0.03);
  EXPECT_NEAR(length_of(face, Zone::burnish), p.burnish, 0.01);
  EXPECT_NEAR(length_of(face, Zone::fracture), (1.0 - 0.5) / std::cos(p.angle), 0.01);
  EXPECT_GT(length_of(face, Zone::burr), 0.05);
}

TEST(ShearedFace, a_burr_begins_at_the_other_surface) {
  const Profile p;
  const ShearedFace face = measure_face(p.outline(0.2), rules());
  double first = 0.0, deepest = 0.0;
  for (std::size_t k = 0; k < face.zone.size(); ++k) {
    if (face.zone[k] != Zone::burr) continue;
    if (first == 0.0) first = face.profile[k].y();
    deepest = std::max(deepest, face.profile[k + 1].y());
  }
  EXPECT_NEAR(deepest - first, face.burr, 1e-9) << "however long the chords";
}

TEST(ShearedFace, heights_are_exact_in_the_limit_of_short_chords) {
  const Profile p;
  const ShearedFace face = measure_face(p.outline(0.001), rules(1e-4));
  expect_heights(face, p, 3e-5);
}

TEST(ShearedFace, sense_of_travel_and_first_point_do_not_matter) {
  const Profile p;
  const FaceOutline outline = p.outline();
  const ShearedFace face = measure_face(outline, rules());
  for (const std::size_t shift : {0U, 17U, 301U}) {
    FaceOutline turned = outline;
    std::rotate(turned.point.begin(), turned.point.begin() + static_cast<std::ptrdiff_t>(shift),
                turned.point.end());
    std::rotate(turned.surface.begin(), turned.surface.begin() + static_cast<std::ptrdiff_t>(shift),
                turned.surface.end());
    for (const FaceOutline& other : {turned, reversed(turned)}) {
      const ShearedFace again = measure_face(other, rules());
      EXPECT_EQ(again.rollover, face.rollover);
      EXPECT_EQ(again.burnish, face.burnish);
      EXPECT_EQ(again.fracture, face.fracture);
      EXPECT_EQ(again.burr, face.burr);
      EXPECT_NEAR(again.fracture_angle, face.fracture_angle, 1e-12);
    }
  }
}

TEST(ShearedFace, round_rollover_ends_where_it_is_parallel_within_the_tolerance) {
  Profile p;
  p.round = true;
  p.rollover = 0.2;
  for (const double parallel : {5.0, 10.0, 20.0}) {
    FaceRules r = rules(0.005);
    r.parallel = parallel * degree;
    const ShearedFace face = measure_face(p.outline(0.002), r);
    EXPECT_NEAR(face.rollover, 0.2 * (1.0 - std::sin(parallel * degree)), 0.005);
    EXPECT_NEAR(face.rollover + face.burnish, 0.55, 0.003);
  }
}

TEST(ShearedFace, angles_of_either_sign) {
  for (const double angle : {-6.0, 0.0, 3.0, 20.0}) {
    Profile p;
    p.angle = angle * degree;
    p.burr = 0.0;
    const ShearedFace face = measure_face(p.outline(), rules());
    EXPECT_NEAR(face.fracture_angle, angle * degree, 1e-6);
    EXPECT_NEAR(face.fracture, 0.5, 0.005);
    EXPECT_NEAR(face.burr, 0.0, 1e-12);
  }
}

TEST(ShearedFace, noise_of_a_tenth_of_the_spacing_moves_little) {
  const Profile p;
  const ShearedFace face = measure_face(p.outline(0.01, 0.001), rules(0.03));
  expect_heights(face, p, 0.012);
  EXPECT_NEAR(face.fracture_angle, p.angle, 0.3 * degree);
}

TEST(ShearedFace, tilted_body_has_the_same_heights) {
  const Profile p;
  for (const double tilt : {-4.0, 5.0}) {
    FaceOutline outline = p.outline();
    for (Vec2& x : outline.point)
      x = Vec2(std::cos(tilt * degree) * x.x() - std::sin(tilt * degree) * x.y(),
               std::sin(tilt * degree) * x.x() + std::cos(tilt * degree) * x.y());
    const ShearedFace face = measure_face(outline, rules());
    EXPECT_NEAR(face.tilt, tilt * degree, 1e-9);
    expect_heights(face, p, 0.005);
    EXPECT_NEAR(face.fracture_angle, p.angle, 1e-6);
    FaceRules held = rules();
    held.fixed = true;
    EXPECT_EQ(measure_face(outline, held).tilt, 0.0);
  }
}

// Heights are then off by what the surface departs from a straight edge.
TEST(ShearedFace, bent_surface_is_said) {
  const Profile p;
  for (const double turn : {2.0, 4.0, 8.0, 20.0, -20.0}) { // degrees within a thickness
    const double curvature = turn * degree;
    FaceOutline outline = p.outline();
    for (Vec2& x : outline.point) {
      const double angle = curvature * x.x(), radius = 1.0 / curvature - x.y();
      x = Vec2(radius * std::sin(angle), 1.0 / curvature - radius * std::cos(angle));
    }
    const ShearedFace face = measure_face(outline, rules());
    const std::string said = fmt::format("bent, by {:.0f} degrees within 1e+03 mm", std::abs(turn));
    EXPECT_EQ(face.note.find(said) != std::string::npos, std::abs(turn) > 5.8) << turn << ' ' << face.note;
    if (face.note.empty()) expect_heights(face, p, 0.05);
  }
}

TEST(ShearedFace, no_outline_is_said) {
  const ShearedFace face = measure_face({}, rules());
  EXPECT_FALSE(face.found());
  EXPECT_EQ(face.note, "the body has no outline");
}

// A sheet that bends up beside the punch, whose wall stays upright: 15 degrees from its own normal.
TEST(ShearedFace, wall_along_the_punch_of_a_tilted_sheet_is_burnish) {
  const double slope = std::tan(-15.0 * degree), height = 0.4;
  const std::vector<Vec2> corner{{-3, 3 * -slope - 1.0}, {0, -1.0}, {0, -1.0 + height},
                                 {3, -1.0 + height},     {3, 1.0},  {0, 0.1},
                                 {-3, 3 * -slope + 0.1}};
  const ShearedFace face = measure_face(Profile::divided(corner, {M, M, M, M, M, M, M}, 0.01, 0.0), rules());
  EXPECT_NEAR(face.tilt, -15.0 * degree, 1e-6);
  EXPECT_NEAR(face.rollover, 0.0, 0.006);
  EXPECT_NEAR(face.burnish, height * std::cos(15.0 * degree), 0.01); // along the normal of the sheet
}

// Its far end, which a turned body shows to this side, is no surface of the sheet.
TEST(ShearedFace, far_end_of_a_short_turned_body_does_not_count) {
  FaceOutline outline = Profile().outline();
  for (Vec2& x : outline.point) {
    x.x() = std::max(x.x(), -1.52); // the window of the tilt ends at 1.5
    x = Vec2(std::cos(0.25) * x.x() - std::sin(0.25) * x.y(),
             std::sin(0.25) * x.x() + std::cos(0.25) * x.y());
  }
  const ShearedFace face = measure_face(outline, rules());
  EXPECT_NEAR(face.tilt, 0.25, 1e-9);
  expect_heights(face, Profile(), 0.005);
}

TEST(ShearedFace, burnish_alone_and_fracture_alone) {
  Profile smooth;
  smooth.burnish = 0.85;
  smooth.angle = 0.0;
  smooth.burr = 0.0;
  ShearedFace face = measure_face(smooth.outline(), rules());
  EXPECT_NEAR(face.burnish, 0.85, 0.005);
  EXPECT_EQ(face.fracture, 0.0);
  EXPECT_TRUE(std::isnan(face.fracture_angle));
  Profile brittle;
  brittle.burnish = 0.0;
  brittle.angle = 15.0 * degree;
  face = measure_face(brittle.outline(), rules());
  EXPECT_NEAR(face.rollover, 0.15, 1e-9);
  EXPECT_EQ(face.burnish, 0.0);
  EXPECT_NEAR(face.fracture, 0.85, 1e-9);
  EXPECT_NEAR(face.fracture_angle, 15.0 * degree, 1e-6);
}

TEST(ShearedFace, whole_body_shows_what_the_punch_has_made_so_far) {
  const ShearedFace face = measure_face(notched(0.4, 0.1), rules());
  EXPECT_FALSE(face.parted);
  EXPECT_NEAR(face.rollover, 0.1, 0.006);
  EXPECT_NEAR(face.burnish, 0.3, 0.006);
  EXPECT_EQ(face.fracture, 0.0);
  EXPECT_EQ(face.burr, 0.0);
  EXPECT_EQ(face.note, "not cut through: heights so far");
}

TEST(ShearedFace, crack_counts_down_to_its_tip) {
  const ShearedFace face = measure_face(notched(0.4, 0.1, {{-0.05, 0.6}}), rules());
  EXPECT_FALSE(face.parted);
  EXPECT_NEAR(face.burnish, 0.25, 0.006);
  EXPECT_NEAR(face.fracture, 0.25, 0.006);
  EXPECT_NEAR(face.fracture_angle, std::atan(0.05 / 0.25), 0.5 * degree);
}

TEST(ShearedFace, no_cut_says_so) {
  const std::vector<Vec2> sheet{{-3, 0}, {3, 0}, {3, 1}, {-3, 1}};
  ShearedFace face = measure_face(Profile::divided(sheet, {M, M, M, M}, 0.05, 0.0), rules());
  EXPECT_FALSE(face.found());
  EXPECT_FALSE(face.parted);
  EXPECT_EQ(face.note, "no cut yet: the surface is drawn in by 0% of the thickness");
  const std::vector<Vec2> dent{{-3, 0}, {-0.4, 0}, {0, 0.06}, {3, 0.06}, {3, 1}, {-3, 1}};
  face = measure_face(Profile::divided(dent, {M, M, M, M, M, M}, 0.05, 0.0), rules());
  EXPECT_NEAR(face.rollover, 0.06, 1e-12);
  EXPECT_EQ(face.burnish, 0.0);
  EXPECT_EQ(face.note, "drawn in only: no part of the face is parallel to the cutting direction yet");
}

TEST(ShearedFace, both_faces_of_a_narrow_slug_are_their_own) {
  // faces at u = 0 and u = −1.2: what is measured is the one at 0
  const std::vector<Vec2> corner{{-1.2, 0.3}, {-0.9, 0},    {-0.1, 0},   {0, 0.1},
                                 {0, 0.6},    {-0.04, 1.0}, {-1.1, 1.0}, {-1.2, 0.5}};
  const FaceOutline outline = Profile::divided(corner, {M, M, M, M, F, M, F, M}, 0.01, 0.0);
  FaceRules r = rules();
  r.whole_surface = true;
  const ShearedFace face = measure_face(outline, r);
  EXPECT_NEAR(face.rollover, 0.1, 0.02);
  EXPECT_NEAR(face.fracture, 0.4, 0.02);
}

} // namespace
} // namespace cnem::evaluate
