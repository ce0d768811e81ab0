#pragma once
// The boundary of a cloud in space while it is being resampled: edges are split, collapsed and flipped.
#include "core/geometry/cloud.hpp"
#include "core/index.hpp"
#include "voronoi/space/surface.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace cnem::adapt {

/// What a change of the surface must keep. Angles in degrees.
struct SurfaceRules {
  double crease = 40.0; ///< facets that turn by more meet at a crease
  double corner = 40.0; ///< creases that turn by more have a corner there, which stays
  double turn = 30.0;   ///< how far normals of facets may turn
  double flat = 14.0;   ///< facets that turn by less may exchange their diagonal
  double volume = 0.02; ///< how much volume a change may add or take (in h³) before it is given back
  double tip = 0.002;   ///< what is thinner holds less than that (in h³) whichever way its node goes
  double shape = 0.05;  ///< least height of a facet over its longest side, unless it was less before
  /// Pieces of which each is repeated by another: nodes on them come and go, but none moves, and what a
  /// change inside of one does to the volume is undone by its image.
  std::vector<PieceIndex> still{};

  bool is_still(PieceIndex piece) const {
    return std::find(still.begin(), still.end(), piece) != still.end();
  }
};

/// Why the surface was left as it was.
enum class Refusal {
  none,
  absent,  ///< the edge is no more
  held,    ///< the node has to stay: conditions name it, or it is on a closed slit
  corner,  ///< creases or pieces meet there
  crease,  ///< the way leads off a crease, or across one
  link,    ///< other facets would meet in one edge (Dey, Edelsbrunner, Guha, Nekhayev 1999)
  normals, ///< a facet would turn too far, or lose its height
  volume,  ///< the shape would change too much
};

struct SurfaceChange {
  Refusal refusal = Refusal::none;
  double volume = 0.0;              ///< m³ that the body has gained
  NodeIndex made = NodeIndex::none; ///< of a split

  bool done() const { return refusal == Refusal::none; }
};

/// What may go.
enum class Collapse {
  in_shape, ///< creases, corners and normals stay
  of_tip,   ///< the end of a whisker or the corner of a film, which hold next to nothing
  of_light, ///< a node with next to no matter, that holds no more than a change of the shape may take
};

/// Which edges may become the other diagonal of their facets.
enum class Flip {
  in_shape, ///< of facets that lie flat beside each other
  of_film,  ///< of two facets that lie back to back, so that a side of one crosses a side of the other
};

/// Half-edges in triples: edge 3f + k leaves node k of facet f (voronoi/space/surface.hpp). It is closed and
/// without branches from beginning to end: whatever would not keep it so is refused, with a reason, and then
/// nothing has changed. Several closed components are one surface. Numbers of nodes and facets stay; those
/// that go are left out by facets(). Cost of an operation: that of the facets round its nodes.
class WorkingSurface {
public:
  using Edge = voronoi::SurfaceEdge;
  static constexpr Edge no_edge = -1;

  /// held: [node] nodes that neither move nor go. A slit that has not opened stays as it is. Throws
  /// GeometryError as voronoi::surface_edges.
  WorkingSurface(const Cloud<3>& cloud, const IndexedVector<NodeIndex, char>& held,
                 const SurfaceRules& rules = {});
  /// New nodes between two that have a mark are held, too: the surface between held nodes is as it was then,
  /// where others could go into these.
  void hold_between(const IndexedVector<NodeIndex, char>& marks) { holds_ = marks; }
  /// Nothing holds those that have a mark together: edges between two of them may be as long as they are.
  void leave_apart(const IndexedVector<NodeIndex, char>& marks) { apart_ = marks; }
  bool apart(Edge e) const { return apart_[start(e)] && apart_[end(e)]; }

  std::size_t nodes() const { return position_.size(); }
  const Vec3& at(NodeIndex i) const { return position_[i]; }
  const IndexedVector<NodeIndex, Vec3>& position() const { return position_; }
  bool on_surface(NodeIndex i) const { return leaving_[i] != no_edge; }
  Edge edges() const {
    return static_cast<Edge>(3 * facet_.size());
  } ///< numbers below, of which some are gone
  bool alive(Edge e) const { return e != no_edge && exists(facet_[index_of(e / 3)].node[0]); }
  NodeIndex start(Edge e) const { return facet_[index_of(e / 3)].node[index_of(e % 3)]; }
  NodeIndex end(Edge e) const { return start(voronoi::next_edge(e)); }
  NodeIndex apex(Edge e) const { return start(last_edge(e)); }
  Edge across(Edge e) const { return across_[index_of(e)]; }
  double length(Edge e) const { return (at(end(e)) - at(start(e))).norm(); }
  bool held(NodeIndex i) const { return held_[i] != 0; }
  bool still(NodeIndex i) const { return still_[i] != 0; }
  bool is_still(PieceIndex piece) const { return rules_.is_still(piece); }
  PieceIndex piece(Edge e) const { return facet_[index_of(e / 3)].piece; }

  /// Calls visit(edge) for the edges that leave a node, turning clockwise as seen from outside.
  template<class Visit> void around(NodeIndex i, Visit&& visit) const {
    Edge e = leaving_[i];
    if (e == no_edge) return;
    do {
      visit(e);
      e = voronoi::next_edge(across(e));
    } while (e != leaving_[i]);
  }
  int valence(NodeIndex i) const;
  /// The edge between two nodes; no_edge where there is none.
  Edge between(NodeIndex from, NodeIndex to) const;
  /// Where facets of two pieces meet, or that turn by more than rules.crease; pieces that are repeated have
  /// no creases inside.
  bool crease(Edge e) const;
  bool on_crease(NodeIndex i) const;
  /// Creases end, branch or turn here.
  bool corner(NodeIndex i) const;
  /// Of which a node may move by its length without changing the volume by more than that: ∂V/∂x, m², less
  /// what leads out of the plane faces it is on. Zero for nodes that stay.
  Vec3 way_of_volume(NodeIndex i) const;

  /// A new node at x on an edge; x on the edge changes no volume.
  SurfaceChange split(Edge e, const Vec3& x);
  SurfaceChange split(Edge e); ///< in the middle
  /// The node that an edge leaves goes into its end, which moves to where the volume is what it was
  /// (Lindstrom and Turk 1998), unless it cannot. Corners stay and creases are not left, but where folds of
  /// one piece have met within a tenth of h: a corner goes into a corner, a node of one crease into one of
  /// another. spacing: h, m.
  SurfaceChange collapse(Edge e, double spacing, Collapse kind = Collapse::in_shape);
  /// What collapse() would do, and where the node that stays would be.
  SurfaceChange try_collapse(Edge e, double spacing, Vec3& to, Collapse kind = Collapse::in_shape) const;
  /// Whether a node is a corner of one piece that holds less than rules.tip whichever way it would go: the
  /// end of a whisker that has been drawn out, or a corner of a film. Collapse::of_tip takes it away.
  bool is_tip(NodeIndex i, double spacing) const;
  /// The edge becomes the other diagonal of its two facets. spacing: h, m.
  SurfaceChange flip(Edge e, double spacing, Flip kind = Flip::in_shape);
  /// What flip() would do.
  SurfaceChange try_flip(Edge e, double spacing, Flip kind = Flip::in_shape) const;
  /// Whether the angles across from an edge are more than π together.
  bool wants_flip(Edge e) const;
  /// Moves a node along its way_of_volume() so that the volume grows by `volume` (m³), to first order; not
  /// where it would have to move by more than `most` (m) or facets turn too far. Whether it did.
  bool swell(NodeIndex i, double volume, double most);

  /// The facets there are.
  IndexedVector<CloudFacetIndex, Facet<3>> facets() const;
  /// Those of them that are not at the same places in the cloud that this surface was made of.
  std::vector<CloudFacetIndex> changed_facets(const Cloud<3>& before) const;

private:
  static Edge last_edge(Edge e) { return e % 3 == 0 ? e + 2 : e - 1; }
  using Corners = std::array<Vec3, 3>;
  Corners corners(std::size_t facet) const;
  Vec3 normal(Edge e) const;
  double cosine_across(Edge e) const;
  void join(Edge a, Edge b);
  bool may_become(const Corners& before, const Corners& after) const;
  void keep_on_faces(NodeIndex i, Vec3& way) const;
  bool of_folds(NodeIndex i) const; ///< one piece is all round it
  /// Whether it takes less than rules.tip or, as light as it is, rules.volume with it whichever way it may
  /// go: within a piece, or along the border of one that is repeated if it is light.
  bool holds_less(NodeIndex i, double spacing, Collapse kind) const;
  int pieces_meet(NodeIndex i) const; ///< edges at a node where facets of two pieces meet
  Refusal may_collapse(Edge e, double spacing, Collapse kind) const;
  double volume_towards(NodeIndex gone, NodeIndex stays) const;
  bool may_cap(Edge e) const;
  bool is_film(Edge e) const;
  Edge add_facet(const Facet<3>& facet);

  SurfaceRules rules_;
  double least_crease_, least_corner_, least_turn_, least_flat_; ///< cosines
  IndexedVector<NodeIndex, Vec3> position_;
  IndexedVector<NodeIndex, char> held_, holds_, apart_, still_;
  IndexedVector<NodeIndex, Edge> leaving_;
  std::vector<Facet<3>> facet_; ///< node none: gone
  std::vector<char> closed_;    ///< [facet] the other face of its slit lies on it
  std::vector<Edge> across_;    ///< [edge]
};

} // namespace cnem::adapt
