// What is known of a body before it has nodes.
#include "clouds/generate_boundary.hpp"
#include "clouds/space/surface.hpp"
#include "core/error.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace cnem::clouds {

namespace {

/// ∮ r²/2 dz: the volume of the body of revolution per radian.
double volume_per_angle(const Curve& curve) {
  double sum = 0.0;
  for (const CurvePiece& piece : curve.pieces) {
    constexpr int divisions = 2000;
    const int count = piece.is_arc() ? divisions : 1;
    for (int k = 0; k < count; ++k) {
      const Vec2 a = piece.point(static_cast<double>(k) / count),
                 b = piece.point(static_cast<double>(k + 1) / count);
      sum += (a.x() * a.x() + a.x() * b.x() + b.x() * b.x()) * (b.y() - a.y()) / 6.0;
    }
  }
  return sum;
}

double soup_volume(const FacetSoup& soup) {
  double sum = 0.0;
  for (const FacetSoup::Triangle& t : soup.triangles) sum += t.corner[0].cross(t.corner[1]).dot(t.corner[2]);
  return sum / 6.0;
}

template<class... F> struct Overload : F... { using F::operator()...; };
template<class... F> Overload(F...) -> Overload<F...>;

} // namespace

Cloud<3> surface_of(const SpaceDomain& domain, const SpaceSpacing& spacing) {
  return std::visit(Overload{[&](const Extrusion& shape) { return extruded_surface(shape, spacing); },
                             [&](const Revolution& shape) { return revolved_surface(shape, spacing); },
                             [&](const Faceted& shape) { return remeshed_surface(shape, spacing); }},
                    domain);
}

double domain_volume(const SpaceDomain& domain) {
  return std::visit(Overload{[](const Extrusion& shape) {
                               double area = std::abs(shape.outline.outer.area());
                               for (const Curve& hole : shape.outline.holes) area -= std::abs(hole.area());
                               return area * (shape.to - shape.from);
                             },
                             [](const Revolution& shape) {
                               double volume = std::abs(volume_per_angle(shape.profile.outer));
                               for (const Curve& hole : shape.profile.holes)
                                 volume -= std::abs(volume_per_angle(hole));
                               return volume * shape.angle;
                             },
                             [](const Faceted& shape) { return soup_volume(shape.soup); }},
                    domain);
}

double domain_size(const SpaceDomain& domain) {
  return std::visit(Overload{[](const Extrusion& shape) {
                               return std::hypot(domain_size(shape.outline), shape.to - shape.from);
                             },
                             [](const Revolution& shape) { return 2.0 * domain_size(shape.profile); },
                             [](const Faceted& shape) {
                               if (shape.soup.triangles.empty())
                                 throw GeometryError("a surface without facets");
                               Vec3 low = shape.soup.triangles.front().corner[0], high = low;
                               for (const FacetSoup::Triangle& t : shape.soup.triangles)
                                 for (const Vec3& x : t.corner) {
                                   low = low.cwiseMin(x);
                                   high = high.cwiseMax(x);
                                 }
                               return (high - low).norm();
                             }},
                    domain);
}

} // namespace cnem::clouds
