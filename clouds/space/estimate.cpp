#include "clouds/space/facet_tree.hpp"
#include "clouds/space/generate.hpp"
#include "clouds/space/surface.hpp"
#include "core/geometry/facets.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::clouds {

namespace {

// Nodes a volume of the body-centred lattice, and what a surface adds to them an area: measured on plane and
// round bodies of 5 to 40 spacings.
constexpr double density = 1.3, by_surface = 0.5;

/// Sums ∫ h⁻³ over the part of a cube inside the surface, by quadrature on an octree.
class Count {
public:
  Count(const FacetTree& tree, const SpaceSpacing& spacing, double coarsest, double limit)
      : tree_(tree), spacing_(spacing), coarsest_(coarsest), limit_(limit) {}

  double sum = 0.0;

  void add(const Vec3& middle, double side, bool cut) {
    if (sum > limit_) return;
    const double reach = 0.5 * std::sqrt(3.0) * side;
    if (cut) {
      const double away = tree_.nearest(middle, std::numeric_limits<double>::max()).distance;
      if (away < -reach) return;
      cut = away < reach;
      if (cut && side < coarsest_ / 4.0) {
        if (away > 0.0) count(middle, side);
        return;
      }
    }
    const double h = spacing_.at(middle);
    const bool even = spacing_.growth() * reach < 0.2 * h || (h >= spacing_.spacing && free(middle, reach));
    if (!cut && even) return count(middle, side);
    for (const double dx : {-0.25, 0.25})
      for (const double dy : {-0.25, 0.25})
        for (const double dz : {-0.25, 0.25}) add(middle + side * Vec3(dx, dy, dz), 0.5 * side, cut);
  }

private:
  void count(const Vec3& middle, double side) { sum += density * std::pow(side / spacing_.at(middle), 3); }

  /// No refinement reaches the cube.
  bool free(const Vec3& middle, double reach) const {
    return std::ranges::none_of(spacing_.refinements, [&](const SpaceRefinement& r) {
      return r.spacing + r.growth * (r.distance(middle) - reach) < spacing_.spacing;
    });
  }

  const FacetTree& tree_;
  const SpaceSpacing& spacing_;
  double coarsest_, limit_;
};

/// ∫ h⁻² over a triangle.
double edges_on(const std::array<Vec3, 3>& x, const SpaceSpacing& spacing, int depth = 0) {
  const Vec3 middle = (x[0] + x[1] + x[2]) / 3.0;
  const double h = spacing.at(middle);
  const double size = std::sqrt(2.0 * area_normal<3>(x).norm());
  if (spacing.uniform() || spacing.growth() * size < 0.3 * h || depth > 12)
    return area_normal<3>(x).norm() / (h * h);
  const std::array<Vec3, 3> m{0.5 * (x[1] + x[2]), 0.5 * (x[2] + x[0]), 0.5 * (x[0] + x[1])};
  return edges_on({x[0], m[2], m[1]}, spacing, depth + 1) + edges_on({x[1], m[0], m[2]}, spacing, depth + 1) +
         edges_on({x[2], m[1], m[0]}, spacing, depth + 1) + edges_on(m, spacing, depth + 1);
}

} // namespace

double estimate_nodes(const SpaceDomain& domain, const SpaceSpacing& spacing, double limit) {
  spacing.check();
  const double size = domain_size(domain);
  const Cloud<3> surface = surface_of(domain, {std::clamp(spacing.spacing, size / 30.0, size), {}});
  double nodes = 0.0;
  for (const Facet<3>& facet : surface.facets)
    nodes += by_surface * edges_on(corners_of(facet, surface.position), spacing);
  if (spacing.uniform()) return nodes + density * enclosed_measure(surface) / std::pow(spacing.spacing, 3);
  Vec3 low = surface.position[0], high = low;
  for (const Vec3& x : surface.position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double side = (high - low).maxCoeff();
  const FacetTree tree(surface);
  Count count(tree, spacing, side / 16.0, 1.1 * limit);
  count.add(0.5 * (low + high), side, true);
  return nodes + count.sum;
}

} // namespace cnem::clouds
