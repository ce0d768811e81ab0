#include "app/machining/stepped_run.hpp"

#include "core/machine/isa.hpp"
#include "report/picture_album.hpp"
#include "results/checkpoint_folder.hpp"
#include "results/output_folder.hpp"

#include <fmt/format.h>

namespace cnem::app {

SteppedRun::SteppedRun(const input::Case& input, const RunOptions& options, RunObserver& observer,
                       bool goes_on, std::vector<std::string> columns)
    : MachiningSession(input, options, observer, goes_on), columns_(std::move(columns)),
      checkpoints_(input.output.checkpoint) {}

std::filesystem::path SteppedRun::history_file() const {
  return options_.output.empty() ? options_.output : options_.output / results::files::history;
}

void SteppedRun::write_checkpoint() {
  if (!options_.output.empty()) {
    results::flush_file(history_file()); // what the checkpoint counts on must not be lost before it
    results::CheckpointWriter writer;
    results::CheckpointInfo info{options_.version, std::string(isa_name(active_isa())),
                                 input_.name,      results::hash_of_inputs(input_.resolved),
                                 steps(),          time()};
    info.archive(writer);
    archive(writer);
    results::add_checkpoint(options_.output, writer.content(), input_.output.checkpoint.keep);
  }
  checkpoints_.written(steps(), time());
}

void SteppedRun::resume(results::CheckpointReader& checkpoint) {
  archive(checkpoint);
  history_.resume(history_file(), columns_, steps());
  report::PictureAlbum(options_.output).truncate(-1.0); // pictures are drawn at the end
  status_.steps = steps();
  checkpoints_.written(steps(), time());
}

bool SteppedRun::solve() {
  if (!history_.begun()) history_.start(history_file(), columns_);
  while (!at_end()) {
    const Request request = observer_.request();
    const bool stopped = request.kind == Request::Kind::stop;
    if (stopped || request.kind == Request::Kind::checkpoint || checkpoints_.due(steps(), time()))
      write_checkpoint();
    if (stopped) {
      status_.exit = Exit::interrupted;
      status_.time = time();
      status_.reason = fmt::format("by {} at step {}", request.by, steps());
      observer_.steps_end();
      return true;
    }
    if (request.kind == Request::Kind::pause) return false;
    const double step = dt();
    advance();
    observer_.progress({.time = time(), .end = end(), .step = steps(), .dt = step});
  }
  observer_.steps_end();
  status_.time = time();
  judge();
  return true;
}

} // namespace cnem::app
