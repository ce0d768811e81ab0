#pragma once
// What milling analyses share as runs: no body, no steps to go back to.
#include "app/run.hpp"
#include "app/stopwatch.hpp"
#include "core/rpm.hpp"
#include "input/case.hpp"
#include "input/case_machining.hpp"
#include "machining/mode.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cnem::app {

class MachiningSession : public Session {
public:
  /// Takes the folder, but where a run that is there goes on. `input` and `observer` must outlive this
  /// object. Throws InputError and IoError.
  MachiningSession(const input::Case& input, const RunOptions& options, RunObserver& observer,
                   bool goes_on = false);

  std::optional<Exit> go_on() override;
  results::RunStatus status() override { return status_; }
  /// Throws InputError: there is no body.
  std::variant<results::Snapshot<2>, results::Snapshot<3>> snapshot() override;
  const results::HistoryLog& history() const override { return history_; }

protected:
  /// Fills the status, and the history where there is one. False where the observer asked for a pause.
  /// Throws DivergenceError.
  virtual bool solve() = 0;
  /// What is written beside status and report, into a folder that is there.
  virtual void write_files() = 0;

  const input::Case& input_;
  RunOptions options_;
  RunObserver& observer_;
  Stopwatch watch_;
  results::HistoryLog history_;
  results::RunStatus status_;
  std::vector<input::NamedMode> modes_; ///< of a milling analysis
  std::vector<machining::Mode> plain_modes() const { return {modes_.begin(), modes_.end()}; }

private:
  void finish();
  bool begun_ = false, ended_ = false;
};

/// Of the kind that the case asks for.
std::unique_ptr<Session> machining_run(const input::Case& input, const RunOptions& options,
                                       RunObserver& observer);

/// What is known before anything is solved.
Checked check_machining(const input::Case& input);

// For those who make them.
/// Of tool and part: those of the case, and of its [part] where the cutter cuts, which is solved for it.
std::vector<input::NamedMode> modes_of(const input::Case& input);
std::string speed_text(double speed); ///< "8000 rpm" of rad/s
/// [place] what cutters meet at stability.places, or `modes` without them. Throws InputError where none of
/// them moves across the axis of the cutter at any place.
std::vector<std::vector<input::NamedMode>> modes_at_places(const input::Case& input,
                                                           const std::vector<input::NamedMode>& modes);
/// [place] the same without names; none where none moves across the axis: nothing chatters there.
using ModesAtPlaces = std::vector<std::vector<machining::Mode>>;
ModesAtPlaces chattering(const std::vector<std::vector<input::NamedMode>>& modes,
                         const machining::Cutter& cutter);
/// The depth that charts and searches span, m: by the least limit of zero order of all places.
double deepest(const input::Case& input, const ModesAtPlaces& modes);

} // namespace cnem::app
