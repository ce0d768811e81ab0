#pragma once
// What a case asks for: pictures, histories, checkpoints, evaluation.
#include "core/vec.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
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
  Vec2 lower{0, 0}; ///< m
  Vec2 upper{0, 0}; ///< m
};

/// What is said in the report beside the pictures of a field at one of their times.
struct PictureNote {
  double at = 0.0;   ///< s
  std::string field; ///< of picture_fields
  std::string text;
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
  std::vector<Window> windows;             ///< parts of the domain drawn enlarged, beside the whole
  std::vector<PictureNote> notes;
  std::vector<Probe> probes;
  std::vector<SampleLine> lines;
  CheckpointControl checkpoint;
};

/// Who cuts, and how sheared faces are measured.
struct BlankingReport {
  std::size_t punch = 0;           ///< index of the tool
  std::vector<std::size_t> dies;   ///< indices of tools
  double parallel = 0.0;           ///< rad
  std::optional<double> smoothing; ///< m
};

/// What is evaluated at the end of an explicit run.
struct Report {
  bool springback = false;
  std::optional<BlankingReport> blanking;
};

} // namespace cnem::input
