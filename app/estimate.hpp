#pragma once
// The last estimate of an indicator and what has been marked by it so far.
#include "adapt/marking.hpp"
#include "core/fields/archive.hpp"
#include "input/case.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

class Estimate {
public:
  /// Marks by an indicator: halves or doubles the spacing size (m, [node]) that is wanted.
  template<int dim>
  void mark(const input::Adaptation& rules, const Cloud<dim>& cloud, const adapt::StructureOf<dim>& structure,
            adapt::Indicator indicator, Field& size) {
    const adapt::Marking marking = adapt::mark<dim>(cloud, structure, indicator,
                                                    {.tolerance = rules.tolerance,
                                                     .coarsen = rules.coarsen,
                                                     .h_min = rules.h_min,
                                                     .h_max = rules.h_max,
                                                     .growth = rules.growth,
                                                     .max_nodes = rules.max_nodes},
                                                    size);
    refined_ += marking.refined;
    coarsened_ += marking.coarsened;
    error_ = std::move(indicator.error);
    total_ = indicator.total;
    norm_ = indicator.norm;
  }

  /// A pass that found nothing to estimate on.
  void skip() { ++skipped_; }

  Field& error() { return error_; } ///< [node], to be carried over; empty before the first estimate
  Field error_at(std::size_t nodes) const { return error_.empty() ? Field(nodes, 0.0) : error_; }
  void add_metrics(std::vector<std::pair<std::string, double>>& list) const;
  void archive(Archive& archive, std::size_t nodes);

private:
  Field error_;
  double total_ = 0.0, norm_ = 0.0;          ///< of the last estimate
  std::int64_t refined_ = 0, coarsened_ = 0; ///< cells
  std::int64_t skipped_ = 0;                 ///< passes
};

} // namespace cnem::app
