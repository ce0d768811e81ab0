// Sheared faces with known heights and angles.
#include "evaluate/sheared_face.hpp"

#include "tests/clouds.hpp"
#include "tests/unit/evaluate/degree.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace cnem::evaluate {
namespace {

constexpr FaceSurface M = FaceSurface::metal, B = FaceSurface::broken, F = FaceSurface::fracture,
                      O = FaceSurface::other;

/// A body of unit thickness, 3 wide, whose face is at u = 0. Corners of its outline, counter-clockwise in u,
/// w.
struct Profile {
  double rollover = 0.15, width = 0.2, burnish = 0.35, angle = 8.0 * degree, burr = 0.04;
  bool round = false; ///< the rollover is a quarter of a circle of radius `rollover`
  double thickness = 1.0;

  FaceOutline outline(double spacing = 0.01, double noise = 0.0) const {
    std::vector<Vec2> corner{{-3.0, 0.0}};
    std::vector<FaceSurface> surface{M};
    const auto add = [&](const Vec2& x, FaceSurface after) {
      corner.push_back(x);
      surface.push_back(after);
    };
    if (round)
      for (int k = 0; k <= 90; ++k)
        add({-rollover + rollover * std::sin(k * degree), rollover - rollover * std::cos(k * degree)}, M);
    else {
      add({-width, 0.0}, M);
      add({0.0, rollover}, M);
    }
    const double begin = rollover + burnish, end = thickness + burr;
    if (begin < thickness) add({0.0, begin}, F);
    const double foot = -std::tan(angle) * (end - begin);
    add({foot, end}, M);
    if (burr > 0.0) add({foot - 1.5 * burr, thickness}, M);
    add({-3.0, thickness}, M);
    return divided(corner, surface, spacing, noise);
  }

  static FaceOutline divided(const std::vector<Vec2>& corner, const std::vector<FaceSurface>& surface,
                             double spacing, double noise) {
    testing::Random random(3);
    FaceOutline outline;
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const Vec2 a = corner[k], b = corner[(k + 1) % corner.size()];
      const int pieces = std::max(1, static_cast<int>(std::ceil((b - a).norm() / spacing)));
      for (int i = 0; i < pieces; ++i) {
        outline.point.push_back(a + (b - a) * (i / double(pieces)) +
                                noise * Vec2(random.uniform(-1, 1), random.uniform(-1, 1)));
        outline.surface.push_back(surface[k]);
      }
    }
    return outline;
  }
};

FaceRules rules(double smoothing = 0.02) {
  return {.thickness = 1.0, .parallel = 10.0 * degree, .smoothing = smoothing, .edge = 0.0, .limit = 0.25};
}

void expect_heights(const ShearedFace& face, const Profile& p, double tolerance) {
  EXPECT_NEAR(face.rollover, p.rollover, tolerance);
  EXPECT_NEAR(face.burnish, p.burnish, tolerance);
  EXPECT_NEAR(face.fracture, 1.0 - p.rollover - p.burnish, tolerance);
  EXPECT_NEAR(face.burr, p.burr, tolerance);
  EXPECT_NEAR(face.second_burnish, 0.0, tolerance);
  EXPECT_NEAR(face.rollover + face.burnish + face.fracture + face.second_burnish, 1.0, tolerance);
}

FaceOutline reversed(FaceOutline outline) {
  std::reverse(outline.point.begin(), outline.point.end());
  std::reverse(outline.surface.begin(), outline.surface.end());
  std::rotate(outline.surface.begin(), outline.surface.begin() + 1, outline.surface.end());
  return outline;
}

double length_of(const ShearedFace& face, Zone zone) {
  double length = 0.0;
  for (std::size_t k = 0; k < face.zone.size(); ++k)
    if (face.zone[k] == zone) length += (face.profile[k + 1] - face.profile[k]).norm();
  return length;
}

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

TEST(ShearedFace, second_burnish_follows_a_fracture_that_ends_early) {
  // rollover 0.1, burnish 0.3, fracture to 0.8, smooth again to 1
  const std::vector<Vec2> corner{{-3, 0}, {-0.1, 0}, {0, 0.1}, {0, 0.4}, {-0.05, 0.8}, {-0.05, 1.0}, {-3, 1}};
  const FaceOutline outline = Profile::divided(corner, {M, M, M, F, M, M, M}, 0.01, 0.0);
  const ShearedFace face = measure_face(outline, rules());
  EXPECT_NEAR(face.fracture, 0.4, 1e-9);
  EXPECT_NEAR(face.second_burnish, 0.2, 1e-9);
  EXPECT_NEAR(length_of(face, Zone::second_burnish), 0.2, 0.01);
}

TEST(ShearedFace, metal_that_is_broken_but_not_open_is_no_burnish) {
  // rollover 0.1, smooth to 0.3, broken to 0.45, smooth to 0.5, fracture to 0.8, then broken to 0.9
  const std::vector<Vec2> corner{{-3, 0},  {-0.1, 0},    {0, 0.1},     {0, 0.3},     {0, 0.45},
                                 {0, 0.5}, {-0.05, 0.8}, {-0.05, 0.9}, {-0.05, 1.0}, {-3, 1}};
  const ShearedFace face =
      measure_face(Profile::divided(corner, {M, M, M, B, M, F, B, M, M, M}, 0.01, 0.0), rules());
  EXPECT_NEAR(face.broken, 0.15 + 0.1, 1e-6);
  EXPECT_NEAR(face.burnish, 0.2 + 0.05, 0.005);
  EXPECT_NEAR(face.fracture, 0.3, 1e-9);
  EXPECT_NEAR(face.second_burnish, 0.1, 1e-9);
  EXPECT_NEAR(face.rollover + face.burnish + face.broken + face.fracture + face.second_burnish, 1.0, 1e-9);
  EXPECT_NEAR(length_of(face, Zone::broken), 0.25, 1e-9);
  EXPECT_TRUE(face.found());
}

// A hole of 0.3 on the line of the cut: above it smooth and fractured metal, below it fracture and a burr.
TEST(ShearedFace, the_wall_of_a_hole_in_the_cut_is_neither_burnish_nor_fracture) {
  std::vector<Vec2> corner{{-3, 0}, {-0.1, 0}, {0, 0.1}, {0, 0.3}};
  std::vector<FaceSurface> surface{M, M, M, F};
  for (int k = 0; k <= 18; ++k) {
    corner.emplace_back(-0.15 * std::sin(10.0 * k * degree), 0.5 - 0.15 * std::cos(10.0 * k * degree));
    surface.push_back(k < 18 ? O : F);
  }
  for (const Vec2& x : {Vec2(0, 1.04), Vec2(-0.06, 1.0), Vec2(-3, 1)}) {
    corner.push_back(x);
    surface.push_back(M);
  }
  const ShearedFace face = measure_face(Profile::divided(corner, surface, 0.01, 0.0), rules());
  EXPECT_NEAR(face.hole, 0.3, 1e-9);
  EXPECT_NEAR(face.rollover, 0.1, 0.005);
  EXPECT_NEAR(face.burnish, 0.2, 0.005);
  EXPECT_NEAR(face.fracture, 0.4, 1e-9);
  EXPECT_NEAR(face.burr, 0.04, 1e-9);
  EXPECT_EQ(face.second_burnish, 0.0);
  EXPECT_EQ(face.note, "a hole lies in the face: 30% of the thickness are its wall");
  EXPECT_NEAR(length_of(face, Zone::hole), 0.15 * 180.0 * degree, 0.01);
  // Where nothing is fractured its wall is not the burnish either.
  for (FaceSurface& one : surface)
    if (one == F) one = M;
  const ShearedFace smooth = measure_face(Profile::divided(corner, surface, 0.01, 0.0), rules());
  EXPECT_NEAR(smooth.hole, 0.3, 1e-9);
  EXPECT_NEAR(smooth.burnish + smooth.second_burnish, 0.6, 0.005);
}

TEST(ShearedFace, a_body_that_has_turned_is_measured_in_its_own_frame) {
  const Profile p;
  for (const double turn : {60.0, -60.0, 40.0, 135.0, 180.0}) {
    SCOPED_TRACE(turn);
    FaceOutline outline = p.outline();
    for (Vec2& x : outline.point)
      x = Vec2(std::cos(turn * degree) * x.x() - std::sin(turn * degree) * x.y(),
               std::sin(turn * degree) * x.x() + std::cos(turn * degree) * x.y());
    FaceRules known = rules();
    known.turn = (turn + 3.0) * degree; // the surface says the rest
    known.limit = std::numeric_limits<double>::infinity();
    const ShearedFace face = measure_face(outline, known);
    EXPECT_TRUE(face.measured);
    expect_heights(face, p, 0.005);
    EXPECT_NEAR(face.tilt, turn * degree, 1e-6);
    EXPECT_NEAR(face.fracture_angle, p.angle, 1e-6);
    EXPECT_EQ(face.note, "");
  }
}

TEST(ShearedFace, what_cannot_be_measured_has_a_note_and_no_numbers) {
  const Profile p;
  FaceOutline turned = p.outline();
  for (Vec2& x : turned.point)
    x = Vec2(0.5 * x.x() - std::sqrt(0.75) * x.y(), std::sqrt(0.75) * x.x() + 0.5 * x.y());
  FaceRules unknown = rules(); // nobody says that it has turned
  unknown.limit = std::numeric_limits<double>::infinity();
  FaceRules whole = rules();
  whole.turn = 60.0 * degree;
  whole.limit = -2.0; // the outline goes on
  for (const FaceRules& r : {unknown, whole}) {
    const ShearedFace face = measure_face(turned, r);
    EXPECT_FALSE(face.measured);
    EXPECT_FALSE(face.found());
    EXPECT_TRUE(face.note.starts_with("cannot be measured: ")) << face.note;
    EXPECT_TRUE(face.profile.empty());
    EXPECT_EQ(face.rollover + face.burnish + face.fracture + face.burr, 0.0);
  }
}

// Its deepest point may be anywhere along the other surface, which is level but for rounding.
TEST(ShearedFace, the_other_surface_is_no_second_burnish) {
  Profile p;
  p.burr = 0.0;
  FaceOutline outline = p.outline();
  for (Vec2& x : outline.point)
    if (x.y() == 1.0) x.y() += 1e-4 * std::exp(-10.0 * (x.x() + 0.4) * (x.x() + 0.4));
  const ShearedFace face = measure_face(outline, rules());
  EXPECT_LT(length_of(face, Zone::second_burnish), 0.02);
  EXPECT_GT(length_of(face, Zone::burr_side), 0.8);
  expect_heights(face, p, 0.005);
}

TEST(ShearedFace, flakes_beside_the_fracture_are_not_it) {
  Profile p;
  FaceOutline outline = p.outline();
  for (std::size_t k = 0; k < outline.point.size(); ++k) {
    const Vec2& x = outline.point[k];
    if (std::abs(x.x() + 0.5) < 0.02 || (x.x() == 0.0 && std::abs(x.y() - 0.3) < 0.006))
      outline.surface[k] = F;
  }
  expect_heights(measure_face(outline, rules()), p, 0.005);
}

/// A whole body with the notch of a punch in it, as deep as `depth`.
FaceOutline notched(double depth, double rollover, const std::vector<Vec2>& crack = {}) {
  std::vector<Vec2> corner{{-3, 0}, {-0.3, 0}, {0, rollover}};
  std::vector<FaceSurface> surface{M, M, M};
  if (!crack.empty()) {
    corner.push_back({0, depth - 0.05});
    surface.push_back(F);
    for (const Vec2& x : crack) {
      corner.push_back(x);
      surface.push_back(F);
    }
    corner.push_back({1e-4, depth - 0.049}); // the other face of the crack
    surface.push_back(M);
  }
  corner.insert(corner.end(),
                {{0, depth}, {3, depth}, {3, 1 + depth}, {0.1, 1 + depth}, {-0.02, 1}, {-3, 1}});
  surface.resize(corner.size(), M);
  return Profile::divided(corner, surface, 0.01, 0.0);
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
