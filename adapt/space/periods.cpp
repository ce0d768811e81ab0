#include "adapt/space/periods.hpp"

#include "core/error.hpp"
#include "core/geometry/mates.hpp"
#include "core/index.hpp"
#include "voronoi/space/surface.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace cnem::adapt {

PeriodImages::PeriodImages(const Cloud<3>& cloud, std::span<const Period> periods)
    : periods_(periods.begin(), periods.end()) {
  for (const Period& period : periods_) {
    auto& other = other_.emplace_back(cloud.position.size(), NodeIndex::none);
    for (const auto& [a, b] : shifted_nodes(cloud, period)) {
      other[a] = b;
      other[b] = a;
    }
  }
}

NodeIndex PeriodImages::image(NodeIndex i, PieceIndex piece) const {
  for (std::size_t p = 0; p < periods_.size(); ++p)
    if (piece == periods_[p][0] || piece == periods_[p][1])
      return index_of(i) < other_[p].size() ? other_[p][i] : NodeIndex::none;
  return NodeIndex::none;
}

void PeriodImages::pair(NodeIndex on_piece, PieceIndex piece, NodeIndex other) {
  for (std::size_t p = 0; p < periods_.size(); ++p) {
    if (piece != periods_[p][0] && piece != periods_[p][1]) continue;
    const std::size_t nodes = index_of(std::max(on_piece, other)) + 1;
    if (other_[p].size() < nodes) other_[p].resize(nodes, NodeIndex::none);
    other_[p][on_piece] = other;
    other_[p][other] = on_piece;
  }
}

std::vector<std::vector<NodeIndex>> PeriodImages::groups() const {
  std::vector<std::vector<NodeIndex>> list;
  if (empty()) return list;
  IndexedVector<NodeIndex, char> listed(other_.front().size(), 0);
  for (const NodeIndex first : listed.indices()) {
    std::vector<NodeIndex> group{first};
    for (std::size_t n = 0; n < group.size() && !listed[first]; ++n)
      for (const auto& other : other_)
        if (const NodeIndex k = other[group[n]];
            exists(k) && std::find(group.begin(), group.end(), k) == group.end())
          group.push_back(k);
    if (group.size() < 2) continue;
    for (const NodeIndex i : group) listed[i] = 1;
    std::sort(group.begin(), group.end());
    list.push_back(std::move(group));
  }
  return list;
}

bool move_alike(Cloud<3>& cloud, const std::vector<std::vector<NodeIndex>>& groups,
                const IndexedVector<NodeIndex, Vec3>& way, const IndexedVector<NodeIndex, char>& held) {
  bool any = false;
  for (const std::vector<NodeIndex>& group : groups) {
    Vec3 longest = Vec3::Zero();
    bool stays = false;
    for (const NodeIndex i : group) {
      if (way[i].norm() > longest.norm()) longest = way[i];
      stays = stays || held[i];
    }
    if (stays || longest.isZero()) continue;
    for (const NodeIndex i : group) cloud.position[i] += longest;
    any = true;
  }
  return any;
}

/// visit(piece, image) for the pieces on both sides of an edge that are of a period; no_edge where the image
/// is not there.
template<class Visit> void AlikeEdits::each_image(Edge e, Visit&& visit) const {
  const std::array<PieceIndex, 2> piece{surface_->piece(e), surface_->piece(surface_->across(e))};
  for (std::size_t side = 0; side < (piece[0] == piece[1] ? 1 : 2); ++side) {
    if (!surface_->is_still(piece[side])) continue;
    const NodeIndex a = images_.image(surface_->start(e), piece[side]),
                    b = images_.image(surface_->end(e), piece[side]);
    visit(piece[side], exists(a) && exists(b) ? surface_->between(a, b) : WorkingSurface::no_edge);
  }
}

std::vector<AlikeEdits::Edge> AlikeEdits::edges(Edge e) const {
  std::vector<Edge> all{e};
  if (images_.empty()) return all;
  bool complete = true;
  for (std::size_t n = 0; n < all.size(); ++n)
    each_image(all[n], [&](PieceIndex, Edge other) {
      if (other == WorkingSurface::no_edge)
        complete = false;
      else if (std::find(all.begin(), all.end(), other) == all.end())
        all.push_back(other);
    });
  return complete ? all : std::vector<Edge>{};
}

std::vector<AlikeEdits::Split> AlikeEdits::split(Edge e) {
  std::vector<Split> done;
  if (!surface_->alive(e)) return done;
  const std::vector<Edge> all = edges(e);
  struct Link {
    std::size_t from, to;
    PieceIndex piece;
  };
  std::vector<Link> links;
  for (std::size_t n = 0; n < all.size() && all.size() > 1; ++n)
    each_image(all[n], [&](PieceIndex piece, Edge other) {
      links.push_back({n, index_of(std::find(all.begin(), all.end(), other) - all.begin()), piece});
    });
  for (const Edge k : all) {
    const NodeIndex a = surface_->start(k), b = surface_->end(k);
    const SurfaceChange change = surface_->split(k);
    if (!change.done()) {
      assert(done.empty()); // slits alone refuse, which are on no period
      return done;
    }
    done.push_back({a, b, change.made});
  }
  for (const Link& link : links) images_.pair(done[link.from].made, link.piece, done[link.to].made);
  return done;
}

namespace {

/// Whether no node is beside two of the edges: what happens at one does not matter at the other then.
bool apart(std::vector<std::vector<NodeIndex>> beside) {
  std::vector<NodeIndex> all;
  for (std::vector<NodeIndex>& nodes : beside) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    all.insert(all.end(), nodes.begin(), nodes.end());
  }
  std::sort(all.begin(), all.end());
  return std::adjacent_find(all.begin(), all.end()) == all.end();
}

} // namespace

bool AlikeEdits::may_collapse(const std::vector<Edge>& all, double spacing, Collapse kind) const {
  if (all.size() < 2) return !all.empty();
  std::vector<std::vector<NodeIndex>> beside;
  for (const Edge e : all) {
    Vec3 to;
    if (!surface_->try_collapse(e, spacing, to, kind).done()) return false;
    auto& nodes = beside.emplace_back();
    for (const NodeIndex i : {surface_->start(e), surface_->end(e)})
      surface_->around(i, [&](Edge k) { nodes.push_back(surface_->end(k)); });
  }
  return apart(std::move(beside));
}

bool AlikeEdits::may_flip(const std::vector<Edge>& all, double spacing, Flip kind) const {
  if (all.size() < 2) return !all.empty();
  std::vector<std::vector<NodeIndex>> beside;
  for (const Edge e : all) {
    if (!surface_->try_flip(e, spacing, kind).done()) return false;
    beside.push_back(
        {surface_->start(e), surface_->end(e), surface_->apex(e), surface_->apex(surface_->across(e))});
  }
  return apart(std::move(beside));
}

void repeat_facets(Cloud<3>& cloud, std::span<const Period> periods) {
  for (const Period& period : periods) {
    IndexedVector<NodeIndex, NodeIndex> other(cloud.position.size(), NodeIndex::none);
    for (const auto& [a, b] : shifted_nodes(cloud, period)) other[a] = b;
    Cloud<3> candidate;
    candidate.position = cloud.position;
    candidate.twins = cloud.twins;
    for (const Facet<3>& facet : cloud.facets)
      if (facet.piece != period[1]) candidate.facets.push_back(facet);
    for (const Facet<3>& facet : cloud.facets)
      if (facet.piece == period[0])
        candidate.facets.push_back(
            {{other[facet.node[2]], other[facet.node[1]], other[facet.node[0]]}, period[1]});
    try {
      voronoi::surface_edges(candidate);
    } catch (const GeometryError&) { continue; } // a crease has other nodes here than there
    cloud.facets = std::move(candidate.facets);
  }
}

} // namespace cnem::adapt
