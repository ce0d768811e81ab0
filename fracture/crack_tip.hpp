#pragma once
// Tips of the cracks of a cloud, each with its own frame.
#include "core/geometry/cloud.hpp"
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
  NodeIndex node = NodeIndex::none;
  Vec2 position{0, 0};      ///< m
  Vec2 direction{1, 0};     ///< unit vector, tangent to the crack and away from it
  double half_length = 0.0; ///< m, a: half the length of a crack with two tips, the whole of an open one
  double straight = 0.0;    ///< m, length of the straight piece that ends here
  double clearance = 0.0;   ///< m, to the nearest boundary that is not this crack
  double spacing = 0.0;     ///< m, mean distance to the neighbours on the crack
  IndexedVector<NodeIndex, std::int8_t> face; ///< +1, −1: on the face θ = +π, −π; 0 elsewhere

  /// Position in the frame of the tip.
  Vec2 local(const Vec2& x) const {
    const Vec2 d = x - position;
    return {d.dot(direction), cross(direction, d)};
  }
  /// Polar angle of a point of the domain; nodes on the faces need angle_of_node.
  double angle(const Vec2& x) const;
  double angle_of_node(NodeIndex i, const Vec2& x) const;
};

/// A traction on a boundary facet, uniform along it.
struct FacetLoad {
  std::array<NodeIndex, 2> node;
  Vec2 from{0, 0}, to{0, 0}; ///< m, of these nodes; material on the left
  Vec2 traction{0, 0};       ///< Pa
};

/// A point of a facet to integrate at.
struct FacetPoint {
  double s = 0.0;              ///< along the facet, from `from` (0) to `to` (1)
  double weight = 0.0;         ///< m
  Vec2 position{0, 0};         ///< m
  double r = 0.0, theta = 0.0; ///< in the frame of the tip, on the side of the material
};

/// Gauss points on a facet seen from a tip; the substitution s = ξ² from the nearer end takes out the root
/// singularity of a facet that ends at the tip.
std::array<FacetPoint, 4> facet_points(const CrackTip& tip, const FacetLoad& facet);

/// The tips of the cracks, in the order of the cracks, first point before last. Ends on the boundary are
/// mouths, not tips. Throws GeometryError when the cloud has no node at a tip.
std::vector<CrackTip> find_tips(const Cloud<2>& cloud, const std::vector<CrackPath>& cracks);

/// Names of two tips from where they are: "left" and "right", for vertical cracks "bottom" and "top".
std::array<std::string, 2> tip_names(const Vec2& first, const Vec2& last);

} // namespace cnem::fracture
