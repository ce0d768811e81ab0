#pragma once
// A square with a central crack, and its tips.
#include "clouds/generate.hpp"
#include "cnem/scni.hpp"
#include "fracture/crack_tip.hpp"
#include "tests/curves.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace cnem::testing {

/// The square [−1, 1]² with sides named "side".
inline clouds::DomainShape square_shape() {
  clouds::DomainShape shape;
  shape.outer = box({-1, -1}, {1, 1}, "side");
  return shape;
}

struct CrackedSquare {
  Cloud<2> cloud;
  std::vector<fracture::CrackTip> tips; ///< "first", "last"
  Approximation<2> approximation;
};

/// Crack of half-length 0.3 about the origin at `angle` from x.
inline CrackedSquare cracked_square(double spacing, double angle) {
  clouds::DomainShape shape = square_shape();
  const Vec2 tip(0.3 * std::cos(angle), 0.3 * std::sin(angle));
  shape.cracks.push_back({"crack", {-tip, tip}});
  CrackedSquare result;
  result.cloud = clouds::generate_cloud(shape, {spacing, {}}, {}).cloud;
  result.tips = fracture::find_tips(result.cloud, {{"crack", {-tip, tip}, {"first", "last"}}});
  result.approximation = scni::Cnem().rebuild(result.cloud);
  return result;
}

} // namespace cnem::testing
