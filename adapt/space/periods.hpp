#pragma once
// Pieces of a surface that continue each other a period away: what is done to one is done to the other.
#include "adapt/space/working_surface.hpp"
#include "core/geometry/cloud.hpp"

#include <array>
#include <span>
#include <vector>

namespace cnem::adapt {

/// Two pieces of which the second is a shifted copy of the first, node by node.
using Period = std::array<PieceIndex, 2>;

/// Which node is whose image across each period. Several periods may meet in an edge: images have images.
class PeriodImages {
public:
  /// Throws GeometryError as shifted_nodes().
  PeriodImages(const Cloud<3>& cloud, std::span<const Period> periods);

  bool empty() const { return periods_.empty(); }
  /// The image of a node of a piece; none where the piece is of no period.
  NodeIndex image(NodeIndex i, PieceIndex piece) const;
  void pair(NodeIndex on_piece, PieceIndex piece, NodeIndex other);
  /// Nodes that are images of each other, in increasing order.
  std::vector<std::vector<NodeIndex>> groups() const;

private:
  std::vector<Period> periods_;
  std::vector<IndexedVector<NodeIndex, NodeIndex>> other_; ///< [period][node]
};

/// Moves nodes of groups of images, which go the longest of their ways (m, [node]) unless one of them is
/// held. Whether any goes.
bool move_alike(Cloud<3>& cloud, const std::vector<std::vector<NodeIndex>>& groups,
                const IndexedVector<NodeIndex, Vec3>& way, const IndexedVector<NodeIndex, char>& held);

/// Changes of a surface that are made on all images of an edge or on none.
class AlikeEdits {
public:
  using Edge = WorkingSurface::Edge;

  AlikeEdits(WorkingSurface& surface, PeriodImages images) : surface_(&surface), images_(std::move(images)) {}

  /// An edge and its images; it alone where it is on no period, empty where an image is not there.
  std::vector<Edge> edges(Edge e) const;

  struct Split {
    NodeIndex start, end, made;
  };
  /// Splits in the middle.
  std::vector<Split> split(Edge e);
  /// Whether collapse() or flip() does all of these edges, which are images of each other, whatever the
  /// order.
  bool may_collapse(const std::vector<Edge>& all, double spacing, Collapse kind = Collapse::in_shape) const;
  bool may_flip(const std::vector<Edge>& all, double spacing, Flip kind = Flip::in_shape) const;

private:
  template<class Visit> void each_image(Edge e, Visit&& visit) const;

  WorkingSurface* surface_;
  PeriodImages images_;
};

/// Where diagonals differ between two pieces of a period the second takes those of the first, unless the
/// surface would not be a manifold then. O(F log F). Throws GeometryError as shifted_nodes().
void repeat_facets(Cloud<3>& cloud, std::span<const Period> periods);

} // namespace cnem::adapt
