// The geometric part of the case reader: domain, tools, cloud.
#include "io/case_parts.hpp"
#include "io/case_walls.hpp"
#include "io/curve_checks.hpp"
#include "io/nearest.hpp"
#include "io/outline.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::io {
namespace {

/// The curve of a table; nothing, and a mistake recorded, when it cannot be made.
std::optional<Curve> outline(const Setting& table, const OutlineNames& names, Diagnostics& diagnostics) {
  try {
    return make_outline(table, names);
  } catch (const OutlineError& error) {
    const std::string key = error.key.empty() ? table.path : table.path + "." + error.key;
    // Elements of a list are "path[2]" in keys and two steps in the tree.
    std::string steps = error.key;
    if (const auto bracket = steps.find('['); bracket != std::string::npos) steps.insert(bracket, ".");
    const Setting* culprit = table.find(steps);
    diagnostics.add(Mistake::geometry, culprit && culprit->given ? culprit->where : table.where, key,
                    error.what());
    return std::nullopt;
  }
}

void check_holes(const Setting& holes, const Domain& domain, Diagnostics& diagnostics) {
  const auto fail = [&](std::size_t i, const std::string& message) {
    const Setting& setting = *holes.find(domain.holes[i].name);
    diagnostics.add(Mistake::geometry, setting.where, setting.path, message);
  };
  for (std::size_t i = 0; i < domain.holes.size(); ++i) {
    const Curve& hole = domain.holes[i].outline;
    if (const auto point = common_point(hole, domain.outer)) {
      fail(i, fmt::format("the hole meets domain.outer at {}, expected it to lie inside", show(*point)));
      continue;
    }
    if (!inside(domain.outer, hole.pieces.front().from))
      fail(i, fmt::format("the hole lies outside domain.outer at {}", show(hole.pieces.front().from)));
    for (std::size_t j = 0; j < i; ++j) {
      const Curve& other = domain.holes[j].outline;
      if (const auto point = common_point(hole, other))
        fail(i, fmt::format("the hole meets domain.holes.{} at {}", domain.holes[j].name, show(*point)));
      else if (inside(other, hole.pieces.front().from) || inside(hole, other.pieces.front().from))
        fail(i, fmt::format("one of the holes {} and {} lies in the other", domain.holes[i].name,
                            domain.holes[j].name));
    }
  }
}

std::array<Vec2, 2> box(const Setting& setting, Diagnostics& diagnostics) {
  const auto& corners = std::get<std::vector<Vec2>>(setting.value);
  if (corners.size() != 2) {
    diagnostics.add(Mistake::type, setting.where, setting.path,
                    fmt::format("found {} points, expected two opposite corners such as {}", corners.size(),
                                setting.key->example_text()));
    return {Vec2(0, 0), Vec2(0, 0)};
  }
  const Vec2 low = corners[0].cwiseMin(corners[1]), high = corners[0].cwiseMax(corners[1]);
  if (!((high - low).minCoeff() > 0.0))
    diagnostics.add(Mistake::geometry, setting.where, setting.path,
                    fmt::format("a box from {} to {} has no area", show(corners[0]), show(corners[1])));
  return {low, high};
}

/// Ends of the cracks named, or of all.
std::vector<Vec2> crack_ends(const Setting& names, const Setting& cracks, Diagnostics& diagnostics) {
  std::vector<Vec2> ends;
  std::vector<std::string> known;
  for (const Setting& crack : cracks.members) known.push_back(crack.name);
  for (const std::string& name : std::get<std::vector<std::string>>(names.value)) {
    bool found = name == "all";
    for (const Setting& crack : cracks.members)
      if (name == "all" || name == crack.name) {
        const std::vector<Vec2> path = crack_path(crack);
        if (!path.empty()) ends.insert(ends.end(), {path.front(), path.back()});
        found = true;
      }
    if (!found)
      diagnostics.add(Mistake::reference, names.where, names.path,
                      fmt::format("found \"{}\", expected a crack: {} or all{}", name, fmt::join(known, ", "),
                                  did_you_mean(name, known)));
  }
  return ends;
}

Refinement read_refinement(const Setting& root, const Setting& table, double cloud_spacing,
                           Diagnostics& diagnostics) {
  Refinement refinement;
  refinement.name = table.name;
  refinement.growth = table.get<double>("growth");
  const Setting *region = table.find("box"), *points = table.find("points");
  const Setting *spacing = table.find("spacing"), *factor = table.find("factor");
  const Setting* tips = table.find("tips");
  if (const int given = int(region != nullptr) + int(points != nullptr) + int(tips != nullptr); given != 1)
    diagnostics.add(
        given ? Mistake::conflict : Mistake::missing_key, table.where, table.path,
        fmt::format("found {} of box, points and tips, expected one", given ? "several" : "none"));
  if (!spacing == !factor)
    diagnostics.add(spacing ? Mistake::conflict : Mistake::missing_key, table.where, table.path,
                    fmt::format("found {} of spacing and factor, expected one", spacing ? "both" : "none"));
  if (region) refinement.box = box(*region, diagnostics);
  if (points) {
    refinement.points = std::get<std::vector<Vec2>>(points->value);
    if (refinement.points.empty())
      diagnostics.add(Mistake::type, points->where, points->path, "found no points, expected at least one");
  }
  if (tips) {
    const Setting* cracks = root.find("domain.cracks");
    refinement.tips = crack_ends(*tips, cracks ? *cracks : Setting{}, diagnostics);
  }
  refinement.spacing = spacing ? std::get<double>(spacing->value)
                               : table.maybe<double>("factor").value_or(1.0) * cloud_spacing;
  return refinement;
}

} // namespace

void read_domain(const Setting& root, Case& result, Diagnostics& diagnostics) {
  const Setting& table = *root.find("domain");
  Domain& domain = result.domain;
  domain.material = table.get<std::string>("material");
  const auto outer = outline(*table.find("outer"), {"outer", true}, diagnostics);
  bool complete = outer.has_value();
  if (outer) domain.outer = *outer;
  for (const Setting& hole : table.entries("holes")) {
    const auto curve = outline(hole, {hole.name, false}, diagnostics);
    complete = complete && curve;
    if (curve) domain.holes.push_back({hole.name, curve->reversed()});
  }
  read_walls(table, domain, diagnostics);
  if (!complete) return;
  if (const Setting* holes = table.find("holes")) check_holes(*holes, domain, diagnostics);
  check_walls(table, domain, diagnostics);
  for (const Setting& line : root.entries("output.lines"))
    for (const char* end : {"from", "to"}) {
      const Setting& at = *line.find(end);
      if (const std::string reason = outside_reason(domain, std::get<Vec2>(at.value)); !reason.empty())
        diagnostics.add(Mistake::geometry, at.where, at.path,
                        fmt::format("the point {} is {}, expected a material point",
                                    show(std::get<Vec2>(at.value)), reason));
    }
  for (const Setting& probe : root.entries("output.probes")) {
    const Setting& at = *probe.find("at");
    const auto& point = std::get<Vec2>(at.value);
    if (const std::string reason = outside_reason(domain, point); !reason.empty())
      diagnostics.add(Mistake::geometry, at.where, at.path,
                      fmt::format("the probe at {} is {}, expected a material point", show(point), reason));
  }
}

void read_tools(const Setting& root, Case& result, Diagnostics& diagnostics) {
  for (const Setting& table : root.entries("tools")) {
    Tool tool;
    tool.name = table.name;
    tool.outline = outline(table, {table.name, false}, diagnostics).value_or(Curve{});
    const auto& velocity = table.get<VectorFunction>("velocity");
    for (std::size_t k = 0; k < 2; ++k) tool.velocity[k] = velocity[k].value_or(TimeTable(0.0));
    tool.friction.law = table.choice<Friction::Law>("friction.law");
    tool.friction.coefficient = table.maybe<double>("friction.coefficient").value_or(0.0);
    tool.friction.shear_factor = table.maybe<double>("friction.shear_factor").value_or(1.0);
    if (const Setting* heat = table.find("heat")) {
      if (!result.analysis.thermal)
        diagnostics.add(Mistake::conflict, heat->where, heat->path,
                        "found the thermal side of a tool, expected it with analysis.thermal = true only");
      ToolHeat& tool_heat = tool.heat.emplace();
      tool_heat.conductance = heat->get<double>("conductance");
      tool_heat.temperature = heat->get<double>("temperature");
      tool_heat.effusivity = heat->maybe<double>("effusivity");
      const auto k = heat->maybe<double>("conductivity"), density = heat->maybe<double>("density"),
                 c = heat->maybe<double>("specific_heat");
      const int parts = int(k.has_value()) + int(density.has_value()) + int(c.has_value());
      if (parts > 0 && (parts < 3 || tool_heat.effusivity))
        diagnostics.add(Mistake::conflict, heat->where, heat->path,
                        "expected either effusivity, or conductivity, density and specific_heat together");
      else if (parts == 3)
        tool_heat.effusivity = std::sqrt(*k * *density * *c);
    }
    result.tools.push_back(std::move(tool));
  }
}

void read_cloud(Setting& root, Case& result, Diagnostics& diagnostics) {
  Setting& table = *root.find("cloud");
  CloudSpec& cloud = result.cloud;
  cloud.pattern = table.choice<CloudSpec::Pattern>("pattern");
  cloud.jitter = table.get<double>("jitter");
  cloud.seed = static_cast<std::uint64_t>(table.get<std::int64_t>("seed"));
  cloud.spacing = table.maybe<double>("spacing").value_or(0.0);
  const bool list = cloud.pattern == CloudSpec::Pattern::list;
  if (!list && !table.find("spacing"))
    diagnostics.add(Mistake::missing_key, table.where, "cloud.spacing",
                    "missing, expected " + find_key("cloud.spacing")->expectation());
  const Setting *nodes = table.find("nodes"), *file = table.find("nodes_file");
  for (const Setting* given : {nodes, file})
    if (given && !list)
      diagnostics.add(Mistake::conflict, given->where, given->path,
                      "goes with pattern = \"list\", found another pattern");
  if (list && !nodes == !file)
    diagnostics.add(nodes ? Mistake::conflict : Mistake::missing_key, table.where, table.path,
                    fmt::format("found {} of nodes and nodes_file, expected one with pattern = \"list\"",
                                nodes ? "both" : "none"));
  else if (list && file) {
    const std::filesystem::path folder = std::filesystem::path(result.path).parent_path();
    try {
      cloud.nodes = read_points((folder / std::get<std::string>(file->value)).string());
    } catch (const InputError& error) {
      diagnostics.add(Mistake::reference, file->where, file->path, error.what());
    }
    std::erase_if(table.members, [](const Setting& member) { return member.name == "nodes_file"; });
    table.set_default("nodes", cloud.nodes);
  } else if (list) {
    cloud.nodes = std::get<std::vector<Vec2>>(nodes->value);
  }
  for (const Setting& refinement : table.entries("refine"))
    cloud.refine.push_back(read_refinement(root, refinement, cloud.spacing, diagnostics));
  for (const Setting& window : root.entries("output.windows")) {
    const std::array<Vec2, 2> corners = box(*window.find("box"), diagnostics);
    result.output.windows.push_back({window.name, corners[0], corners[1]});
  }
}

} // namespace cnem::io
