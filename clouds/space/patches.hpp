#pragma once
// Surfaces put together from patches, each of which the plane's generator divides.
#include "clouds/space/surface.hpp"

#include <functional>
#include <limits>
#include <span>

namespace cnem::clouds {

/// The radius of curvature of a straight line.
inline constexpr double straight = std::numeric_limits<double>::infinity();

/// Vertices of the surface, by number.
using Polyline = std::vector<std::int32_t>;

/// A way around a patch with the patch on its left; the last vertex is followed by the first.
struct PatchLoop {
  Polyline vertex;
  std::vector<Vec2> place; ///< [vertex] in the plane of the patch

  void add(std::int32_t v, const Vec2& x) {
    vertex.push_back(v);
    place.push_back(x);
  }
};

struct Patch {
  std::vector<PatchLoop> loops; ///< the outer one first
  SpacingField spacing;         ///< in the plane of the patch
  std::function<Vec3(const Vec2&)> on_surface;
  bool turned = false; ///< the plane's left-hand side is out of the body
  PieceIndex piece{};
};

class SurfaceBuilder {
public:
  explicit SurfaceBuilder(const SpaceSpacing& spacing) : spacing_(spacing) {}

  const SpaceSpacing& spacing() const { return spacing_; }
  std::int32_t add(const Vec3& x);
  const Vec3& at(std::int32_t vertex) const { return cloud_.position[index_of(vertex)]; }

  /// The piece of a name, added when it is new.
  PieceIndex piece(const std::string& name);

  /// Fractions of a curve at its nodes, 0 and 1 among them: edges share out ∫ ds/h equally, and are chords of
  /// the given radius of curvature (m, infinite: none) as in generate_cloud.
  std::vector<double> divide(const std::function<Vec3(double)>& curve, double length, double radius,
                             double turn) const;

  /// Nodes and triangles of a patch, but for its loops, whose vertices are there.
  void add_patch(const Patch& patch);

  /// The surface, with the vertices that have triangles.
  Cloud<3> take();

private:
  const SpaceSpacing& spacing_;
  Cloud<3> cloud_;
};

/// What of the spacing a curved edge or face can have, m: h, but chords of at most 20°, or, where these were
/// shorter than 0.6 h, of 0.6 h and at most 45°.
double curved_spacing(double h, double radius);

} // namespace cnem::clouds
