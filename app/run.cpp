#include "app/run.hpp"

#include "app/folder_lock.hpp"
#include "app/run_signals.hpp"
#include "app/simulation.hpp"
#include "app/statics.hpp"
#include "core/isa.hpp"
#include "io/case_reader.hpp"
#include "io/checkpoint_folder.hpp"
#include "io/output_folder.hpp"
#include "io/report.hpp"

#include <fmt/format.h>
#include <memory>
#include <omp.h>

namespace cnem::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* another_run = "run";

void take_folder(const io::Case& input, const RunOptions& options) {
  io::prepare_output_folder(options.output, options.force);
  io::write_atomically(options.output / io::files::resolved_case, input.resolved);
}

/// Whether a checkpoint is one of this case; takes over its name and instruction set then, so that the run
/// goes on with the same bits.
bool adopt(io::CheckpointReader& checkpoint, io::Case& input, const std::string& version,
           std::vector<std::string>& warnings) {
  io::CheckpointInfo info;
  info.archive(checkpoint);
  if (info.inputs != io::hash_of_inputs(input.resolved)) return false;
  input.name = info.name;
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512})
    if (info.isa == isa_name(isa) && isa_supported(isa)) set_isa(isa);
  if (info.isa != isa_name(active_isa()))
    warnings.push_back(
        fmt::format("the run began with instruction set {}, which this machine lacks: it will not "
                    "end with the same bits",
                    info.isa));
  if (info.version != version)
    warnings.push_back(
        fmt::format("the run began with version {}, this is {}: it may not end with the same bits",
                    info.version, version));
  return true;
}

/// A file that is no use must not come before good ones again.
void set_aside(const fs::path& checkpoint) {
  std::error_code ignored;
  fs::rename(checkpoint, checkpoint.parent_path() / "checkpoint.refused.h5", ignored);
}

/// The run at its last good checkpoint; none when there is no checkpoint. Throws InputError when there are
/// only those of another case.
std::unique_ptr<Simulation> at_last_checkpoint(io::Case& input, const RunOptions& options) {
  std::vector<std::string> warnings;
  std::vector<fs::path> refused;
  bool foreign = false;
  for (const fs::path& path : io::list_checkpoints(options.output)) {
    try {
      io::CheckpointReader checkpoint(io::read_file(path));
      if (!adopt(checkpoint, input, options.version, warnings)) {
        foreign = true;
        throw IoError(fmt::format("it belongs to another case than {}", io::files::resolved_case));
      }
      auto simulation = std::make_unique<Simulation>(input, options);
      simulation->resume(checkpoint);
      for (std::string& warning : warnings) simulation->warn(std::move(warning));
      for (const fs::path& other : refused) set_aside(other);
      fmt::print("going on from {}\n", path.string());
      return simulation;
    } catch (const IoError& error) {
      warnings.push_back(fmt::format("{} is refused: {}", path.string(), error.what()));
      fmt::print(stderr, "warning: {}\n", warnings.back());
      refused.push_back(path);
    }
  }
  if (foreign)
    throw InputError(
        fmt::format("{} has no checkpoint of the case in its {}: put that file back as it was, or run "
                    "the case anew",
                    options.output.string(), io::files::resolved_case));
  return nullptr;
}

} // namespace

Exit run(const io::Case& input, const RunOptions& options) {
  if (input.analysis.type == io::Analysis::Type::statics) return run_static(input, options);
  if (options.threads > 0) omp_set_num_threads(options.threads);
  const RunSignals signals;
  const bool fresh = !io::holds_run(options.output);
  // A new folder is taken before the set-up, so that a run killed meanwhile can be restarted; one that holds
  // a run loses it only when the set-up has succeeded.
  if (fresh || !options.force) take_folder(input, options);
  const FolderLock lock(options.output, another_run);
  std::unique_ptr<Simulation> simulation;
  try {
    simulation = std::make_unique<Simulation>(input, options);
  } catch (const InputError&) {
    std::error_code ignored;
    if (fresh) fs::remove(options.output / io::files::resolved_case, ignored);
    if (fresh) fs::remove(options.output, ignored);
    throw;
  }
  if (!fresh) take_folder(input, options);
  simulation->start();
  return simulation->run();
}

Exit restart(const RunOptions& options) {
  const fs::path resolved = options.output / io::files::resolved_case;
  if (!fs::exists(resolved))
    throw InputError(
        fmt::format("{} holds no run to restart: expected the output folder of `cnem run`, with its {}",
                    options.output.string(), io::files::resolved_case));
  const FolderLock lock(options.output, another_run);
  io::clear_leftovers(options.output);
  if (fs::exists(options.output / io::files::status) && io::read_status(options.output).exit == Exit::done) {
    const fs::path report = options.output / io::files::report;
    if (!fs::exists(report)) io::write_report(options.output);
    fmt::print("the run in {} has finished: there is nothing to do\nreport: {}\n", options.output.string(),
               report.string());
    return Exit::done;
  }
  io::Case input = io::read_case(resolved.string());
  if (input.analysis.type == io::Analysis::Type::statics) {
    fmt::print("a static analysis has no checkpoints: it is solved again\n");
    input.resolved = io::read_file(resolved);
    RunOptions again = options;
    again.force = true;
    return run_static(input, again);
  }
  if (options.threads > 0) omp_set_num_threads(options.threads);
  const RunSignals signals;
  std::unique_ptr<Simulation> simulation = at_last_checkpoint(input, options);
  if (simulation) {
    for (const char* end : {io::files::blanking, io::files::status, io::files::report})
      fs::remove(options.output / end);
  } else {
    fmt::print("there is no checkpoint to go on from: starting at step 0\n");
    simulation = std::make_unique<Simulation>(input, options);
    io::clear_results(options.output);
    simulation->start();
  }
  return simulation->run();
}

} // namespace cnem::app
