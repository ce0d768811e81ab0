#include "adapt/plane/working_cloud.hpp"

#include "core/error.hpp"
#include "voronoi/order.hpp"
#include "voronoi/plane/boundary_checks.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace cnem::adapt {

WorkingCloud::WorkingCloud(const Cloud<2>& cloud, NodeProperties properties, PieceIndex free_piece)
    : Matter(std::move(properties)), cloud_(cloud), free_piece_(free_piece) {
  voronoi::outgoing_facets(cloud); // throws for open loops
  const std::size_t nodes = cloud.position.size();
  next_.assign(nodes, NodeIndex::none);
  previous_.assign(nodes, NodeIndex::none);
  piece_.assign(nodes, PieceIndex::none);
  IndexedVector<NodeIndex, char> seen(nodes, 0);
  for (const Facet<2>& facet : cloud.facets) {
    const auto [a, b] = facet.node;
    next_[a] = b;
    previous_[b] = a;
    piece_[a] = facet.piece;
  }
  facing_.assign(nodes, NodeIndex::none);
  for (const CloudFacetIndex f : cloud.mates.indices())
    if (exists(cloud.mates[f])) facing_[cloud.facets[f].node[0]] = cloud.facets[cloud.mates[f]].node[0];
  for (const Facet<2>& facet : cloud.facets) {
    if (seen[facet.node[0]]) continue;
    loop_.push_back(facet.node[0]);
    for (NodeIndex i = facet.node[0]; !seen[i]; i = next_[i]) seen[i] = 1;
  }
}

NodeIndex WorkingCloud::append(const Vec2& x, const std::vector<std::pair<NodeIndex, double>>& parents) {
  const NodeIndex made = cloud_.position.next();
  cloud_.position.push_back(x);
  if (!cloud_.body.empty()) {
    const std::int32_t body = cloud_.body[parents.front().first];
    cloud_.body.push_back(body);
  }
  begin_with({}, {});
  Matter::append(parents);
  next_.push_back(NodeIndex::none);
  previous_.push_back(NodeIndex::none);
  piece_.push_back(PieceIndex::none);
  facing_.push_back(NodeIndex::none);
  return made;
}

NodeIndex WorkingCloud::insert_between(NodeIndex a, NodeIndex b, bool on_boundary, double place) {
  const Vec2 x = (1.0 - place) * cloud_.position[a] + place * cloud_.position[b];
  const NodeIndex made = append(x, {{a, 1.0 - place}, {b, place}});
  if (!on_boundary) return made;
  const NodeIndex opposite = facing_[a];
  divide(a, made);
  if (!exists(opposite)) return made;
  assert(place == 0.5);
  const NodeIndex behind = next_[opposite];
  const NodeIndex mate = append(0.5 * cloud_.position[opposite] + 0.5 * cloud_.position[behind],
                                {{opposite, 0.5}, {behind, 0.5}});
  divide(opposite, mate);
  be_mates(a, mate);
  be_mates(made, opposite);
  // of a period they are much farther apart
  const double apart = (cloud_.position[made] - cloud_.position[mate]).norm();
  if (apart < 0.1 * (cloud_.position[b] - cloud_.position[a]).norm()) cloud_.twins.push_back({made, mate});
  return made;
}

/// The boundary goes over a new node on the facet that leaves a.
void WorkingCloud::divide(NodeIndex a, NodeIndex made) {
  const NodeIndex b = next_[a];
  next_[a] = made;
  next_[made] = b;
  previous_[b] = made;
  previous_[made] = a;
  piece_[made] = piece_[a];
}

/// The facets that leave two nodes belong together.
void WorkingCloud::be_mates(NodeIndex a, NodeIndex b) {
  facing_[a] = b;
  facing_[b] = a;
}

NodeIndex WorkingCloud::mate(NodeIndex i) const {
  if (!on_boundary(i)) return NodeIndex::none;
  const NodeIndex entering = facing_[previous_[i]], leaving = facing_[i];
  return exists(entering) && exists(leaving) && next_[leaving] == entering && entering != i ? entering
                                                                                            : NodeIndex::none;
}

/// Mates reach a node, but none goes with it.
bool WorkingCloud::ends_mates(NodeIndex i) const { return has_mates(i) && !exists(mate(i)); }

bool WorkingCloud::stays(NodeIndex i) const {
  const auto must = [&](NodeIndex k) {
    return held(k) || ends_piece(k) || (on_boundary(k) && ends_mates(k));
  };
  const NodeIndex other = mate(i);
  return must(i) || (exists(other) && must(other));
}

NodeIndex WorkingCloud::insert_at(const Vec2& x, const std::array<NodeIndex, 3>& corner,
                                  const std::array<double, 3>& weight) {
  return append(x, {{corner[0], weight[0]}, {corner[1], weight[1]}, {corner[2], weight[2]}});
}

void WorkingCloud::promote(NodeIndex node, NodeIndex a, const Vec2& x) {
  assert(!exists(facing_[a]));
  cloud_.position[node] = x;
  divide(a, node);
}

bool WorkingCloud::ends_piece(NodeIndex i) const {
  if (!on_boundary(i)) return false;
  const NodeIndex before = previous_[i];
  const PieceIndex entering = piece_[before], leaving = piece_[i];
  if (entering == leaving) return false;
  const auto last = [&](PieceIndex piece) { return std::count(piece_.begin(), piece_.end(), piece) == 1; };
  if (leaving == free_piece_) return piece_[previous_[before]] != entering && last(entering);
  if (entering == free_piece_) return piece_[next_[i]] != leaving && last(leaving);
  return true;
}

void WorkingCloud::bypass(NodeIndex node) {
  const NodeIndex other = mate(node);
  const NodeIndex ahead = facing_[node], before = previous_[node]; // which become mates
  pass_by(node);
  if (!exists(other)) return;
  pass_by(other);
  be_mates(before, ahead);
}

void WorkingCloud::pass_by(NodeIndex node) {
  const NodeIndex a = previous_[node], b = next_[node];
  if (piece_[node] == free_piece_) piece_[a] = free_piece_;
  next_[a] = b;
  previous_[b] = a;
  if (b == node) std::erase(loop_, node); // the last of its loop
  for (NodeIndex& start : loop_)
    if (start == node) start = b;
  next_[node] = previous_[node] = facing_[node] = NodeIndex::none;
  piece_[node] = PieceIndex::none;
}

std::vector<std::array<NodeIndex, 2>> WorkingCloud::open(std::span<const NodeIndex> path, PieceIndex piece,
                                                         double gap) {
  const auto at = [&](NodeIndex i) -> Vec2& { return cloud_.position[i]; };
  const auto link = [&](NodeIndex a, NodeIndex b, PieceIndex of_piece) {
    next_[a] = b;
    previous_[b] = a;
    piece_[a] = of_piece;
  };
  const bool through = on_boundary(path.back()); // else it ends at a tip, which stays one node
  const NodeIndex first = path.front(), last = path.back();
  const NodeIndex after_first = next(first), before_last = through ? previous(last) : NodeIndex::none;
  const PieceIndex piece_first = piece_[first];
  const auto towards = [&](NodeIndex from, NodeIndex to) {
    return Vec2(0.5 * gap * (at(to) - at(from)).normalized());
  };
  std::vector<Vec2> left(path.size()), right(path.size());
  for (std::size_t k = 0; k < path.size(); ++k) {
    const NodeIndex behind = path[k > 0 ? k - 1 : 0], ahead = path[std::min(k + 1, path.size() - 1)];
    left[k] = 0.5 * gap * left_normal((at(ahead) - at(behind)).normalized());
    right[k] = -left[k];
  }
  // ends part along the boundary, so that they stay on it; there is no such way at the tip of a crack
  if (!is_tip(first)) {
    left.front() = towards(first, previous(first));
    right.front() = towards(first, after_first);
  }
  if (through && !is_tip(last)) {
    left.back() = towards(last, next(last));
    right.back() = towards(last, before_last);
  }
  for (const std::size_t end : {std::size_t{0}, path.size() - 1})
    if (on_boundary(path[end]) && has_mates(path[end])) left[end] = right[end] = Vec2::Zero();
  std::vector<std::array<NodeIndex, 2>> doubled;
  for (std::size_t k = 0; k < path.size() - (through ? 0 : 1); ++k) {
    const NodeIndex made = append(at(path[k]) + right[k], {{path[k], 1.0}});
    at(path[k]) += left[k];
    hold(made, node().held[path[k]]);
    doubled.push_back({path[k], made});
    if (left[k] == right[k]) cloud_.twins.push_back({path[k], made});
  }
  if (through) {
    link(before_last, doubled.back()[1], piece_[before_last]);
  } else {
    link(last, doubled.back()[1], piece);
  }
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    link(path[k], path[k + 1], piece);
    if (k + 1 < doubled.size()) link(doubled[k + 1][1], doubled[k][1], piece);
  }
  link(doubled.front()[1], after_first, piece_first);
  if (const NodeIndex opposite = std::exchange(facing_[first], NodeIndex::none); exists(opposite))
    be_mates(doubled.front()[1], opposite);
  renew_loops();
  return doubled;
}

bool WorkingCloud::is_tip(NodeIndex i) const {
  constexpr double sharp = 0.8;   // cosine of the angle between the faces
  constexpr double closed = 0.02; // faces that are pressed on each other may overlap a little
  if (!on_boundary(i)) return false;
  const Vec2 back = cloud_.position[previous_[i]] - cloud_.position[i],
             ahead = cloud_.position[next_[i]] - cloud_.position[i];
  const double lengths = back.norm() * ahead.norm();
  return back.dot(ahead) > sharp * lengths && cross(ahead, back) < closed * lengths;
}

void WorkingCloud::renew_loops() {
  loop_.clear();
  IndexedVector<NodeIndex, char> seen(size(), 0);
  for (const NodeIndex i : nodes()) {
    if (!exists(next_[i]) || seen[i]) continue;
    loop_.push_back(i);
    for (NodeIndex k = i; !seen[k]; k = next_[k]) seen[k] = 1;
  }
}

IndexedVector<NodeIndex, NodeIndex> WorkingCloud::drop(const IndexedVector<NodeIndex, char>& gone) {
  const IndexedVector<NodeIndex, NodeIndex> number = numbers_without(gone);
  const auto rename = [&](NodeIndex& i) {
    if (exists(i)) i = number[i];
  };
  begin_with({}, {});
  Matter::renumber(number);
  adapt::renumber(number, cloud_.position);
  if (!cloud_.body.empty()) adapt::renumber(number, cloud_.body);
  for (auto* list : {&next_, &previous_, &facing_}) {
    adapt::renumber(number, *list);
    for (NodeIndex& i : *list) rename(i);
  }
  adapt::renumber(number, piece_);
  for (NodeIndex& i : loop_) rename(i);
  std::erase_if(cloud_.twins, [&](const auto& pair) { return gone[pair[0]] || gone[pair[1]]; });
  for (auto& pair : cloud_.twins)
    for (NodeIndex& i : pair) rename(i);
  return number;
}

void WorkingCloud::refresh_facets() {
  cloud_.facets.clear();
  for (const NodeIndex start : loop_) {
    NodeIndex i = start;
    do {
      cloud_.facets.push_back({{i, next_[i]}, piece_[i]});
      i = next_[i];
    } while (i != start);
  }
  if (cloud_.mates.empty()) return;
  IndexedVector<NodeIndex, CloudFacetIndex> leaving(size(), CloudFacetIndex::none);
  for (const CloudFacetIndex f : cloud_.facets.indices()) leaving[cloud_.facets[f].node[0]] = f;
  cloud_.mates.clear();
  for (const Facet<2>& facet : cloud_.facets) {
    const NodeIndex opposite = facing_[facet.node[0]];
    cloud_.mates.push_back(exists(opposite) ? leaving[opposite] : CloudFacetIndex::none);
  }
}

Resampling<2> WorkingCloud::finish() {
  if (!came_or_went()) return Matter::finished(cloud_);
  const std::vector<std::int32_t> order = voronoi::hilbert_order(cloud_.position);
  IndexedVector<NodeIndex, NodeIndex> number(size());
  for (std::size_t n = 0; n < order.size(); ++n) number[index_of(order[n])] = as<NodeIndex>(n);
  Matter::renumber(number);
  return Matter::finished(voronoi::renumber(cloud_, order));
}

} // namespace cnem::adapt
