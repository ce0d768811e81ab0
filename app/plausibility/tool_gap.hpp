#pragma once
// How far tools are from the workpiece as it stands at the start, by the nodes of its boundary.
#include "core/geometry/box.hpp"
#include "core/index.hpp"
#include "mechanics/explicit_solver.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <vector>

namespace cnem::app {

/// A unit vector: (0, -1).
template<int dim> std::string show_direction(const Vec<dim>& u) {
  std::string text;
  for (int k = 0; k < dim; ++k) text += fmt::format("{}{:.3g}", k > 0 ? ", " : "", u[k] + 0.0);
  return "(" + text + ")";
}

/// The boundary at the start.
template<int dim> class StartingSurface {
public:
  explicit StartingSurface(const ExplicitSolver<dim>& solver) {
    const Cloud<dim>& cloud = solver.conditions().cloud;
    std::vector<double> spacing(index_of(cloud.nodes()), 0.0);
    for (const Facet<dim>& facet : cloud.facets)
      for (std::size_t a = 0; a < facet.node.size(); ++a) {
        const auto i = index_of(facet.node[a]), j = index_of(facet.node[(a + 1) % facet.node.size()]);
        const double length = (cloud.position[i] - cloud.position[j]).norm();
        for (const auto node : {i, j}) spacing[node] = std::max(spacing[node], length);
      }
    for (std::size_t i = 0; i < spacing.size(); ++i)
      if (spacing[i] > 0.0) {
        place_.push_back(cloud.position[i]);
        spacing_.push_back(spacing[i]);
      }
  }

  struct Gap {
    double distance = std::numeric_limits<double>::infinity(); ///< m, negative inside the tool
    double spacing = 0.0;                                      ///< m, of the node that is nearest
    Vec<dim> at = Vec<dim>::Zero();                            ///< m, where that is
  };
  /// To the boundary node for which distance(place), m, is the least.
  template<class Distance> Gap least(Distance&& distance) const {
    Gap least;
    for (std::size_t i = 0; i < place_.size(); ++i)
      if (const double d = distance(place_[i]); d < least.distance) least = {d, spacing_[i], place_[i]};
    return least;
  }
  /// Between a tool that has moved by `moved` (m) and the nearest node.
  Gap gap(const contact::ToolShape<dim>& shape, const Vec<dim>& moved) const {
    return least([&](const Vec<dim>& x) { return shape.closest(x - moved).distance; });
  }
  /// The boundary node nearest to a place, as a gap.
  Gap nearest(const Vec<dim>& x) const {
    return least([&](const Vec<dim>& place) { return (place - x).norm(); });
  }

  Box<dim> box() const { return box_of<dim>(place_); }
  /// The diagonal of its bounding box, m.
  double size() const {
    const Box<dim> around = box();
    return (around.high - around.low).norm();
  }

private:
  std::vector<Vec<dim>> place_;
  std::vector<double> spacing_; ///< [·] m, the longer facet beside it
};

} // namespace cnem::app
