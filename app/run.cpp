#include "app/run.hpp"

#include "app/process/exhaustion.hpp"
#include "app/process/run_signals.hpp"
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
  results::prepare_output_folder(options.output, options.force);
  results::write_atomically(options.output / results::files::resolved_case, input.resolved);
}

/// Whether a checkpoint is one of this case; takes over its name then, and its instruction set unless
/// CNEM_ISA asks for another, so that the run goes on with the same bits.
bool adopt(results::CheckpointReader& checkpoint, input::Case& input, const std::string& version,
           std::vector<std::string>& differences) {
  results::CheckpointInfo info;
  info.archive(checkpoint);
  if (info.inputs != results::hash_of_inputs(input.resolved)) return false;
  input.name = info.name;
  const std::optional<Isa> wanted = wanted_isa();
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512})
    if (info.isa == isa_name(isa) && isa_supported(isa)) set_isa(wanted.value_or(isa));
  if (info.isa != isa_name(active_isa()))
    differences.push_back(
        fmt::format("the run began with instruction set {} and goes on with {}, {}: it may not end with the "
                    "same bits",
                    info.isa, isa_name(active_isa()),
                    wanted ? "as CNEM_ISA says" : "because this machine lacks the first"));
  if (info.version != version)
    differences.push_back(
        fmt::format("the run began with version {}, this is {}: it may not end with the same bits",
                    info.version, version));
  return true;
}

/// The run at its last good checkpoint; none when there is no good one, of which `warnings` tell. Files that
/// are no use are set aside, so that they do not come before good ones again. Throws InputError when there
/// are only those of another case.
template<int dim>
std::unique_ptr<Simulation<dim>> at_last_checkpoint(input::Case& input, const RunOptions& options,
                                                    std::vector<std::string>& warnings) {
  std::vector<fs::path> refused;
  bool foreign = false;
  for (const fs::path& path : results::list_checkpoints(options.output)) {
    try {
      std::vector<std::string> differences;
      results::CheckpointReader checkpoint(results::read_file(path));
      if (!adopt(checkpoint, input, options.version, differences)) {
        foreign = true;
        throw IoError(fmt::format("it belongs to another case than {}", results::files::resolved_case));
      }
      auto simulation = std::make_unique<Simulation<dim>>(input, options);
      simulation->resume(checkpoint);
      warnings.insert(warnings.end(), differences.begin(), differences.end());
      for (const fs::path& other : refused) results::set_aside(other);
      fmt::print("going on from {}\n", path.string());
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

template<int dim> Exit run_explicit(const input::Case& input, const RunOptions& options) {
  const RunSignals signals;
  const bool fresh = !results::holds_run(options.output);
  // A new folder is taken before the set-up, so that a run killed meanwhile can be restarted; one that holds
  // a run loses it only when the set-up has succeeded.
  if (fresh || !options.force) take_folder(input, options);
  const auto set_up = [&] {
    auto simulation = std::make_unique<Simulation<dim>>(input, options);
    simulation->check_tools();
    return simulation;
  };
  std::unique_ptr<Simulation<dim>> simulation;
  try {
    simulation = fresh ? before_steps(input, options, set_up) : set_up();
  } catch (const InputError&) {
    std::error_code ignored;
    if (fresh) fs::remove(options.output / results::files::resolved_case, ignored);
    throw;
  }
  if (!fresh) take_folder(input, options);
  before_steps(input, options, [&] { simulation->start(); });
  return simulation->run();
}

template<int dim> Exit resume_explicit(input::Case& input, const RunOptions& options) {
  const RunSignals signals;
  std::unique_ptr<Simulation<dim>> simulation;
  before_steps(input, options, [&] {
    std::vector<std::string> warnings;
    simulation = at_last_checkpoint<dim>(input, options, warnings);
    if (simulation) {
      for (const char* end : {results::files::blanking, results::files::cutting, results::files::experiment,
                              results::files::status, results::files::report})
        fs::remove(options.output / end);
    } else {
      fmt::print("there is no checkpoint to go on from: starting at step 0\n");
      simulation = std::make_unique<Simulation<dim>>(input, options);
      results::clear_results(options.output);
      simulation->start();
    }
    for (std::string& warning : warnings) simulation->warn(std::move(warning));
  });
  return simulation->run();
}

} // namespace

Exit run(const input::Case& input, const RunOptions& options) {
  use_threads(options.threads);
  const results::FolderLock lock(options.output, another_run);
  if (input.analysis.type != input::Analysis::Type::statics)
    return input.analysis.dimensions() == 3 ? run_explicit<3>(input, options)
                                            : run_explicit<2>(input, options);
  const auto solve = [&] { return run_static(input, options); };
  // The status of a run that is there stays until that run is replaced.
  return results::holds_run(options.output) ? solve() : before_steps(input, options, solve);
}

Exit restart(const RunOptions& options) {
  const fs::path resolved = options.output / results::files::resolved_case;
  if (!fs::exists(resolved))
    throw InputError(
        fmt::format("{} holds no run to restart: expected the output folder of `cnem run`, with its {}",
                    options.output.string(), results::files::resolved_case));
  const results::FolderLock lock(options.output, another_run);
  results::clear_leftovers(options.output);
  if (fs::exists(options.output / results::files::status) &&
      results::read_status(options.output).exit == Exit::done) {
    const fs::path report = options.output / results::files::report;
    if (!fs::exists(report)) report::write_report(options.output);
    fmt::print("the run in {} has finished: there is nothing to do\nreport: {}\n", options.output.string(),
               report.string());
    return Exit::done;
  }
  input::Case input = input::read_case(resolved.string());
  use_threads(options.threads);
  if (input.analysis.type == input::Analysis::Type::statics) {
    fmt::print("a static analysis has no checkpoints: it is solved again\n");
    input.resolved = results::read_file(resolved);
    RunOptions again = options;
    again.force = true;
    return run_static(input, again);
  }
  return input.analysis.dimensions() == 3 ? resume_explicit<3>(input, options)
                                          : resume_explicit<2>(input, options);
}

} // namespace cnem::app
