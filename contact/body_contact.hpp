#pragma once
// Where the boundary of the workpiece touches itself or another body of the cloud: nodes against facets.
#include "contact/bonds.hpp"
#include "contact/images.hpp"
#include "contact/surface.hpp"
#include "contact/tool.hpp"
#include "core/fields/archive.hpp"
#include "core/geometry/box_tree.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace cnem::contact {

/// Contact between deformable boundaries; off unless a case asks for it.
struct BodyContactLaw {
  bool active = false;
  Friction friction;
  double conductance = 0.0; ///< W/(m² K), across faces that touch; 0 insulates
};

/// A node that has gone through a facet of the workpiece.
template<int dim> struct FacetHit {
  BoundaryNodeIndex node{};
  FacetIndex facet{};
  std::array<double, dim> weight{};   ///< of the facet's nodes
  Vec<dim> normal = Vec<dim>::Zero(); ///< out of the facet's body
  double start = 0.0;     ///< m, gap less clearance at the start of the step where that was < 0, else 0
  double clearance = 0.0; ///< m, gap that is kept so that boundaries that touch never cross by rounding
  Vec<dim> shift = Vec<dim>::Zero(); ///< m, of the facet: what is hit is this image of it
};

/// Two edges of a surface in space.
struct EdgePair {
  SurfaceEdgeIndex one{}, other{};
  Vec3 shift{0, 0, 0};   ///< m, of the other: this image of it
  bool overlaps = false; ///< they were within each other's bodies when they were listed
};

/// Edges that have gone through each other.
struct EdgeHit {
  EdgePair pair;
  std::array<double, 2> weight_one{}, weight_other{}; ///< of their ends
  Vec3 normal{0, 0, 0};                               ///< out of the body of the other
  double start = 0.0, clearance = 0.0;                ///< m, as of FacetHit
};

/// Lists pairs of node and facet that are near each other (a bounding-volume tree over the facets) and looks
/// at those alone until boundary nodes have moved by half a skin. Nodes are never paired with facets that end
/// at them, nor, seen through the body, with facets of its far side: of pairs whose node lies behind the
/// facet only those stay between whose ends two bodies overlap (winding number 2), or nothing is (0) where
/// the node may yet come round a corner onto the facet.
///
/// In space a boundary may go on at its images. Then nodes and edges meet those too, by as many periods as
/// the boundary has come beside itself. A pair and its image a period away may both be found; what they push
/// is tied, and contact/tied_contacts.cpp makes one of them.
template<int dim> class BodyContact {
public:
  /// Of all boundaries to come.
  void repeat(Repetition<dim> repetition) { repetition_ = std::move(repetition); }

  /// Takes a boundary. group, ≥ 0: nodes that are tied have the same number; facets
  /// between tied nodes are no surface. Empty: none is tied.
  void set_boundary(const Surface<dim>& surface, IndexedSpan<NodeIndex, const std::int32_t> group);

  /// Faces that are bonded to each other: a bonded node does not meet the other face of its interface about
  /// where it is bonded, and where a bond broke, what had pressed it stays. Until the next boundary, or
  /// bonds.
  void set_bonds(const Bonds& bonds) {
    bonds_ = bonds;
    listed_.clear();
  }

  /// Lists pairs anew where the list does not cover nodes at `end` any more; start, end [boundary node], m.
  void look(const Surface<dim>& surface, PlacesOnBoundary<dim> start, PlacesOnBoundary<dim> end);

  /// Appends the hits of a step that goes start → end, in the order of nodes and facets. A node counts when
  /// it crossed a facet that faces it; one that was inside already counts for the facet it is least deep
  /// under. After `look`.
  void find(const Surface<dim>& surface, PlacesOnBoundary<dim> start, PlacesOnBoundary<dim> end,
            std::vector<FacetHit<dim>>& hits) const;

  /// Appends for each node the facet that it is nearest to of those whose gap is at most `closed` times their
  /// size, with its weights and normal. After `look`.
  void find_closed(const Surface<dim>& surface, PlacesOnBoundary<dim> position, double closed,
                   std::vector<FacetHit<dim>>& hits) const;

  /// In space: as `find`, of edges that crossed between their nodes, in the order of the edges.
  void find_edges(const Surface<dim>& surface, PlacesOnBoundary<dim> start, PlacesOnBoundary<dim> end,
                  std::vector<EdgeHit>& hits) const; // only in space

  double size() const { return size_; } ///< m, extent of the boundary as listed: the scale of rounding
  int listings() const { return listings_; }

  /// Carries out or in where nodes stood when pairs were listed and narrowed, on the same boundary.
  void archive(Archive& archive, const Surface<dim>& surface);

private:
  struct Pair {
    BoundaryNodeIndex node;
    FacetIndex facet;
    Vec<dim> shift; ///< m, of the facet
  };
  static constexpr double none = std::numeric_limits<double>::infinity();
  /// Appends for each node the hit of its pair with the least |gap|, less than the skin. look(pair, hit): m,
  /// the gap, having set the hit; `none` where it is no hit.
  template<class Look> void append_nearest(Look&& look, std::vector<FacetHit<dim>>& hits) const {
    for (std::size_t first = 0; first < pairs_.size();) {
      const BoundaryNodeIndex node = pairs_[first].node;
      FacetHit<dim> nearest, hit;
      double least = skin_;
      for (; first < pairs_.size() && pairs_[first].node == node; ++first)
        if (const double off = std::abs(look(pairs_[first], hit)); off < least) {
          least = off;
          nearest = hit;
        }
      if (least < skin_) hits.push_back(nearest);
    }
  }
  void list(const Surface<dim>& surface);
  void list_edges(const Surface<dim>& surface, const BoxTree& facets,
                  std::span<const Vec3> shifts); // in space
  /// Of the pairs of edges those that are nearer than a fraction of the skin, until nodes have moved by half
  /// of that less the way of a step: of a flat surface edges are listed that never meet.
  void narrow(const Surface<dim>& surface); // in space
  bool same(BoundaryNodeIndex one, BoundaryNodeIndex other, const Vec<dim>& shift) const;
  bool related(const Surface<dim>& surface, BoundaryNodeIndex node, FacetIndex facet,
               const Vec<dim>& shift) const;
  bool tied(const Surface<dim>& surface, FacetIndex facet) const;

  Repetition<dim> repetition_;
  IndexedVector<FacetIndex, char> side_;                 ///< of a period: no surface; empty: nothing repeats
  IndexedVector<BoundaryNodeIndex, std::int32_t> group_; ///< −1: free
  Bonds bonds_;
  IndexedVector<BoundaryNodeIndex, Vec<dim>> listed_;   ///< m; empty: no list yet
  std::vector<Pair> pairs_;                             ///< by node, then image, then facet
  std::vector<EdgePair> edge_pairs_;                    ///< 3D
  IndexedVector<BoundaryNodeIndex, Vec<dim>> narrowed_; ///< 3D: m, at which near_edges_ were chosen
  std::vector<EdgePair> near_edges_;                    ///< 3D: of edge_pairs_, in their order
  double skin_ = 0.0, narrow_ = 0.0;                    ///< m
  bool wide_ = false; ///< 3D: the step goes so far that all edge_pairs_ are looked at
  double size_ = 0.0;
  int listings_ = 0;
};

template<> void BodyContact<2>::list(const Surface<2>& surface);
template<>
void BodyContact<2>::find(const Surface<2>& surface, PlacesOnBoundary<2> start, PlacesOnBoundary<2> end,
                          std::vector<FacetHit<2>>& hits) const;
template<>
void BodyContact<2>::find_closed(const Surface<2>& surface, PlacesOnBoundary<2> position, double closed,
                                 std::vector<FacetHit<2>>& hits) const;
template<>
void BodyContact<3>::find_closed(const Surface<3>& surface, PlacesOnBoundary<3> position, double closed,
                                 std::vector<FacetHit<3>>& hits) const;
template<> void BodyContact<3>::list(const Surface<3>& surface);
template<>
void BodyContact<3>::list_edges(const Surface<3>& surface, const BoxTree& facets,
                                std::span<const Vec3> shifts);
template<> void BodyContact<3>::narrow(const Surface<3>& surface);
template<>
void BodyContact<3>::find(const Surface<3>& surface, PlacesOnBoundary<3> start, PlacesOnBoundary<3> end,
                          std::vector<FacetHit<3>>& hits) const;
template<>
void BodyContact<3>::find_edges(const Surface<3>& surface, PlacesOnBoundary<3> start, PlacesOnBoundary<3> end,
                                std::vector<EdgeHit>& hits) const;
extern template class BodyContact<2>;
extern template class BodyContact<3>;

} // namespace cnem::contact
