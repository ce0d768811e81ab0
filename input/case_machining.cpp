// Reads milling cases.
#include "input/case_machining.hpp"
#include "core/index.hpp"
#include "core/rpm.hpp"
#include "input/case_parts.hpp"
#include "input/case_structure.hpp"
#include "input/constants.hpp"
#include "input/schema/document.hpp"
#include "input/schema/nearest.hpp"
#include "machining/layer_grading.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <numeric>
#include <tuple>

namespace cnem::input {
namespace {

/// Two numbers of the table `range`; everywhere without them.
Range read_range(const Setting& range, const char* name, Diagnostics& diagnostics) {
  const Setting* given = range.find(name);
  if (!given) return {};
  const auto& ends = std::get<std::vector<double>>(given->value);
  if (ends.size() == 2 && ends[0] <= ends[1]) return {.low = ends[0], .high = ends[1]};
  diagnostics.add(ends.size() == 2 ? Mistake::range : Mistake::type, given->where, given->path,
                  fmt::format("found {} numbers{}, expected two of them, the smaller one first, such as {}",
                              ends.size(), ends.size() == 2 ? " that fall" : "", given->key->example_text()));
  return {};
}

void read_cutting_law(const Setting& root, MachiningCase& read, Diagnostics& diagnostics) {
  const Setting& forces = *root.find("cutting.forces");
  if (auto law = read_law<machining::CuttingLaw>(machining::CuttingLaws{}, forces, diagnostics))
    read.cut.law = *law;
  if (const Setting* range = forces.find("range"))
    read.law_range = {read_range(*range, "thickness", diagnostics), read_range(*range, "speed", diagnostics),
                      read_range(*range, "rake", diagnostics)};
  const machining::CuttingEdge* edge = read.cut.cutter.edge.get();
  read.rake = root.maybe<double>("cutter.rake");
  if (edge) read.rake = edge->angles(0.0, read.axial_depth).rake;
  if (const Setting* rakes = forces.find("rakes");
      rakes && read.cut.law.known().several_rakes() && !read.rake && !root.find("cutter.rake_face"))
    diagnostics.add(
        Mistake::missing_key, root.find("cutter")->where, "cutter.rake",
        fmt::format("missing, expected an angle such as \"10 deg\": the law is over several rakes "
                    "({})",
                    rakes->where.text()));
  read.law_range = common(read.law_range, read.cut.law.known());
  if (edge) return; // each of its elements has its own angles
  read.cut.law.incline(read.cut.cutter.helix);
  read.cut.law.take_rake(read.rake.value_or(0.0));
}

void read_shape(NamedMode& mode, const Setting& table, Diagnostics& diagnostics) {
  for (const auto& [at, value, points, shape] :
       {std::tuple{"along", "shape_along", &mode.along, &mode.shape_along},
        {"height", "shape_over_height", &mode.height, &mode.shape_over_height}}) {
    for (const auto& [name, list] : {std::pair{at, points}, {value, shape}})
      read_list({.name = name}, table, *list, diagnostics);
    try {
      check_points(at, *points, value, *shape);
    } catch (const InputError& error) {
      diagnostics.add(Mistake::conflict, table.where, table.path, error.what());
    }
  }
  read_list({.name = "frequency_along"}, table, mode.frequency_along, diagnostics);
  if (mode.frequency_along.size == 0) return;
  try {
    check_points("along", mode.along, "frequency_along", mode.frequency_along);
  } catch (const InputError& error) {
    diagnostics.add(Mistake::conflict, table.where, table.path, error.what());
  }
  if (const NumberList& shares = mode.frequency_along;
      std::any_of(shares.value, shares.value + shares.size, [](double f) { return !(f > 0.0); }))
    diagnostics.add(Mistake::range, table.where, table.path + ".frequency_along",
                    "found a share that is not positive, expected shares of the frequency > 0");
}

NamedMode read_mode(const Setting& table, Diagnostics& diagnostics) {
  NamedMode mode;
  mode.name = table.name;
  mode.of = table.choice<machining::Mode::Of>("of");
  mode.frequency = table.get<double>("frequency");
  mode.damping = table.get<double>("damping");
  mode.direction = table.get<Vec3>("direction");
  const Setting *stiffness = table.find("stiffness"), *mass = table.find("mass");
  if (stiffness && mass)
    diagnostics.add(Mistake::conflict, mass->where, mass->path,
                    "found a mass and a stiffness, expected one of them");
  else if (!stiffness && !mass)
    diagnostics.add(
        Mistake::missing_key, table.where, table.path + ".stiffness",
        fmt::format("missing, expected {}, or mass", find_key("modes.*.stiffness")->expectation()));
  else
    mode.stiffness = stiffness ? std::get<double>(stiffness->value)
                               : std::get<double>(mass->value) * mode.omega() * mode.omega();
  read_shape(mode, table, diagnostics);
  const double length = mode.direction.norm();
  const Setting& direction = *table.find("direction");
  if (!(length > 0.0))
    diagnostics.add(Mistake::range, direction.where, direction.path,
                    "found a vector without length, expected a direction such as " +
                        direction.key->example_text());
  else
    mode.direction /= length;
  return mode;
}

void check_modes(const Setting& modes, const MachiningCase& read, Diagnostics& diagnostics) {
  constexpr double along_axis = 1e-9;
  if (read.modes.empty() || read.cut.cutter.rounded()) return;
  if (std::any_of(read.modes.begin(), read.modes.end(),
                  [](const NamedMode& mode) { return !(mode.direction.norm() > 0.0); }))
    return; // it has been told
  if (std::all_of(read.modes.begin(), read.modes.end(),
                  [](const NamedMode& mode) { return mode.direction.head<2>().norm() < along_axis; }))
    diagnostics.add(Mistake::range, modes.where, "modes",
                    "found modes along z alone, expected one across the axis of the cutter: a flat end that "
                    "moves along z cuts the same chips");
}

void check_time_domain(const Setting& root, const MachiningCase& read, Analysis::Type type,
                       Diagnostics& diagnostics) {
  const machining::Cutter& cutter = read.cut.cutter;
  const Setting* places = root.find("stability.places");
  for (const NamedMode& mode : read.modes) {
    if (type == Analysis::Type::stability && (mode.height.size > 0 || (mode.along.size > 0 && !places)))
      diagnostics.add(
          Mistake::conflict, root.where, "modes." + mode.name,
          "found a mode that changes along the path or over the height, expected the stiffness "
          "at one place, or stability.places for what changes along the path: lobes are those of a "
          "place; analysis.type = \"milling\" takes shapes");
    if (type == Analysis::Type::milling && mode.frequency_along.size > 0)
      diagnostics.add(Mistake::conflict, root.where, "modes." + mode.name + ".frequency_along",
                      "found a frequency that changes along the path, expected it with analysis.type = "
                      "\"stability\" alone: modes of a run in time are those of one structure");
  }
  const double closest = *std::min_element(cutter.pitch.begin(), cutter.pitch.end());
  if (const Setting& steps = *root.find("dexels.steps");
      read.dexels.steps * closest < 2.0 * machining::full_turn)
    diagnostics.add(Mistake::range, steps.where, steps.path,
                    fmt::format("found {} steps a turn, expected at least {:.0f}, two from each tooth to the "
                                "next one",
                                read.dexels.steps, std::ceil(2.0 * machining::full_turn / closest)));
}

/// The zone of the part that charts over places let go.
void read_takes(const Setting& root, const std::optional<PartCase>& part, StabilityRange& range,
                Diagnostics& diagnostics) {
  const Setting* takes = root.find("stability.takes");
  if (!takes) return;
  const auto refuse = [&](const Setting& where, const std::string& what) {
    diagnostics.add(Mistake::conflict, where.where, where.path, what);
  };
  if (range.places.empty()) {
    refuse(*takes, "found without stability.places, expected places along the way on which it is taken");
    return;
  }
  if (!part) {
    refuse(*takes, "found without a [part], expected one with this zone: modes.*.frequency_along tells what "
                   "becomes of modes that are given");
    return;
  }
  const auto& name = std::get<std::string>(takes->value);
  std::vector<std::string> zones;
  for (const Setting& zone : root.entries("part.zones")) {
    zones.push_back(zone.name);
    if (zone.name == name) range.takes = {zone.get<Vec3>("from"), zone.get<Vec3>("to")};
  }
  if (!range.takes)
    diagnostics.add(Mistake::reference, takes->where, takes->path,
                    fmt::format("found {}, expected a zone of part.zones{}", toml_quoted(shortened(name)),
                                did_you_mean(name, zones)));
  constexpr double along = 1.0 - 1e-9;
  if (part->to_cutter.row(0).cwiseAbs().maxCoeff() < along)
    refuse(*root.find("part.feed"), "found a direction that is oblique to the part, expected one along its "
                                    "x, y or z: stability.takes is a box that ends at the cutter");
}

} // namespace

void read_machining(Setting& root, Case& result, Diagnostics& diagnostics) {
  if (!root.find("cutting.forces")) {
    diagnostics.add(Mistake::missing_key, root.where, "cutting.forces",
                    find_key("cutting.forces")->missing());
    return;
  }
  const auto made = std::make_shared<MachiningCase>();
  MachiningCase& read = *made;
  result.machining = made;
  read.axial_depth = root.get<double>("milling.axial_depth");
  read.cut.cutter = read_cutter(*root.find("cutter"), result.path, read.axial_depth, diagnostics);
  const double diameter = root.get<double>("cutter.diameter"); // of a rake face but about that of its edge
  root.set_default("milling.radial_depth", diameter);
  const Setting& milling = *root.find("milling");
  read_drive(milling, read, result.analysis.type, diagnostics);
  read.cut.engagement = {milling.choice<machining::Engagement::Side>("side"),
                         milling.get<double>("radial_depth")};
  if (const Setting& depth = *milling.find("radial_depth"); read.cut.engagement.radial_depth > diameter)
    diagnostics.add(Mistake::range, depth.where, depth.path,
                    fmt::format("found {:g} m, expected at most cutter.diameter = {:g} m",
                                read.cut.engagement.radial_depth, diameter));
  double& radial_depth = read.cut.engagement.radial_depth;
  radial_depth = radial_depth < diameter ? std::min(radial_depth, read.cut.cutter.diameter)
                                         : read.cut.cutter.diameter; // a slot
  if (const Setting& feed = *milling.find("feed"); read.cut.feed >= 0.5 * diameter)
    diagnostics.add(Mistake::range, feed.where, feed.path,
                    fmt::format("found {:g} m, expected less than the radius of the cutter, {:g} m",
                                read.cut.feed, 0.5 * diameter));
  read_cutting_law(root, read, diagnostics);
  if (const Setting* flank = root.find("cutting.flank")) {
    read.cut.flank = {flank->get<double>("land"), flank->get<double>("clearance"),
                      flank->get<double>("recovery"), flank->get<double>("specific_force"),
                      flank->get<double>("friction")};
    if (const Setting& land = *flank->find("land");
        read.cut.flank.land > machining::widest_land * 0.5 * diameter)
      diagnostics.add(Mistake::range, land.where, land.path,
                      fmt::format("found {:g} m, expected at most half the radius of the cutter, {:g} m",
                                  read.cut.flank.land, machining::widest_land * 0.5 * diameter));
  }
  for (const Setting& table : root.entries("modes")) read.modes.push_back(read_mode(table, diagnostics));
  if (const Setting* modes = root.find("modes")) check_modes(*modes, read, diagnostics);
  if (const Setting* part = root.find("part")) {
    for (const char* key : {"cutter", "damping"})
      if (!part->find(key) && (std::string_view(key) != "damping" || !part->find("rayleigh")))
        diagnostics.add(Mistake::missing_key, part->where, part->path + "." + key,
                        find_key(std::string("part.") + key)->missing());
  } else if (read.modes.empty() && result.analysis.type == Analysis::Type::stability)
    diagnostics.add(
        Mistake::missing_key, root.where, "modes",
        "missing, expected a mode of tool or part, [modes.NAME], or a [part]: nothing else can chatter");
  const double turn = read.cut.feed * static_cast<double>(read.cut.cutter.teeth());
  constexpr double turns = 12.0, share = 0.1;
  if (!milling.find("passes")) root.set_default("milling.length", turns * turn);
  root.set_default("dexels.pitch", share * read.cut.feed);
  const int layers = machining::LayerGrading(read.cut, read.axial_depth,
                                             static_cast<int>(root.get<std::int64_t>("dexels.steps")))
                         .layers();
  root.set_default("dexels.layers", std::int64_t{std::min(layers, 2000)});
  read.length = root.maybe<double>("milling.length").value_or(0.0);
  read.dwell = root.get<double>("milling.dwell");
  read.start = root.choice<machining::ProcessSettings::Start>("milling.start");
  read.dexels = {root.get<double>("dexels.pitch"), static_cast<int>(root.get<std::int64_t>("dexels.layers")),
                 static_cast<int>(root.get<std::int64_t>("dexels.steps"))};
  read_path(root, read, result.path, diagnostics);
  if (read.drive) {
    constexpr double most_steps = 1e8;
    const std::vector<double>& feeds = read.drive->feed.values();
    const double least =
        *std::min_element(feeds.begin(), feeds.end()) * static_cast<double>(read.cut.cutter.teeth());
    if (const double steps = (read.length / least + read.dwell) * read.dexels.steps;
        least > 0.0 && steps > most_steps)
      diagnostics.add(
          Mistake::range, milling.find("feed")->where, milling.find("feed")->path,
          fmt::format("takes up to {:.3g} steps at its least, expected at most {:g}", steps, most_steps));
  }
  constexpr double most_lines = 2e5;
  if (const Setting& pitch = *root.find("dexels.pitch"); // of a feed of nothing it has been told
      (pitch.given || milling.get<TimeTable>("feed").values().front() > 0.0) &&
      (read.length + 3.0 * diameter) / read.dexels.pitch > most_lines)
    diagnostics.add(Mistake::range, pitch.where, pitch.path,
                    fmt::format("found {:g} m, expected at least {:.3g} m: {:g} lines along the path",
                                read.dexels.pitch, (read.length + 3.0 * diameter) / most_lines, most_lines));
  check_time_domain(root, read, result.analysis.type, diagnostics);
  root.set_default("stability.speed_from", 0.5 * read.speed);
  root.set_default("stability.speed_to", 1.5 * read.speed);
  const Setting& range = *root.find("stability");
  read.stability = {range.get<double>("speed_from"),
                    range.get<double>("speed_to"),
                    static_cast<int>(range.get<std::int64_t>("speeds")),
                    range.maybe<double>("depth_to"),
                    static_cast<int>(range.get<std::int64_t>("depths")),
                    range.maybe<std::vector<double>>("places").value_or(std::vector<double>{}),
                    std::nullopt};
  if (range.get<bool>("edge_forces")) read.cut = machining::with_edge_forces(read.cut);
  read_takes(root, result.structure->part, read.stability, diagnostics);
  if (const auto& places = read.stability.places;
      !std::is_sorted(places.begin(), places.end(), std::less_equal<>()) && places.size() > 1)
    diagnostics.add(Mistake::range, range.find("places")->where, range.find("places")->path,
                    "found places that do not increase, expected them in order along the path");
  if (const auto& places = read.stability.places;
      !places.empty() && !read.modes.empty() && !root.find("part") &&
      std::none_of(places.begin(), places.end(), [&](double x) {
        return std::any_of(read.modes.begin(), read.modes.end(),
                           [x](const NamedMode& mode) { return mode.moves_at(x); });
      }))
    diagnostics.add(Mistake::range, range.find("places")->where, range.find("places")->path,
                    "found places at none of which a mode moves, expected others: nothing can chatter there");
  if (const Setting& to = *range.find("speed_to"); read.stability.speed_to <= read.stability.speed_from)
    diagnostics.add(Mistake::range, to.where, to.path,
                    fmt::format("found {:g} rpm, expected more than stability.speed_from = {:g} rpm",
                                read.stability.speed_to / rpm, read.stability.speed_from / rpm));
}

} // namespace cnem::input
