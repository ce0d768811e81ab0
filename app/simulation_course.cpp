// What of a run is kept and taken up again: checkpoints, restarts, going back after a failure.
#include "app/process/exhaustion.hpp"
#include "app/simulation.hpp"
#include "core/machine/isa.hpp"
#include "results/checkpoint_folder.hpp"
#include "results/output_folder.hpp"

#include <fmt/format.h>

namespace cnem::app {

namespace {

template<int dim> std::string step_and_time(const State<dim>& state) {
  return fmt::format("step {}, t = {:.6g} s", state.step, state.time);
}

} // namespace
template<int dim> void Simulation<dim>::resume(results::CheckpointReader& checkpoint) {
  take_up_files(archive(checkpoint, 0));
  checkpoints_.written(solver_.state().step, solver_.state().time);
  last_checkpoint_ = step_and_time(solver_.state());
}
template<int dim> void Simulation<dim>::take_up_files(int frames) {
  const double now = solver_.state().time;
  if (!options_.output.empty()) {
    fields_.emplace(options_.output, input_, now);
    if (fields_->frames() != frames)
      throw IoError(fmt::format("{} has {} of the {} frames written until then",
                                (options_.output / results::files::fields).string(), fields_->frames(),
                                frames));
  }
  history_.resume(solver_);
  features_.resume(options_.output, now);
}
template<int dim> int Simulation<dim>::archive_course(Archive& archive, int frames) {
  solver_.archive(archive);
  history_due_.archive(archive, "run/due/history");
  fields_due_.archive(archive, "run/due/fields");
  pictures_due_.archive(archive, "run/due/pictures");
  control_.archive(archive);
  renewal_.archive(archive);
  melting_.archive(archive);
  penetration_.archive(archive);
  measured_range_.archive(archive);
  mass_balance_.archive(archive);
  features_.archive(archive);
  history_.archive(archive);
  lines_.archive(archive);
  archive.integer("run/last_check", last_check_);
  archive.number("run/node_steps", "1", node_steps_);
  archive.integer("run/frames", frames);
  return frames;
}
template<int dim> int Simulation<dim>::archive(Archive& archive, int frames) {
  frames = archive_course(archive, frames);
  retries_.archive(archive);
  for (auto [phase, seconds] : wall()) {
    archive.number(fmt::format("run/wall/{}", phase), "s", seconds);
    if (archive.loading()) watch_.add(phase, seconds);
  }
  double cpu = watch_.cpu();
  archive.number("run/cpu", "s", cpu);
  if (archive.loading()) watch_.add_cpu(cpu);
  return frames;
}
template<int dim> void Simulation<dim>::write_checkpoint(int frames) {
  const State<dim>& state = solver_.state();
  if (!options_.output.empty()) {
    results::flush_file(options_.output /
                        results::files::history); // what the checkpoint counts on must not be lost before it
    results::CheckpointWriter writer;
    results::CheckpointInfo info{options_.version, std::string(isa_name(active_isa())),
                                 input_.name,      results::hash_of_inputs(input_.resolved),
                                 state.step,       state.time};
    info.archive(writer);
    archive(writer, frames);
    results::add_checkpoint(options_.output, writer.content(), input_.output.checkpoint.keep);
  }
  checkpoints_.written(state.step, state.time);
  last_checkpoint_ = step_and_time(state);
  set_last_words(options_.output, status(), how_to_go_on());
}
template<int dim> bool Simulation<dim>::go_back(const DivergenceError& error) {
  if (!retries_.may_go_back(error)) return false;
  watch_.time("output.disk", [&] { files_.wait(); });
  const double failed = solver_.state().time;
  add_step_times(watch_); // the next solver counts from zero
  std::vector<std::string> told;
  solver_ = make_solver<dim>(input_, told); // a restart begins with the same one
  int frames = 0;
  retries_.go_back(failed, error.what(), [&](Archive& archive) { frames = archive_course(archive, 0); });
  observer_.remark(fmt::format("{}\nback to {}: the reference is renewed at {:g} of the strain from there",
                               input_.placed(error.what()), step_and_time(solver_.state()),
                               retries_.strain_share()));
  // Before the files are cut short: killed in between, the run goes on from here.
  write_checkpoint(frames);
  take_up_files(frames);
  return true;
}
template<int dim> std::string Simulation<dim>::how_to_go_on() const {
  if (options_.output.empty()) return "";
  const std::string folder = options_.output.string();
  return last_checkpoint_.empty()
             ? fmt::format(
                   "there is no checkpoint yet: once this is mended, `cnem restart {}` begins at step 0",
                   folder)
             : fmt::format(
                   "the last checkpoint is of {}: once this is mended, `cnem restart {}` goes on from it",
                   last_checkpoint_, folder);
}

template void Simulation<2>::resume(results::CheckpointReader&);
template void Simulation<2>::take_up_files(int);
template int Simulation<2>::archive_course(Archive&, int);
template int Simulation<2>::archive(Archive&, int);
template void Simulation<2>::write_checkpoint(int);
template bool Simulation<2>::go_back(const DivergenceError&);
template std::string Simulation<2>::how_to_go_on() const;
template void Simulation<3>::resume(results::CheckpointReader&);
template void Simulation<3>::take_up_files(int);
template int Simulation<3>::archive_course(Archive&, int);
template int Simulation<3>::archive(Archive&, int);
template void Simulation<3>::write_checkpoint(int);
template bool Simulation<3>::go_back(const DivergenceError&);
template std::string Simulation<3>::how_to_go_on() const;

} // namespace cnem::app
