#pragma once
// What each pass of a milling run took, and which forces it bore.
#include "machining/milling_process.hpp"
#include "results/status.hpp"

#include <vector>

namespace cnem::app {

class PassRecords {
public:
  /// A step that the process has just made. Nothing of a run without passes.
  void add(const machining::MillingProcess& process, const machining::ProcessStep& step);
  /// Metrics of each pass, "milling.pass_1.depth" and the like.
  void tell(const machining::ToolMotion& motion, results::RunStatus& status) const;
  /// m over its tip, how deep along the axis the pass cut that cut the deepest; its number, from 0.
  struct Deepest {
    std::size_t pass = 0;
    double depth = 0.0;
  };
  Deepest deepest() const;
  void archive(Archive& archive);

private:
  /// m, up to the highest layer of which a pass has taken a share of what it took of another.
  static double depth_of(const machining::MillingProcess& process, const std::vector<double>& before);

  // [pass] the largest of a pass, and sums of it
  std::vector<double> Fx_, Fy_, Fz_, torque_, thickest_, removed_, depth_;
  std::vector<double> before_; ///< [layer] m², when the pass began
};

} // namespace cnem::app
