#pragma once
// The stability of one milling case: its limit, a chart, and what they say.
#include "app/machining/machining_session.hpp"
#include "machining/stability.hpp"

namespace cnem::app {

/// Writes stability.csv (limits over speeds), stability_chart.csv (spectral radii), stability.svg,
/// stability_places.csv (limits along the path) and modes.csv (those met there) where places are asked for,
/// status.json and the report.
class StabilityRun final : public MachiningSession {
public:
  using MachiningSession::MachiningSession;

private:
  bool solve() override;
  void write_files() override;
  void judge();
  /// Warns where the limit at the speed of the case is another with edge forces.
  void doubt_edge_forces(const std::vector<machining::Mode>& modes,
                         const std::optional<machining::DepthLimit>& limit, double step, double deepest);

  machining::StabilityChart chart_;
  std::optional<machining::PlaceChart> places_;
  std::vector<std::vector<input::NamedMode>> met_; ///< [place] modes_at_places()
};

} // namespace cnem::app
