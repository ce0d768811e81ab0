#pragma once
// Estimate, mark, resample, transfer: what happens to the cloud at a new reference.
#include "adapt/marking.hpp"
#include "adapt/plane/flow.hpp"
#include "adapt/plane/resample.hpp"
#include "app/estimate.hpp"
#include "app/moving_window.hpp"
#include "input/case.hpp"
#include "mechanics/explicit_solver.hpp"
#include "results/adaptation_log.hpp"
#include "results/snapshot.hpp"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

class Adaptation {
public:
  /// The spacing that the cloud has is the one that is wanted.
  Adaptation(const input::Case& input, const ExplicitSolver<2>& solver);

  bool active() const { return input_->adapt.resample; }

  /// Begins adaptation.csv, or goes on with it. Throw IoError.
  void start_log(const std::filesystem::path& folder);
  void resume_log(const std::filesystem::path& folder);

  /// Told how nodes went over, after each change of the cloud.
  using Follow = std::function<void(const Resampling<2>&)>;

  /// Before the first step: passes until the cloud has the spacing that tools want.
  void fit_to_tools(ExplicitSolver<2>& solver, const Follow& follow);

  /// Estimates, marks, opens the cloud where it is broken if the case says so, resamples it and makes it the
  /// reference. Returns the share of the nodes that came or went. Throws GeometryError with the solver left
  /// as it was, IoError.
  double renew(ExplicitSolver<2>& solver, const Follow& follow);

  /// Without adaptation: makes the present configuration the reference, and lets neighbours exchange mass
  /// where it has come apart from volume, with methods whose cells tile the body. Throws GeometryError with
  /// the solver left as it was.
  void balance(ExplicitSolver<2>& solver);

  /// For pictures and files at a time, s.
  AdaptationFields fields(double time) const;
  /// Sums over the run, for status.json.
  std::vector<std::pair<std::string, double>> metrics() const;
  void archive(Archive& archive);

private:
  /// What balance() does once faces that overlap have been set apart.
  void balance_parted(ExplicitSolver<2>& solver);
  void estimate_and_mark(const ExplicitSolver<2>& solver, const Cloud<2>& cloud,
                         const adapt::Structure& structure);
  /// m, [node] the spacing that marks, flow, tools and growth ask for.
  Field wanted_spacing(const ExplicitSolver<2>& solver, const Cloud<2>& cloud,
                       const adapt::Structure& structure) const;
  /// Moves the ends of the window that are due.
  void move_window(ExplicitSolver<2>& solver, const Follow& follow);
  /// Takes over to a changed cloud what this object knows of nodes.
  void follow_nodes(const Resampling<2>& change, double time);
  bool follows_flow() const { return input_->adapt.surface_spacing || input_->adapt.rest_factor > 0.0; }
  double tool_limit(const ExplicitSolver<2>& solver, const Vec2& x) const;
  adapt::NodeProperties properties(const ExplicitSolver<2>& solver, Field wanted) const;

  const input::Case* input_;
  Field size_, birth_;    ///< [node] m, wanted spacing before tools and growth; s, when it was inserted
  Field wanted_;          ///< [node] m, wanted spacing of the last pass
  adapt::Flow flow_;      ///< where surface_spacing or rest_factor ask for it
  Field first_;           ///< [node] m, spacing at the start; with rest_factor
  double coarsest_ = 0.0; ///< m, the spacing of level 0
  std::vector<std::vector<Vec2>> tips_; ///< [tool] m, points of its corners and arcs at time 0
  Estimate estimate_;
  IndexedVector<NodeIndex, std::int32_t> corner_; ///< 1: stays
  std::optional<MovingWindow> window_;
  adapt::PassReport total_;
  std::int64_t passes_ = 0;
  results::AdaptationLog log_;
};

} // namespace cnem::app
