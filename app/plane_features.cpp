#include "app/plane_features.hpp"

#include "app/divergence.hpp"
#include "evaluate/blanking.hpp"

#include <fmt/format.h>

namespace cnem::app {
namespace {

/// The state of a run as it is let go. cooled_to: [node] K, null: temperatures stay.
StressedBody body_of(const ExplicitSolver<2>& solver, const Field* cooled_to = nullptr) {
  const Model<2>& model = solver.model();
  const State<2>& state = solver.state();
  return {solver.approximation(), state.point,     state.node.position,
          state.node.mass,        model.materials, solver.conditions().supports,
          model.stabilisation,    cooled_to};
}

} // namespace

void PlaneFeatures::start(const std::filesystem::path& folder, ExplicitSolver<2>& solver,
                          const Adaptation::Follow& follow) {
  adaptation_.start_log(folder);
  adaptation_.fit_to_tools(solver, follow);
  if (!folder.empty()) pictures_.emplace(*input_, folder);
  if (cutting_) cutting_->start(folder);
}

void PlaneFeatures::resume(const std::filesystem::path& folder, double time) {
  adaptation_.resume_log(folder);
  if (!folder.empty()) pictures_.emplace(*input_, folder).truncate(time);
  if (cutting_) cutting_->resume(folder);
}

double PlaneFeatures::renew(ExplicitSolver<2>& solver, const Adaptation::Follow& follow) {
  if (adaptation_.active()) return adaptation_.renew(solver, follow);
  adaptation_.balance(solver);
  return 1.0;
}

results::Snapshot<2> PlaneFeatures::snapshot(const ExplicitSolver<2>& solver) {
  results::Snapshot<2> shot = results::snapshot(solver);
  if (adaptation_.active()) {
    adaptation_fields_ = adaptation_.fields(solver.state().time);
    shot.adaptation = &adaptation_fields_;
  }
  if (springback_) shot.springback = &springback_->displacement;
  return shot;
}

std::string PlaneFeatures::draw_place(results::FileQueue& files, const ExplicitSolver<2>& solver,
                                      std::size_t node) {
  const Place<2> place = place_of(solver, node);
  return pictures_->record_place(files, snapshot(solver), place.centre, place.radius);
}

std::string PlaneFeatures::unload(const ExplicitSolver<2>& solver) {
  if (!input_->report.springback) return "";
  check_finite(solver.state());
  try {
    springback_ = springback(body_of(solver));
    return "";
  } catch (const InputError& error) { return fmt::format("there is no springback: {}", error.what()); }
}

void PlaneFeatures::evaluate(const std::filesystem::path& folder, const ExplicitSolver<2>& solver,
                             const results::HistoryLog& history) {
  if (input_->report.blanking || springback_) {
    blanking_ = evaluate::evaluate_blanking(*input_, snapshot(solver), solver.conditions().supports,
                                            springback_ ? &*springback_ : nullptr, history.table());
    if (!folder.empty()) evaluate::write_blanking(folder, *blanking_);
  }
  if (!input_->report.experiments.empty()) {
    experiments_ =
        evaluate::evaluate_experiments(*input_, history.table(), blanking_ ? &*blanking_ : nullptr);
    if (!folder.empty()) evaluate::write_experiments(folder, experiments_);
  }
  if (!cutting_) return;
  const StressedBody body = body_of(solver, &solver.state().node.initial_temperature);
  cut_ = evaluate::evaluate_cutting(*input_, snapshot(solver), *cutting_, cutting_->rows(),
                                    solver.conditions().ties.empty() ? &body : nullptr);
  if (!folder.empty()) evaluate::write_cutting(folder, *cut_);
}

std::vector<std::pair<std::string, double>> PlaneFeatures::metrics() const {
  std::vector<std::pair<std::string, double>> list = adaptation_.metrics();
  const auto add = [&](const auto& more) { list.insert(list.end(), more.begin(), more.end()); };
  if (blanking_ && !blanking_->punch.empty()) add(evaluate::metrics_of(*blanking_));
  if (blanking_ && !blanking_->springback.empty()) add(evaluate::metrics_of(blanking_->springback));
  if (cut_) add(evaluate::metrics_of(*cut_));
  add(evaluate::metrics_of(experiments_));
  return list;
}

std::vector<std::string> PlaneFeatures::flags() const {
  if (!cut_) return {};
  std::vector<std::string> list{"cutting.steady"};
  if (cut_->breaks) list.emplace_back("cutting.chip_completed");
  return list;
}

} // namespace cnem::app
