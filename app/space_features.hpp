#pragma once
// What runs in space have of app/plane_features.hpp: their state, and a cloud that follows the deformation.
// What they have not is refused by the reader (input/keys/space.cpp).
#include "app/space_adaptation.hpp"
#include "input/case.hpp"
#include "mechanics/explicit_solver.hpp"
#include "results/file_queue.hpp"
#include "results/history_log.hpp"
#include "results/snapshot.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

class SpaceFeatures {
public:
  using Follow = SpaceAdaptation::Follow;

  /// `input` must outlive this object.
  SpaceFeatures(const input::Case& input, const ExplicitSolver<3>& solver) : adaptation_(input, solver) {}
  void start(const std::filesystem::path& folder, ExplicitSolver<3>&, const Follow&) {
    adaptation_.start_log(folder);
  }
  void resume(const std::filesystem::path& folder, double) { adaptation_.resume_log(folder); }
  void archive(Archive& archive) { adaptation_.archive(archive); }
  double renew(ExplicitSolver<3>& solver, const Follow& follow) {
    if (adaptation_.active()) return adaptation_.renew(solver, follow);
    return solver.prepare(), 1.0;
  }
  void add_step(const ExplicitSolver<3>&) {}
  void record(const ExplicitSolver<3>&) {}
  results::Snapshot<3> snapshot(const ExplicitSolver<3>& solver) { return results::snapshot(solver); }
  void draw(results::FileQueue&, const results::Snapshot<3>&) {}
  void finish_pictures(results::FileQueue&) {}
  std::string draw_place(results::FileQueue&, const ExplicitSolver<3>&, std::size_t) { return ""; }
  std::string unload(const ExplicitSolver<3>&) { return ""; }
  void evaluate(const std::filesystem::path&, const ExplicitSolver<3>&, const results::HistoryLog&) {}
  std::vector<std::pair<std::string, double>> metrics() const { return adaptation_.metrics(); }
  std::vector<std::string> flags() const { return {}; }

private:
  SpaceAdaptation adaptation_;
};

} // namespace cnem::app
