#include "app/machining/machining_session.hpp"

#include "app/machining/milling_run.hpp"
#include "app/machining/stability_run.hpp"
#include "app/process/exhaustion.hpp"
#include "app/profile.hpp"
#include "core/error.hpp"
#include "input/case_machining.hpp"
#include "machining/zero_order.hpp"
#include "report/report.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <omp.h>

namespace cnem::app {

using results::si_format;

MachiningSession::MachiningSession(const input::Case& input, const RunOptions& options, RunObserver& observer,
                                   bool goes_on)
    : input_(input), options_(options), observer_(observer), history_(options.keep_history) {
  if (!options_.output.empty() && !goes_on) {
    results::prepare_output_folder(options_.output, options_.force);
    results::write_atomically(options_.output / results::files::resolved_case, input.resolved);
  }
  status_.version = options_.version;
  status_.case_name = input_.name;
  status_.threads = omp_get_max_threads();
  watch_.pause();
}

std::variant<results::Snapshot<2>, results::Snapshot<3>> MachiningSession::snapshot() {
  throw InputError("a milling analysis has no body, expected an explicit or a static one");
}

void MachiningSession::finish() {
  status_.peak_rss_bytes = results::peak_rss_bytes();
  const auto note_times = [&] {
    status_.wall_s = watch_.spent();
    status_.cpu_s = watch_.cpu();
  };
  note_times();
  observer_.outcome(status_.reason);
  if (options_.output.empty()) return;
  if (status_.exit == Exit::done) watch_.time("output", [&] { write_files(); });
  const std::filesystem::path report = report::write_report(options_.output, status_);
  note_times();
  results::write_status(options_.output, status_);
  if (options_.profile) observer_.outcome(profile_table(status_));
  observer_.outcome("report: " + report.string());
}

std::optional<Exit> MachiningSession::go_on() {
  if (!ended_) {
    watch_.go_on();
    before_steps(input_, options_, [&] {
      if (!begun_) {
        std::vector<std::string> doubts = milling_doubts(input_);
        status_.warnings.insert(status_.warnings.end(), doubts.begin(), doubts.end());
        for (const std::string& warning : status_.warnings) observer_.remark("warning: " + warning);
        status_.exit = Exit::done;
        begun_ = true;
      }
      ended_ = true;
      try {
        watch_.time("step", [&] { ended_ = solve(); });
      } catch (const DivergenceError& error) {
        status_.exit = Exit::diverged;
        status_.reason = error.what();
      }
      if (ended_) finish();
    });
    watch_.pause();
    if (!ended_) return std::nullopt;
  }
  return static_cast<Exit>(status_.exit);
}

std::unique_ptr<Session> machining_run(const input::Case& input, const RunOptions& options,
                                       RunObserver& observer) {
  if (input.analysis.type == input::Analysis::Type::milling)
    return std::make_unique<MillingRun>(input, options, observer);
  return std::make_unique<StabilityRun>(input, options, observer);
}

std::vector<machining::Mode> modes_of(const input::Case& input) {
  return {input.machining->modes.begin(), input.machining->modes.end()};
}

std::string speed_text(double speed) { return results::number_format(speed / rpm, 6) + " rpm"; }

double deepest(const input::Case& input) {
  const input::MachiningCase& milling = *input.machining;
  if (milling.stability.depth_to) return *milling.stability.depth_to;
  constexpr double lobes = 6.0, beyond = 1.5;
  const auto least = machining::zero_order_minimum(milling.cut, modes_of(input), milling.speed);
  return std::max(least ? lobes * least->depth : 0.0, beyond * milling.axial_depth);
}

std::vector<std::string> milling_doubts(const input::Case& input) {
  const input::MachiningCase& milling = *input.machining;
  std::vector<std::string> doubts;
  const auto [thinnest, thickest] = machining::steady_chips(milling.cut);
  if (thinnest <= 0.0)
    doubts.push_back(
        input
            .error("cutter.run_out",
                   "with this run-out a tooth misses the cut at some angles: what it leaves is cut "
                   "by the next one, which stability takes no account of; expected a run-out well "
                   "below milling.feed")
            .what());
  const auto [low, high] = milling.cut.law.thicknesses();
  if (thickest > high || thickest < low)
    doubts.push_back(
        input
            .error("cutting.forces.thickness",
                   fmt::format("chips are up to {} thick, expected between {} and {}, which the "
                               "table covers",
                               si_format(thickest, "m"), si_format(low, "m"), si_format(high, "m")))
            .what());
  if (input.analysis.type != input::Analysis::Type::milling) return doubts;
  constexpr double few = 5.0, periods = 20.0;
  if (milling.dexels.pitch > milling.cut.feed / few)
    doubts.push_back(
        input
            .error("dexels.pitch",
                   fmt::format("lines are {} apart, expected at least five in a feed of {}",
                               si_format(milling.dexels.pitch, "m"), si_format(milling.cut.feed, "m")))
            .what());
  for (const input::NamedMode& mode : milling.modes)
    if (const double steps = milling.dexels.steps * milling.speed / mode.omega(); steps < periods)
      doubts.push_back(
          input
              .error("dexels.steps", fmt::format("mode {} swings once in {:.3g} steps, expected at "
                                                 "least {:g}",
                                                 mode.name, steps, periods))
              .what());
  return doubts;
}

Checked check_machining(const input::Case& input) {
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
  if (input.analysis.type == input::Analysis::Type::milling) {
    const input::DexelSettings& dexels = milling.dexels;
    const double turns = milling.length / (milling.cut.feed * static_cast<double>(cutter.teeth()));
    add("path", fmt::format("{}, {} turns of {} steps", si_format(milling.length, "m"),
                            results::number_format(turns), dexels.steps));
    add("dexels", fmt::format("{} apart, {} layers", si_format(dexels.pitch, "m"), dexels.layers));
    checked.numbers = {{"steps", turns * dexels.steps}};
    return checked;
  }
  const input::StabilityRange& range = milling.stability;
  add("chart",
      fmt::format("{} speeds from {} to {}, {} depths to {}", range.speeds, speed_text(range.speed_from),
                  speed_text(range.speed_to), range.depths, si_format(deepest(input), "m")));
  checked.numbers = {{"modes", static_cast<double>(milling.modes.size())},
                     {"points", static_cast<double>(range.speeds * range.depths)}};
  return checked;
}

} // namespace cnem::app
