#pragma once
// Tips of the cracks of a cloud, each with its own frame.
#include "core/cloud.hpp"
#include "core/vec.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cnem::fracture {

/// The path of a crack as a case gives it: its faces are the boundary pieces NAME+ (material on the left of
/// the path) and NAME-.
struct CrackPath {
  std::string name;
  std::vector<Vec2> points;             ///< m, at least two
  std::array<std::string, 2> tip_names; ///< of the first and the last point
};

/// A tip inside the material. Its frame has x along `direction`; θ = ±π are the faces.
struct CrackTip {
  std::string name;
  std::string crack; ///< name of the crack it belongs to
  std::int32_t node = -1;
  Vec2 position{0, 0};           ///< m
  Vec2 direction{1, 0};          ///< unit vector, tangent to the crack and away from it
  double half_length = 0.0;      ///< m, a: half the length of a crack with two tips, the whole of an open one
  double straight = 0.0;         ///< m, length of the straight piece that ends here
  double clearance = 0.0;        ///< m, to the nearest boundary that is not this crack
  double spacing = 0.0;          ///< m, mean distance to the neighbours on the crack
  std::vector<std::int8_t> face; ///< [node] +1, −1: on the face θ = +π, −π; 0 elsewhere

  /// Position in the frame of the tip.
  Vec2 local(const Vec2& x) const {
    const Vec2 d = x - position;
    return {d.dot(direction), cross(direction, d)};
  }
  /// Polar angle of a point of the domain; nodes on the faces need angle_of_node.
  double angle(const Vec2& x) const;
  double angle_of_node(std::int32_t i, const Vec2& x) const;
};

/// The tips of the cracks, in the order of the cracks, first point before last. Ends on the boundary are
/// mouths, not tips. Throws GeometryError when the cloud has no node at a tip.
std::vector<CrackTip> find_tips(const Cloud<2>& cloud, const std::vector<CrackPath>& cracks);

/// Names of two tips from where they are: "left" and "right", for vertical cracks "bottom" and "top".
std::array<std::string, 2> tip_names(const Vec2& first, const Vec2& last);

} // namespace cnem::fracture
