#include "app/estimate.hpp"

namespace cnem::app {

void Estimate::add_metrics(std::vector<std::pair<std::string, double>>& list) const {
  list.emplace_back("adapt.refined", static_cast<double>(refined_));
  list.emplace_back("adapt.coarsened", static_cast<double>(coarsened_));
  list.emplace_back("adapt.not_estimated", static_cast<double>(skipped_));
  list.emplace_back("adapt.error", norm_ > 0.0 ? total_ / norm_ : 0.0);
}

void Estimate::archive(Archive& archive, std::size_t nodes) {
  archive.integer("run/adapt/refined", refined_);
  archive.integer("run/adapt/coarsened", coarsened_);
  archive.integer("run/adapt/not_estimated", skipped_);
  archive.number("run/adapt/error_total", "m", total_);
  archive.number("run/adapt/error_norm", "m", norm_);
  error_.resize(nodes);
  archive.field("run/adapt/error", "m", error_);
}

} // namespace cnem::app
