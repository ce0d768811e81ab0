#pragma once
// What the rake face of a tool and the chip do to each other, summed up in every step.
#include "core/fields/archive.hpp"
#include "evaluate/chip.hpp"
#include "input/cutting_tool.hpp"
#include "mechanics/explicit_solver.hpp"

#include <vector>

namespace cnem::evaluate {

/// Sums over a time, in bins along the rake face from the tip.
struct RakeSums {
  double duration = 0.0;           ///< s
  std::vector<double> normal;      ///< [bin] N s/m, that presses the chip off the face
  std::vector<double> shear;       ///< [bin] N s/m, that the face takes along the way of the chip
  std::vector<double> temperature; ///< [bin] K N s/m, of the chip there, weighted with `normal`
  std::vector<double> slip;        ///< [bin] m/s N s/m, of the chip up the face, weighted with `normal`

  std::vector<double> edge; ///< N s/m, along the cut and into the workpiece, by edge and flank

  explicit RakeSums(std::size_t bins = 0)
      : normal(bins, 0.0), shear(bins, 0.0), temperature(bins, 0.0), slip(bins, 0.0), edge(2, 0.0) {}
  RakeSums& operator+=(const RakeSums& other);
};

/// The face as it is on average over some cut.
struct RakeFace {
  std::vector<double> at;              ///< [bin] m, from the tip, of its middle
  std::vector<double> normal, shear;   ///< [bin] Pa, on the tool; shear > 0 along the way of the chip
  std::vector<double> temperature;     ///< [bin] K; not-a-number where nothing touches
  std::vector<double> slip;            ///< [bin] m/s
  double contact_length = unknown;     ///< m, from the tip: 99% of the normal force act on it
  double mean_temperature = unknown;   ///< K, weighted with the normal force
  double edge_Fc = 0.0, edge_Ft = 0.0; ///< N/m, of edge and flank
};

/// Adds up after every step; keeps sums for each half of a feed of cut.
class RakeContact {
public:
  /// feed: m.
  RakeContact(const input::CuttingTool& cut, ToolIndex tool, double feed);

  void add_step(const ExplicitSolver<2>& solver);
  /// Since the last call; the next one begins anew.
  RakeFace take_recent();
  /// Over a part of the cut, m; in whole halves of a feed.
  RakeFace mean(double from, double to) const;
  void archive(Archive& archive);

private:
  RakeFace face_of(const RakeSums& sums) const;

  input::CuttingTool cut_;
  ToolIndex tool_;
  double bin_ = 0.0, stretch_ = 0.0; ///< m
  double last_time_ = 0.0;           ///< s, of the last step
  RakeSums recent_;
  std::vector<RakeSums> stretches_; ///< [half of a feed of cut]
};

} // namespace cnem::evaluate
