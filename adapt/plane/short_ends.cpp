// Short facets between two nodes that stay: what cuts and flow have left of a piece of the boundary.
#include "adapt/plane/apply_valid.hpp"
#include "adapt/plane/resample.hpp"
#include "core/index.hpp"

#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace cnem::adapt {

namespace {

/// A node at an end of a short facet, and the other end.
struct End {
  NodeIndex goes, stays;
};

/// m, of a point from the line through two others.
double off_line(const Vec2& x, const Vec2& a, const Vec2& b) {
  return std::abs(cross((b - a).normalized(), x - a));
}

/// Takes ends out of a cloud, but where that would be the last of a piece. Returns how many.
int take_out(WorkingCloud& work, std::span<const End> ends) {
  std::map<PieceIndex, int> facets;
  for (const NodeIndex i : work.nodes())
    if (work.on_boundary(i)) ++facets[work.piece(i)];
  IndexedVector<NodeIndex, char> gone(work.size(), 0);
  int count = 0;
  for (const auto& [node, other] : ends) {
    if (gone[node] || gone[other] || work.next(work.next(work.next(node))) == node) continue;
    const bool first = work.next(node) == other;
    if (!first && work.previous(node) != other) continue;
    const NodeIndex before = work.previous(node);
    // the free piece takes over from the facet before it
    const bool taken_over = first && work.piece(node) == work.free_piece();
    int& left = facets[work.piece(first && !taken_over ? node : before)];
    if (left == 1) continue;
    --left;
    if (!first) work.take_next_piece(before);
    work.move_now(node, other, 1.0);
    work.bypass(node);
    gone[node] = 1;
    ++count;
  }
  work.drop(gone);
  work.refresh_facets();
  return count;
}

} // namespace

void join_ends(WorkingCloud& work, Structure& structure, PassReport& report) {
  constexpr double shortest = 0.05; // of the spacing
  std::vector<End> ends;
  const auto at = [&](NodeIndex i) -> const Vec2& { return work.cloud().position[i]; };
  for (const NodeIndex a : work.nodes()) {
    if (!work.on_boundary(a)) continue;
    const NodeIndex b = work.next(a);
    if ((at(b) - at(a)).norm() >= shortest * work.size_between(a, b) || !work.stays(a) || !work.stays(b) ||
        work.has_mates(a) || work.has_mates(b))
      continue;
    // the one that bends the boundary less
    const bool first =
        off_line(at(a), at(work.previous(a)), at(b)) <= off_line(at(b), at(a), at(work.next(b)));
    ends.push_back(first ? End{a, b} : End{b, a});
  }
  report.removed_boundary += apply_valid(work, structure, std::move(ends), take_out, report);
}

} // namespace cnem::adapt
