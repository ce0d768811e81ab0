#pragma once
// The audit of each change of the cloud: what there is before and after.
#include "adapt/pass_report.hpp"
#include "core/fields/archive.hpp"
#include "mechanics/explicit_solver.hpp"
#include "results/history_log.hpp"
#include "results/history_units.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace cnem::results {

/// Components of an angular momentum: one in the plane.
template<int dim> using Turn = Eigen::Vector<double, dim == 2 ? 1 : 3>;

/// What a change of the cloud keeps, or books, with what a window that moves has taken off. Of revolution in
/// kg, N s, J; else per thickness.
template<int dim> struct Audit {
  double nodes = 0.0, enclosed = 0.0; ///< –, m² (m³ of revolution)
  double mass = 0.0;
  Vec<dim> momentum = Vec<dim>::Zero();             ///< of v_{n−½}, without what mass scaling added
  Turn<dim> angular_momentum = Turn<dim>::Zero();   ///< about the origin
  double momentum_scale = 0.0, angular_scale = 0.0; ///< Σ m|v|, Σ m|x||v|: what errors are relative to
  double heat = 0.0;                                ///< Σ C T
  double energy = 0.0;                              ///< all terms of the ledger
  double lost = 0.0;                                ///< of these, booked to new references and to resampling
};
template<int dim> Audit<dim> audit(const ExplicitSolver<dim>& solver);

/// adaptation.csv: a row for each change, and the largest errors for status.json.
class AdaptationLog {
public:
  /// Starts the file of a new run in the plane (dimensions 2) or in space (3); without a folder there is
  /// none. Throws IoError.
  void start(const std::filesystem::path& folder, const HistoryUnits& units, int dimensions);
  /// Goes on behind the rows that the checkpoint counts. Throws IoError when some are missing.
  void resume(const std::filesystem::path& folder, const HistoryUnits& units, int dimensions);
  template<int dim>
  void record(const State<dim>& state, const adapt::PassReport& report, const Audit<dim>& before,
              const Audit<dim>& after);
  /// Largest relative errors of what must be kept, the largest relative change of the angular momentum, which
  /// is not (matter moves to the nodes that take it).
  std::vector<std::pair<std::string, double>> metrics() const;
  void archive(Archive& archive);

private:
  HistoryLog log_;
  std::int64_t rows_ = 0;
  double mass_ = 0.0, momentum_ = 0.0, heat_ = 0.0, energy_ = 0.0, angular_ = 0.0;
};

} // namespace cnem::results
