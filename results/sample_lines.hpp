#pragma once
// Fields along lines of material points, at the end of a run.
#include "core/operators/resampling.hpp"
#include "input/case.hpp"
#include "results/point_weights.hpp"
#include "results/snapshot.hpp"

#include <filesystem>
#include <vector>

namespace cnem::results {

/// The lines of a case (output.lines). Their points are material ones: they are given by their places at time
/// 0 and stay where they are in the matter of a changed cloud.
template<int dim> class SampleLines {
public:
  /// cloud: at time 0. Throws InputError for points outside of it.
  SampleLines(const input::Case& input, const Cloud<dim>& cloud, const Approximation<dim>& approximation);

  void resample(const Resampling<dim>& change, const Cloud<dim>& cloud,
                const Approximation<dim>& approximation);
  void archive(Archive& archive);
  /// Writes lines/NAME.csv for every line: distance and initial position, then the fields, from
  /// natural-neighbour interpolation of nodal values. Throws IoError.
  void write(const Snapshot<dim>& shot, const std::filesystem::path& folder) const;

private:
  Vec<dim> place(const input::SampleLine& line, std::size_t k) const;

  const input::Case* input_;
  std::vector<std::vector<PointWeights>> points_; ///< [line][sample]
};

} // namespace cnem::results
