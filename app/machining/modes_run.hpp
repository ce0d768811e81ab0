#pragma once
// How parts and shafts vibrate and bend.
#include "app/machining/machining_session.hpp"
#include "app/machining/structure_modes.hpp"
#include "machining/structure/shaft.hpp"

namespace cnem::app {

/// Writes modes.csv (a row for each mode and place), modes.vtk (the part and the shapes of its modes),
/// status.json and the report.
class ModesRun final : public MachiningSession {
public:
  using MachiningSession::MachiningSession;

private:
  bool solve() override;
  void write_files() override;
  void solve_part(const input::PartCase& input);
  void solve_shaft(const input::ShaftCase& input);
  /// A row of modes.csv and its metrics.
  void add_mode(const char* of, std::size_t number, const machining::Mode& mode, const std::string& place);

  std::optional<SolvedPart> part_;
  std::string table_;
};

} // namespace cnem::app
