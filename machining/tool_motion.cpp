#include "machining/tool_motion.hpp"

#include "core/index.hpp"
#include "machining/cutter.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace cnem::machining {

ToolPath::ToolPath(std::vector<CurvePiece> pieces, double tip)
    : pieces_(std::move(pieces)), tip_(tip), begin_{0.0} {
  assert(!pieces_.empty());
  for (const CurvePiece& piece : pieces_) begin_.push_back(begin_.back() + piece.length());
}

ToolPath::Place ToolPath::at(double way) const {
  const auto after = std::upper_bound(begin_.begin() + 1, begin_.end() - 1, way);
  const auto k = index_of(after - begin_.begin() - 1);
  const double share = std::clamp((way - begin_[k]) / (begin_[k + 1] - begin_[k]), 0.0, 1.0);
  return {pieces_[k].point(share), pieces_[k].tangent(share)};
}

ToolMotion::ToolMotion(double speed, double feed_speed, int steps, double start, double length, double dwell)
    : steps_(steps), dt_(full_turn / speed / steps), feed_of_turn_(feed_speed * full_turn / speed),
      start_(start), length_(length), fed_(length / feed_speed / dt_),
      duration_(length / feed_speed + dwell * full_turn / speed) {
  passes_.push_back({0, static_cast<std::int64_t>(std::ceil(duration_ / dt_))});
}

ToolMotion::ToolMotion(double speed, double feed_speed, int steps, std::vector<ToolPath> passes, double dwell,
                       const std::optional<DriveTables>& drive, std::size_t teeth)
    : steps_(steps), dt_(full_turn / speed / steps), feed_of_turn_(feed_speed * full_turn / speed),
      path_(std::move(passes)) {
  assert(!path_.empty());
  std::vector<double> lengths;
  for (const ToolPath& path : path_) lengths.push_back(path.length());
  plan(lengths, dwell, drive, teeth);
}

ToolMotion::ToolMotion(double speed, double feed_speed, int steps, double start, double length, double dwell,
                       const DriveTables& drive, std::size_t teeth)
    : ToolMotion(speed, feed_speed, steps, start, length, dwell) {
  passes_.clear();
  plan({length}, dwell, drive, teeth);
}

void ToolMotion::plan(const std::vector<double>& lengths, double dwell,
                      const std::optional<DriveTables>& drive, std::size_t teeth) {
  // Time and way at the begins of steps, as far as they are needed.
  const double angle = full_turn / steps_, feed_of_step = feed_of_turn_ / steps_;
  double time = 0.0, way = 0.0;
  if (drive) {
    time_ = {0.0};
    way_ = {0.0};
  }
  const auto next = [&](bool fed) {
    if (!drive) {
      time += dt_;
      way += fed ? feed_of_step : 0.0;
      return;
    }
    // The angle is the integral of the speed, piecewise quadratic in time: Newton from the speed that is.
    const double turned = drive->speed.integral(time) + angle;
    double end = time + angle / drive->speed(time);
    constexpr int most = 50;
    for (int k = 0; k < most; ++k) {
      const double change = (turned - drive->speed.integral(end)) / drive->speed(end);
      end += change;
      if (std::abs(change) < 1e-14 * end) break;
    }
    const auto feed_speed = [&](double t) {
      return drive->feed(t) * static_cast<double>(teeth) * drive->speed(t) / full_turn;
    };
    if (fed)
      way += (end - time) / 6.0 *
             (feed_speed(time) + 4.0 * feed_speed(0.5 * (time + end)) + feed_speed(end)); // Simpson
    time = end;
    time_.push_back(time);
    way_.push_back(way);
  };
  std::int64_t step = 0;
  for (const double length : lengths) {
    Pass pass{.begin = step, .end = step};
    if (!drive) way = 0.0; // steps of a pass do not depend on those before it, to the last bit
    const double begin = way;
    constexpr double whole = 1.0 - 1e-12;
    while (way - begin < whole * length) {
      next(true);
      ++step;
    }
    pass.end = step;
    passes_.push_back(pass);
  }
  fed_ = static_cast<double>(step);
  for (double turned = 0.0; turned < dwell * steps_ - 1e-9; turned += 1.0) {
    next(false);
    ++step;
  }
  passes_.back().end = step;
  duration_ = drive ? time : static_cast<double>(step) * dt_;
}

std::size_t ToolMotion::pass_of(std::int64_t step) const {
  std::size_t pass = 0;
  while (pass + 1 < passes_.size() && step >= passes_[pass].end) ++pass;
  return pass;
}

double ToolMotion::way(double at) const {
  if (way_.empty()) return feed_of_turn_ * (at / steps_);
  const double last = static_cast<double>(way_.size()) - 1.0;
  const double before = std::clamp(std::floor(at), 0.0, last);
  const auto k = static_cast<std::size_t>(before);
  return k + 1 < way_.size() ? way_[k] + (at - before) * (way_[k + 1] - way_[k]) : way_[k];
}

ToolPath::Place ToolMotion::place(std::size_t pass, double at) const {
  if (path_.empty()) return {Vec2(start_ + std::min(way(at), length_), 0.0), Vec2::UnitX()};
  return path_[pass].at(way_of(pass, at));
}

double ToolMotion::way_of(std::size_t pass, double at) const {
  const double begin = static_cast<double>(passes_[pass].begin);
  return way_.empty() ? way(at - begin) : way(at) - way(begin);
}

} // namespace cnem::machining
