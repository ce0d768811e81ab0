#pragma once
// What a case asks for: pictures, histories, checkpoints, evaluation.
#include "core/parameter.hpp"
#include "core/vec.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cnem::input {

/// A field recorded at a material point.
struct Probe {
  std::string name;
  Vec3 at{0, 0, 0};                ///< m, initial position
  std::vector<std::string> fields; ///< of field_names()
};

/// Fields sampled along a straight line through the initial configuration at the end of the run.
struct SampleLine {
  std::string name;
  Vec3 from{0, 0, 0}, to{0, 0, 0}; ///< m
  int samples = 101;
  std::vector<std::string> fields; ///< of field_names()
};

struct Window {
  std::string name;
  Vec2 lower{0, 0};                    ///< m, at t = 0
  Vec2 upper{0, 0};                    ///< m
  std::optional<std::size_t> follow{}; ///< index of the tool that it moves with
};

/// What is said in the report beside the pictures of a field at one of their times.
struct PictureNote {
  double at = 0.0;   ///< s
  std::string field; ///< of picture_fields
  std::string text;
};

/// How pictures are drawn.
struct Drawing {
  bool mirror = false;                     ///< halves and quarters are drawn whole
  bool common = true;                      ///< one range of colours and one view for all times of a field
  std::optional<double> percentile;        ///< % of the cells (of magnitudes, of fields with a sign) in it
  std::optional<std::array<Vec2, 2>> view; ///< m, corners of the part that pictures of the whole show
  std::map<std::string, std::array<double, 2>> ranges; ///< [field] of its colours, SI
  Vec3 eye = Vec3(1.0, -1.6, 1.0);                     ///< in space: from the body towards the eye
};

/// A plane that pictures of a body in space are cut by.
struct Section {
  std::string name;
  Vec3 at, normal; ///< m; towards the eye
};

/// When checkpoints are written besides the one at step 0; 0: not by this.
struct CheckpointControl {
  std::int64_t every_steps = 0;
  double every_time = 0.0;   ///< s, simulated
  double every_wall = 600.0; ///< s of the wall clock
  int keep = 2;
};

struct Output {
  double history_every = 0.0;              ///< s
  double fields_every = 0.0;               ///< s
  std::vector<double> pictures;            ///< s, increasing; times beyond the end are kept here
  std::vector<std::string> picture_fields; ///< of field_names()
  std::vector<Section> sections;           ///< in space
  bool surface = false, polyhedra = false; ///< in space: frames have these parts beside tetrahedra and nodes
  Drawing drawing;
  std::vector<Window> windows; ///< parts of the domain drawn enlarged, beside the whole
  std::vector<PictureNote> notes;
  std::vector<Probe> probes;
  std::vector<SampleLine> lines;
  CheckpointControl checkpoint;
};

/// A length, or a share of the thickness.
struct MeasuredHeight {
  double value = 0.0; ///< m, –
  bool share = false;
};

/// The face of a body as an experiment has it.
struct MeasuredFace {
  std::string body; ///< "slug" or "skeleton"
  std::optional<MeasuredHeight> rollover, burnish, fracture, burr;
  std::optional<double> fracture_angle; ///< rad
};

/// Who cuts, and how sheared faces are measured.
struct BlankingReport {
  std::size_t punch = 0;           ///< index of the tool
  std::vector<std::size_t> dies;   ///< indices of tools
  double parallel = 0.0;           ///< rad
  std::optional<double> smoothing; ///< m
  std::vector<MeasuredFace> measured;
  int sections = 0; ///< in space: round the punch
  std::optional<Vec3>
      centre; ///< m, in space: on the axis that they go through; none: the middle of the punch
};

/// A measured curve that the force of a tool is compared with: scaled, shifted, and without the compliance of
/// the machine.
struct Experiment {
  enum class Component { along, across, x, y };
  std::string name;
  std::vector<double> x;     ///< m of stroke, or s; increases
  std::vector<double> force; ///< N, or N/m of cut
  bool over_stroke = true;   ///< else over time
  bool per_length = false;   ///< N/m
  std::size_t tool = 0;      ///< index of the tool
  Component component = Component::along;
  std::optional<double> cut_length; ///< m, that N stand for where the model has N/m, or the other way round
  std::optional<double> cuts;       ///< – that the model carries the force of; none: those that are found
};

/// Depth of wear of a tool per time: dW/dt = a σ_n v exp(−b/T), with the normal stress, the speed of sliding
/// and the temperature (K) of the interface.
struct UsuiWear {
  double a = 0.0, b = 0.0;

  static constexpr Parameter<UsuiWear> parameters[] = {{&UsuiWear::a,
                                                        {.name = "a",
                                                         .unit = "1/Pa",
                                                         .range = positive,
                                                         .required = true,
                                                         .meaning = "Factor, of the pair of metals.",
                                                         .source = "Usui, Shirakashi, Kitagawa 1984",
                                                         .example = "7.8e-9 1/Pa"}},
                                                       {&UsuiWear::b,
                                                        {.name = "b",
                                                         .unit = "K",
                                                         .range = not_negative,
                                                         .required = true,
                                                         .meaning = "Of the temperature in the exponent.",
                                                         .example = "5302 K"}}};
};

/// Who cuts, how much, and how a cut is evaluated.
struct CuttingReport {
  std::size_t tool = 0;          ///< index of the tool
  double feed = 0.0;             ///< m, uncut chip thickness
  double width = 0.0;            ///< m, of cut, out of the plane
  double filter = 0.0;           ///< m of cut that forces are averaged over
  double clear = 0.0;            ///< m from the tool and the beginning of the cut: no surface is measured
  double steady_feeds = 0.0;     ///< – feeds that the steady part is long at least
  double steady_tolerance = 0.0; ///< –
  std::optional<UsuiWear> wear;
  std::vector<double> isotherms; ///< K, of the tool; empty: whole hundreds
};

/// Whether a unit is one of energies, which have the dimension of forces too: J/m and N.
inline bool is_energy(std::string_view unit) { return unit.find('J') != std::string_view::npos; }

/// What is evaluated at the end of an explicit run, and how pages show numbers.
struct Report {
  std::vector<std::string> units; ///< that numbers are shown in, each of another dimension
  bool springback = false;
  std::optional<BlankingReport> blanking;
  std::optional<CuttingReport> cutting;
  std::vector<Experiment> experiments;
};

} // namespace cnem::input
