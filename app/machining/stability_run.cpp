#include "app/machining/stability_run.hpp"

#include "app/machining/structure_modes.hpp"
#include "input/case_machining.hpp"
#include "machining/zero_order.hpp"
#include "report/stability_page.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cnem::app {

namespace {

using machining::StabilityChart;
using results::si_format;

/// The mode that a vibration is nearest to.
std::string nearest_mode(const std::vector<input::NamedMode>& modes, double frequency) {
  const auto near = std::min_element(modes.begin(), modes.end(), [&](const auto& a, const auto& b) {
    return std::abs(std::log(a.frequency / frequency)) < std::abs(std::log(b.frequency / frequency));
  });
  return fmt::format("mode {} of the {} ({})", near->name,
                     near->of == machining::Mode::Of::tool ? "tool" : "part",
                     si_format(near->frequency, "Hz"));
}

std::string vibration(const std::vector<input::NamedMode>& modes, const machining::Multiplier& at) {
  if (at.kind() == machining::Bifurcation::fold) return "it grows without a vibration of its own";
  return fmt::format("it chatters at {} ({}), by {}", si_format(at.frequency, "Hz"),
                     machining::name_of(at.kind()), nearest_mode(modes, at.frequency));
}

/// Another speed that bears the depth with a tenth to spare, "" where there is none; metrics of it.
std::string better_speed(const input::MachiningCase& milling, const StabilityChart& chart,
                         results::RunStatus& status) {
  constexpr double spare = 1.1;
  const auto there = machining::nearest_speed(chart, milling.speed, spare * milling.axial_depth);
  if (!there)
    return fmt::format("no speed from {} to {} bears this depth", speed_text(chart.speed.front()),
                       speed_text(chart.speed.back()));
  const auto& limit = chart.limit[*there];
  status.add_metric("stability.better_speed[rad/s]", chart.speed[*there]);
  return fmt::format("the nearest better speed is {}, which bears {}", speed_text(chart.speed[*there]),
                     limit ? si_format(limit->depth, "m")
                           : "more than " + si_format(chart.depth.back(), "m"));
}

} // namespace

void StabilityRun::judge() {
  const StabilityChart& chart = chart_;
  const input::MachiningCase& milling = *input_.machining;
  const std::vector<machining::Mode> modes = plain_modes();
  const double most = std::max(chart.depth.back(), milling.axial_depth);
  const auto lowest = machining::zero_order_minimum(milling.cut, modes, milling.speed);
  // Lobes that flips bound are narrow: steps of a fifth of the least limit, but not without end.
  const double step = std::clamp(lowest ? 0.2 * lowest->depth : most, most / 1000.0, most / 50.0);
  constexpr double further = 4.0;
  const double deepest = std::max(most, std::min(further * most, milling.cut.cutter.top()));
  const auto limit = machining::depth_limit(milling.cut, modes, milling.speed, step, deepest);
  const auto zero = machining::zero_order_limit(milling.cut, modes, milling.speed);
  const auto here = machining::multiplier(milling.cut, modes, milling.speed, milling.axial_depth);
  const bool stable = std::abs(here.value) < 1.0;
  status_.add_metric("stability.speed[rad/s]", milling.speed);
  status_.add_metric("stability.depth[m]", milling.axial_depth);
  status_.add_metric("stability.stable", stable ? 1.0 : 0.0);
  status_.flags.emplace_back("stability.stable");
  status_.add_metric("stability.spectral_radius", std::abs(here.value));
  if (zero) status_.add_metric("stability.zero_order_limit[m]", zero->depth);
  std::string bound;
  if (limit) {
    status_.add_metric("stability.depth_limit[m]", limit->depth);
    status_.add_metric("stability.chatter_frequency[Hz]", limit->at.frequency);
    status_.add_metric("stability.flip", limit->at.kind() == machining::Bifurcation::flip ? 1.0 : 0.0);
    status_.flags.emplace_back("stability.flip");
    bound = fmt::format("the limit is {}", si_format(limit->depth, "m"));
  } else
    bound = fmt::format("there is no limit up to {}", si_format(deepest, "m"));
  const std::string cut =
      fmt::format("{} deep at {}", si_format(milling.axial_depth, "m"), speed_text(milling.speed));
  if (!stable)
    status_.reason = fmt::format("unstable {}: {}; {}; {}", cut, bound, vibration(modes_, here),
                                 better_speed(milling, chart, status_));
  else if (limit && limit->depth < 1.1 * milling.axial_depth)
    status_.reason =
        fmt::format("stable {}, but barely: {}; {}", cut, bound, better_speed(milling, chart, status_));
  else
    status_.reason = fmt::format("stable {}: {}", cut, bound);
  if (!stable && limit && limit->depth > milling.axial_depth)
    status_.reason += "; it lies in an island of instability below that limit";
  doubt_edge_forces(modes, limit, step, deepest);
}

void StabilityRun::doubt_edge_forces(const std::vector<machining::Mode>& modes,
                                     const std::optional<machining::DepthLimit>& limit, double step,
                                     double deepest) {
  const input::MachiningCase& milling = *input_.machining;
  if (milling.cut.onset > 0.0) return;
  const machining::MillingCut cut = machining::with_edge_forces(milling.cut);
  const machining::LawPoint thin =
      cut.law.at({.thickness = cut.onset, .speed = milling.speed * cut.cutter.radius()});
  constexpr double rounding = 1e-9;
  if ((thin.force - thin.slope * cut.onset).norm() <= rounding * thin.force.norm()) return;
  const auto with = machining::depth_limit(cut, modes, milling.speed, step, deepest);
  if (with) status_.add_metric("stability.depth_limit_with_edge_forces[m]", with->depth);
  const double none = 2.0 * deepest, one = limit ? limit->depth : none, other = with ? with->depth : none;
  if (constexpr double matters = 0.05; std::abs(other - one) <= matters * one) return;
  const auto told = [&](const auto& depth) {
    return depth ? si_format(depth->depth, "m") : "none up to " + si_format(deepest, "m");
  };
  status_.warnings.push_back(
      input_
          .error("cutting.forces",
                 fmt::format("edge forces change the limit: it is {} with them, {} without; charts are "
                             "without them, expected stability.edge_forces = true, or a run in time",
                             told(with), told(limit)))
          .what());
  observer_.remark("warning: " + status_.warnings.back());
}

void StabilityRun::write_files() {
  const StabilityChart& chart = chart_;
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::string limits = "speed[rad/s],speed[rpm],limit[m],zero_order[m],frequency[Hz],flip\n",
              radii = "depth[m]";
  for (std::size_t i = 0; i < chart.speed.size(); ++i) {
    const auto& limit = chart.limit[i];
    limits +=
        fmt::format("{},{},{},{},{},{}\n", chart.speed[i], chart.speed[i] / rpm, limit ? limit->depth : none,
                    chart.zero_order[i].value_or(none), limit ? limit->at.frequency : none,
                    limit && limit->at.kind() == machining::Bifurcation::flip ? 1 : 0);
    radii += fmt::format(",{} rpm", results::number_format(chart.speed[i] / rpm, 6));
  }
  radii += '\n';
  for (std::size_t k = 0; k < chart.depth.size(); ++k) {
    radii += fmt::format("{}", chart.depth[k]);
    for (std::size_t i = 0; i < chart.speed.size(); ++i)
      radii += fmt::format(",{:.9g}", chart.radius[i * chart.depth.size() + k]);
    radii += '\n';
  }
  results::write_atomically(options_.output / results::files::stability, limits);
  if (places_) {
    std::string along = "place[m]";
    for (const double speed : places_->speed)
      along += fmt::format(",{}_rpm[m]", results::number_format(speed / rpm, 6));
    along += '\n';
    for (std::size_t k = 0; k < places_->place.size(); ++k) {
      along += fmt::format("{}", places_->place[k]);
      for (std::size_t i = 0; i < places_->speed.size(); ++i) {
        const auto& limit = places_->limit[k * places_->speed.size() + i];
        along += fmt::format(",{}", limit ? limit->depth : none);
      }
      along += '\n';
    }
    results::write_atomically(options_.output / results::files::stability_places, along);
    std::string modes = mode_table_head;
    for (std::size_t k = 0; k < met_.size(); ++k)
      for (const input::NamedMode& mode : met_[k])
        modes += mode_row(mode.of == machining::Mode::Of::tool ? "tool" : "part", mode.name, mode,
                          fmt::format("{}", places_->place[k]));
    results::write_atomically(options_.output / results::files::modes, modes);
  }
  results::write_atomically(options_.output / results::files::stability_chart, radii);
  if (const auto lobes = report::stability_lobes(options_.output, status_))
    results::write_atomically(options_.output / results::files::stability_picture,
                              report::svg_file(*lobes, results::ShownUnits::of_case(input_.resolved)));
}

bool StabilityRun::solve() {
  const input::MachiningCase& milling = *input_.machining;
  const input::StabilityRange& range = milling.stability;
  met_ = modes_at_places(input_, modes_);
  const ModesAtPlaces there = chattering(met_, milling.cut.cutter);
  const double most = deepest(input_, there);
  double weakest = 0.0; // m, place along the path
  if (!range.places.empty()) {
    constexpr int fine = 25;
    places_ = machining::place_chart(milling.cut, there, range.places, range.speed_from, range.speed_to,
                                     range.speeds, most, std::min(range.depths, fine));
    const std::size_t k = places_->weakest(milling.speed);
    weakest = places_->place[k];
    status_.add_metric("stability.weakest_place[m]", weakest);
    modes_ = met_[k];
  }
  chart_ = machining::stability_chart(milling.cut, plain_modes(), range.speed_from, range.speed_to,
                                      range.speeds, most, range.depths);
  judge();
  if (places_)
    status_.reason += fmt::format("; that is where the path is weakest, at {}", si_format(weakest, "m"));
  status_.time = 0.0;
  return true;
}

} // namespace cnem::app
