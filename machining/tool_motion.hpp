#pragma once
// Where the axis of a cutter is: passes of straight pieces and arcs, a feed and a speed that may change with
// time.
#include "core/geometry/curve.hpp"
#include "core/time_table.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace cnem::machining {

/// Pieces end to end, in a plane across the axis of the cutter.
class ToolPath {
public:
  /// Pieces of one pass, one at least, each as long as it is not without length. tip: m, the height of the
  /// cutter's tip.
  explicit ToolPath(std::vector<CurvePiece> pieces, double tip = 0.0);

  double length() const { return begin_.back(); } ///< m
  struct Place {
    Vec2 at;    ///< m
    Vec2 along; ///< unit vector of the feed
  };
  /// way: m from the start, at which it ends at the latest.
  Place at(double way) const;
  const std::vector<CurvePiece>& pieces() const { return pieces_; }
  double tip() const { return tip_; } ///< m

private:
  std::vector<CurvePiece> pieces_;
  double tip_;
  std::vector<double> begin_; ///< m, ways at which pieces begin, and the length
};

/// Speed of the spindle, rad/s, and feed per tooth, m, over time, all > 0.
struct DriveTables {
  TimeTable speed, feed;
};

/// In steps of equal angles of the cutter. Between passes the cutter jumps.
class ToolMotion {
public:
  /// Straight along +x from `start` at a constant speed, rad/s, and feed, m/s. dwell: turns at the end
  /// without feed.
  ToolMotion(double speed, double feed_speed, int steps, double start, double length, double dwell);
  /// The same where speed and feed change; `speed` and `feed_speed` are the largest. teeth: of the cutter.
  ToolMotion(double speed, double feed_speed, int steps, double start, double length, double dwell,
             const DriveTables& drive, std::size_t teeth);
  /// Passes one after the other, with constant speed and feed where `drive` says no other.
  ToolMotion(double speed, double feed_speed, int steps, std::vector<ToolPath> passes, double dwell,
             const std::optional<DriveTables>& drive, std::size_t teeth);

  struct Pass {
    std::int64_t begin = 0, end = 0; ///< steps; the last one has the dwell behind its end
  };
  const std::vector<Pass>& passes() const { return passes_; }
  std::size_t pass_of(std::int64_t step) const;
  /// Of the axis at a time in steps, within a pass.
  ToolPath::Place place(std::size_t pass, double at) const;
  Vec2 axis(std::size_t pass, double at) const { return place(pass, at).at; }            ///< m
  double tip(std::size_t pass) const { return path_.empty() ? 0.0 : path_[pass].tip(); } ///< m

  /// s, at the begin of a step.
  double time(std::int64_t step) const {
    return time_.empty() ? static_cast<double>(step) * dt_ : time_[static_cast<std::size_t>(step)];
  }
  double dt(std::int64_t step) const { return time_.empty() ? dt_ : time(step + 1) - time(step); } ///< s
  bool steady() const { return time_.empty(); }                                ///< in its speed
  double duration() const { return time_.empty() ? duration_ : time_.back(); } ///< s
  bool at_end(std::int64_t step) const {
    return time_.empty() ? time(step) >= duration_ : step >= static_cast<std::int64_t>(time_.size()) - 1;
  }
  /// When the feed ends, in steps.
  double fed() const { return fed_; }
  /// m, the largest of a turn.
  double feed_of_turn() const { return feed_of_turn_; }
  double start() const { return start_; } ///< m, along x at first
  /// Of the last pass; none of a run straight along x.
  const ToolPath* last_path() const { return path_.empty() ? nullptr : &path_.back(); }

private:
  double way(double at) const;                      ///< m since the begin of the run, at a time in steps
  double way_of(std::size_t pass, double at) const; ///< m, of a pass
  void plan(const std::vector<double>& lengths, double dwell, const std::optional<DriveTables>& drive,
            std::size_t teeth);

  int steps_;
  double dt_, feed_of_turn_, start_ = 0.0, length_ = 0.0, fed_ = 0.0, duration_ = 0.0;
  std::vector<ToolPath> path_;
  std::vector<Pass> passes_;
  std::vector<double> time_, way_; ///< [step] s, m; where the speed or the feed change
};

} // namespace cnem::machining
