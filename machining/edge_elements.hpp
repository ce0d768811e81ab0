#pragma once
// The edges of a cutter divided into elements, one for each tooth and layer, and what they bear.
#include "machining/dexels.hpp"
#include "machining/milling_cut.hpp"
#include "machining/slices.hpp"

#include <span>
#include <vector>

namespace cnem::machining {

/// Where a cutter is: the place of its axis at the height of the tip, and how far it has turned.
struct CutterPlace {
  Vec3 axis = Vec3::Zero(); ///< m
  double angle = 0.0;       ///< rad, of the tip of tooth 0
};

/// Means over a step; forces on the tool.
struct EdgeLoad {
  Vec3 force = Vec3::Zero(); ///< N
  double torque = 0.0;       ///< N m, against the spindle
  double work = 0.0;         ///< J, of edges along their ways relative to the part, against the chip
  double ploughed = 0.0;     ///< J, the same against the surface under their flanks
  double power = 0.0;        ///< W, of the forces along the ways of the middles of chips, and under flanks
  double removed = 0.0;      ///< m³
  double thickest = 0.0;     ///< m, chip
};

class EdgeElements {
public:
  /// slices: layers of the workpiece; tip: m, the height of the cutter's tip among them, between two of them.
  /// step: rad that the cutter turns by in a step; edges go straight in one, so far out that they enclose
  /// what arcs would.
  EdgeElements(const MillingCut& cut, std::span<const Slice> slices, double tip, double step);

  std::size_t layers() const { return layer_.size(); }
  std::size_t teeth() const { return teeth_.size(); }
  /// Whether the middle of a layer lies over the tip and between the ends of the edges: there are some in it.
  bool reaches(std::size_t layer) const { return layer >= lowest_ && layer < end_; }
  /// m over the tip, the middle of a layer.
  double over_tip(std::size_t layer) const { return layer_[layer].low + 0.5 * layer_[layer].thickness; }
  /// m, mean of a layer that it reaches, of the cutter round its own axis.
  double radius(std::size_t layer) const { return layer_[layer].radius; }

  /// An element's rake face, which is `reach` deep but where the cutter is thinner. The cutter that is higher
  /// cuts a layer farther down its profile.
  Rake rake(std::size_t layer, std::size_t tooth, const CutterPlace& place, double reach) const;

  /// m, from the axis of the cutter to an edge.
  Vec2 arm(std::size_t layer, std::size_t tooth, const CutterPlace& place) const;

  /// N, what the edges of a tooth bear together on a chip of a thickness, m, at a speed, m/s, at most.
  double bears(double thickness, double speed) const;

  /// Adds what an element bears that has taken a bite on its way in a step, m relative to the part, of a
  /// duration, s, and between two angles of the cutter.
  void add(EdgeLoad& load, std::size_t layer, std::size_t tooth, const Bite& bite, const Vec3& way,
           double duration, const CutterPlace& from, const CutterPlace& to) const;
  /// Adds what its flank bears that presses in a section on that way, m², in the mean of the step.
  void plough(EdgeLoad& load, std::size_t layer, std::size_t tooth, double pressed, const Vec3& way,
              double duration, const CutterPlace& from, const CutterPlace& to) const;

private:
  struct Layer {
    double low = 0.0;       ///< m over the tip
    double thickness = 0.0; ///< m
    double radius = 0.0;    ///< m
    double lag = 0.0;       ///< rad
    double width = 0.0;     ///< m, of the chip: along the profile
    double lead = 0.0;      ///< rad
  };
  /// Of an edge at a layer when the cutter has turned so far.
  double phi(std::size_t layer, std::size_t tooth, double turned) const {
    return turned - teeth_[tooth] - layer_[layer].lag;
  }
  /// Adds forces (tangential, radial, axial), N, where the cutter has turned so far. The force on the tool.
  Vec3 bear(EdgeLoad& load, std::size_t layer, std::size_t tooth, double turned, const Vec3& local) const;

  MillingCut cut_;
  double chord_ = 1.0;               ///< of the radius
  std::size_t lowest_ = 0, end_ = 0; ///< layers with edges
  std::vector<Layer> layer_;
  std::vector<CuttingLaw> law_; ///< [layer] of edges whose angles change; none: that of the cut
  std::vector<double> teeth_;   ///< rad behind tooth 0
};

} // namespace cnem::machining
