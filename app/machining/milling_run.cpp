#include "app/machining/milling_run.hpp"

#include "core/index.hpp"
#include "core/machine/isa.hpp"
#include "input/case_machining.hpp"
#include "results/checkpoint_folder.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace cnem::app {

namespace {

using results::si_format;

const std::vector<std::string> columns{"time[s]",      "angle[rad]",  "Fx[N]",    "Fy[N]",
                                       "Fz[N]",        "torque[N m]", "power[W]", "thickest[m]",
                                       "removed[m^3]", "x[m]",        "y[m]",     "z[m]"};

double mean(const std::vector<double>& list) {
  return std::accumulate(list.begin(), list.end(), 0.0) / static_cast<double>(list.size());
}

machining::ProcessSettings settings_of(const input::MachiningCase& milling) {
  return {.spindle = milling.speed,
          .axial_depth = milling.axial_depth,
          .length = milling.length,
          .dwell = milling.dwell,
          .start = milling.start,
          .pitch = milling.dexels.pitch,
          .layers = milling.dexels.layers,
          .steps = milling.dexels.steps};
}

} // namespace

void MillingRun::Course::add(const machining::ProcessStep& step, double dt) {
  force = force.cwiseMax(step.force.cwiseAbs());
  torque = std::max(torque, step.torque);
  work += step.power * dt;
  time += dt;
  removed += step.removed;
  thickest = std::max(thickest, step.thickest);
  displacement = std::max(displacement, step.displacement.norm());
}

void MillingRun::Course::archive(Archive& archive) {
  archive.vector<3>("run/steady/force", "N", force);
  archive.number("run/steady/torque", "N m", torque);
  archive.number("run/steady/work", "J", work);
  archive.number("run/steady/time", "s", time);
  archive.number("run/steady/removed", "m^3", removed);
  archive.number("run/steady/thickest", "m", thickest);
  archive.number("run/steady/displacement", "m", displacement);
}

MillingRun::MillingRun(const input::Case& input, const RunOptions& options, RunObserver& observer,
                       bool goes_on)
    : MachiningSession(input, options, observer, goes_on),
      process_(input.machining->cut, plain_modes(), settings_of(*input.machining)),
      checkpoints_(input.output.checkpoint) {
  observer_.begins();
}

void MillingRun::archive(Archive& archive) {
  process_.archive(archive);
  steady_.archive(archive);
}

void MillingRun::write_checkpoint() {
  if (!options_.output.empty()) {
    results::flush_file(history_file()); // what the checkpoint counts on must not be lost before it
    results::CheckpointWriter writer;
    results::CheckpointInfo info{options_.version, std::string(isa_name(active_isa())),
                                 input_.name,      results::hash_of_inputs(input_.resolved),
                                 process_.steps(), process_.time()};
    info.archive(writer);
    archive(writer);
    results::add_checkpoint(options_.output, writer.content(), input_.output.checkpoint.keep);
  }
  checkpoints_.written(process_.steps(), process_.time());
}

void MillingRun::resume(results::CheckpointReader& checkpoint) {
  archive(checkpoint);
  history_.resume(history_file(), columns, process_.steps());
  status_.steps = process_.steps();
  checkpoints_.written(process_.steps(), process_.time());
}

std::filesystem::path MillingRun::history_file() const {
  return options_.output.empty() ? options_.output : options_.output / results::files::history;
}

bool MillingRun::solve() {
  const input::MachiningCase& milling = *input_.machining;
  if (!history_.begun()) history_.start(history_file(), columns);
  const double dt = machining::full_turn / milling.speed / milling.dexels.steps;
  // Whole turns before the end: what counts is steady there, as far as the path lets it.
  const double fed = process_.motion().duration() - milling.dwell * dt * milling.dexels.steps;
  const double turns = std::floor(fed / (dt * milling.dexels.steps));
  const double window = std::max(1.0, std::floor(0.25 * turns)) * milling.dexels.steps * dt;
  while (!process_.at_end()) {
    const Request request = observer_.request();
    const bool stopped = request.kind == Request::Kind::stop;
    if (stopped || request.kind == Request::Kind::checkpoint ||
        checkpoints_.due(process_.steps(), process_.time()))
      write_checkpoint();
    if (stopped) {
      status_.exit = Exit::interrupted;
      status_.time = process_.time();
      status_.reason = fmt::format("by {} at step {}", request.by, process_.steps());
      observer_.steps_end();
      return true;
    }
    if (request.kind == Request::Kind::pause) return false;
    const machining::ProcessStep step = process_.advance();
    if (step.time > fed - window && step.time < fed) steady_.add(step, dt);
    const std::array row{step.time,
                         step.angle,
                         step.force.x(),
                         step.force.y(),
                         step.force.z(),
                         step.torque,
                         step.power,
                         step.thickest,
                         step.removed,
                         step.displacement.x(),
                         step.displacement.y(),
                         step.displacement.z()};
    history_.write(row);
    ++status_.steps;
    observer_.progress(
        {.time = process_.time(), .end = process_.motion().duration(), .step = process_.steps(), .dt = dt});
  }
  observer_.steps_end();
  status_.time = process_.time();
  measure_surface();
  judge();
  return true;
}

void MillingRun::measure_surface() {
  const double turn = process_.feed_of_turn();
  const bool outside = input_.machining->start == machining::ProcessSettings::Start::outside;
  // Teeth have passed there: from where the first turns have been to where the last one is.
  const double from = process_.motion().start() +
                      std::max(2.0 * turn, outside ? 0.0 : 0.5 * (process_.axis().x() - process_.motion().start())),
               to = process_.axis().x() - turn, pitch = input_.machining->dexels.pitch;
  for (double x = std::max(from, 0.0); x <= to; x += pitch) place_.push_back(x);
  for (std::size_t k = 0; k < process_.layers().size(); ++k) {
    if (!process_.cuts(k)) continue;
    cut_layer_.push_back(k);
    left_.emplace_back();
    for (const double x : place_) left_.back().push_back(left_at(k, x));
  }
}

double MillingRun::left_at(std::size_t layer, double x) const {
  if (const auto left = process_.left_at(layer, x)) return *left;
  throw DivergenceError(
      fmt::format("nothing is left of the workpiece at {} along the path and {} over the tip: the "
                  "cutter has gone through it, expected vibrations that are small beside the cut",
                  si_format(x, "m"), si_format(process_.height(layer), "m")),
      -1, "displacement");
}

MillingRun::Texture MillingRun::texture(std::size_t layer) const {
  // Tips of scallops lie between dexels.
  constexpr int finer = 16;
  constexpr std::size_t lengths = 5;
  std::vector<double> height;
  for (std::size_t i = 0; i + 1 < place_.size(); ++i)
    for (int part = 0; part < finer; ++part)
      height.push_back(left_at(layer, place_[i] + part * (place_[i + 1] - place_[i]) / finer));
  if (height.empty()) return {};
  Texture texture;
  texture.location_error = mean(height);
  for (const double h : height)
    texture.Ra += std::abs(h - texture.location_error) / static_cast<double>(height.size());
  const auto [low, high] = std::minmax_element(height.begin(), height.end());
  texture.peak_to_valley = *high - *low;
  for (std::size_t k = 0; k < lengths; ++k) { // ISO 4287
    const auto from = height.begin() + static_cast<std::ptrdiff_t>(k * height.size() / lengths);
    const auto to = height.begin() + static_cast<std::ptrdiff_t>((k + 1) * height.size() / lengths);
    const auto [least, most] = std::minmax_element(from, to);
    texture.Rz += (*most - *least) / lengths;
  }
  return texture;
}

void MillingRun::tell_surface() {
  std::vector<Texture> layers;
  for (const std::size_t k : cut_layer_) layers.push_back(texture(k));
  const auto zone = [&](const std::string& name, std::size_t from, std::size_t to) {
    Texture all;
    for (std::size_t k = from; k < to; ++k) {
      all.Ra += layers[k].Ra / static_cast<double>(to - from);
      all.Rz += layers[k].Rz / static_cast<double>(to - from);
      all.peak_to_valley = std::max(all.peak_to_valley, layers[k].peak_to_valley);
      if (std::abs(layers[k].location_error) > std::abs(all.location_error))
        all.location_error = layers[k].location_error;
    }
    for (const auto& [what, value] : {std::pair{"Ra", all.Ra},
                                      {"Rz", all.Rz},
                                      {"peak_to_valley", all.peak_to_valley},
                                      {"location_error", all.location_error}})
      status_.add_metric(fmt::format("{}.{}[m]", name, what), value);
    return all;
  };
  const Texture whole = zone("milling", 0, layers.size());
  surface_ = fmt::format("the surface is {} from peak to valley along the feed, and off its place by {}",
                         si_format(whole.peak_to_valley, "m"), si_format(whole.location_error, "m"));
  if (layers.size() < 3) return;
  const std::array<std::size_t, 4> third{0, layers.size() / 3, 2 * layers.size() / 3, layers.size()};
  for (const auto& [k, name] : {std::pair{0U, "bottom"}, {1U, "middle"}, {2U, "top"}})
    zone(fmt::format("milling.{}", name), third[k], third[k + 1]);
}

void MillingRun::judge() {
  const Course& steady = steady_;
  const input::MachiningCase& milling = *input_.machining;
  for (const auto& [axis, force] :
       {std::pair{"x", steady.force.x()}, {"y", steady.force.y()}, {"z", steady.force.z()}})
    status_.add_metric(fmt::format("milling.F{}[N]", axis), force);
  status_.add_metric("milling.torque[N m]", steady.torque);
  status_.add_metric("milling.power[W]", steady.work / steady.time);
  status_.add_metric("milling.removal_rate[m^3/s]", steady.removed / steady.time);
  status_.add_metric("milling.thickest[m]", steady.thickest);
  // Campomanes and Altintas (2003): chips a quarter thicker than without vibration are chatter.
  constexpr double chatter = 1.25;
  // Across the profile, where it is the steepest.
  const double still = std::sin(milling.cut.cutter.lead(milling.axial_depth, milling.axial_depth)) *
                       machining::steady_chips(milling.cut).thickest;
  const bool chatters = !modes_.empty() && steady.thickest > chatter * still;
  status_.add_metric("milling.chip_growth", steady.thickest / still);
  status_.add_metric("milling.chatter", chatters ? 1.0 : 0.0);
  status_.flags.emplace_back("milling.chatter");
  if (!modes_.empty()) status_.add_metric("milling.displacement[m]", steady.displacement);
  // Chips change by more than a small part of themselves: lobes, which are of small vibrations, say no more.
  if (constexpr double small = 0.5; steady.displacement > small * milling.cut.engagement.radial_depth)
    warn(input_
             .error("milling.radial_depth",
                    fmt::format("the cutter moves by {} relative to the part, expected less than half of the "
                                "radial depth: vibrations are not small beside the cut",
                                si_format(steady.displacement, "m")))
             .what());
  if (place_.size() > 1 && !cut_layer_.empty()) tell_surface();
  status_.reason =
      fmt::format("{}; at most {} along x, {} along y; {}",
                  modes_.empty() ? "a rigid cut"
                  : chatters     ? fmt::format("chatter: chips {} times as thick as without vibration",
                                               results::number_format(steady.thickest / still, 3))
                                 : "no chatter",
                  si_format(steady.force.x(), "N"), si_format(steady.force.y(), "N"), surface_);
}

void MillingRun::write_files() {
  std::string text = "x[m]";
  for (const std::size_t k : cut_layer_)
    text += fmt::format(",left_at_{:.6g}_mm[m]", 1e3 * process_.height(k));
  text += '\n';
  for (std::size_t i = 0; i < place_.size(); ++i) {
    text += fmt::format("{}", place_[i]);
    for (const std::vector<double>& left : left_) text += fmt::format(",{:.9g}", left[i]);
    text += '\n';
  }
  results::write_atomically(options_.output / results::files::machined_surface, text);
}

} // namespace cnem::app
