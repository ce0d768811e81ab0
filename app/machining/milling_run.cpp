#include "app/machining/milling_run.hpp"

#include "app/machining/left_workpiece.hpp"
#include "app/machining/structure_modes.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "input/case_machining.hpp"
#include "input/left_workpiece.hpp"
#include "machining/engaged_edges.hpp"
#include "report/picture_album.hpp"
#include "report/surface_map.hpp"
#include "results/file_queue.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::app {

namespace {

using results::si_format;

const std::vector<std::string> history_columns{"time[s]",
                                               "angle[rad]",
                                               "Fx[N]",
                                               "Fy[N]",
                                               "Fz[N]",
                                               "torque[N m]",
                                               "power[W]",
                                               "thickest[m]",
                                               "removed[m^3]",
                                               "x[m]",
                                               "y[m]",
                                               "z[m]",
                                               "axis_x[m]",
                                               "axis_y[m]",
                                               "axis_z[m]",
                                               "energy.spindle[J]",
                                               "energy.feed[J]",
                                               "energy.cutting[J]",
                                               "energy.ploughing[J]",
                                               "energy.damping[J]",
                                               "energy.chips[J]",
                                               "energy.kinetic[J]",
                                               "energy.elastic[J]",
                                               "energy.residual[J]"};

machining::ProcessSettings settings_of(const input::Case& input) {
  const input::MachiningCase& milling = *input.machining;
  return {.spindle = milling.speed,
          .axial_depth = milling.axial_depth,
          .length = milling.length,
          .dwell = milling.dwell,
          .start = milling.start,
          .pitch = milling.dexels.pitch,
          .layers = milling.dexels.layers,
          .steps = milling.dexels.steps,
          .passes = milling.passes,
          .blank = blank_of(input),
          .drive = milling.drive};
}

/// Of the turns of a run those that count, for forces and for vibration, and how many at most.
constexpr double share_of_forces = 0.25, share_of_vibration = 0.5, most_turns = 128.0;

/// A row a frequency, up to some harmonics of the teeth and beyond all modes; empty for too short a run.
std::string spectra_file(const machining::CutVibration& vibration, const input::Case& input,
                         const std::vector<input::NamedMode>& modes) {
  using machining::CutVibration;
  const input::MachiningCase& milling = *input.machining;
  std::vector<machining::Spectrum> spectra;
  for (std::size_t k = 0; k < (modes.empty() ? 3 : CutVibration::signals); ++k)
    if (auto spectrum = vibration.spectrum(static_cast<CutVibration::Signal>(k), milling.speed))
      spectra.push_back(std::move(*spectrum));
  if (spectra.empty()) return {};
  constexpr double harmonics = 10.0, beyond = 3.0;
  const double turning = milling.speed / machining::full_turn,
               teeth = turning * static_cast<double>(milling.cut.cutter.teeth());
  double last = harmonics * teeth;
  for (const input::NamedMode& mode : modes) last = std::max(last, beyond * mode.frequency);
  std::string text = "frequency[Hz],harmonic,Fx[N],Fy[N],Fz[N]";
  if (!modes.empty()) text += ",x[m],y[m],z[m]";
  text += '\n';
  const auto on = [&](double frequency, double base) {
    return std::abs(frequency / base - std::round(frequency / base)) * base < 0.5 * spectra[0].step;
  };
  for (std::size_t k = 0; k < spectra[0].amplitude.size() && spectra[0].frequency(k) <= last; ++k) {
    const double frequency = spectra[0].frequency(k);
    text += fmt::format("{:.9g},{}", frequency,
                        k == 0                   ? 0
                        : on(frequency, teeth)   ? 2
                        : on(frequency, turning) ? 1
                                                 : 0);
    for (const machining::Spectrum& spectrum : spectra) text += fmt::format(",{:.6g}", spectrum.amplitude[k]);
    text += '\n';
  }
  return text;
}

} // namespace

std::vector<machining::Mode> MillingRun::modes_of_process() const {
  const bool mapped = input_.structure->part && input_.structure->part->mapped;
  return mapped ? std::vector<machining::Mode>(input_.machining->modes.begin(), input_.machining->modes.end())
                : plain_modes();
}

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
    : MillingRun(input, options, observer, goes_on, settings_of(input)) {}

MillingRun::MillingRun(const input::Case& input, const RunOptions& options, RunObserver& observer,
                       bool goes_on, const machining::ProcessSettings& settings)
    : SteppedRun(input, options, observer, goes_on, history_columns),
      process_(input.machining->cut, modes_of_process(), settings, flexible_part(input, settings)),
      counts_(steady_turns(share_of_forces, infinite)), heard_(steady_turns(share_of_vibration, most_turns)),
      vibration_(input.machining->cut.cutter, input.machining->dexels.steps) {
  if (process_.part()) first_frequency_ = process_.part()->frequency();
  observer_.begins();
}

void MillingRun::archive(Archive& archive) {
  process_.archive(archive);
  steady_.archive(archive);
  archive.number("run/still", "m", still_);
  passes_.archive(archive);
  vibration_.archive(archive);
  archive.integer("run/unsettled_steps", unsettled_steps_);
  archive.number("run/unsettled", "m", unsettled_);
}

void MillingRun::advance() {
  const double step_dt = dt(), at = static_cast<double>(steps()) + 0.5;
  const Vec2 axis = process_.axis();
  const double tip = process_.tip();
  const machining::ProcessStep step = made_step();
  passes_.add(process_, step);
  if (steps() == process_.motion().passes().back().begin + 1) still_ = still_chips();
  if (counts_.holds(at)) steady_.add(step, step_dt);
  if (heard_.holds(at)) vibration_.add(step.force, step.displacement);
  if (step.unsettled > 0.0) {
    ++unsettled_steps_;
    unsettled_ = std::max(unsettled_, step.unsettled);
  }
  const machining::MillingLedger& ledger = process_.ledger();
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
                       step.displacement.z(),
                       axis.x(),
                       axis.y(),
                       tip,
                       ledger.spindle,
                       ledger.feed,
                       ledger.cutting,
                       ledger.ploughing,
                       ledger.damping,
                       ledger.chips,
                       ledger.kinetic,
                       ledger.elastic,
                       ledger.residual()};
  history_.write(row);
  ++status_.steps;
}

machining::ProcessStep MillingRun::made_step() {
  try {
    return process_.advance();
  } catch (const DivergenceError& error) { // nothing has been taken of the workpiece yet
    write_checkpoint();
    throw DivergenceError(
        fmt::format("step {} at {}: {}", process_.steps(), si_format(process_.time(), "s"), error.what()),
        error.node, error.field);
  }
}

MillingRun::Window MillingRun::steady_turns(double share, double most) const {
  const machining::ToolMotion& motion = process_.motion();
  const double steps = input_.machining->dexels.steps,
               begin = static_cast<double>(motion.passes().back().begin);
  const double turns = std::floor((motion.fed() - begin) / steps);
  constexpr double quarter = 0.25, half = 0.5;
  const double length =
      std::max(1.0, std::min(most, std::floor((motion.last_path() ? half : share) * turns))) * steps;
  const double from =
      motion.last_path() ? begin + std::floor(quarter * turns) * steps : motion.fed() - length;
  return {from, from + length};
}

double MillingRun::still_chips() const {
  const input::MachiningCase& milling = *input_.machining;
  if (milling.passes.empty() && process_.motion().steady())
    return machining::steady_chips(milling.cut, milling.axial_depth).thickest;
  if (modes_.empty()) return 0.0; // it is that run itself
  machining::MillingProcess rigid = process_.rigid();
  double thickest = 0.0;
  while (!rigid.at_end() && static_cast<double>(rigid.steps()) < counts_.to) {
    const double at = static_cast<double>(rigid.steps()) + 0.5;
    const double chip = rigid.advance().thickest;
    if (counts_.holds(at)) thickest = std::max(thickest, chip);
  }
  return thickest;
}

MillingRun::Disturbances
MillingRun::judge_vibration(const std::optional<machining::CutVibration::Growth>& growth) {
  const input::MachiningCase& milling = *input_.machining;
  const double spindle = milling.speed, teeth = static_cast<double>(milling.cut.cutter.teeth());
  if (!process_.motion().steady()) return Disturbances::unknown; // periods differ though nothing chatters
  status_.add_metric("milling.tooth_frequency[Hz]", teeth * spindle / machining::full_turn);
  if (modes_.empty()) return Disturbances::unknown;
  if (!growth) return Disturbances::unknown;
  status_.add_metric("milling.growth", growth->factor);
  constexpr double shrinks = 0.999, felt = 0.1;
  const bool small = growth->size <= felt * growth->vibration;
  if (growth->factor > shrinks) return small ? Disturbances::last : Disturbances::grow;
  return small && growth->late <= 1.0 ? Disturbances::die_out : Disturbances::last;
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
  // Campomanes and Altintas (2003): chips a quarter thicker than without vibration are chatter; but for those
  // that the teeth alone force, which uneven ones do near a resonance, as does a free side that comes nearer.
  // Of teeth that are alike, more than twice as thick they are what teeth have left that missed the cut: what
  // dies out then are disturbances of a vibration that goes on without them.
  constexpr double chatter = 1.25, missed = 2.0, settled = 0.1;
  const auto growth = vibration_.growth();
  const Disturbances disturbances = judge_vibration(growth);
  const auto thicker_than = [&](double times) {
    return !modes_.empty() && still_ > 0.0 && steady.thickest > times * still_;
  };
  const bool thick = thicker_than(chatter);
  const bool alike = milling.cut.cutter.period(true) == milling.cut.cutter.pitch[0];
  const bool goes_on = alike && disturbances == Disturbances::die_out && thicker_than(missed) &&
                       growth->size < settled * (steady.thickest - still_);
  const bool chatters =
      disturbances == Disturbances::grow || (thick && (disturbances != Disturbances::die_out || goes_on));
  std::string tone;
  if (chatters && process_.motion().steady())
    if (const auto peak = vibration_.chatter(milling.speed)) {
      status_.add_metric("milling.chatter_frequency[Hz]", peak->frequency);
      tone = fmt::format(" at {}", si_format(peak->frequency, "Hz"));
    }
  if (still_ > 0.0) status_.add_metric("milling.chip_growth", steady.thickest / still_);
  status_.add_metric("milling.chatter", chatters ? 1.0 : 0.0);
  status_.flags.emplace_back("milling.chatter");
  if (!modes_.empty()) status_.add_metric("milling.displacement[m]", steady.displacement);
  if (const machining::FlexiblePart* part = process_.part()) {
    status_.add_metric("milling.part.begin.f1[Hz]", first_frequency_);
    status_.add_metric("milling.part.end.f1[Hz]", part->frequency());
  }
  // Chips change by more than a small part of themselves: lobes, which are of small vibrations, say no more.
  if (constexpr double small = 0.5;
      milling.passes.empty() && steady.displacement > small * milling.cut.engagement.radial_depth)
    warn(input_
             .error("milling.radial_depth",
                    fmt::format("the cutter moves by {} relative to the part, expected less than half of the "
                                "radial depth: vibrations are not small beside the cut",
                                si_format(steady.displacement, "m")))
             .what());
  if (!milling.passes.empty()) {
    status_.add_metric("milling.workpiece.before[m^3]", process_.block());
    status_.add_metric("milling.workpiece.after[m^3]", process_.volume());
  }
  passes_.tell(process_.motion(), status_);
  constexpr double rounding = 1e-6;
  if (const auto [pass, depth] = passes_.deepest();
      !modes_.empty() && depth > (1.0 + rounding) * milling.axial_depth)
    warn(
        input_
            .error("milling.axial_depth",
                   fmt::format("pass {} cuts {} deep, expected at most {}: for that depth lobes of this case "
                               "are made",
                               pass + 1, si_format(depth, "m"), si_format(milling.axial_depth, "m")))
            .what());
  if (unsettled_steps_ > 0)
    warn(input_
             .error("dexels.steps",
                    fmt::format(
                        "forces and vibration do not agree in {} of {} steps, by up to {}: edges rub there "
                        "that cut nothing from one question to the next, expected more steps where that "
                        "matters",
                        unsettled_steps_, steps(), si_format(unsettled_, "m")))
             .what());
  surface_.emplace(process_, *input_.machining);
  const std::string surface = surface_->tell(status_);
  const machining::MillingLedger& ledger = process_.ledger();
  status_.energy_residual = ledger.share();
  for (const auto& [name, value] : {std::pair{"spindle", ledger.spindle},
                                    {"feed", ledger.feed},
                                    {"cutting", ledger.cutting},
                                    {"ploughing", ledger.ploughing},
                                    {"damping", ledger.damping},
                                    {"chips", ledger.chips},
                                    {"kinetic", ledger.kinetic},
                                    {"elastic", ledger.elastic}})
    status_.add_metric(fmt::format("milling.energy.{}[J]", name), value);
  const bool cuts = steady.removed > 0.0;
  if (!cuts)
    warn(input_
             .error(milling.passes.empty() ? "milling.length" : "milling.passes",
                    fmt::format("no tooth meets the workpiece in {}, expected a path through it",
                                milling.passes.empty() ? "the turns that stand for the cut"
                                                       : "the middle of the last pass"))
             .what());
  const std::string thicker = thick ? fmt::format("chips {} times as thick as without vibration",
                                                  results::number_format(steady.thickest / still_, 3))
                                    : "";
  const std::string verdict =
      !cuts               ? "nothing is cut"
      : modes_.empty()    ? "a rigid cut"
      : chatters && thick ? fmt::format("chatter{}: {}", tone, thicker)
      : chatters          ? fmt::format("chatter{}: disturbances grow", tone)
      : thick ? fmt::format("no chatter: disturbances die out; what the teeth force makes {}", thicker)
              : "no chatter";
  status_.reason = fmt::format("{}; at most {} along x, {} along y; {}", verdict,
                               si_format(steady.force.x(), "N"), si_format(steady.force.y(), "N"), surface);
}

void MillingRun::write_files() {
  if (process_.motion().last_path())
    results::write_atomically(options_.output / input::left_workpiece, left_workpiece_file(process_.left()));
  results::write_atomically(options_.output / results::files::machined_surface, surface_->csv());
  results::write_atomically(options_.output / results::files::machined_surface_grid, surface_->vtk());
  if (process_.motion().steady())
    if (const std::string spectra = spectra_file(vibration_, input_, modes_); !spectra.empty())
      results::write_atomically(options_.output / results::files::spectra, spectra);
  if (const auto map = surface_->map()) {
    results::FileQueue queue;
    report::PictureAlbum album(options_.output);
    const std::string text =
        report::machined_map(*map, input_.title.empty() ? input_.name : input_.title, status_.time,
                             results::ShownUnits::of_case(input_.resolved));
    album.add(
        queue, "surface",
        {.field = "left on the surface",
         .time = status_.time,
         .caption = "",
         .note = "Along the way of the cutter and over its height; positive: material is left."},
        [text] { return text; }, text.size());
    queue.wait();
  }
}

} // namespace cnem::app
