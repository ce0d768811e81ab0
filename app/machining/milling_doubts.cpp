#include "app/machining/milling_doubts.hpp"

#include "app/machining/machining_session.hpp"
#include "app/machining/removal_run.hpp"
#include "app/machining/structure_modes.hpp"
#include "machining/engaged_edges.hpp"
#include "machining/layer_grading.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace cnem::app {

using results::si_format;

namespace {

/// rad/s, of modes where they are the fastest along the path, by what they are of and their name.
std::map<std::pair<machining::Mode::Of, std::string>, double>
fastest(const input::Case& input, const std::vector<input::NamedMode>& modes) {
  std::map<std::pair<machining::Mode::Of, std::string>, double> most;
  const auto add = [&](const std::vector<input::NamedMode>& there) {
    for (const input::NamedMode& mode : there) {
      double& omega = most[{mode.of, mode.name}];
      omega = std::max(omega, mode.omega());
    }
  };
  const std::vector<double>& places = input.machining->stability.places;
  if (places.empty()) add(modes);
  for (const double place : places) add(modes_met(input, place));
  return most;
}

/// Flanks that touch nothing, or as deep as chips; lobes take what they do for a damping, which waves have to
/// be long for.
std::vector<std::string> flank_doubts(const input::Case& input, const std::vector<input::NamedMode>& modes) {
  const input::MachiningCase& milling = *input.machining;
  std::vector<std::string> doubts;
  if (!milling.cut.flank.presses()) return doubts;
  const double contact = machining::longest_contact(milling.cut);
  const auto doubt = [&](const char* key, const std::string& what) {
    doubts.push_back(input.error(key, what).what());
  };
  if (!(contact > 0.0))
    doubt("cutting.flank.clearance",
          "the land touches nothing in a steady cut, expected a recovery of the surface, or less clearance");
  const double thickest = machining::steady_chips(milling.cut, milling.axial_depth).thickest;
  if (milling.cut.flank.recovery >= thickest)
    doubt("cutting.flank.recovery",
          fmt::format("the surface springs back by {}, expected less than the thickest chip, {}",
                      si_format(milling.cut.flank.recovery, "m"), si_format(thickest, "m")));
  if (input.analysis.type != input::Analysis::Type::stability) return doubts;
  const double slowest = milling.stability.speed_from;
  for (const auto& [mode, omega] : fastest(input, modes))
    if (const double wave = slowest * milling.cut.cutter.radius() / omega; contact > wave)
      doubt(
          "cutting.flank.land",
          fmt::format(
              "at {} mode {} of the {} leaves waves of {} a radian, expected longer ones than the contact of "
              "the land, {}: its damping is taken for that of long waves",
              speed_text(slowest), mode.second, mode.first == machining::Mode::Of::tool ? "tool" : "part",
              si_format(wave, "m"), si_format(contact, "m")));
  return doubts;
}

/// What of a cut lies beyond the range of its law.
std::vector<std::string> law_doubts(const input::Case& input, const machining::SteadyChips& chips) {
  const input::MachiningCase& milling = *input.machining;
  const machining::LawRange& holds = milling.law_range;
  constexpr double degree = std::numbers::pi / 180.0, rounding = 1e-6; // of numbers as files have them
  std::vector<std::string> doubts;
  if (!(chips.radius > 0.0)) return doubts; // no edge comes to the workpiece
  const auto compare = [&](const Range& range, double value, const char* name, const std::string& what,
                           auto&& text) {
    const double slack = rounding * std::max(std::abs(range.low), std::abs(range.high));
    if (!range.bounded() || (value >= range.low - slack && value <= range.high + slack)) return;
    const std::string given = std::string("cutting.forces.range.") + name;
    const std::string of_table = std::string("cutting.forces.") + name;
    doubts.push_back(
        input
            .error(input.location.contains(given)      ? given
                   : input.location.contains(of_table) ? of_table
                                                       : "cutting.forces",
                   fmt::format("{} {}, expected {}{}, for which the law holds", what, text(value),
                               text(range.low), range.high > range.low ? " to " + text(range.high) : ""))
            .what());
  };
  compare(holds.thickness, chips.thickest, "thickness", "chips are up to",
          [](double h) { return si_format(h, "m"); });
  compare(holds.speed, milling.speed * chips.radius, "speed", "edges move at",
          [](double v) { return si_format(v, "m/s"); });
  if (!milling.rake) return doubts;
  const bool facets = milling.cut.cutter.edge != nullptr; // lean by as much as an edge turns along them
  const double off = std::max(holds.rake.low - *milling.rake, *milling.rake - holds.rake.high);
  if (facets && off <= degree) return doubts;
  compare(holds.rake, *milling.rake, "rake", facets ? "the rake of cutter.rake_face is" : "cutter.rake is",
          [&](double a) { return results::number_format(a / degree, 4) + " deg"; });
  return doubts;
}

/// Passes that go below matter over the upper end of their edges, which no pass before them has cut.
std::vector<std::string> reach_doubts(const input::Case& input) {
  const input::MachiningCase& milling = *input.machining;
  std::vector<std::string> doubts;
  if (!milling.cut.cutter.edge || (!milling.passes.empty() && !milling.blank)) return doubts;
  const double top = milling.cut.cutter.edge->top(),
               slack = 0.5 * machining::LayerGrading(milling.cut, milling.axial_depth, milling.dexels.steps)
                                 .thickest(milling.dexels.layers),
               height = milling.blank ? milling.blank->height : milling.axial_depth;
  std::vector<double> tips;
  for (std::size_t pass = 0; pass < std::max<std::size_t>(1, milling.passes.size()); ++pass) {
    const double tip = milling.passes.empty() ? 0.0 : milling.passes[pass].tip();
    double cut = tip + top;
    for (const double before : tips) // upwards
      if (before <= cut + slack) cut = std::max(cut, before + top);
    tips.insert(std::upper_bound(tips.begin(), tips.end(), tip), tip);
    if (cut + slack >= height) continue;
    doubts.push_back(
        input
            .error("cutter.rake_face",
                   fmt::format("edges end {} over the tip, and in pass {} matter lies up to {} "
                               "over it, which is not cut; expected a rake face that is as high, "
                               "or passes from the top down",
                               si_format(top, "m"), pass + 1, si_format(height - tip, "m")))
            .what());
  }
  return doubts;
}

/// Under a force at a point solids give way without end as cells get smaller (Boussinesq); plates hardly do.
std::vector<std::string> point_force_doubts(const input::Case& input) {
  std::vector<std::string> doubts;
  const auto& part = input.structure->part;
  if (!part || part->element == machining::PartElement::plate_8) return doubts;
  for (const input::PartPlace& place : part->places)
    if (place.at && !place.force.isZero(0.0))
      doubts.push_back(input
                           .error("part.points." + place.name + ".force",
                                  "at a point of solid cells the displacement there grows without end as "
                                  "cells get smaller, expected a force on a face, or displacements read "
                                  "beside it")
                           .what());
  return doubts;
}

} // namespace

std::vector<std::string> milling_doubts(const input::Case& input,
                                        const std::vector<input::NamedMode>& modes) {
  std::vector<std::string> doubts;
  if (input.structure->removal) return removal_doubts(input);
  if (!input.machining) return point_force_doubts(input);
  const input::MachiningCase& milling = *input.machining;
  const machining::SteadyChips chips = machining::steady_chips(milling.cut, milling.axial_depth);
  if (input.analysis.type == input::Analysis::Type::stability && chips.thinnest <= 0.0)
    doubts.push_back(
        input
            .error("cutter.run_out",
                   "with this run-out a tooth misses the cut at some angles: what it leaves is cut "
                   "by the next one, which stability takes no account of; expected a run-out well "
                   "below milling.feed")
            .what());
  for (std::string& doubt : law_doubts(input, chips)) doubts.push_back(std::move(doubt));
  for (std::string& doubt : flank_doubts(input, modes)) doubts.push_back(std::move(doubt));
  if (input.analysis.type != input::Analysis::Type::milling) return doubts;
  for (std::string& doubt : reach_doubts(input)) doubts.push_back(std::move(doubt));
  constexpr double few = 5.0, periods = 20.0;
  if (milling.dexels.pitch > milling.cut.feed / few)
    doubts.push_back(
        input
            .error("dexels.pitch",
                   fmt::format("lines are {} apart, expected at least five in a feed of {}",
                               si_format(milling.dexels.pitch, "m"), si_format(milling.cut.feed, "m")))
            .what());
  for (const input::NamedMode& mode : modes)
    if (const double steps = milling.dexels.steps * milling.speed / mode.omega(); steps < periods)
      doubts.push_back(
          input
              .error("dexels.steps", fmt::format("mode {} swings once in {:.3g} steps, expected at "
                                                 "least {:g}",
                                                 mode.name, steps, periods))
              .what());
  return doubts;
}

} // namespace cnem::app
