#include "adapt/plane/cut.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace cnem::adapt {

namespace {

/// Moves the inner nodes of a cut towards a smooth line, so that its two faces do not interlock.
void straighten(WorkingCloud& work, std::span<const NodeIndex> path, double most) {
  constexpr int sweeps = 10;
  std::vector<Vec2> place;
  for (const NodeIndex i : path) place.push_back(work.cloud().position[i]);
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t k = 1; k + 1 < path.size(); ++k) {
      const Vec2& start = work.cloud().position[path[k]];
      const Vec2 moved = 0.5 * place[k] + 0.25 * (place[k - 1] + place[k + 1]) - start;
      const double limit = most * work.node().size[index_of(path[k])];
      place[k] = start + moved * std::min(1.0, limit / std::max(moved.norm(), 1e-300));
    }
  for (std::size_t k = 1; k + 1 < path.size(); ++k) work.place(path[k], place[k]);
}

} // namespace

BoundaryLoops::BoundaryLoops(const WorkingCloud& work)
    : loop_(work.size(), -1), along_(work.size(), 0.0), order_(work.size(), 0) {
  const IndexedVector<NodeIndex, Vec2>& at = work.cloud().position;
  const auto onwards = [&](NodeIndex i) {
    while (exists(work.facing(i))) i = work.next(work.facing(i));
    return i;
  };
  for (const NodeIndex i : work.nodes()) {
    if (!work.on_boundary(i) || exists(work.facing(i)) || loop_[i] >= 0) continue;
    double length = 0.0;
    int nodes = 0;
    for (NodeIndex k = i; loop_[k] < 0; k = onwards(work.next(k))) {
      loop_[k] = as<std::int32_t>(length_.size());
      along_[index_of(k)] = length;
      order_[k] = nodes++;
      length += (at[work.next(k)] - at[k]).norm();
    }
    length_.push_back(length);
    nodes_.push_back(nodes);
  }
}

bool BoundaryLoops::parts(NodeIndex from, NodeIndex to, double length, int nodes) const {
  if (loop_[from] != loop_[to]) return true;
  const auto loop = index_of(loop_[from]);
  const double one = std::abs(along_[index_of(from)] - along_[index_of(to)]);
  const int some = std::abs(order_[from] - order_[to]);
  return std::min(one, length_[loop] - one) >= length && std::min(some, nodes_[loop] - some) > nodes;
}

namespace {

/// Sets the two sides of an opened cut apart where it goes on from a node to its mate.
void part_crossing(WorkingCloud& work, const Path& path, const Path& onwards, NodeIndex right,
                   NodeIndex right_mate, double gap) {
  const auto at = [&](NodeIndex i) -> const Vec2& { return work.cloud().position[i]; };
  // of a period the ends are far apart
  const Vec2 in = at(path.back()) - at(path[path.size() - 2]), out = at(onwards[1]) - at(onwards.front());
  const Vec2 left = 0.5 * gap * left_normal((in + out).normalized());
  for (const NodeIndex i : {path.back(), onwards.front()}) work.place(i, at(i) + left);
  for (const NodeIndex i : {right, right_mate}) work.place(i, at(i) - left);
}

} // namespace

bool open_cut(WorkingCloud& work, Structure& structure, std::span<const Path> paths, const SplitRules& rules,
              double smoothed) {
  WorkingCloud opened = work;
  std::vector<std::array<NodeIndex, 2>> doubled;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const Path& path = paths[k];
    straighten(opened, path, smoothed);
    const double gap = rules.gap * work.size_between(path.front(), path.back());
    const auto pairs = opened.open(path, rules.piece, gap);
    if (k > 0) part_crossing(opened, paths[k - 1], path, doubled.back()[1], pairs.front()[1], gap);
    doubled.insert(doubled.end(), pairs.begin(), pairs.end());
  }
  opened.refresh_facets();
  std::optional<Structure> after = structure_if_valid(opened.cloud(), structure.space);
  if (!after) return false;
  for (const auto& [old, made] : doubled) {
    const double mine = after->volume(old), other = after->volume(made);
    opened.move_now(old, made, other / (mine + other));
  }
  work = std::move(opened);
  structure = std::move(*after);
  return true;
}

bool open_cut(WorkingCloud& work, Structure& structure, std::span<const Path> paths, const SplitRules& rules,
              PassReport& report) {
  if (!open_cut(work, structure, paths, rules, rules.smoothed) &&
      !open_cut(work, structure, paths, rules, 0.0)) {
    ++report.undone;
    return false;
  }
  for (const Path& path : paths) report.opened += static_cast<int>(path.size()) - 1;
  return true;
}

bool shaves(const WorkingCloud& work, NodeIndex from, NodeIndex to, const SplitRules& rules) {
  const double steepest = std::cos(rules.least_angle * std::numbers::pi / 180.0);
  const auto cosine = [&](NodeIndex beside) {
    const auto& at = work.cloud().position;
    const Vec2 a = at[to] - at[from], b = at[beside] - at[from];
    return a.dot(b) / (a.norm() * b.norm());
  };
  return std::max(cosine(work.next(from)), cosine(work.previous(from))) > steepest;
}

} // namespace cnem::adapt
