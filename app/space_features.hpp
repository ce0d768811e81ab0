#pragma once
// What runs in space have of app/plane_features.hpp: no more than their state. What they have not is refused
// by the reader (input/keys/space.cpp).
#include "input/case.hpp"
#include "mechanics/explicit_solver.hpp"
#include "results/file_queue.hpp"
#include "results/history_log.hpp"
#include "results/snapshot.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

class SpaceFeatures {
public:
  using Follow = std::function<void(const Resampling<3>&)>;

  SpaceFeatures(const input::Case&, const ExplicitSolver<3>&) {}
  void start(const std::filesystem::path&, ExplicitSolver<3>&, const Follow&) {}
  void resume(const std::filesystem::path&, double) {}
  void archive(Archive&) {}
  double renew(ExplicitSolver<3>& solver, const Follow&) { return solver.prepare(), 1.0; }
  void add_step(const ExplicitSolver<3>&) {}
  void record(const ExplicitSolver<3>&) {}
  results::Snapshot<3> snapshot(const ExplicitSolver<3>& solver) { return results::snapshot(solver); }
  void draw(results::FileQueue&, const results::Snapshot<3>&) {}
  void finish_pictures(results::FileQueue&) {}
  std::string draw_place(results::FileQueue&, const ExplicitSolver<3>&, std::size_t) { return ""; }
  std::string unload(const ExplicitSolver<3>&) { return ""; }
  void evaluate(const std::filesystem::path&, const ExplicitSolver<3>&, const results::HistoryLog&) {}
  std::vector<std::pair<std::string, double>> metrics() const { return {}; }
  std::vector<std::string> flags() const { return {}; }
};

} // namespace cnem::app
