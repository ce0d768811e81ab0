#pragma once
// Natural elements where the cloud is fine, linear triangles beyond, on the same nodes.
#include "cnem/scni.hpp"

namespace cnem::methods {

/// Whether the longest edge of each triangle is at most `spacing` (m): the zone of natural elements.
IndexedVector<SimplexIndex, bool> natural_zone(const Cloud<2>& cloud,
                                               const voronoi::Triangulation& triangulation, double spacing);

/// C-NEM with two kinds of functions: on the face between two cells Sibson's where a triangle beside it is of
/// the zone, and beyond those of the linear triangles, which have fewer neighbours. Each cell integrates what
/// stands on its faces (Chen, Wu, Yoon, You, Int. J. Numer. Meth. Eng. 50, 2001),
///
///   b_iJ = 1/V_i ∮ φ_J n dΓ,
///
/// and each face gives its two cells the same with either sign: forces balance whichever functions it has,
/// and linear fields are exact because both kinds reproduce them. Stress points stay those of nodes, so that
/// the border may lie elsewhere in each reference and nothing is carried across it. Nodal integration of
/// linear triangles does not lock as `fe-triangles` do.
class Hybrid final : public Discretisation<2> {
public:
  static constexpr Promises promised = scni::Cnem::promised;

  /// zone_spacing: m; 0: triangles everywhere. Throws InputError as scni::Cnem does.
  explicit Hybrid(double zone_spacing = 0.0, int gauss_points = 2, Space space = Space::plane);

  /// Throws GeometryError as scni::Cnem does. Cost O(N log N).
  Approximation<2> rebuild(const Cloud<2>& cloud) override;
  std::string name() const override { return "hybrid"; }
  Promises promises() const override { return promised; }

private:
  double zone_spacing_;
  int gauss_points_;
  Space space_;
};

} // namespace cnem::methods
