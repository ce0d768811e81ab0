#include "adapt/working_cloud.hpp"

#include "core/error.hpp"
#include "voronoi/boundary_checks.hpp"
#include "voronoi/order.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cnem::adapt {

namespace {

/// a += factor · b.
void add(Row& a, const Row& b, double factor) {
  Row sum;
  sum.reserve(a.size() + b.size());
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() || j != b.end()) {
    if (j == b.end() || (i != a.end() && i->first < j->first))
      sum.push_back(*i++);
    else if (i == a.end() || j->first < i->first) {
      sum.emplace_back(j->first, factor * j->second);
      ++j;
    } else {
      sum.emplace_back(i->first, i->second + factor * j->second);
      ++i;
      ++j;
    }
  }
  a = std::move(sum);
}

} // namespace

WorkingCloud::WorkingCloud(const Cloud<2>& cloud, NodeProperties properties, std::int32_t free_piece)
    : cloud_(cloud), node_(std::move(properties)), old_nodes_(cloud.position.size()),
      free_piece_(free_piece) {
  if (!cloud.twins.empty())
    throw GeometryError("a cloud with cracks or interfaces cannot be resampled: their two faces would part");
  voronoi::outgoing_facets(cloud); // throws for open loops
  next_.assign(old_nodes_, -1);
  previous_.assign(old_nodes_, -1);
  piece_.assign(old_nodes_, -1);
  std::vector<char> seen(old_nodes_, 0);
  for (const Facet<2>& facet : cloud.facets) {
    const auto [a, b] = facet.node;
    next_[index(a)] = b;
    previous_[index(b)] = a;
    piece_[index(a)] = facet.piece;
  }
  for (const Facet<2>& facet : cloud.facets) {
    if (seen[index(facet.node[0])]) continue;
    loop_.push_back(facet.node[0]);
    for (std::int32_t i = facet.node[0]; !seen[index(i)]; i = next_[index(i)]) seen[index(i)] = 1;
  }
  old_of_.resize(old_nodes_);
  std::iota(old_of_.begin(), old_of_.end(), 0);
  parcels_.resize(old_nodes_);
  labels_.resize(old_nodes_);
}

Row& WorkingCloud::row(std::vector<Row>& rows, std::int32_t i) {
  Row& mine = rows[index(i)];
  if (mine.empty() && old_of_[index(i)] >= 0) mine = {{old_of_[index(i)], 1.0}};
  return mine;
}

std::int32_t WorkingCloud::append(const Vec2& x,
                                  const std::vector<std::pair<std::int32_t, double>>& parents) {
  const auto made = static_cast<std::int32_t>(size());
  cloud_.position.push_back(x);
  Row label;
  double size = 0.0;
  for (const auto& [parent, weight] : parents) {
    add(label, row(labels_, parent), weight);
    size += weight * node_.size[index(parent)];
  }
  labels_.push_back(std::move(label));
  parcels_.emplace_back();
  node_.mass.push_back(0.0);
  node_.jacobian.push_back(1.0);
  node_.density.push_back(node_.density[index(parents.front().first)]);
  node_.size.push_back(size);
  node_.held.push_back(0);
  if (!node_.broken.empty()) {
    double broken = 0.0;
    for (const auto& [parent, weight] : parents) broken += weight * node_.broken[index(parent)];
    node_.broken.push_back(broken);
  }
  next_.push_back(-1);
  previous_.push_back(-1);
  piece_.push_back(-1);
  old_of_.push_back(-1);
  return made;
}

std::int32_t WorkingCloud::insert_between(std::int32_t a, std::int32_t b, bool on_boundary, double place) {
  const Vec2 x = (1.0 - place) * cloud_.position[index(a)] + place * cloud_.position[index(b)];
  const std::int32_t made = append(x, {{a, 1.0 - place}, {b, place}});
  if (on_boundary) {
    next_[index(a)] = made;
    next_[index(made)] = b;
    previous_[index(b)] = made;
    previous_[index(made)] = a;
    piece_[index(made)] = piece_[index(a)];
  }
  return made;
}

std::int32_t WorkingCloud::insert_at(const Vec2& x, const std::array<std::int32_t, 3>& corner,
                                     const std::array<double, 3>& weight) {
  return append(x, {{corner[0], weight[0]}, {corner[1], weight[1]}, {corner[2], weight[2]}});
}

void WorkingCloud::promote(std::int32_t node, std::int32_t a, const Vec2& x) {
  const std::int32_t b = next_[index(a)];
  cloud_.position[index(node)] = x;
  next_[index(a)] = previous_[index(b)] = node;
  next_[index(node)] = b;
  previous_[index(node)] = a;
  piece_[index(node)] = piece_[index(a)];
}

bool WorkingCloud::ends_piece(std::int32_t i) const {
  if (!on_boundary(i)) return false;
  const std::int32_t before = previous_[index(i)], entering = piece_[index(before)],
                     leaving = piece_[index(i)];
  if (entering == leaving) return false;
  if (leaving == free_piece_) return piece_[index(previous_[index(before)])] != entering;
  if (entering == free_piece_) return piece_[index(next_[index(i)])] != leaving;
  return true;
}

void WorkingCloud::bypass(std::int32_t node) {
  const std::int32_t a = previous_[index(node)], b = next_[index(node)];
  if (piece_[index(node)] == free_piece_) piece_[index(a)] = free_piece_;
  next_[index(a)] = b;
  previous_[index(b)] = a;
  for (std::int32_t& start : loop_)
    if (start == node) start = b;
  next_[index(node)] = previous_[index(node)] = piece_[index(node)] = -1;
}

std::vector<std::array<std::int32_t, 2>> WorkingCloud::open(std::span<const std::int32_t> path,
                                                            std::int32_t piece, double gap) {
  const auto at = [&](std::int32_t i) -> Vec2& { return cloud_.position[index(i)]; };
  const auto link = [&](std::int32_t a, std::int32_t b, std::int32_t of_piece) {
    next_[index(a)] = b;
    previous_[index(b)] = a;
    piece_[index(a)] = of_piece;
  };
  const std::int32_t first = path.front(), last = path.back();
  const std::int32_t after_first = next(first), before_last = previous(last);
  const std::int32_t piece_first = piece_[index(first)], piece_last = piece_[index(before_last)];
  // ends part along the boundary, so that they stay on it
  const auto towards = [&](std::int32_t from, std::int32_t to) {
    return Vec2(0.5 * gap * (at(to) - at(from)).normalized());
  };
  std::vector<Vec2> left(path.size()), right(path.size());
  left.front() = towards(first, previous(first));
  right.front() = towards(first, after_first);
  left.back() = towards(last, next(last));
  right.back() = towards(last, before_last);
  for (std::size_t k = 1; k + 1 < path.size(); ++k) {
    left[k] = 0.5 * gap * left_normal((at(path[k + 1]) - at(path[k - 1])).normalized());
    right[k] = -left[k];
  }
  std::vector<std::array<std::int32_t, 2>> doubled;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const std::int32_t made = append(at(path[k]) + right[k], {{path[k], 1.0}});
    at(path[k]) += left[k];
    node_.held[index(made)] = node_.held[index(path[k])];
    doubled.push_back({path[k], made});
  }
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    link(path[k], path[k + 1], piece);
    link(doubled[k + 1][1], doubled[k][1], piece);
  }
  link(doubled.front()[1], after_first, piece_first);
  link(before_last, doubled.back()[1], piece_last);
  renew_loops();
  return doubled;
}

void WorkingCloud::renew_loops() {
  loop_.clear();
  std::vector<char> seen(size(), 0);
  for (std::size_t i = 0; i < size(); ++i) {
    if (next_[i] < 0 || seen[i]) continue;
    loop_.push_back(static_cast<std::int32_t>(i));
    for (auto k = static_cast<std::int32_t>(i); !seen[index(k)]; k = next_[index(k)]) seen[index(k)] = 1;
  }
}

void WorkingCloud::move(const std::vector<Parcel>& parcels) {
  std::vector<std::pair<std::int32_t, double>> left; // donor and what has left it
  for (const Parcel& parcel : parcels) {
    const std::size_t from = index(parcel.from), to = index(parcel.to);
    const double mass = parcel.fraction * node_.mass[from];
    const double total = node_.mass[to] + mass;
    node_.jacobian[to] = (node_.jacobian[to] * node_.mass[to] + node_.jacobian[from] * mass) / total;
    node_.mass[to] = total;
    add(row(parcels_, parcel.to), row(parcels_, parcel.from), parcel.fraction);
    left.emplace_back(parcel.from, parcel.fraction);
  }
  std::stable_sort(left.begin(), left.end(), [](auto& a, auto& b) { return a.first < b.first; });
  for (std::size_t k = 0; k < left.size();) {
    const std::size_t from = index(left[k].first);
    double gone = 0.0;
    for (; k < left.size() && index(left[k].first) == from; ++k) gone += left[k].second;
    node_.mass[from] *= 1.0 - gone;
    for (auto& entry : row(parcels_, static_cast<std::int32_t>(from))) entry.second *= 1.0 - gone;
  }
}

void WorkingCloud::move_now(std::int32_t from, std::int32_t to, double fraction) {
  move({{from, to, fraction}});
}

std::vector<std::int32_t> WorkingCloud::drop(const std::vector<char>& gone) {
  std::vector<std::int32_t> number(size(), -1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < gone.size(); ++i)
    if (!gone[i]) number[i] = static_cast<std::int32_t>(kept++);
  const auto compact = [&](auto& list) {
    for (std::size_t i = 0; i < gone.size(); ++i)
      if (!gone[i] && index(number[i]) != i) list[index(number[i])] = std::move(list[i]);
    list.resize(kept);
  };
  const auto rename = [&](std::int32_t& i) { i = i < 0 ? -1 : number[index(i)]; };
  compact(cloud_.position);
  compact(node_.mass);
  compact(node_.jacobian);
  compact(node_.density);
  compact(node_.size);
  compact(node_.held);
  if (!node_.broken.empty()) compact(node_.broken);
  compact(next_);
  compact(previous_);
  compact(piece_);
  compact(old_of_);
  compact(parcels_);
  compact(labels_);
  for (auto* list : {&next_, &previous_, &loop_})
    for (std::int32_t& i : *list) rename(i);
  return number;
}

void WorkingCloud::refresh_facets() {
  cloud_.facets.clear();
  for (const std::int32_t start : loop_) {
    std::int32_t i = start;
    do {
      cloud_.facets.push_back({{i, next_[index(i)]}, piece_[index(i)]});
      i = next_[index(i)];
    } while (i != start);
  }
}

NodeRows WorkingCloud::in_order(std::vector<Row>& rows, const std::vector<std::int32_t>& order) {
  NodeRows result;
  result.begin.reserve(order.size() + 1);
  result.begin.push_back(0);
  for (const std::int32_t i : order) {
    for (const auto& [node, weight] : row(rows, i)) {
      result.node.push_back(node);
      result.weight.push_back(weight);
    }
    result.begin.push_back(static_cast<std::int32_t>(result.node.size()));
  }
  return result;
}

Resampling<2> WorkingCloud::finish() {
  Resampling<2> result;
  const bool same_nodes =
      size() == old_nodes_ && std::find(old_of_.begin(), old_of_.end(), -1) == old_of_.end();
  std::vector<std::int32_t> order(size());
  std::iota(order.begin(), order.end(), 0);
  if (!same_nodes) order = voronoi::hilbert_order(cloud_.position);
  result.cloud = voronoi::renumber(cloud_, order);
  result.parcels = in_order(parcels_, order);
  result.labels = in_order(labels_, order);
  result.new_of.assign(old_nodes_, -1);
  result.old_of.resize(size());
  for (std::size_t p = 0; p < order.size(); ++p) {
    result.old_of[p] = old_of_[index(order[p])];
    if (result.old_of[p] >= 0) result.new_of[index(result.old_of[p])] = static_cast<std::int32_t>(p);
  }
  return result;
}

} // namespace cnem::adapt
