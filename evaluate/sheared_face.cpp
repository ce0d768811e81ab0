#include "evaluate/sheared_face.hpp"

#include "evaluate/face_walk.hpp"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <numbers>

namespace cnem::evaluate {

namespace {

constexpr double touch = 0.01; ///< of the thickness: less than this is no draw-in

constexpr double beside = 0.6; ///< of the width of a body: no further than this is beside one of its faces

constexpr double bent =
    0.1; ///< rad within the length that a straight edge is laid on: a twentieth of it in height

/// Where the zones of a face lie on its walk.
class Face {
public:
  Face(const FaceOutline& outline, const FaceRules& rules) : rules_(rules), step_(rules.smoothing / 8.0) {
    walk_ = walk_of(outline, rules, face_.parted);
    face_.thickness = rules.thickness;
    if (std::abs(rules.turn) > steep) turn_ = face_.tilt = rules.turn;
    if (turn_ != 0.0 && std::isfinite(rules.limit)) { // the edge of the tool is nothing to its frame
      face_.parted = false;
      fail(fmt::format("the body has turned by {:.0f} degrees and is not cut through",
                       std::abs(turn_) * 180.0 / std::numbers::pi));
      return;
    }
    double low = walk_.point.front().x(), high = low;
    for (const Vec2& x : walk_.point) high = std::max(high, x.x());
    edge_ = face_.parted ? high : rules.edge;
    reach_ = std::min(rules.thickness, beside * (edge_ - low));
    width_ = edge_ - low;
    find_fracture();
    find_parallel();
    remove_tilt();
    set_plane();
    find_end();
    divide();
    judge_surface();
    if (const std::string doubt = judge_heights(); !doubt.empty()) {
      fail(doubt);
      return;
    }
    place_end();
    crop();
  }
  ShearedFace result() { return std::move(face_); }

private:
  double depth(double l) const { return walk_(l).y(); }
  bool is(std::size_t segment, FaceSurface surface) const { return walk_.surface[segment] == surface; }
  bool near(double u, double share = 1.0) const { return u >= edge_ - share * reach_; }

  /// The deepest run of fracture facets; runs that chords do not tell apart, or that the wall of a hole
  /// divides, are one.
  void find_fracture() {
    double deepest = 0.0;
    const auto of_metal = [&](std::size_t k) { return walk_.at[k] - walk_.aside[k]; };
    for (std::size_t k = 0; k < walk_.segments(); ++k) {
      if (!is(k, FaceSurface::fracture) || !near(walk_.point[k].x())) continue;
      std::size_t last = k;
      for (std::size_t m = k;
           m < walk_.segments() && of_metal(m) - of_metal(last + 1) <= 2.0 * rules_.smoothing; ++m)
        if (is(m, FaceSurface::fracture) && near(walk_.point[m].x())) last = m;
      const auto begin = walk_.point.begin();
      const auto [low, high] = std::minmax_element(
          begin + static_cast<std::ptrdiff_t>(k), begin + static_cast<std::ptrdiff_t>(last) + 2,
          [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
      if (const double size = high->y() - low->y(); size > std::max(deepest, rules_.smoothing)) {
        deepest = size;
        crack_ = true;
        crack_begin_ = walk_.at[k];
        crack_end_ = walk_.at[index_of(high - begin)]; // where the body is whole: the tip
      }
      k = last;
    }
  }

  /// Parallel to the cutting direction, which leans by −tilt in the frame of the body, to its normal, or
  /// between. What has turned further has not been cut in that position: only its normal counts.
  void find_parallel() {
    wall_ = false;
    for (double l = 0.0; l + rules_.smoothing <= walk_.length(); l += step_) {
      if (crack_ && l + rules_.smoothing > crack_begin_) break;
      const double lean = walk_.lean(l, rules_.smoothing), tilt = face_.tilt - turn_;
      if (!near(walk_(l).x()) || walk_.surface_at(l) == FaceSurface::other ||
          lean < std::min(0.0, -tilt) - rules_.parallel || lean > std::max(0.0, -tilt) + rules_.parallel)
        continue;
      wall_ = true;
      wall_begin_ = l;
      break;
    }
    surface_end_ = wall_ ? wall_begin_ : crack_ ? crack_begin_ : walk_.length();
  }

  /// The line through the drawn-in surface between two distances from the face.
  Line surface(double far, double close) const {
    return fitted(walk_, 0.0, surface_end_,
                  [&](const Vec2& x) { return x.x() >= edge_ - far && x.x() <= edge_ - close; });
  }

  /// Turns the walk so that the surface beside the cut lies level.
  void remove_tilt() {
    if (rules_.fixed) return;
    const Line line =
        rules_.whole_surface ? surface(0.75 * width_, 0.25 * width_) : surface(1.5 * reach_, 0.5 * reach_);
    if (line.length < 0.25 * reach_) return;
    const double tilt = std::atan(line.slope);
    face_.tilt = turn_ + tilt;
    const Vec2 pivot = walk_(surface_end_);
    for (Vec2& x : walk_.point) x = pivot + turned_back(x - pivot, tilt);
    find_parallel(); // in the frame of the body
  }

  /// Says where the surface that a skeleton is measured from is not straight.
  void judge_surface() {
    if (rules_.whole_surface) return;
    const Line beyond = surface(1.5 * reach_, reach_), here = surface(reach_, 0.5 * reach_);
    if (std::min(beyond.length, here.length) < 0.25 * reach_) return;
    // their middles are half a reach apart
    const double turn = 2.0 * std::abs(std::atan(here.slope) - std::atan(beyond.slope));
    if (turn < bent) return;
    add_note(fmt::format("the surface beside the face is bent, by {:.0f} degrees within {:.3g} mm: "
                         "heights and angle depend on where the straight edge is laid",
                         turn * 180.0 / std::numbers::pi, 1e3 * reach_));
  }

  /// A straight edge laid on the drawn-in surface.
  void set_plane() {
    double plane = depth(surface_end_);
    for (std::size_t k = 0; k < walk_.point.size() && walk_.at[k] <= surface_end_; ++k)
      if (near(walk_.point[k].x())) plane = std::min(plane, walk_.point[k].y());
    for (Vec2& x : walk_.point) x.y() -= plane;
  }

  void find_end() {
    // The wall ends where it turns away.
    wall_end_ = crack_ ? crack_begin_ : walk_.length();
    if (wall_)
      for (double l = wall_begin_; l + rules_.smoothing < wall_end_; l += step_)
        if (std::abs(walk_.lean(l, 2.0 * rules_.smoothing)) > 0.25 * std::numbers::pi) {
          wall_end_ = std::min(wall_end_, l + rules_.smoothing);
          break;
        }
    if (!face_.parted) {
      end_ = crack_ ? crack_end_ : wall_end_;
      return;
    }
    end_ = surface_end_;
    for (std::size_t k = 0; k < walk_.point.size(); ++k)
      if (walk_.at[k] >= surface_end_ && near(walk_.point[k].x(), 0.5) && walk_.point[k].y() > depth(end_))
        end_ = walk_.at[k];
    double length = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < walk_.segments(); ++k) {
      const Vec2 middle = 0.5 * (walk_.point[k] + walk_.point[k + 1]);
      if (walk_.at[k] < end_ || !near(middle.x()) || near(middle.x(), 0.5)) continue;
      const double l = walk_.at[k + 1] - walk_.at[k];
      length += l;
      sum += l * middle.y();
    }
    other_side_ = length > 0.0 ? sum / length : rules_.thickness;
  }

  /// Greatest depth between two places.
  double deepest(double from, double to) const {
    double most = std::max(depth(from), depth(to));
    for (std::size_t k = 0; k < walk_.point.size(); ++k)
      if (walk_.at[k] >= from && walk_.at[k] <= to) most = std::max(most, walk_.point[k].y());
    return most;
  }

  /// How much of the depth between two places, down to a level, is broken metal and other surface.
  struct Part {
    double broken = 0.0, other = 0.0;
  };
  Part part(double from, double to, double level) const {
    Part sum;
    double reached = depth(from);
    for (std::size_t k = 0; k < walk_.segments(); ++k) {
      if (walk_.at[k + 1] <= from || walk_.at[k] >= to) continue;
      const double deeper = std::min(depth(std::min(walk_.at[k + 1], to)), level) - reached;
      if (!(deeper > 0.0)) continue;
      reached += deeper;
      if (is(k, FaceSurface::broken)) sum.broken += deeper;
      if (is(k, FaceSurface::other)) sum.other += deeper;
    }
    return sum;
  }

  /// Takes what is not sheared metal out of the heights.
  void tell_apart(double all) {
    const double smooth_end = crack_ ? crack_begin_ : wall_end_;
    const auto take = [&](double& height, double from, double to, bool broken) {
      const Part found = part(from, to, std::min(all, depth(from) + height));
      height -= found.other + (broken ? found.broken : 0.0);
      face_.hole += found.other;
      if (broken) face_.broken += found.broken;
    };
    take(face_.burnish, surface_end_, smooth_end, true);
    if (crack_) take(face_.fracture, crack_begin_, crack_end_, false);
    if (face_.parted && face_.second_burnish > 0.0)
      take(face_.second_burnish, crack_ ? crack_end_ : wall_end_, end_, true);
    if (face_.hole > 0.0)
      add_note(fmt::format("a hole lies in the face: {:.0f}% of the thickness are its wall",
                           100.0 * face_.hole / rules_.thickness));
  }

  void add_note(const std::string& text) { face_.note += (face_.note.empty() ? "" : "; ") + text; }

  /// Leaves no numbers behind.
  void fail(const std::string& why) {
    ShearedFace nothing;
    nothing.parted = face_.parted;
    nothing.thickness = face_.thickness;
    nothing.tilt = face_.tilt;
    nothing.measured = false;
    nothing.note = "cannot be measured: " + why;
    face_ = std::move(nothing);
  }

  /// Why the heights cannot be those of a face; "" when they can.
  std::string judge_heights() const {
    constexpr double wrong = 0.4; // of the thickness
    const double t = rules_.thickness;
    if (face_.parted && (wall_ || crack_) && std::abs(other_side_ - t) > wrong * t)
      return fmt::format("its two surfaces are {:.2g} thicknesses of the sheet apart", other_side_ / t);
    if (face_.rollover > t * (1.0 + wrong))
      return fmt::format("its edge would be drawn in by {:.2g} thicknesses", face_.rollover / t);
    if (face_.burr > wrong * t) return fmt::format("its burr would be {:.2g} thicknesses", face_.burr / t);
    return "";
  }

  /// A face without a burr ends where it comes down to the other surface, wherever the deepest point of that
  /// lies.
  void place_end() {
    if (!face_.parted || face_.burr > touch * rules_.thickness) return;
    for (std::size_t k = 0; k < walk_.point.size() && walk_.at[k] < end_; ++k)
      if (walk_.at[k] >= std::max(surface_end_, crack_ ? crack_end_ : 0.0) &&
          walk_.point[k].y() >= other_side_ - touch * rules_.thickness) {
        const auto goes_on = [&](const Vec2& a, const Vec2& b) {
          return b.y() - a.y() > std::abs(b.x() - a.x());
        };
        while (k + 1 < walk_.point.size() && goes_on(walk_.point[k], walk_.point[k + 1])) ++k;
        end_ = std::min(end_, walk_.at[k]);
        return;
      }
  }

  void divide() {
    const double all = face_.parted ? other_side_ : INFINITY;
    if (!wall_ && !crack_) {
      double most = 0.0;
      for (const Vec2& x : walk_.point)
        if (near(x.x())) most = std::max(most, x.y());
      if (face_.parted || most < touch * rules_.thickness) {
        face_.note = face_.parted
                         ? "no part of the face is parallel to the cutting direction or fractured"
                         : fmt::format("no cut yet: the surface is drawn in by {:.2g}% of the thickness",
                                       100.0 * most / rules_.thickness);
        return;
      }
      face_.rollover = most;
      face_.note = "drawn in only: no part of the face is parallel to the cutting direction yet";
      return;
    }
    face_.rollover = std::min(depth(surface_end_), all);
    const double wall = wall_ ? deepest(wall_begin_, wall_end_) : face_.rollover;
    face_.burnish = std::max(0.0, std::min(crack_ ? depth(crack_begin_) : wall, all) - face_.rollover);
    double reached = face_.rollover + face_.burnish;
    if (crack_) {
      const double to = depth(crack_end_);
      face_.fracture = std::max(0.0, (to > all - rules_.smoothing ? all : to) - reached);
      if (!face_.parted) face_.fracture = std::max(0.0, to - reached);
      reached += face_.fracture;
      face_.fracture_angle = angle_of_fracture(all);
    }
    if (face_.parted) {
      constexpr double rounding = 1e-9; // of the thickness
      face_.second_burnish = all - reached > rounding * rules_.thickness ? all - reached : 0.0;
      if (!crack_ && face_.second_burnish < rules_.smoothing) {
        face_.burnish += face_.second_burnish;
        face_.second_burnish = 0.0;
      }
      face_.burr = std::max(0.0, depth(end_) - all);
    } else {
      face_.note = "not cut through: heights so far";
    }
    tell_apart(all);
    double l = surface_end_;
    while (l > 0.0 && depth(l) > touch * rules_.thickness && near(walk_(l).x())) l -= step_;
    rollover_begin_ = std::max(0.0, l);
    face_.rollover_width = walk_(surface_end_).x() - walk_(rollover_begin_).x();
  }

  /// Of the line with the least squares of distances, by length.
  double angle_of_fracture(double all) const {
    double length = 0.0;
    Vec2 mean = Vec2::Zero();
    Mat2 moment = Mat2::Zero();
    for (std::size_t k = 0; k < walk_.segments(); ++k) {
      const Vec2 &a = walk_.point[k], &b = walk_.point[k + 1];
      if (walk_.at[k] < crack_begin_ || walk_.at[k + 1] > crack_end_ + 1e-12 * walk_.length() ||
          b.y() > all + rules_.smoothing)
        continue;
      const Vec2 middle = 0.5 * (a + b), d = b - a;
      const double l = d.norm();
      length += l;
      mean += l * middle;
      moment += l * (middle * middle.transpose() + d * d.transpose() / 12.0);
    }
    if (!(length > 0.0)) return NAN;
    mean /= length;
    const Eigen::SelfAdjointEigenSolver<Mat2> axes(moment / length - mean * mean.transpose());
    Vec2 along = axes.eigenvectors().col(1);
    if (along.y() < 0.0) along = -along;
    return std::atan2(-along.x(), along.y());
  }

  Zone zone_at(double l) const {
    if (!wall_ && !crack_)
      return l >= rollover_begin_ && face_.rollover > 0.0 ? Zone::rollover : Zone::surface;
    if (l < rollover_begin_) return Zone::surface;
    if (l < surface_end_) return Zone::rollover;
    const double w = depth(l), all = face_.parted ? other_side_ : INFINITY;
    if (l > end_)
      return face_.parted ? (w > all + touch * rules_.thickness ? Zone::burr : Zone::burr_side)
                          : Zone::surface;
    if (w > all) return Zone::burr;
    const FaceSurface surface = walk_.surface_at(l);
    if (surface == FaceSurface::other) return Zone::hole;
    if (crack_ && l >= crack_begin_ && l <= crack_end_) return Zone::fracture;
    if (surface == FaceSurface::broken) return Zone::broken;
    return l < crack_begin_ || (!crack_ && l <= wall_end_) ? Zone::burnish : Zone::second_burnish;
  }

  /// Keeps what lies beside the cut, with a point wherever the zone changes.
  void crop() {
    if (!wall_ && !crack_) {
      rollover_begin_ = walk_.length();
      for (int k = 0; k * step_ < walk_.length(); ++k)
        if (near(walk_(k * step_).x()) && depth(k * step_) > touch * rules_.thickness) {
          rollover_begin_ = k * step_;
          break;
        }
    }
    std::vector<double> places = walk_.at;
    for (const double l : {rollover_begin_, surface_end_, wall_end_, crack_begin_, crack_end_, end_})
      if (l > 0.0 && l < walk_.length()) places.push_back(l);
    if (face_.parted)
      for (std::size_t k = 0; k < walk_.segments(); ++k) { // where a burr begins
        const double a = depth(walk_.at[k]) - other_side_, b = depth(walk_.at[k + 1]) - other_side_;
        if (a < 0.0 && b > 0.0) places.push_back(walk_.at[k] + a / (a - b) * (walk_.at[k + 1] - walk_.at[k]));
      }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    for (std::size_t k = 0; k + 1 < places.size(); ++k) {
      const Vec2 a = walk_(places[k]), b = walk_(places[k + 1]);
      if (!near(a.x()) || !near(b.x())) {
        if (!face_.profile.empty()) break; // round the body and back
        continue;
      }
      if (face_.profile.empty()) face_.profile.push_back(a - Vec2(edge_, 0.0));
      face_.profile.push_back(b - Vec2(edge_, 0.0));
      face_.zone.push_back(zone_at(0.5 * (places[k] + places[k + 1])));
    }
  }

  const FaceRules& rules_;
  double step_;
  FaceWalk walk_;
  ShearedFace face_;
  double edge_ = 0.0, reach_ = 0.0, width_ = 0.0; ///< m
  double turn_ = 0.0;                             ///< rad, of the frame that a steep body is measured in
  bool crack_ = false, wall_ = false;
  // places on the walk, m
  double crack_begin_ = 0.0, crack_end_ = 0.0, wall_begin_ = 0.0, wall_end_ = 0.0, surface_end_ = 0.0,
         end_ = 0.0, rollover_begin_ = 0.0;
  double other_side_ = 0.0; ///< m, depth of the surface on the side of the burr
};

} // namespace

ShearedFace measure_face(const FaceOutline& outline, const FaceRules& rules) {
  if (outline.point.size() < 3) {
    ShearedFace face;
    face.thickness = rules.thickness;
    face.note = "the body has no outline";
    return face;
  }
  return Face(outline, rules).result();
}

} // namespace cnem::evaluate
