#pragma once
// Milling in the time domain: teeth sweep through dexels, what they remove makes forces, forces make the
// modes swing (paper 004, section 3.2 and Box 1: (5), (6)).
#include "machining/blank.hpp"
#include "machining/edge_elements.hpp"
#include "machining/flexible_part.hpp"
#include "machining/milling_ledger.hpp"
#include "machining/mode.hpp"
#include "machining/tool_motion.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cnem::machining {

struct ProcessSettings {
  /// Where the cutter begins: in the middle of a cut, in a hole of its own size, or beside the workpiece.
  enum class Start { inside, hole, outside };
  double spindle = 0.0;     ///< rad/s; the largest where `drive` changes it, as the feed of the cut is
  double axial_depth = 0.0; ///< m
  double length = 0.0;      ///< m, of the path of the cutter's axis along +x
  double dwell = 0.0;       ///< turns at its end, without feed
  Start start = Start::inside;
  double pitch = 0.0; ///< m, of dexels
  int layers = 1;     ///< along the axis, in `axial_depth`
  int steps = 0;      ///< in a turn
  /// In place of length: passes through a blank, which begin in a hole or beside matter. Between two of them
  /// the cutter is lifted.
  std::vector<ToolPath> passes{};
  std::optional<Blank> blank{};
  std::optional<DriveTables> drive{};
};

struct ProcessStep : EdgeLoad {
  double time = 0.0;                ///< s, at the middle
  double angle = 0.0;               ///< rad, of the tip of tooth 0 there
  Vec3 displacement = Vec3::Zero(); ///< m, of the tool relative to the part, at the end, in the
                                    ///< layer where it is the largest
  double unsettled = 0.0; ///< m, by how much the shift still changed where forces and vibration did not
                          ///< agree for good: edges that only rub
};

/// Corners of the workpiece at first, m: x and y, and z from 0, over which tips count, to its height.
struct Workpiece {
  Vec3 low, high;
};
Workpiece workpiece_of(const MillingCut& cut, const ProcessSettings& settings);
/// The layers that it is divided into: tips of passes lie between two of them.
std::vector<Slice> slices_of(const MillingCut& cut, const ProcessSettings& settings);
/// The way of the cutter's axis.
ToolMotion motion_of(const MillingCut& cut, const ProcessSettings& settings);

class MillingProcess {
public:
  /// part: one that deforms where it is cut, in axes of the cut; none: it is rigid but for its modes.
  MillingProcess(MillingCut cut, std::vector<Mode> modes, const ProcessSettings& settings,
                 std::unique_ptr<FlexiblePart> part = nullptr);

  /// The same cutter, which does not vibrate, in what is left of the workpiece, from here on.
  MillingProcess rigid() const;

  bool at_end() const;
  /// Makes a step: edges ask the dexels what they would remove until modes and forces agree, then they erase
  /// what they sweep. Throws DivergenceError where they do not agree, or the part folds, or a pass begins in
  /// matter: everything is then as it was at the begin of the step; in the first one of a pass after that
  /// pass has begun: what vibrates has come to rest, and a hole to begin in is there.
  ProcessStep advance();

  /// What evolves.
  void archive(Archive& archive);

  std::int64_t steps() const { return step_; }
  double time() const { return motion_.time(step_); }
  const ToolMotion& motion() const { return motion_; }
  /// m, of the cutter's axis without vibration at the begin of the next step.
  Vec2 axis() const { return way_at(static_cast<double>(step_)).at; }
  double tip() const { return motion_.tip(motion_.pass_of(step_)); } ///< m, height of the tip then
  double pass_tip() const { return motion_.tip(pass()); }            ///< m, in the last step
  const FlexiblePart* part() const { return part_.get(); }           ///< none: it is rigid but for its modes
  Workpiece workpiece() const { return workpiece_of(cut_, settings_); }
  const std::vector<DexelLayer>& layers() const { return layer_; }
  /// Whether a surface of a file bounds it: what its box holds beside that has never been matter.
  bool has_surface() const { return settings_.blank && !settings_.blank->surface.triangles.empty(); }
  /// A layer of the workpiece of passes before any run; empty where an earlier one has left it, whose sides
  /// may all be machined.
  DexelLayer stock(std::size_t layer) const;
  const std::vector<Slice>& slices() const { return slice_; }               ///< [layer]
  double height(std::size_t layer) const { return slice_[layer].middle(); } ///< m
  double radius(std::size_t layer) const { return edges().radius(layer); }  ///< m, of the cutter
  double volume() const;                                                    ///< m³ of matter
  double block() const { return block_; } ///< m³ of matter before anything was taken
  LeftWorkpiece left() const;             ///< what there is now, for another run
  const MillingLedger& ledger() const { return ledger_; }
  /// Whether teeth of this pass reach matter in a layer: the end of a cutter is thinner.
  bool cuts(std::size_t layer) const {
    return edges().reaches(layer) &&
           edges().radius(layer) > cut_.cutter.radius() - cut_.engagement.radial_depth;
  }
  /// m, matter that is left on the machined side beyond where the teeth pass, at a place along x; negative:
  /// too much was taken. None where no matter is left.
  std::optional<double> left_at(std::size_t layer, double x) const;
  /// The same beside the last pass, at a way along it, m, of matter that begins the nearest to where the
  /// teeth pass. stock: of this layer; none where nothing of it has been taken there: that is no machined
  /// side.
  std::optional<double> left_beside(std::size_t layer, double way, const DexelLayer& stock) const;
  /// Unit vector from the axis to the machined side, of a way along another one.
  Vec2 machined_side(const Vec2& along) const {
    return cut_.engagement.side == Engagement::Side::up ? left_normal(along) : right_normal(along);
  }
  /// m that the cutter goes on in a turn.
  double feed_of_turn() const { return feed_speed_ * full_turn / settings_.spindle; }

private:
  using PerLayer = std::vector<Vec3>;

  std::size_t pass() const {
    return passes_begun_ > 0 ? index_of(passes_begun_) - 1 : 0;
  } ///< of the last step
  const EdgeElements& edges() const { return edges_[pass()]; }
  void take_flanks(); ///< of the pass, without traces
  /// At a time in steps within the pass of this step.
  ToolPath::Place way_at(double at) const;
  CutterPlace place(std::int64_t step) const; ///< without vibration
  void take_blank();
  Vec2 cells() const; ///< m, of dexels at most
  /// Takes the duration of this step; the cutter goes to the begin of a pass. Throws DivergenceError.
  void begin_step();
  void begin_pass(std::size_t pass);
  /// m, by how much modes move at most in a step for the forces of edges that only touch.
  double rubbing(double chip) const;
  /// How many steps a turn are so many times as many and a quarter to spare, in tens.
  double finer(double times) const;
  /// What edges meet, answered by questions until shifts agree, and the step that erases it.
  ProcessStep make_step();
  /// What teeth remove and bear whose cutter is shifted at the end of the step, m for each layer; forces on
  /// the tool for each, N, come into `force`. bite(layer, sweep): what is taken of a layer, or would be.
  template<class TakeBite> EdgeLoad bear(const PerLayer& shift, PerLayer& force, TakeBite&& bite);
  /// A sweep of an element as the material sees it: its rakes go back through Φ⁺ of both ends of the step
  /// (6).
  Sweep in_material(std::size_t layer, std::size_t tooth, const std::array<CutterPlace, 2>& place,
                    double depth, const Sweep& sweep) const;
  /// Of an edge, as the last question found it.
  FlankTraces::Way way_of(std::size_t edge) const {
    return {way_[edge].head<2>(), bite_[edge].begin, bite_[edge].end};
  }
  /// Where edges go in this step, of a cutter whose shift at its end is this one: sweep_, way_, edge_.
  void sweep_edges(const PerLayer& shift);
  /// Of the cutter relative to the part, m, at the machined side of each layer.
  PerLayer relative(const PerLayer& shift) const;
  /// m, where a mode would rest under forces.
  double rest_of(std::size_t mode, const PerLayer& force) const;
  /// Modes are integrated exactly under the mean force of the step.
  Eigen::MatrixXd moved(const PerLayer& force) const;
  PerLayer shift_of(const Eigen::MatrixXd& state) const;
  /// Of modes in layers, where the cutter is in the middle of this step.
  void take_shapes();
  /// Books a step that ends with these states and shifts.
  void book(const EdgeLoad& load, const Eigen::MatrixXd& state, const PerLayer& shift);
  /// m, how deep rakes have to be: thicker than any chip.
  double reach(const PerLayer& shift) const;

  MillingCut cut_;
  std::vector<Mode> modes_;
  ProcessSettings settings_;
  ToolMotion motion_;
  double dt_ = 0.0, feed_speed_ = 0.0, block_ = 0.0;
  std::vector<FreeMotion> free_;
  std::vector<Mat2> loss_;          ///< of modes in a step, damping_loss()
  std::vector<Slice> slice_;        ///< [layer]
  std::vector<EdgeElements> edges_; ///< [pass] one without passes
  double first_ = 0.0;              ///< steps that runs before this one have turned the cutter by
  std::int64_t step_ = 0, passes_begun_ = 0;
  std::vector<DexelLayer> layer_;
  std::vector<Sweep> sweep_; ///< [layer × tooth] of the last question
  std::vector<Bite> bite_;   ///< [layer × tooth] of the last question
  std::vector<Vec3> way_;    ///< [layer × tooth] m, of the edge in space relative to the part
  std::optional<FlankTraces> flanks_;
  std::vector<double> pressed_; ///< [layer × tooth] m², under flanks at the end of the step
  Eigen::MatrixXd state_;       ///< [2 × modes] (q, v/ω)
  Eigen::MatrixXd shape_;       ///< [layers × modes] –, in this step
  std::unique_ptr<FlexiblePart> part_;
  std::vector<Vec3> edge_; ///< [layer × tooth] m, of the material, where the edge is in the middle of its way
  PerLayer shift_;         ///< m, at the begin of the step
  PerLayer force_;         ///< N, of the last step
  double farthest_ = 0.0;  ///< m, the largest shift so far in this pass
  MillingLedger ledger_;
};

} // namespace cnem::machining
