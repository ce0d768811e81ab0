// Parts of the workpiece, its initial state and what repeats: regions, initial, periodic.
#include "input/case_parts.hpp"
#include "input/case_walls.hpp"
#include "input/curve_checks.hpp"
#include "input/schema/nearest.hpp"
#include "input/space_domain.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::input {

void read_regions(const Setting& root, Case& result, Diagnostics& diagnostics) {
  Domain& domain = result.domain;
  for (const Setting& table : root.entries("domain.regions")) {
    const Setting& at = *table.find("at");
    domain.regions.push_back({table.name, std::get<Vec2>(at.value), table.get<std::string>("material"),
                              table.get<double>("temperature"), table.get<Vec2>("velocity")});
    if (const std::string reason = outside_reason(domain, domain.regions.back().at); !reason.empty())
      diagnostics.add(Mistake::geometry, at.where, at.path,
                      fmt::format("the point {} is {}, expected a point of the workpiece",
                                  show(domain.regions.back().at), reason));
    if (domain.interfaces.empty() && domain.cracks.empty())
      diagnostics.add(Mistake::reference, table.where, table.path,
                      "found a region of an undivided domain, expected domain.interfaces that divide it");
  }
}

void read_initial_and_loads(const Setting& root, Case& result, Diagnostics& diagnostics) {
  const Setting& table = *root.find("initial");
  InitialState& initial = result.initial;
  initial.temperature = table.get<double>("temperature");
  initial.velocity = table.vector("velocity");
  if (const Setting* spin = table.find("spin"))
    initial.spin = Spin{spin->get<double>("rate"), spin->get<Vec2>("centre")};
  if (const Setting* gradient = table.find("velocity_gradient")) {
    VelocityGradient& added = initial.gradient.emplace();
    added.rate << gradient->get<double>("xx"), gradient->get<double>("xy"), gradient->get<double>("yx"),
        gradient->get<double>("yy");
    added.centre = gradient->get<Vec2>("centre");
  }
  for (const Setting& entry : table.entries("imperfections")) {
    const Setting& points = *entry.find("points");
    initial.imperfections.push_back({entry.name, std::get<std::vector<Vec2>>(points.value),
                                     entry.get<double>("width"), entry.get<double>("reduction")});
    if (initial.imperfections.back().points.empty())
      diagnostics.add(Mistake::type, points.where, points.path, "found no points, expected at least one");
  }
  result.loads.body_force = root.maybe<VectorFunction>("loads.body_force").value_or(VectorFunction{});
}

void read_periodic(const Setting& root, Case& result, Diagnostics& diagnostics) {
  const std::vector<std::string> known = result.domain.piece_names();
  for (const Setting& table : root.entries("periodic")) {
    const Setting& pieces = *table.find("pieces");
    const auto& names = std::get<std::vector<std::string>>(pieces.value);
    for (const std::string& name : names)
      if (std::find(known.begin(), known.end(), name) == known.end())
        diagnostics.add(Mistake::reference, pieces.where, pieces.path,
                        fmt::format("found \"{}\", expected a boundary piece: {}{}", name,
                                    fmt::join(known, ", "), did_you_mean(name, known)));
    if (result.analysis.dimensions() == 3)
      for (const std::string& name : names)
        if (std::find(known.begin(), known.end(), name) != known.end() && !is_plane(result.domain, name))
          diagnostics.add(
              Mistake::geometry, pieces.where, pieces.path,
              fmt::format("found \"{}\", which is not plane, expected two parallel planes", name));
    for (const Periodicity& other : result.periodic)
      for (const std::string& name : names)
        if (std::find(other.pieces.begin(), other.pieces.end(), name) != other.pieces.end())
          diagnostics.add(
              Mistake::conflict, pieces.where, pieces.path,
              fmt::format("found \"{}\", which is of periodic.{} too, expected a piece to continue "
                          "at one other",
                          name, other.name));
    if (names.size() != 2 || names[0] == names[1])
      diagnostics.add(Mistake::type, pieces.where, pieces.path,
                      "expected two different boundary pieces such as [\"left\", \"right\"]");
    else
      result.periodic.push_back({table.name, {names[0], names[1]}});
  }
}

} // namespace cnem::input
