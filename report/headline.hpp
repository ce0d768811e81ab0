#pragma once
// What a reader came for: the numbers that a page begins with, by the kind of the run.
#include "evaluate/blanking_result.hpp"
#include "evaluate/cutting_result.hpp"
#include "results/history_writer.hpp"
#include "results/shown_units.hpp"
#include "results/status.hpp"

#include <string>
#include <vector>

namespace cnem::report {

/// A number with its unit.
struct Figure {
  std::string name, value;
  std::string note{}; ///< of what, at which stroke
};

/// What is known of a run; what is not there is null.
struct HeadlineSource {
  const results::RunStatus& status;
  const results::HistoryTable* history = nullptr;
  const evaluate::BlankingResult* blanking = nullptr;
  const evaluate::CuttingResult* cutting = nullptr;
  const results::ShownUnits& units;
};

/// Of a cut through sheet its force, stroke, work and zones of the face; of a machined surface forces, chip
/// and temperature; of a cracked body stress intensities; of others lengths, the leading force and largest
/// values.
std::vector<Figure> headline(const HeadlineSource& source);

} // namespace cnem::report
