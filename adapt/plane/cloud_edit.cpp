#include "adapt/plane/cloud_edit.hpp"

#include "core/index.hpp"
#include "voronoi/order.hpp"

#include <utility>

namespace cnem::adapt {

CloudEdit::CloudEdit(const Cloud<2>& cloud, const Structure& structure, const NodeProperties& node)
    : before_(cloud), structure_(structure), node_(node), place_(cloud.position),
      next_(cloud.position.size(), NodeIndex::none), previous_(next_), facing_(next_),
      piece_(cloud.position.size(), PieceIndex::none), gone_(cloud.position.size(), 0) {
  for (const Facet<2>& facet : cloud.facets) link(facet.node[0], facet.node[1], facet.piece);
  for (const CloudFacetIndex f : cloud.mates.indices())
    if (exists(cloud.mates[f])) facing_[cloud.facets[f].node[0]] = cloud.facets[cloud.mates[f]].node[0];
}

NodeIndex CloudEdit::add(const Vec2& x, NodeIndex like, bool virgin) {
  const NodeIndex made = place_.next();
  place_.push_back(x);
  for (auto* list : {&next_, &previous_, &facing_}) list->push_back(NodeIndex::none);
  piece_.push_back(PieceIndex::none);
  gone_.push_back(0);
  made_.push_back({like, virgin});
  return made;
}

void CloudEdit::link(NodeIndex a, NodeIndex b, PieceIndex piece) {
  next_[a] = b;
  previous_[b] = a;
  piece_[a] = piece;
}

std::optional<Resampling<2>> CloudEdit::finish() {
  Resampling<2> change;
  if (!renumber(change)) return std::nullopt;
  const std::optional<Structure> after = structure_if_valid(change.cloud, structure_.space);
  if (!after) return std::nullopt;
  share_out(*after, change);
  change.old_position = before_.position;
  return change;
}

/// The cloud that is left, in space-filling order. False where the boundary leads to a node that is gone.
bool CloudEdit::renumber(Resampling<2>& change) {
  Cloud<2> cloud = before_;
  cloud.position.clear();
  cloud.facets.clear();
  cloud.simplices.clear();
  cloud.across.clear();
  cloud.body.clear();
  IndexedVector<NodeIndex, NodeIndex> number(place_.size(), NodeIndex::none);
  for (const NodeIndex i : place_.indices()) {
    if (gone(i)) continue;
    number[i] = cloud.position.next();
    cloud.position.push_back(place_[i]);
    if (!before_.body.empty())
      cloud.body.push_back(before_.body[is_old(i) ? i : made_[index_of(i) - before_.position.size()].like]);
    kept_.push_back(i);
  }
  IndexedVector<NodeIndex, CloudFacetIndex> leaving(place_.size(), CloudFacetIndex::none);
  for (const NodeIndex start : kept_)
    for (NodeIndex i = start; on_boundary(i) && !exists(leaving[i]); i = next(i)) {
      if (gone(next(i))) return false;
      leaving[i] = cloud.facets.next();
      cloud.facets.push_back({{number[i], number[next(i)]}, piece(i)});
    }
  if (!cloud.mates.empty()) {
    cloud.mates.assign(cloud.facets.size(), CloudFacetIndex::none);
    for (const NodeIndex i : kept_)
      if (exists(leaving[i]) && exists(facing_[i]) && !gone(facing_[i]))
        cloud.mates[leaving[i]] = leaving[facing_[i]];
  }
  std::erase_if(cloud.twins, [&](const auto& pair) { return gone(pair[0]) || gone(pair[1]); });
  for (auto& pair : cloud.twins)
    for (NodeIndex& i : pair) i = number[i];
  order_ = voronoi::hilbert_order(cloud.position);
  change.cloud = voronoi::renumber(cloud, order_);
  return true;
}

/// Nodes whose cells have other neighbours than before.
IndexedVector<NodeIndex, char> CloudEdit::touched(const Structure& after) const {
  IndexedVector<NodeIndex, char> marked(place_.size(), 0);
  for (const NodeIndex i : old_nodes())
    if (gone(i))
      for (const NodeIndex k : structure_.neighbours(i)) marked[k] = 1;
  for (std::size_t p = 0; p < order_.size(); ++p)
    if (!is_old(number_here(as<NodeIndex>(p))))
      for (const NodeIndex k : after.neighbours(as<NodeIndex>(p))) marked[number_here(k)] = 1;
  return marked;
}

void CloudEdit::share_out(const Structure& after, Resampling<2>& change) const {
  const IndexedVector<NodeIndex, char> changed = touched(after);
  change.gain.assign(before_.position.size(), 0.0);
  change.new_of.assign(before_.position.size(), NodeIndex::none);
  for (const NodeIndex i : old_nodes())
    if (gone(i)) change.gain[index_of(i)] = -1.0;
  for (NodeRows* rows : {&change.parcels, &change.labels}) rows->begin.push_back(0);
  for (std::size_t n = 0; n < order_.size(); ++n) {
    const auto p = as<NodeIndex>(n);
    const NodeIndex i = number_here(p);
    const Made made = is_old(i) ? Made{i, false} : made_[index_of(i) - before_.position.size()];
    const std::size_t from = index_of(made.like);
    double weight = 1.0;
    if (made.virgin)
      weight = node_.density[from] * after.volume(p) / node_.mass[from];
    else if (!is_old(i) || changed[i])
      weight = after.volume(p) / structure_.volume(made.like);
    if (made.virgin)
      change.virgin.push_back(p);
    else
      change.gain[from] += is_old(i) ? weight - 1.0 : weight;
    for (const auto& [rows, share] : {std::pair{&change.parcels, weight}, {&change.labels, 1.0}}) {
      rows->from.push_back(made.like);
      rows->weight.push_back(share);
      rows->begin.push_back(as<std::int32_t>(rows->from.size()));
    }
    change.old_of.push_back(is_old(i) ? i : NodeIndex::none);
    if (is_old(i)) change.new_of[i] = p;
  }
}

} // namespace cnem::adapt
