#include "app/machining/milling_run.hpp"

#include "core/index.hpp"
#include "input/case_machining.hpp"
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

void MillingRun::solve() {
  const input::MachiningCase& milling = *input_.machining;
  machining::MillingProcess process(milling.cut, plain_modes(),
                                    {.spindle = milling.speed,
                                     .axial_depth = milling.axial_depth,
                                     .length = milling.length,
                                     .from_outside = milling.entry,
                                     .pitch = milling.dexels.pitch,
                                     .layers = milling.dexels.layers,
                                     .steps = milling.dexels.steps});
  history_.start(results::file_in(options_.output, results::files::history), columns);
  const double dt = machining::full_turn / milling.speed / milling.dexels.steps;
  // Whole turns before the end: what counts is steady there, as far as the path lets it.
  const double turns = std::floor(process.duration() / (dt * milling.dexels.steps));
  const double window = std::max(1.0, std::floor(0.25 * turns)) * milling.dexels.steps * dt;
  Course steady;
  while (!process.at_end()) {
    const machining::ProcessStep step = process.advance();
    if (step.time > process.duration() - window) steady.add(step, dt);
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
  }
  status_.time = process.time();
  measure_surface(process);
  judge(steady);
}

void MillingRun::measure_surface(const machining::MillingProcess& process) {
  const double turn = process.feed_of_turn();
  // Teeth have passed there: from where the first turns have been to where the last one is.
  const double from = process.start() + std::max(2.0 * turn, input_.machining->entry
                                                                 ? 0.0
                                                                 : 0.5 * (process.axis() - process.start())),
               to = process.axis() - turn, pitch = input_.machining->dexels.pitch;
  for (double x = std::max(from, 0.0); x <= to; x += pitch) place_.push_back(x);
  left_.resize(process.layers().size());
  for (std::size_t k = 0; k < left_.size(); ++k) {
    height_.push_back(process.height(k));
    for (const double x : place_) left_[k].push_back(process.left_at(k, x));
  }
}

void MillingRun::judge(const Course& steady) {
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
  const double still = machining::steady_chips(milling.cut).thickest;
  const bool chatters = !modes_.empty() && steady.thickest > chatter * still;
  status_.add_metric("milling.chip_growth", steady.thickest / still);
  status_.add_metric("milling.chatter", chatters ? 1.0 : 0.0);
  status_.flags.emplace_back("milling.chatter");
  if (!modes_.empty()) status_.add_metric("milling.displacement[m]", steady.displacement);
  std::string surface = "the path is too short for a surface";
  if (!place_.empty()) {
    double roughness = 0.0, error = 0.0;
    for (const std::vector<double>& left : left_) {
      const auto [low, high] = std::minmax_element(left.begin(), left.end());
      roughness = std::max(roughness, *high - *low);
      if (const double e = mean(left); std::abs(e) > std::abs(error)) error = e;
    }
    status_.add_metric("milling.peak_to_valley[m]", roughness);
    status_.add_metric("milling.location_error[m]", error);
    surface = fmt::format("the surface is {} from peak to valley along the feed, and off its place by {}",
                          si_format(roughness, "m"), si_format(error, "m"));
  }
  status_.reason =
      fmt::format("{}; at most {} along x, {} along y; {}",
                  modes_.empty() ? "a rigid cut"
                  : chatters     ? fmt::format("chatter: chips {} times as thick as without vibration",
                                               results::number_format(steady.thickest / still, 3))
                                 : "no chatter",
                  si_format(steady.force.x(), "N"), si_format(steady.force.y(), "N"), surface);
}

void MillingRun::write_files() {
  std::string text = "x[m]";
  for (const double z : height_) text += fmt::format(",left_at_{:.6g}_mm[m]", 1e3 * z);
  text += '\n';
  for (std::size_t i = 0; i < place_.size(); ++i) {
    text += fmt::format("{}", place_[i]);
    for (const std::vector<double>& left : left_) text += fmt::format(",{:.9g}", left[i]);
    text += '\n';
  }
  results::write_atomically(options_.output / results::files::machined_surface, text);
}

} // namespace cnem::app
