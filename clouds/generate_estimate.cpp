#include "clouds/generate_boundary.hpp"
#include "voronoi/plane/edge_tree.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::clouds {

namespace {

/// Sums ∫ (1/h² − 1/h0²) over the part of a square inside the domain by quadrature on a quadtree.
class Surplus {
public:
  Surplus(const voronoi::EdgeTree& tree, const SpacingField& spacing, double coarsest, double limit)
      : tree_(tree), spacing_(spacing), coarsest_(coarsest), limit_(limit), growth_(spacing.growth()) {}

  double sum = 0.0;

  void add(const Vec2& middle, double side) {
    const double h = spacing_.at(middle), variation = growth_ * side * std::sqrt(0.5);
    if (sum > limit_ || (h >= spacing_.spacing && tree_free(middle, side))) return;
    const auto count = [&](const Vec2& x, double area) {
      const double hx = spacing_.at(x);
      if (tree_.inside(x)) sum += area * (1.0 / (hx * hx) - 1.0 / (spacing_.spacing * spacing_.spacing));
    };
    const bool leaf = side <= coarsest_ && variation < 0.35 * h;
    if (leaf && side < coarsest_ / 4.0) return count(middle, side * side);
    for (const double dx : {-0.25, 0.25})
      for (const double dy : {-0.25, 0.25}) {
        const Vec2 quarter = middle + side * Vec2(dx, dy);
        if (leaf)
          count(quarter, 0.25 * side * side);
        else
          add(quarter, 0.5 * side);
      }
  }

private:
  /// No refinement reaches the square.
  bool tree_free(const Vec2& middle, double side) const {
    return std::ranges::none_of(spacing_.refinements, [&](const Refinement& r) {
      return r.spacing + r.growth * (r.distance(middle) - side * std::sqrt(0.5)) < spacing_.spacing;
    });
  }

  const voronoi::EdgeTree& tree_;
  const SpacingField& spacing_;
  double coarsest_, limit_;
  double growth_;
};

} // namespace

double estimate_nodes(const DomainShape& domain, const SpacingField& spacing, const CloudOptions& options) {
  if (options.pattern == Pattern::list) return static_cast<double>(options.nodes.size());
  spacing.check();
  const DomainShape shape = checked_and_oriented(domain);
  double area = shape.outer.area(), perimeter = shape.outer.length();
  for (const Curve& hole : shape.holes) {
    area += hole.area();
    perimeter += hole.length();
  }
  const double density = options.pattern == Pattern::regular ? 1.0 : 2.0 / std::sqrt(3.0);
  const double h0 = spacing.spacing;
  const double uniform = density * area / (h0 * h0) + 0.5 * perimeter / h0 + 1.0;
  if (spacing.uniform() || uniform > options.nodes_limit) return uniform;

  const double size = domain_size(shape);
  const Cloud<2> outline =
      assemble_boundary(discretise_boundary({shape.outer, shape.holes, {}}, SpacingField{size / 100.0, {}}));
  Vec2 low = outline.position[0], high = low;
  for (const Vec2& x : outline.position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double side = (high - low).maxCoeff();
  const voronoi::EdgeTree tree(outline);
  Surplus surplus(tree, spacing, side / 64.0, 1.1 * options.nodes_limit / density);
  surplus.add(0.5 * (low + high), side);
  double boundary = 0.0; // what refinement adds to the nodes along the boundary, half of each in the area
  for (const Facet<2>& f : outline.facets) {
    const Vec2 a = outline.position[std::size_t(f.node[0])], b = outline.position[std::size_t(f.node[1])];
    for (const double s : {0.125, 0.375, 0.625, 0.875})
      boundary += 0.5 * 0.25 * (b - a).norm() * (1.0 / spacing.at(a + s * (b - a)) - 1.0 / h0);
  }
  return uniform + density * surplus.sum + boundary;
}

} // namespace cnem::clouds
