#pragma once
// Outlines of bodies whose faces have known heights and angles.
#include "evaluate/sheared_face.hpp"
#include "tests/clouds.hpp"
#include "tests/degree.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace cnem::evaluate {

inline constexpr FaceSurface M = FaceSurface::metal, B = FaceSurface::broken, F = FaceSurface::fracture,
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

inline FaceRules rules(double smoothing = 0.02) {
  return {.thickness = 1.0, .parallel = 10.0 * degree, .smoothing = smoothing, .edge = 0.0, .limit = 0.25};
}

inline void expect_heights(const ShearedFace& face, const Profile& p, double tolerance) {
  EXPECT_NEAR(face.rollover, p.rollover, tolerance);
  EXPECT_NEAR(face.burnish, p.burnish, tolerance);
  EXPECT_NEAR(face.fracture, 1.0 - p.rollover - p.burnish, tolerance);
  EXPECT_NEAR(face.burr, p.burr, tolerance);
  EXPECT_NEAR(face.second_burnish, 0.0, tolerance);
  EXPECT_NEAR(face.rollover + face.burnish + face.fracture + face.second_burnish, 1.0, tolerance);
}

inline FaceOutline reversed(FaceOutline outline) {
  std::reverse(outline.point.begin(), outline.point.end());
  std::reverse(outline.surface.begin(), outline.surface.end());
  std::rotate(outline.surface.begin(), outline.surface.begin() + 1, outline.surface.end());
  return outline;
}

inline double length_of(const ShearedFace& face, Zone zone) {
  double length = 0.0;
  for (std::size_t k = 0; k < face.zone.size(); ++k)
    if (face.zone[k] == zone) length += (face.profile[k + 1] - face.profile[k]).norm();
  return length;
}

/// A whole body with the notch of a punch in it, as deep as `depth`.
inline FaceOutline notched(double depth, double rollover, const std::vector<Vec2>& crack = {}) {
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

} // namespace cnem::evaluate
