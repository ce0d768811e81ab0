// What of a face is burnish and fracture, and what is neither: broken metal, holes, flakes, the other
// surface.
#include "tests/unit/evaluate/drawn_profile.hpp"

#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace cnem::evaluate {
namespace {

TEST(FaceZones, second_burnish_follows_a_fracture_that_ends_early) {
  // rollover 0.1, burnish 0.3, fracture to 0.8, smooth again to 1
  const std::vector<Vec2> corner{{-3, 0}, {-0.1, 0}, {0, 0.1}, {0, 0.4}, {-0.05, 0.8}, {-0.05, 1.0}, {-3, 1}};
  const FaceOutline outline = Profile::divided(corner, {M, M, M, F, M, M, M}, 0.01, 0.0);
  const ShearedFace face = measure_face(outline, rules());
  EXPECT_NEAR(face.fracture, 0.4, 1e-9);
  EXPECT_NEAR(face.second_burnish, 0.2, 1e-9);
  EXPECT_NEAR(length_of(face, Zone::second_burnish), 0.2, 0.01);
}

TEST(FaceZones, metal_that_is_broken_but_not_open_is_no_burnish) {
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
TEST(FaceZones, the_wall_of_a_hole_in_the_cut_is_neither_burnish_nor_fracture) {
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

TEST(FaceZones, a_body_that_has_turned_is_measured_in_its_own_frame) {
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

TEST(FaceZones, what_cannot_be_measured_has_a_note_and_no_numbers) {
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
TEST(FaceZones, the_other_surface_is_no_second_burnish) {
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

TEST(FaceZones, flakes_beside_the_fracture_are_not_it) {
  Profile p;
  FaceOutline outline = p.outline();
  for (std::size_t k = 0; k < outline.point.size(); ++k) {
    const Vec2& x = outline.point[k];
    if (std::abs(x.x() + 0.5) < 0.02 || (x.x() == 0.0 && std::abs(x.y() - 0.3) < 0.006))
      outline.surface[k] = F;
  }
  expect_heights(measure_face(outline, rules()), p, 0.005);
}

} // namespace
} // namespace cnem::evaluate
