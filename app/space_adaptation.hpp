#pragma once
// What happens to a cloud in space at a new reference: its surface is kept sound, broken matter parts, nodes
// come and go.
#include "adapt/space/resample.hpp"
#include "app/estimate.hpp"
#include "input/case.hpp"
#include "mechanics/explicit_solver.hpp"
#include "results/adaptation_log.hpp"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

class SpaceAdaptation {
public:
  /// The spacing that the cloud has is the one that is wanted.
  SpaceAdaptation(const input::Case& input, const ExplicitSolver<3>& solver);

  bool active() const { return input_->adapt.resample; }

  /// Begins adaptation.csv, or goes on with it. Throw IoError.
  void start_log(const std::filesystem::path& folder);
  void resume_log(const std::filesystem::path& folder);

  /// Told how nodes went over, after each change of the cloud.
  using Follow = std::function<void(const Resampling<3>&)>;

  /// Estimates and marks if the case says so, resamples the cloud and makes it the reference. Returns the
  /// share of the nodes that came or went. Throws GeometryError with the solver left as it was, IoError.
  double renew(ExplicitSolver<3>& solver, const Follow& follow);

  /// Renews until tools have the nodes that the case wants at them, before the first step, or until a pass
  /// fails. Throws IoError.
  void fit_to_tools(ExplicitSolver<3>& solver, const Follow& follow);

  /// Sums over the run, for status.json.
  std::vector<std::pair<std::string, double>> metrics() const;
  void archive(Archive& archive);

private:
  /// Wanted spacing after an estimate on a cloud, m, [node]: with growth limited.
  Field refined_spacing(const ExplicitSolver<3>& solver, const Cloud<3>& cloud);
  /// Lowers it as adapt.tool_spacing says.
  void limit_at_tools(const ExplicitSolver<3>& solver, const Cloud<3>& cloud, Field& wanted) const;

  const input::Case* input_;
  Field size_;   ///< [node] m, wanted spacing before growth
  Field wanted_; ///< [node] m, of the last pass; with an indicator
  Estimate estimate_;
  adapt::PassReport total_;
  std::int64_t passes_ = 0;
  results::AdaptationLog log_;
};

} // namespace cnem::app
