#include "app/space_features.hpp"

#include "evaluate/round_cut.hpp"

namespace cnem::app {

void SpaceFeatures::evaluate(const std::filesystem::path& folder, const ExplicitSolver<3>& solver,
                             const results::HistoryLog& history) {
  if (!input_->report.blanking) return;
  blanking_ =
      evaluate::evaluate_blanking(*input_, snapshot(solver), solver.conditions().supports, history.table());
  if (!folder.empty()) evaluate::write_blanking(folder, *blanking_);
}

std::vector<std::pair<std::string, double>> SpaceFeatures::metrics() const {
  std::vector<std::pair<std::string, double>> list = adaptation_.metrics();
  if (blanking_) {
    const auto more = evaluate::metrics_of(*blanking_);
    list.insert(list.end(), more.begin(), more.end());
  }
  return list;
}

} // namespace cnem::app
