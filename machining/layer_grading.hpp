#pragma once
// Where layers of the workpiece end that a cutter cuts: near each other where the angles change at which
// edges enter and leave, and where their normal turns.
#include "machining/milling_cut.hpp"

#include <vector>

namespace cnem::machining {

class LayerGrading {
public:
  /// depth: m over the tip; steps: in a turn.
  LayerGrading(const MillingCut& cut, double depth, int steps);

  /// How many it takes for edges of a layer to enter and leave at most a step, or half a degree to one, after
  /// those below: else forces come and go by a layer. Of rounded ends and rake faces also for their normal to
  /// turn by 4.5° at most in one, and for a twentieth of the depth.
  int layers() const;
  /// m over the tip, count + 1 heights from 0 to the depth: each layer takes an equal share of the changes.
  /// Fewer where several would be at one height, where angles jump, and one layer where nothing changes.
  std::vector<double> ends(int count) const;
  double thickest(int count) const; ///< m, of those layers

private:
  std::vector<double> height_;  ///< m, from 0 to the depth
  std::vector<double> changes_; ///< layers up to a height
};

} // namespace cnem::machining
