#include "adapt/cut.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cnem::adapt {

namespace {

/// Moves the inner nodes of a cut towards a smooth line, so that its two faces do not interlock.
void straighten(WorkingCloud& work, std::span<const std::int32_t> path, double most) {
  constexpr int sweeps = 10;
  std::vector<Vec2> place;
  for (const std::int32_t i : path) place.push_back(work.cloud().position[u(i)]);
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t k = 1; k + 1 < path.size(); ++k) {
      const Vec2& start = work.cloud().position[u(path[k])];
      const Vec2 moved = 0.5 * place[k] + 0.25 * (place[k - 1] + place[k + 1]) - start;
      const double limit = most * work.node().size[u(path[k])];
      place[k] = start + moved * std::min(1.0, limit / std::max(moved.norm(), 1e-300));
    }
  for (std::size_t k = 1; k + 1 < path.size(); ++k) work.place(path[k], place[k]);
}

} // namespace

BoundaryLoops::BoundaryLoops(const WorkingCloud& work)
    : loop_(work.size(), -1), along_(work.size(), 0.0), order_(work.size(), 0) {
  const std::vector<Vec2>& at = work.cloud().position;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(work.size()); ++i) {
    if (!work.on_boundary(i) || loop_[u(i)] >= 0) continue;
    double length = 0.0;
    int nodes = 0;
    for (std::int32_t k = i; loop_[u(k)] < 0; k = work.next(k)) {
      loop_[u(k)] = static_cast<std::int32_t>(length_.size());
      along_[u(k)] = length;
      order_[u(k)] = nodes++;
      length += (at[u(work.next(k))] - at[u(k)]).norm();
    }
    length_.push_back(length);
    nodes_.push_back(nodes);
  }
}

bool BoundaryLoops::parts(std::int32_t from, std::int32_t to, double length, int nodes) const {
  if (loop_[u(from)] != loop_[u(to)]) return true;
  const auto loop = u(loop_[u(from)]);
  const double one = std::abs(along_[u(from)] - along_[u(to)]);
  const int some = std::abs(order_[u(from)] - order_[u(to)]);
  return std::min(one, length_[loop] - one) >= length && std::min(some, nodes_[loop] - some) > nodes;
}

bool open_cut(WorkingCloud& work, Structure& structure, std::span<const std::int32_t> path,
              const SplitRules& rules, double smoothed) {
  WorkingCloud opened = work;
  straighten(opened, path, smoothed);
  const double gap = rules.gap * work.size_between(path.front(), path.back());
  const std::vector<std::array<std::int32_t, 2>> doubled = opened.open(path, rules.piece, gap);
  opened.refresh_facets();
  std::optional<Structure> after = structure_if_valid(opened.cloud());
  if (!after) return false;
  for (const auto& [old, made] : doubled) {
    const double mine = after->cells.volume[u(old)], other = after->cells.volume[u(made)];
    opened.move_now(old, made, other / (mine + other));
  }
  work = std::move(opened);
  structure = std::move(*after);
  return true;
}

} // namespace cnem::adapt
