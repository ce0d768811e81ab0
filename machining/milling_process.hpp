#pragma once
// Milling in the time domain: teeth sweep through dexels, what they remove makes forces, forces make the
// modes swing (paper 004, section 3.2 and 3.3: (5), (6)).
#include "machining/dexels.hpp"
#include "machining/milling_cut.hpp"
#include "machining/mode.hpp"

#include <vector>

namespace cnem::machining {

struct ProcessSettings {
  double spindle = 0.0;      ///< rad/s
  double axial_depth = 0.0;  ///< m
  double length = 0.0;       ///< m, of the path of the cutter's axis along +x
  bool from_outside = false; ///< it begins beside the workpiece, not in the middle of a cut
  double pitch = 0.0;        ///< m, of dexels
  int layers = 1;            ///< along the axis
  int steps = 0;             ///< in a turn
};

/// Means over a step; forces on the tool.
struct ProcessStep {
  double time = 0.0;                ///< s, at the middle
  double angle = 0.0;               ///< rad, of the tip of tooth 0 there
  Vec3 force = Vec3::Zero();        ///< N
  double torque = 0.0;              ///< N m, against the spindle
  double power = 0.0;               ///< W, of the edges along their own paths
  double removed = 0.0;             ///< m³
  double thickest = 0.0;            ///< m, chip
  Vec3 displacement = Vec3::Zero(); ///< m, of the tool relative to the part, at the end
};

class MillingProcess {
public:
  MillingProcess(MillingCut cut, std::vector<Mode> modes, const ProcessSettings& settings);

  bool at_end() const;
  /// Makes a step: edges ask the dexels what they would remove until modes and forces agree, then they erase
  /// what they sweep.
  ProcessStep advance();

  double time() const { return static_cast<double>(step_) * dt_; }
  double duration() const { return settings_.length / feed_speed_; } ///< s
  double start() const { return start_; }                            ///< m, x of the axis at first
  double axis() const {
    return start_ + feed_speed_ * time();
  } ///< m, x of the cutter's axis without vibration
  const std::vector<DexelLayer>& layers() const { return layer_; }
  double height(std::size_t layer) const; ///< m, middle of it over the tip
  double volume() const;                  ///< m³ of matter
  /// m, matter that is left on the machined side beyond where the teeth pass, at a place along x; negative:
  /// too much was taken. Of the last layer's line that is nearest.
  double left_at(std::size_t layer, double x) const;
  /// m that the cutter goes on in a turn.
  double feed_of_turn() const { return feed_speed_ * full_turn / settings_.spindle; }

private:
  /// The way of an edge in this step, whose cutter is shifted at its end.
  DexelLayer::Sweep sweep(std::size_t tooth, std::size_t layer, const Vec2& shift) const;
  /// What teeth would remove and bear whose cutter is shifted at the end of the step. chips: [layer × tooth]
  /// m, of the step before, then of this one.
  ProcessStep ask(const Vec2& shift, std::vector<double>& chips) const;
  void erase(const Vec2& shift);
  Vec2 shift_of(const Eigen::MatrixXd& state) const;

  MillingCut cut_;
  std::vector<Mode> modes_;
  ProcessSettings settings_;
  double dt_ = 0.0, feed_speed_ = 0.0, start_ = 0.0, strip_ = 0.0;
  std::int64_t step_ = 0;
  std::vector<DexelLayer> layer_;
  std::vector<double> chips_; ///< [layer × tooth] m
  Eigen::MatrixXd state_;     ///< [2 × modes] (q, v/ω)
  Vec2 shift_ = Vec2::Zero(); ///< m, at the begin of the step
  Vec3 force_ = Vec3::Zero(); ///< N, of the last step
};

} // namespace cnem::machining
