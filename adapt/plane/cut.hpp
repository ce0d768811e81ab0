#pragma once
// What cuts through broken matter have in common, whoever finds them: split, open_cracks, cut_films.
#include "adapt/plane/resample.hpp"

#include <span>
#include <vector>

namespace cnem::adapt {

/// Where boundary nodes are along the loops of the boundary; faces that are mates belong to none, and loops
/// go on beyond them.
class BoundaryLoops {
public:
  explicit BoundaryLoops(const WorkingCloud& work);
  /// Whether a cut between two boundary nodes takes off a part and no crumb or skin: each side has at least
  /// `length` (m) of the loop, and more than `nodes` nodes. Between two loops nothing comes off.
  bool parts(NodeIndex from, NodeIndex to, double length, int nodes) const;

private:
  IndexedVector<NodeIndex, std::int32_t> loop_; ///< −1: inside
  Field along_;                                 ///< [node] m
  IndexedVector<NodeIndex, int> order_;         ///< number along its loop
  Field length_;                                ///< [loop] m
  std::vector<int> nodes_;                      ///< [loop]
};

/// The edge leaves a boundary node nearly along one of its facets: by less than rules.least_angle.
bool shaves(const WorkingCloud& work, NodeIndex from, NodeIndex to, const SplitRules& rules);

/// Two boundary nodes and the interior ones between them; of a crack, the last is its tip.
using Path = std::vector<NodeIndex>;

/// Opens the cloud along paths that go on from mate to mate. Inner nodes may be moved by `smoothed` spacings
/// to straighten them. Doubled nodes share their matter by the volumes of their cells. False when the cloud
/// would have no valid structure: then nothing has changed.
bool open_cut(WorkingCloud& work, Structure& structure, std::span<const Path> paths, const SplitRules& rules,
              double smoothed);
/// The same, straightened by rules.smoothed or, where that has no valid structure, not at all; told in the
/// report.
bool open_cut(WorkingCloud& work, Structure& structure, std::span<const Path> paths, const SplitRules& rules,
              PassReport& report);

} // namespace cnem::adapt
