// What of a run is kept and taken up again: checkpoints, restarts, going back after a failure.
#include "app/process/exhaustion.hpp"
#include "app/simulation.hpp"
#include "core/isa.hpp"
#include "results/checkpoint_folder.hpp"
#include "results/output_folder.hpp"

#include <fmt/format.h>

namespace cnem::app {

namespace {

std::string step_and_time(const State<2>& state) {
  return fmt::format("step {}, t = {:.6g} s", state.step, state.time);
}

} // namespace

void Simulation::resume(results::CheckpointReader& checkpoint) {
  take_up_files(archive(checkpoint, 0));
  checkpoints_.written(solver_.state());
  last_checkpoint_ = step_and_time(solver_.state());
}

void Simulation::take_up_files(int frames) {
  const double now = solver_.state().time;
  fields_.emplace(options_.output, input_.origin, now);
  if (fields_->frames() != frames)
    throw IoError(fmt::format("{} has {} of the {} frames written until then",
                              (options_.output / results::files::fields).string(), fields_->frames(),
                              frames));
  history_.resume(solver_);
  adaptation_.resume_log(options_.output);
  pictures_.emplace(input_, options_.output);
  pictures_->truncate(now);
}

int Simulation::archive_course(Archive& archive, int frames) {
  solver_.archive(archive);
  history_due_.archive(archive, "run/due/history");
  fields_due_.archive(archive, "run/due/fields");
  pictures_due_.archive(archive, "run/due/pictures");
  control_.archive(archive);
  renewal_.archive(archive);
  melting_.archive(archive);
  adaptation_.archive(archive);
  history_.archive(archive);
  archive.integer("run/last_check", last_check_);
  archive.number("run/node_steps", "1", node_steps_);
  archive.integer("run/frames", frames);
  return frames;
}

int Simulation::archive(Archive& archive, int frames) {
  frames = archive_course(archive, frames);
  retries_.archive(archive);
  for (auto [phase, seconds] : wall()) {
    archive.number(fmt::format("run/wall/{}", phase), "s", seconds);
    if (archive.loading()) watch_.add(phase, seconds);
  }
  return frames;
}

void Simulation::write_checkpoint(int frames) {
  const State<2>& state = solver_.state();
  results::flush_file(options_.output /
                      results::files::history); // what the checkpoint counts on must not be lost before it
  results::CheckpointWriter writer;
  results::CheckpointInfo info{options_.version, std::string(isa_name(active_isa())),
                               input_.name,      results::hash_of_inputs(input_.resolved),
                               state.step,       state.time};
  info.archive(writer);
  archive(writer, frames);
  results::add_checkpoint(options_.output, writer.content(), input_.output.checkpoint.keep);
  checkpoints_.written(state);
  last_checkpoint_ = step_and_time(state);
  set_last_words(options_.output, status(), how_to_go_on());
}

bool Simulation::go_back(const DivergenceError& error) {
  if (!retries_.may_go_back(error)) return false;
  watch_.time("output.disk", [&] { files_.wait(); });
  const double failed = solver_.state().time;
  add_step_times(watch_); // the next solver counts from zero
  std::vector<std::string> told;
  solver_ = make_solver(input_, told); // a restart begins with the same one
  int frames = 0;
  retries_.go_back(failed, error.what(), [&](Archive& archive) { frames = archive_course(archive, 0); });
  progress_.message(fmt::format("{}\nback to {}: the reference is renewed at {:g} of the strain from there",
                                input_.placed(error.what()), step_and_time(solver_.state()),
                                retries_.strain_share()));
  // Before the files are cut short: killed in between, the run goes on from here.
  write_checkpoint(frames);
  take_up_files(frames);
  return true;
}

std::string Simulation::how_to_go_on() const {
  const std::string folder = options_.output.string();
  return last_checkpoint_.empty()
             ? fmt::format(
                   "there is no checkpoint yet: once this is mended, `cnem restart {}` begins at step 0",
                   folder)
             : fmt::format(
                   "the last checkpoint is of {}: once this is mended, `cnem restart {}` goes on from it",
                   last_checkpoint_, folder);
}

} // namespace cnem::app
