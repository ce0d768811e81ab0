#pragma once
// A window on a longer workpiece, which goes with a tool: where it is to move, and by what change of the
// cloud.
#include "adapt/plane/window.hpp"
#include "input/case.hpp"
#include "input/cutting_tool.hpp"
#include "mechanics/explicit_solver.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

class MovingWindow {
public:
  /// Of a case with [adapt.window], which must outlive this object.
  explicit MovingWindow(const input::Case& input);

  enum class End { ahead, behind, chip };
  /// The change that moves an end of the window to where it belongs; empty where it is there, or the cloud
  /// cannot be changed so now. cloud: that of the solver where it is now.
  std::optional<Resampling<2>> next(End end, const ExplicitSolver<2>& solver, const Cloud<2>& cloud,
                                    const adapt::NodeProperties& node);

  /// Nodes fed in and taken off so far, and moves that could not be made when they were due.
  std::vector<std::pair<std::string, double>> metrics() const;
  void archive(Archive& archive);

private:
  /// A straight cut: what lies on the right of it goes.
  struct Cut {
    Vec2 from, to; ///< m
  };
  std::optional<Cut> behind(const Cloud<2>& cloud, const std::vector<Vec2>& place) const;
  std::optional<Cut> across_chip(const Cloud<2>& cloud, const std::vector<Vec2>& place) const;
  /// In the sense of the boundary, whichever way the frame of the tool turns.
  Cut oriented(const Vec2& from, const Vec2& to) const;

  const input::MovingWindow* rules_;
  double feed_ = 0.0; ///< m, of [report.cutting]; 0: none
  input::CuttingTool tool_;
  std::int64_t fed_ = 0, taken_off_ = 0, refused_ = 0;
};

} // namespace cnem::app
