// Short facets between two nodes that stay: what cuts and flow have left of a piece of the boundary.
#include "adapt/plane/resample.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace cnem::adapt {

void join_ends(WorkingCloud& work, Structure& structure, PassReport& report) {
  constexpr double shortest = 0.05; // of the spacing
  const auto& at = work.cloud().position;
  std::map<PieceIndex, int> facets;
  for (const NodeIndex i : work.nodes())
    if (work.on_boundary(i)) ++facets[work.piece(i)];
  IndexedVector<NodeIndex, char> gone(work.size(), 0);
  WorkingCloud joined = work;
  int count = 0;
  for (const NodeIndex a : work.nodes()) {
    if (!joined.on_boundary(a)) continue;
    const NodeIndex b = joined.next(a);
    if ((at[b] - at[a]).norm() >= shortest * work.size_between(a, b) || !joined.stays(a) ||
        !joined.stays(b) || joined.has_mates(a) || joined.has_mates(b) || joined.next(joined.next(b)) == a)
      continue;
    int& left = facets[joined.piece(a)];
    if (left == 1) continue;
    --left;
    joined.move_now(a, b, 1.0);
    joined.bypass(a);
    gone[a] = 1;
    ++count;
  }
  if (count == 0) return;
  joined.drop(gone);
  joined.refresh_facets();
  std::optional<Structure> after = structure_if_valid(joined.cloud(), structure.space);
  if (!after) {
    ++report.undone;
    return;
  }
  work = std::move(joined);
  structure = std::move(*after);
  report.removed_boundary += count;
}

} // namespace cnem::adapt
