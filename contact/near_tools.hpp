#pragma once
// Which parts of the boundary tools may meet soon, so that the others need not be looked at in each step.
#include "contact/surface.hpp"
#include "contact/tool.hpp"
#include "contact/tool_motions.hpp"
#include "core/geometry/box_tree.hpp"

#include <span>
#include <vector>

namespace cnem::contact {

/// Lists for each tool the nodes nearer than a skin (beyond what they stay off its arcs), and what of the
/// surface nearly reaches one of its ridges: in space pairs of ridge and edge, or of point and facet. The
/// lists cover the boundary until a node or a tool has moved by half the skin; they say where to look, never
/// what is found, so that results do not depend on when they were made.
template<int dim> class NearTools {
public:
  /// Forgets the lists: another boundary.
  void clear() { listed_.clear(); }

  /// Lists anew unless the lists cover `position` (m, [boundary node]) with tools at the ends of their poses.
  void look(const Surface<dim>& surface, const Tools<dim>& tools, const Poses<dim>& poses,
            PlacesOnBoundary<dim> position);
  /// The same where no nodes but these have moved since the last look.
  void look(const Surface<dim>& surface, const Tools<dim>& tools, const Poses<dim>& poses,
            PlacesOnBoundary<dim> position, std::span<const BoundaryNodeIndex> moved);

  /// In increasing order. After `look`.
  const std::vector<BoundaryNodeIndex>& nodes(ToolIndex tool) const { return of_tool_[tool].nodes; }
  const std::vector<RidgeCandidate<dim>>& at_ridges(ToolIndex tool) const { return of_tool_[tool].at_ridges; }

  int listings() const { return listings_; }

private:
  struct Near {
    std::vector<BoundaryNodeIndex> nodes;
    std::vector<RidgeCandidate<dim>> at_ridges;
    BoxTree ridges; ///< 3D: of the tool
  };
  void list_at_ridges(const Surface<dim>& surface, const ToolShape<dim>& shape, const Vec<dim>& shift,
                      PlacesOnBoundary<dim> position, Near& near);
  bool tools_covered(const Poses<dim>& poses) const;
  void list(const Surface<dim>& surface, const Tools<dim>& tools, const Poses<dim>& poses,
            PlacesOnBoundary<dim> position);

  IndexedVector<BoundaryNodeIndex, Vec<dim>> listed_; ///< m; empty: no lists yet
  IndexedVector<ToolIndex, Vec<dim>> shift_;          ///< m, of tools when listed
  IndexedVector<ToolIndex, Near> of_tool_;
  double skin_ = 0.0; ///< m
  int listings_ = 0;
};

template<>
void NearTools<2>::list_at_ridges(const Surface<2>&, const ToolShape<2>&, const Vec2&, PlacesOnBoundary<2>,
                                  Near&);
template<>
void NearTools<3>::list_at_ridges(const Surface<3>&, const ToolShape<3>&, const Vec3&, PlacesOnBoundary<3>,
                                  Near&);
extern template class NearTools<2>;
extern template class NearTools<3>;

} // namespace cnem::contact
