#include "app/run.hpp"

#include "app/machining/machining_session.hpp"
#include "app/machining/milling_run.hpp"
#include "app/machining/removal_run.hpp"
#include "app/process/exhaustion.hpp"
#include "app/simulation.hpp"
#include "app/statics/statics.hpp"
#include "core/machine/isa.hpp"
#include "core/machine/threads.hpp"
#include "input/case_reader.hpp"
#include "report/report.hpp"
#include "results/checkpoint_folder.hpp"
#include "results/folder_lock.hpp"
#include "results/output_folder.hpp"

#include <fmt/format.h>
#include <memory>

namespace cnem::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* another_run = "run";

void take_folder(const input::Case& input, const RunOptions& options) {
  if (options.output.empty()) return;
  results::prepare_output_folder(options.output, options.force);
  results::write_atomically(options.output / results::files::resolved_case, input.resolved);
}

/// Whether a checkpoint is one of this case; takes over its name then, and its instruction set where that is
/// the run's to choose and CNEM_ISA does not ask for another, so that the run goes on with the same bits.
bool adopt(results::CheckpointReader& checkpoint, input::Case& input, const std::string& version,
           bool owns_process, std::vector<std::string>& differences) {
  results::CheckpointInfo info;
  info.archive(checkpoint);
  if (info.inputs != results::hash_of_inputs(input.resolved)) return false;
  input.name = info.name;
  const std::optional<Isa> wanted = wanted_isa();
  bool there = false;
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512})
    if (info.isa == isa_name(isa) && isa_supported(isa)) {
      there = true;
      if (owns_process) set_isa(wanted.value_or(isa));
    }
  if (info.isa != isa_name(active_isa()))
    differences.push_back(
        fmt::format("the run began with instruction set {} and goes on with {}, {}: it may not end with the "
                    "same bits",
                    info.isa, isa_name(active_isa()),
                    wanted  ? "as CNEM_ISA says"
                    : there ? "which this process runs with"
                            : "because this machine lacks the first"));
  if (info.version != version)
    differences.push_back(
        fmt::format("the run began with version {}, this is {}: it may not end with the same bits",
                    info.version, version));
  return true;
}

/// The run at its last good checkpoint; none when there is no good one, of which `warnings` tell. Files that
/// are no use are set aside, so that they do not come before good ones again. Throws InputError when there
/// are only those of another case.
/// make(): the run before its first step.
template<class Make>
auto at_last_checkpoint(input::Case& input, const RunOptions& options, RunObserver& observer,
                        std::vector<std::string>& warnings, Make&& make) -> decltype(make()) {
  std::vector<fs::path> refused;
  bool foreign = false;
  for (const fs::path& path : results::list_checkpoints(options.output)) {
    try {
      std::vector<std::string> differences;
      results::CheckpointReader checkpoint(results::read_file(path));
      if (!adopt(checkpoint, input, options.version, observer.owns_process(), differences)) {
        foreign = true;
        throw IoError(fmt::format("it belongs to another case than {}", results::files::resolved_case));
      }
      auto simulation = make();
      simulation->resume(checkpoint);
      warnings.insert(warnings.end(), differences.begin(), differences.end());
      for (const fs::path& other : refused) results::set_aside(other);
      observer.outcome(fmt::format("going on from {}", path.string()));
      return simulation;
    } catch (const IoError& error) {
      warnings.push_back(fmt::format("{} is refused: {}", path.string(), error.what()));
      refused.push_back(path);
    }
  }
  if (foreign)
    throw InputError(
        fmt::format("{}\n{} has no checkpoint of the case in its {}: put that file back as it was, or run "
                    "the case anew",
                    fmt::join(warnings, "\n"), options.output.string(), results::files::resolved_case));
  for (const fs::path& path : refused) results::set_aside(path);
  if (!refused.empty()) warnings.emplace_back("there is no good checkpoint: the run begins again at step 0");
  return nullptr;
}

/// Analyses of bodies without steps, and all of milling.
bool is_solved_at_once(const input::Case& input) {
  return input.analysis.type != input::Analysis::Type::explicit_dynamics;
}

input::Case resolved_case(const fs::path& folder) {
  const fs::path resolved = folder / results::files::resolved_case;
  input::Case input = input::read_case(resolved.string());
  if (is_solved_at_once(input)) input.resolved = results::read_file(resolved);
  return input;
}

std::unique_ptr<Session> solved_at_once(const input::Case& input, const RunOptions& options,
                                        RunObserver& observer) {
  if (input.analysis.of_milling()) return machining_run(input, options, observer);
  if (input.analysis.dimensions() == 3) return std::make_unique<StaticRun<3>>(input, options, observer);
  return std::make_unique<StaticRun<2>>(input, options, observer);
}

} // namespace

template<int dim> void Run::begin(RunObserver& observer) {
  observer.begins();
  const bool fresh = options_.output.empty() || !results::holds_run(options_.output);
  // A new folder is taken before the set-up, so that a run killed meanwhile can be restarted; one that holds
  // a run loses it only when the set-up has succeeded.
  if (fresh || !options_.force) take_folder(input_, options_);
  const auto set_up = [&] {
    auto simulation = std::make_unique<Simulation<dim>>(input_, options_, observer);
    simulation->check_tools();
    return simulation;
  };
  std::unique_ptr<Simulation<dim>> simulation;
  try {
    simulation = fresh ? before_steps(input_, options_, set_up) : set_up();
  } catch (const InputError&) {
    std::error_code ignored;
    if (fresh && lock_) fs::remove(options_.output / results::files::resolved_case, ignored);
    throw;
  }
  if (!fresh) take_folder(input_, options_);
  before_steps(input_, options_, [&] { simulation->start(); });
  session_ = std::move(simulation);
}

/// Takes a run up in its folder. make(goes on): the run before its first step, whose folder holds what a
/// checkpoint counts on, or nothing but the resolved case.
template<class Make> auto Run::take_up(RunObserver& observer, Make&& make) -> decltype(make(true)) {
  return before_steps(input_, options_, [&] {
    std::vector<std::string> warnings;
    auto session = at_last_checkpoint(input_, options_, observer, warnings, [&] { return make(true); });
    if (session) {
      for (const char* end : {results::files::blanking, results::files::cutting, results::files::experiment,
                              results::files::status, results::files::report})
        fs::remove(options_.output / end);
    } else {
      observer.outcome("there is no checkpoint to go on from: starting at step 0");
      session = make(false);
    }
    for (std::string& warning : warnings) session->warn(std::move(warning));
    return session;
  });
}

template<int dim> void Run::resume(RunObserver& observer) {
  observer.begins();
  session_ = take_up(observer, [&](bool goes_on) {
    auto simulation = std::make_unique<Simulation<dim>>(input_, options_, observer);
    if (!goes_on) {
      results::clear_results(options_.output);
      simulation->start();
    }
    return simulation;
  });
}

Run::Run(input::Case input, RunOptions options, RunObserver& observer)
    : options_(std::move(options)), input_(std::move(input)) {
  const ThreadCount threads(options_.threads);
  use_threads(options_.threads);
  if (!options_.output.empty()) lock_.emplace(options_.output, another_run);
  if (is_solved_at_once(input_)) {
    const auto make = [&] { session_ = solved_at_once(input_, options_, observer); };
    // The status of a run that is there stays until that run is replaced.
    const bool there = lock_ && results::holds_run(options_.output);
    there ? make() : before_steps(input_, options_, make);
  } else if (input_.analysis.dimensions() == 3)
    begin<3>(observer);
  else
    begin<2>(observer);
}

Run::Run(RunOptions options, RunObserver& observer) : options_(std::move(options)) {
  if (has_finished(options_.output))
    throw InputError(
        fmt::format("the run in {} has finished: there is nothing to do", options_.output.string()));
  lock_.emplace(options_.output, another_run);
  results::clear_leftovers(options_.output);
  input_ = resolved_case(options_.output);
  const ThreadCount threads(options_.threads);
  use_threads(options_.threads);
  if (input_.analysis.type == input::Analysis::Type::milling) {
    options_.force = true;
    session_ = take_up(observer, [&](bool goes_on) {
      return std::make_unique<MillingRun>(input_, options_, observer, goes_on);
    });
  } else if (input_.analysis.type == input::Analysis::Type::removal) {
    options_.force = true;
    session_ = take_up(observer, [&](bool goes_on) {
      return std::make_unique<RemovalRun>(input_, options_, observer, goes_on);
    });
  } else if (is_solved_at_once(input_)) {
    observer.outcome(fmt::format("a {} analysis has no checkpoints: it is solved again",
                                 input_.analysis.of_milling() ? "stability" : "static"));
    options_.force = true;
    session_ = solved_at_once(input_, options_, observer);
  } else if (input_.analysis.dimensions() == 3)
    resume<3>(observer);
  else
    resume<2>(observer);
}

Run::~Run() = default;

std::optional<Exit> Run::go_on() {
  const ThreadCount threads(options_.threads);
  const std::optional<Exit> exit = session_->go_on();
  if (exit) lock_.reset();
  return exit;
}

Exit run(const input::Case& input, const RunOptions& options, RunObserver& observer) {
  return Run(input, options, observer).go_on().value();
}

Exit run(const input::Case& input, const RunOptions& options) {
  RunObserver silent;
  return run(input, options, silent);
}

bool has_finished(const fs::path& folder) {
  if (!fs::exists(folder / results::files::resolved_case))
    throw InputError(
        fmt::format("{} holds no run to restart: expected the output folder of `cnem run`, with its {}",
                    folder.string(), results::files::resolved_case));
  results::check_writable(folder);
  const results::FolderLock lock(folder, another_run);
  results::clear_leftovers(folder);
  if (!fs::exists(folder / results::files::status)) return false;
  try {
    if (results::read_status(folder).exit != Exit::done) return false;
  } catch (const IoError&) { // cut short by a full disk, say: checkpoints have all that a run goes on with
    if (results::list_checkpoints(folder).empty()) throw;
    return false;
  }
  if (!fs::exists(folder / results::files::report)) report::write_report(folder);
  return true;
}

Exit restart(const RunOptions& options, RunObserver& observer) {
  if (has_finished(options.output)) {
    observer.outcome(fmt::format("the run in {} has finished: there is nothing to do\nreport: {}",
                                 options.output.string(),
                                 (options.output / results::files::report).string()));
    return Exit::done;
  }
  return Run(options, observer).go_on().value();
}

} // namespace cnem::app
