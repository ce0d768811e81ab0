#include "app/machining/machining_session.hpp"

#include "app/machining/left_workpiece.hpp"
#include "app/machining/milling_doubts.hpp"
#include "app/machining/milling_run.hpp"
#include "app/machining/modes_run.hpp"
#include "app/machining/removal_run.hpp"
#include "app/machining/stability_run.hpp"
#include "app/machining/structure_modes.hpp"
#include "app/process/exhaustion.hpp"
#include "app/profile.hpp"
#include "core/error.hpp"
#include "input/case_machining.hpp"
#include "machining/engaged_edges.hpp"
#include "machining/zero_order.hpp"
#include "report/report.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <omp.h>

namespace cnem::app {

using results::si_format;

MachiningSession::MachiningSession(const input::Case& input, const RunOptions& options, RunObserver& observer,
                                   bool goes_on)
    : input_(input), options_(options), observer_(observer), history_(options.keep_history) {
  if (!options_.output.empty() && !goes_on) {
    if (input.machining && !input.machining->earlier_run.empty() &&
        std::filesystem::weakly_canonical(options_.output) ==
            std::filesystem::weakly_canonical(input.machining->earlier_run))
      throw input.error("milling.workpiece.run",
                        "found the folder that this run's results go to, expected another --output: the "
                        "workpiece there would be deleted");
    results::prepare_output_folder(options_.output, options_.force);
    results::write_atomically(options_.output / results::files::resolved_case, input.resolved);
  }
  status_.version = options_.version;
  status_.case_name = input_.name;
  status_.threads = omp_get_max_threads();
  if (input.machining) modes_ = modes_of(input);
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
        std::vector<std::string> doubts = milling_doubts(input_, modes_);
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
  if (input.analysis.type == input::Analysis::Type::modes)
    return std::make_unique<ModesRun>(input, options, observer);
  if (input.analysis.type == input::Analysis::Type::removal)
    return std::make_unique<RemovalRun>(input, options, observer);
  return std::make_unique<StabilityRun>(input, options, observer);
}

namespace {

/// Whether any of them moves across the axis of the cutter: edges at one radius that move along it cut the
/// same chips.
bool move_across(const std::vector<input::NamedMode>& modes, const machining::Cutter& cutter) {
  constexpr double still = 1e-6; // directions of a solved part have rounding of some 1e-9
  return std::any_of(modes.begin(), modes.end(), [&](const machining::Mode& mode) {
    return cutter.rounded() || mode.direction.head<2>().norm() >= still;
  });
}

} // namespace

std::vector<input::NamedMode> modes_of(const input::Case& input) {
  std::vector<input::NamedMode> modes = input.machining->modes;
  if (input.structure->part) {
    const SolvedPart solved(input);
    if (input.structure->part->mapped) { // all of them deform it; what they do at one place is not asked
      int number = 0;
      for (const double omega : solved.modes.omega)
        modes.push_back({machining::Mode{.of = machining::Mode::Of::part,
                                         .frequency = omega / machining::full_turn,
                                         .damping = input.structure->part->damping_of(omega),
                                         .stiffness = omega * omega},
                         fmt::format("{}", ++number)});
      return modes;
    }
    for (const input::NamedMode& mode : modes_at_cutter(input, solved)) modes.push_back(mode);
    const bool at_places = input.analysis.type == input::Analysis::Type::stability &&
                           !input.machining->stability.places.empty(); // modes_at_places() asks there
    if (!at_places && !move_across(modes, input.machining->cut.cutter))
      throw input.error("part.cutter",
                        "found a place where no mode of the part moves across the axis of the cutter, "
                        "expected one away from what is held");
  }
  return modes;
}

std::string speed_text(double speed) { return results::number_format(speed / rpm, 6) + " rpm"; }

std::vector<std::vector<input::NamedMode>> modes_at_places(const input::Case& input,
                                                           const std::vector<input::NamedMode>& modes) {
  const std::vector<double>& places = input.machining->stability.places;
  if (places.empty()) return {modes};
  std::vector<std::vector<input::NamedMode>> met;
  for (const double place : places) met.push_back(modes_met(input, place));
  const auto move = [&](const auto& there) { return move_across(there, input.machining->cut.cutter); };
  if (std::none_of(met.begin(), met.end(), move))
    throw input.error("stability.places",
                      "found places at none of which a mode moves across the axis of the cutter, expected "
                      "others: nothing can chatter there");
  return met;
}

ModesAtPlaces chattering(const std::vector<std::vector<input::NamedMode>>& modes,
                         const machining::Cutter& cutter) {
  ModesAtPlaces all;
  for (const std::vector<input::NamedMode>& there : modes)
    all.push_back(move_across(there, cutter) ? std::vector<machining::Mode>(there.begin(), there.end())
                                             : std::vector<machining::Mode>{});
  return all;
}

double deepest(const input::Case& input, const ModesAtPlaces& modes) {
  const input::MachiningCase& milling = *input.machining;
  if (milling.stability.depth_to) return *milling.stability.depth_to;
  constexpr double lobes = 6.0, beyond = 1.5;
  double least = infinite; // m
  for (const std::vector<machining::Mode>& there : modes)
    if (const auto limit = machining::zero_order_minimum(milling.cut, there, milling.speed))
      least = std::min(least, limit->depth);
  return std::min(milling.cut.cutter.top(),
                  std::max(least < infinite ? lobes * least : 0.0, beyond * milling.axial_depth));
}

namespace {

/// What there is to say of parts and shafts.
void describe(const input::Case& input, Checked& checked) {
  const input::StructureCase& structure = *input.structure;
  if (const auto& read = structure.part) {
    const machining::Part part = part_of(input);
    for (const input::PartPlace& place : read->places) displacement_at(input, part, place);
    if (read->mapped && input.machining)
      check_mapped_workpiece(input, part);
    else if (read->cutter)
      displacement_at_cutter(input, part);
    if (input.machining)
      for (const double place : input.machining->stability.places)
        displacement_on_the_way(input, part, place);
    const Vec3& size = read->shape.size;
    checked.facts.emplace_back("part", fmt::format("{} × {} × {}, {} cells, {} unknowns",
                                                   si_format(size.x(), "m"), si_format(size.y(), "m"),
                                                   si_format(size.z(), "m"), part.cells(), part.unknowns()));
    checked.numbers.emplace_back("unknowns", static_cast<double>(part.unknowns()));
    if (structure.removal) describe_removal(input, part, checked);
  }
  if (const auto& read = structure.shaft) {
    const machining::Shaft shaft = shaft_of(input);
    checked.facts.emplace_back("shaft", fmt::format("{} long, {} elements, at {}",
                                                    si_format(shaft.end() - shaft.begin(), "m"),
                                                    shaft.nodes().size() - 1, speed_text(read->speed)));
  }
}

/// "3, tips at 4 mm, 2 mm, 0 m"
std::string tips_text(const input::MachiningCase& milling) {
  std::string text = fmt::format("{}, tips at ", milling.passes.size());
  for (std::size_t k = 0; k < milling.passes.size(); ++k)
    text += (k > 0 ? ", " : "") + si_format(milling.passes[k].tip(), "m");
  return text;
}

} // namespace

Checked check_machining(const input::Case& input) {
  Checked checked;
  if (!input.machining) {
    checked.warnings = milling_doubts(input, {});
    checked.facts.emplace_back("case", input.title.empty() ? input.name : input.title);
    describe(input, checked);
    return checked;
  }
  const input::MachiningCase& milling = *input.machining;
  const std::vector<input::NamedMode> modes = modes_of(input);
  checked.warnings = milling_doubts(input, modes);
  const auto add = [&](const char* label, std::string text) {
    checked.facts.emplace_back(label, std::move(text));
  };
  const machining::Cutter& cutter = milling.cut.cutter;
  const double in_cut = machining::steady_chips(milling.cut, milling.axial_depth).radius,
               radius = in_cut > 0.0 ? in_cut : cutter.radius(), degree = std::numbers::pi / 180.0,
               entry = milling.cut.engagement.entry(cutter, radius),
               exit = milling.cut.engagement.exit(cutter, radius);
  add("case", input.title.empty() ? input.name : input.title);
  const auto shown = [&](double angle) { return results::number_format(angle / degree, 4) + " deg"; };
  if (const machining::CuttingEdge* edge = cutter.edge.get()) {
    const auto [inclination, rake] = edge->angles(0.0, milling.axial_depth);
    add("cutter",
        fmt::format("{}, {} teeth, edges of {} pieces up to {}, inclined by {}, rake {} in the mean",
                    si_format(cutter.diameter, "m"), cutter.teeth(), edge->points().size() - 1,
                    si_format(edge->top(), "m"), shown(inclination), shown(rake)));
  } else
    add("cutter", fmt::format("{}, {} teeth, helix {}", si_format(cutter.diameter, "m"), cutter.teeth(),
                              shown(cutter.helix)));
  add("cut", fmt::format("{} deep, teeth cut from {} to {} deg", si_format(milling.axial_depth, "m"),
                         results::number_format(entry / degree), results::number_format(exit / degree)));
  add("speed",
      fmt::format(
          "{}, teeth pass at {}, edges move at {}", speed_text(milling.speed),
          si_format(milling.speed * static_cast<double>(cutter.teeth()) / (2.0 * std::numbers::pi), "Hz"),
          si_format(milling.speed * radius, "m/s")));
  if (const machining::Flank& flank = milling.cut.flank; flank.presses())
    add("flanks",
        fmt::format("a land of {} ploughs, {} of clearance, {} of recovery", si_format(flank.land, "m"),
                    results::number_format(flank.clearance / degree) + " deg",
                    si_format(flank.recovery, "m")));
  describe(input, checked);
  add("modes", fmt::format("{}", modes.size()));
  if (input.analysis.type == input::Analysis::Type::milling) {
    const input::DexelSettings& dexels = milling.dexels;
    const double turns = milling.length / (milling.cut.feed * static_cast<double>(cutter.teeth()));
    add("path", fmt::format("{}, {} turns of {} steps", si_format(milling.length, "m"),
                            results::number_format(turns), dexels.steps));
    if (!milling.passes.empty()) add("passes", tips_text(milling));
    if (const auto left = workpiece_of_earlier_run(input))
      add("workpiece", fmt::format("what {} has left, {} high in {} layers", milling.earlier_run,
                                   si_format(left->height(), "m"), left->layers.size()));
    add("dexels", fmt::format("{} apart, {} layers", si_format(dexels.pitch, "m"), dexels.layers));
    checked.numbers.emplace_back("steps", turns * dexels.steps);
    return checked;
  }
  const input::StabilityRange& range = milling.stability;
  add("chart",
      fmt::format("{} speeds from {} to {}, {} depths to {}", range.speeds, speed_text(range.speed_from),
                  speed_text(range.speed_to), range.depths,
                  si_format(deepest(input, chattering(modes_at_places(input, modes), cutter)), "m")));
  checked.numbers.emplace_back("modes", static_cast<double>(modes.size()));
  checked.numbers.emplace_back("points", static_cast<double>(range.speeds * range.depths));
  return checked;
}

} // namespace cnem::app
