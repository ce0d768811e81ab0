#include "app/machining/stability_run.hpp"

#include "app/process/exhaustion.hpp"
#include "app/profile.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "input/case_machining.hpp"
#include "machining/zero_order.hpp"
#include "report/report.hpp"
#include "report/stability_page.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <omp.h>

namespace cnem::app {

namespace {

using machining::StabilityChart;
using results::si_format;

constexpr double rpm = std::numbers::pi / 30.0; // rad/s

std::vector<machining::Mode> modes_of(const input::Case& input) {
  return {input.machining->modes.begin(), input.machining->modes.end()};
}

std::string speed_text(double speed) { return results::number_format(speed / rpm, 6) + " rpm"; }

/// The depth that charts and searches span, m.
double deepest(const input::Case& input) {
  const input::MachiningCase& milling = *input.machining;
  if (milling.stability.depth_to) return *milling.stability.depth_to;
  constexpr double lobes = 6.0, beyond = 1.5;
  const auto least = machining::zero_order_minimum(milling.cut, modes_of(input), milling.speed);
  return std::max(least ? lobes * least->depth : 0.0, beyond * milling.axial_depth);
}

/// The mode that a vibration is nearest to.
std::string nearest_mode(const input::MachiningCase& milling, double frequency) {
  const auto near =
      std::min_element(milling.modes.begin(), milling.modes.end(), [&](const auto& a, const auto& b) {
        return std::abs(std::log(a.frequency / frequency)) < std::abs(std::log(b.frequency / frequency));
      });
  return fmt::format("mode {} of the {} ({})", near->name,
                     near->of == machining::Mode::Of::tool ? "tool" : "part",
                     si_format(near->frequency, "Hz"));
}

std::string vibration(const input::MachiningCase& milling, const machining::Multiplier& at) {
  if (at.kind() == machining::Bifurcation::fold) return "it grows without a vibration of its own";
  return fmt::format("it chatters at {} ({}), by {}", si_format(at.frequency, "Hz"),
                     machining::name_of(at.kind()), nearest_mode(milling, at.frequency));
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

StabilityRun::StabilityRun(const input::Case& input, const RunOptions& options, RunObserver& observer)
    : input_(input), options_(options), observer_(observer), history_(options.keep_history) {
  if (!options_.output.empty()) {
    results::prepare_output_folder(options_.output, options_.force);
    results::write_atomically(options_.output / results::files::resolved_case, input.resolved);
  }
  status_.version = options_.version;
  status_.case_name = input_.name;
  status_.threads = omp_get_max_threads();
  watch_.pause();
}

std::variant<results::Snapshot<2>, results::Snapshot<3>> StabilityRun::snapshot() {
  throw InputError("a stability analysis has no body, expected an explicit or a static one");
}

void StabilityRun::judge(const StabilityChart& chart) {
  const input::MachiningCase& milling = *input_.machining;
  const std::vector<machining::Mode> modes = modes_of(input_);
  const double most = std::max(chart.depth.back(), milling.axial_depth);
  const auto lowest = machining::zero_order_minimum(milling.cut, modes, milling.speed);
  // Lobes that flips bound are narrow: steps of a fifth of the least limit, but not without end.
  const double step = std::clamp(lowest ? 0.2 * lowest->depth : most, most / 1000.0, most / 50.0);
  constexpr double further = 4.0;
  const auto limit = machining::depth_limit(milling.cut, modes, milling.speed, step, further * most);
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
    bound = fmt::format("there is no limit up to {}", si_format(further * most, "m"));
  const std::string cut =
      fmt::format("{} deep at {}", si_format(milling.axial_depth, "m"), speed_text(milling.speed));
  if (!stable)
    status_.reason = fmt::format("unstable {}: {}; {}; {}", cut, bound, vibration(milling, here),
                                 better_speed(milling, chart, status_));
  else if (limit && limit->depth < 1.1 * milling.axial_depth)
    status_.reason =
        fmt::format("stable {}, but barely: {}; {}", cut, bound, better_speed(milling, chart, status_));
  else
    status_.reason = fmt::format("stable {}: {}", cut, bound);
  if (!stable && limit && limit->depth > milling.axial_depth)
    status_.reason += "; it lies in an island of instability below that limit";
}

void StabilityRun::write_files(const StabilityChart& chart) const {
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
  results::write_atomically(options_.output / results::files::stability_chart, radii);
  if (const auto lobes = report::stability_lobes(options_.output, status_))
    results::write_atomically(options_.output / results::files::stability_picture,
                              report::svg_file(*lobes, results::ShownUnits::of_case(input_.resolved)));
}

void StabilityRun::solve() {
  status_.warnings = milling_doubts(input_);
  for (const std::string& warning : status_.warnings) observer_.remark("warning: " + warning);
  const input::MachiningCase& milling = *input_.machining;
  const input::StabilityRange& range = milling.stability;
  const StabilityChart chart = watch_.time("step", [&] {
    return machining::stability_chart(milling.cut, modes_of(input_), range.speed_from, range.speed_to,
                                      range.speeds, deepest(input_), range.depths);
  });
  watch_.time("step", [&] { judge(chart); });
  status_.exit = Exit::done;
  status_.time = 0.0;
  status_.peak_rss_bytes = results::peak_rss_bytes();
  const auto note_times = [&] {
    status_.wall_s = watch_.spent();
    status_.cpu_s = watch_.cpu();
  };
  note_times();
  observer_.outcome(status_.reason);
  if (options_.output.empty()) return;
  watch_.time("output", [&] { write_files(chart); });
  const std::filesystem::path report = report::write_report(options_.output, status_);
  note_times();
  results::write_status(options_.output, status_);
  if (options_.profile) observer_.outcome(profile_table(status_));
  observer_.outcome("report: " + report.string());
  observer_.recorded(false, false);
}

std::optional<Exit> StabilityRun::go_on() {
  if (!ended_) {
    watch_.go_on();
    before_steps(input_, options_, [&] { solve(); });
    watch_.pause();
    ended_ = true;
  }
  return static_cast<Exit>(status_.exit);
}

std::vector<std::string> milling_doubts(const input::Case& input) {
  const input::MachiningCase& milling = *input.machining;
  std::vector<std::string> doubts;
  const double thinnest = machining::thinnest_chip(milling.cut);
  if (thinnest <= 0.0)
    doubts.push_back(
        input
            .error("cutter.run_out",
                   "with this run-out a tooth misses the cut at some angles: what it leaves is cut "
                   "by the next one, which stability takes no account of; expected a run-out well "
                   "below milling.feed")
            .what());
  const auto [low, high] = milling.cut.law.thicknesses();
  const double angle = std::clamp(0.5 * std::numbers::pi, milling.cut.engagement.entry(milling.cut.cutter),
                                  milling.cut.engagement.exit(milling.cut.cutter));
  double thickest = 0.0;
  for (std::size_t j = 0; j < milling.cut.cutter.teeth(); ++j)
    thickest = std::max(thickest, machining::steady_thickness(milling.cut, j, angle));
  if (thickest > high || thickest < low)
    doubts.push_back(
        input
            .error("cutting.forces.thickness",
                   fmt::format("chips are up to {} thick, expected between {} and {}, which the "
                               "table covers",
                               si_format(thickest, "m"), si_format(low, "m"), si_format(high, "m")))
            .what());
  return doubts;
}

Checked check_stability(const input::Case& input) {
  const input::MachiningCase& milling = *input.machining;
  Checked checked;
  checked.warnings = milling_doubts(input);
  const auto add = [&](const char* label, std::string text) {
    checked.facts.emplace_back(label, std::move(text));
  };
  const machining::Cutter& cutter = milling.cut.cutter;
  const double degree = std::numbers::pi / 180.0, entry = milling.cut.engagement.entry(cutter),
               exit = milling.cut.engagement.exit(cutter);
  add("case", input.title.empty() ? input.name : input.title);
  add("cutter", fmt::format("{}, {} teeth, helix {} deg", si_format(cutter.diameter, "m"), cutter.teeth(),
                            results::number_format(cutter.helix / degree)));
  add("cut", fmt::format("{} deep, teeth cut from {} to {} deg", si_format(milling.axial_depth, "m"),
                         results::number_format(entry / degree), results::number_format(exit / degree)));
  add("speed",
      fmt::format(
          "{}, teeth pass at {}, edges move at {}", speed_text(milling.speed),
          si_format(milling.speed * static_cast<double>(cutter.teeth()) / (2.0 * std::numbers::pi), "Hz"),
          si_format(milling.speed * cutter.radius(), "m/s")));
  add("modes", fmt::format("{}", milling.modes.size()));
  const input::StabilityRange& range = milling.stability;
  add("chart",
      fmt::format("{} speeds from {} to {}, {} depths to {}", range.speeds, speed_text(range.speed_from),
                  speed_text(range.speed_to), range.depths, si_format(deepest(input), "m")));
  checked.numbers = {{"modes", static_cast<double>(milling.modes.size())},
                     {"points", static_cast<double>(range.speeds * range.depths)}};
  return checked;
}

} // namespace cnem::app
