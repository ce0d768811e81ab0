#pragma once
// How many nodes a cloud has once it is as fine as adaptation wants it: beside tools, and in bands that flow.
#include "adapt/marking.hpp"
#include "input/case.hpp"

#include <optional>
#include <vector>

namespace cnem::app {

/// A straight band through the workpiece in which cells are of one spacing; beside it they grow.
struct Band {
  Vec2 at{0, 0};                        ///< m, in the middle of it
  Vec2 across{1, 0};                    ///< unit vector
  double width = 0.0;                   ///< m
  double spacing = 0.0;                 ///< m, in it
  double least = 0.0;                   ///< m, of a few cells in it
  double distance(const Vec2& x) const; ///< m, from x to the band; 0 inside
};

class WantedNodes {
public:
  WantedNodes(const input::Case& input, const Cloud<2>& cloud, const adapt::Structure& structure);

  /// Nodes beyond those there are, which cells wanted finer than they are take: beside corners and arcs of
  /// tools as they stand (`adapt.tool_spacing`), and in and beside the bands.
  double added(const std::vector<Band>& bands) const;

  /// Of the cloud as it is, m: of the node nearest to x.
  double spacing_at(const Vec2& x) const;

private:
  double tool_limit(const Vec2& x) const;

  const input::Adaptation* rules_;
  const Cloud<2>* cloud_;
  const adapt::Structure* structure_;
  Field spacing_;          ///< [node] m
  std::vector<Vec2> tips_; ///< m, of all tools
};

} // namespace cnem::app
