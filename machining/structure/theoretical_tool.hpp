#pragma once
// What a tool that does not vibrate takes of a part, and when: D of paper 004, 3.3.
#include "machining/milling_process.hpp"
#include "machining/structure/part.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace cnem::machining {

/// 1 − D of the cells of a part at the ends of intervals of a milling run, D = `most` times the share of a
/// cell that dexels have lost.
class TheoreticalTool {
public:
  struct Intervals {
    std::int64_t interval = 1; ///< steps
    double most = 0.0;         ///< –
  };
  /// Makes the run. rigid: before its first step. in_cut: where a point of the part is in axes of the cut, m;
  /// what is no workpiece there stays.
  TheoreticalTool(const Part& part, MillingProcess rigid, const std::function<Vec3(const Vec3&)>& in_cut,
                  const Intervals& intervals);

  /// [cell], at the end of the interval that is over by the begin of a step.
  const std::vector<double>& presence(std::int64_t step) const;

private:
  Intervals intervals_;
  std::vector<std::vector<double>> presence_; ///< [interval][cell]
};

} // namespace cnem::machining
