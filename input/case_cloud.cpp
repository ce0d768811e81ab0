// The nodes of a case: spacing, refinements, node lists; and the windows of its pictures.
#include "core/geometry/box.hpp"
#include "input/case_parts.hpp"
#include "input/case_walls.hpp"
#include "input/curve_checks.hpp"
#include "input/schema/nearest.hpp"
#include "input/space_domain.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>

namespace cnem::input {
namespace {

/// Ends of the cracks named, or of all.
std::vector<Vec2> crack_ends(const Setting& names, const Setting& cracks, Diagnostics& diagnostics) {
  std::vector<Vec2> ends;
  std::vector<std::string> known;
  for (const Setting& crack : cracks.members) known.push_back(crack.name);
  const auto& wanted = std::get<std::vector<std::string>>(names.value);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const std::string& name = wanted[i];
    bool found = name == "all" && !known.empty();
    for (const Setting& crack : cracks.members)
      if (name == "all" || name == crack.name) {
        const std::vector<Vec2> path = crack_path(crack);
        if (!path.empty()) ends.insert(ends.end(), {path.front(), path.back()});
        found = true;
      }
    if (!found)
      diagnostics.add(
          Mistake::reference, names.where_of(i), names.path,
          known.empty() ? fmt::format("found {} in a domain without cracks, expected box or points",
                                      toml_quoted(shortened(name)))
                        : fmt::format("found {}, expected a crack: {} or all{}", toml_quoted(shortened(name)),
                                      fmt::join(known, ", "), did_you_mean(name, known)));
  }
  return ends;
}

} // namespace

std::vector<clouds::Refinement> read_refinement(const Setting& root, const Setting& table,
                                                double cloud_spacing, Diagnostics& diagnostics) {
  using Kind = clouds::Refinement::Region;
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
  const double wanted = spacing ? std::get<double>(spacing->value)
                                : table.maybe<double>("factor").value_or(1.0) * cloud_spacing;
  std::vector<clouds::Refinement> list;
  const auto add = [&](Kind kind, std::vector<Vec2> places) {
    list.push_back({kind, std::move(places), wanted, table.get<double>("growth")});
  };
  if (region) {
    const auto [low, high] = read_box(*region, diagnostics);
    add(Kind::box, {low, high});
  } else if (points) {
    add(Kind::path, std::get<std::vector<Vec2>>(points->value));
    if (list.back().points.empty())
      diagnostics.add(Mistake::type, points->where, points->path, "found no points, expected at least one");
  }
  if (tips) {
    const Setting* cracks = root.find("domain.cracks");
    for (const Vec2& tip : crack_ends(*tips, cracks ? *cracks : Setting{}, diagnostics))
      add(Kind::path, {tip});
  }
  return list;
}

namespace {

/// Distance between the domain and a refinement outside it, m; 0 where they touch.
double gap(const clouds::Refinement& refinement, const Domain& domain) {
  std::vector<Vec2> corners = refinement.points;
  const bool is_box = refinement.region == clouds::Refinement::Region::box;
  if (is_box) {
    const Vec2 low = corners[0], high = corners[1];
    corners = {low, {high.x(), low.y()}, high, {low.x(), high.y()}, low};
  }
  Curve region;
  for (std::size_t k = 1; k < corners.size(); ++k)
    region.pieces.push_back({corners[k - 1], corners[k], {0, 0}, 0.0, false, ""});
  for (const Vec2& x : corners)
    if (outside_reason(domain, x).empty()) return 0.0;
  if (is_box && inside(region, domain.outer.pieces.front().from)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [key, curve] : curves_of(domain)) {
    if (common_point(region, *curve)) return 0.0;
    for (const Vec2& x : corners) least = std::min(least, distance(*curve, x));
    for (const CurvePiece& piece : curve->pieces) {
      const int samples = piece.is_arc() ? 64 : 1; // two segments are nearest at an end of one
      for (int k = 0; k < samples; ++k)
        least = std::min(least, distance(region, piece.point(double(k) / samples)));
    }
  }
  return least;
}

/// A refinement that lies so far outside that nothing of the domain becomes finer was not meant.
void check_reach(const Setting& table, const clouds::Refinement& refinement, const CloudSpec& cloud,
                 const Domain& domain, Diagnostics& diagnostics) {
  if (domain.outer.pieces.empty() || refinement.points.empty()) return; // told already
  const double away = gap(refinement, domain), there = refinement.spacing + refinement.growth * away;
  if (away == 0.0 || there < cloud.spacing) return;
  const Setting& region = *table.find(table.find("box") ? "box" : "points");
  diagnostics.add(
      Mistake::geometry, region.where, region.path,
      fmt::format(
          "lies {:.3g} m outside the domain, where its spacing has grown to {:.3g} m, expected a place "
          "that makes the cloud finer than cloud.spacing = {:.3g} m somewhere",
          away, there, cloud.spacing));
}

/// Distance between a refinement and the box around the workpiece, m: no more than to the workpiece.
double gap_in_space(const clouds::SpaceRefinement& refinement, const Box<3>& around) {
  const auto away = [&](const Box<3>& from) {
    return Vec3((from.low - around.high).cwiseMax(around.low - from.high).cwiseMax(0.0)).norm();
  };
  const std::vector<Vec3>& points = refinement.points;
  if (refinement.region == clouds::SpaceRefinement::Region::box) return away(box_of<3>(points));
  double least = away({points[0], points[0]});
  for (std::size_t k = 1; k < points.size(); ++k) {
    const auto at = [&](double t) {
      const Vec3 x = points[k - 1] + t * (points[k] - points[k - 1]);
      return away({x, x});
    };
    double low = 0.0, high = 1.0; // along a segment the distance from what is convex is convex
    while (high - low > 1e-12) {
      const double third = (high - low) / 3.0;
      if (at(low + third) < at(high - third))
        high -= third;
      else
        low += third;
    }
    least = std::min({least, at(low), at(1.0)});
  }
  return least;
}

/// As check_reach.
void check_reach_in_space(const Setting& region, const clouds::SpaceRefinement& refinement, const Case& input,
                          Diagnostics& diagnostics) {
  const auto [low, high] = space_bounds(input.domain);
  const double away = gap_in_space(refinement, {low, high}),
               there = refinement.spacing + refinement.growth * away;
  if (away <= 1e-9 * (high - low).norm() || there < input.cloud.spacing) return;
  diagnostics.add(
      Mistake::geometry, region.where, region.path,
      fmt::format("lies {:.3g} m outside the box around the workpiece, where its spacing has grown to {:.3g} "
                  "m, expected a place that makes the cloud finer than cloud.spacing = {:.3g} m somewhere",
                  away, there, input.cloud.spacing));
}

/// A spacing that makes neighbours of nodes on opposite sides is a slip of the unit.
void check_spacing(const Setting& spacing, const Domain& domain, Diagnostics& diagnostics) {
  const double size = extent(domain.outer), given = std::get<double>(spacing.value);
  if (size > 0.0 && given > size)
    diagnostics.add(
        Mistake::range, spacing.where, spacing.path,
        fmt::format("found {:g} m, expected less than the size of the domain, {:.3g} m", given, size));
}

/// Regions in space with a finer spacing.
void read_space_refinements(const Setting& table, Case& result, Diagnostics& diagnostics) {
  using Kind = clouds::SpaceRefinement::Region;
  const Domain& domain = result.domain;
  for (const Setting& entry : table.entries("refine")) {
    if ((domain.block && domain.block->grid) || domain.faceted)
      diagnostics.add(Mistake::conflict, entry.where, entry.path,
                      domain.faceted
                          ? "found a refinement of a surface from a file, which takes one spacing; "
                            "expected none"
                          : "found a refinement of a grid, expected it with grid = false");
    const Setting *box = entry.find("box"), *points = entry.find("points");
    const Setting *spacing = entry.find("spacing"), *factor = entry.find("factor");
    if (!box == !points)
      diagnostics.add(box ? Mistake::conflict : Mistake::missing_key, entry.where, entry.path,
                      fmt::format("found {} of box and points, expected one", box ? "both" : "none"));
    if (!spacing == !factor)
      diagnostics.add(spacing ? Mistake::conflict : Mistake::missing_key, entry.where, entry.path,
                      fmt::format("found {} of spacing and factor, expected one", spacing ? "both" : "none"));
    const Setting* place = box ? box : points;
    if (!place) continue;
    clouds::SpaceRefinement refinement{box ? Kind::box : Kind::path, entry.vectors(place->name), 0.0,
                                       entry.get<double>("growth")};
    if (box ? refinement.points.size() != 2 : refinement.points.empty())
      diagnostics.add(Mistake::type, place->where, place->path,
                      box ? "expected two opposite corners" : "found no points, expected at least one");
    refinement.spacing = spacing ? std::get<double>(spacing->value)
                                 : entry.maybe<double>("factor").value_or(1.0) * result.cloud.spacing;
    const bool complete = box ? refinement.points.size() == 2 : !refinement.points.empty();
    if (complete) check_reach_in_space(*place, refinement, result, diagnostics);
    result.cloud.space_refinements.push_back(std::move(refinement));
  }
}

/// The spacing of a workpiece in space.
void read_space_cloud(const Setting& table, Case& result, Diagnostics& diagnostics) {
  const Setting* spacing = table.find("spacing");
  if (!spacing)
    return diagnostics.add(Mistake::missing_key, table.where, "cloud.spacing",
                           "missing, expected " + find_key("cloud.spacing")->expectation());
  result.cloud.spacing = std::get<double>(spacing->value);
  const auto [low, high] = space_bounds(result.domain);
  if (const double size = (high - low).norm(); result.cloud.spacing > size)
    diagnostics.add(Mistake::range, spacing->where, spacing->path,
                    fmt::format("found {:g} m, expected less than the size of the workpiece, {:.3g} m",
                                result.cloud.spacing, size));
  read_space_refinements(table, result, diagnostics);
  if (!result.domain.block) return;
  const Block& block = *result.domain.block;
  if (block.shape == Block::Shape::cylinder && result.cloud.spacing > 0.5 * block.radius)
    diagnostics.add(
        Mistake::range, spacing->where, spacing->path,
        fmt::format("found {:g} m, expected at most half of the radius of the cylinder, {:.3g} m: "
                    "facets would cut off more than a fortieth of it",
                    result.cloud.spacing, 0.5 * block.radius));
}

void check_window(const Setting& setting, const std::array<Vec2, 2>& corners, const Domain& domain,
                  Diagnostics& diagnostics) {
  if (domain.outer.pieces.empty()) return;
  const auto [low, high] = bounds(domain.outer);
  if ((corners[0].array() > high.array()).any() || (corners[1].array() < low.array()).any())
    diagnostics.add(
        Mistake::geometry, setting.where, setting.path,
        fmt::format(
            "the window from {} to {} shows nothing of the domain, expected one that meets its {} to {}",
            show(corners[0]), show(corners[1]), show(low), show(high)));
}

/// Random offsets: a study over seeds of a cloud that has none would compare a run with itself. Resolved
/// cases of earlier versions hold the defaults whatever the pattern.
void read_offsets(Setting& table, CloudSpec& cloud, Diagnostics& diagnostics) {
  const CloudSpec rest = cloud;
  cloud.jitter = table.get<double>("jitter");
  cloud.seed = static_cast<std::uint64_t>(table.get<std::int64_t>("seed"));
  if (cloud.pattern == clouds::Pattern::jittered) return;
  const auto refuse = [&](const char* name, bool changed) {
    if (const Setting& setting = *table.find(name); setting.given && changed)
      diagnostics.add(Mistake::conflict, setting.where, setting.path,
                      fmt::format("has no effect with pattern = \"{}\", whose nodes have no random offsets, "
                                  "expected it with \"jittered\"",
                                  table.get<std::string>("pattern")));
    table.erase(name);
  };
  refuse("jitter", cloud.jitter != rest.jitter);
  refuse("seed", cloud.seed != rest.seed);
}

} // namespace

std::array<Vec2, 2> read_box(const Setting& setting, Diagnostics& diagnostics) {
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
                    fmt::format("a box from {} to {} has no area, expected two opposite corners such as {}",
                                show(corners[0]), show(corners[1]), setting.key->example_text()));
  return {low, high};
}

void read_cloud(Setting& root, Case& result, Diagnostics& diagnostics) {
  Setting& table = *root.find("cloud");
  CloudSpec& cloud = result.cloud;
  if (result.analysis.dimensions() == 3)
    return result.domain.in_space() ? read_space_cloud(table, result, diagnostics) : void();
  cloud.pattern = table.choice<clouds::Pattern>("pattern");
  read_offsets(table, cloud, diagnostics);
  cloud.spacing = table.maybe<double>("spacing").value_or(0.0);
  const bool list = cloud.pattern == clouds::Pattern::list;
  if (!list && !table.find("spacing"))
    diagnostics.add(Mistake::missing_key, table.where, "cloud.spacing",
                    "missing, expected " + find_key("cloud.spacing")->expectation());
  if (const Setting* spacing = table.find("spacing")) check_spacing(*spacing, result.domain, diagnostics);
  const Setting *nodes = table.find("nodes"), *file = table.find("nodes_file");
  for (const Setting* given : {nodes, file})
    if (given && !list)
      diagnostics.add(Mistake::conflict, given->where, given->path,
                      fmt::format("goes with pattern = \"list\", expected none with pattern = \"{}\"",
                                  table.get<std::string>("pattern")));
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
    result.location["cloud.nodes"] = file->where.text();
    table.erase("nodes_file");
    table.set_default("nodes", cloud.nodes);
  } else if (list) {
    cloud.nodes = std::get<std::vector<Vec2>>(nodes->value);
  }
  for (const Setting& refinement : table.entries("refine")) {
    const auto regions = read_refinement(root, refinement, cloud.spacing, diagnostics);
    if (cloud.spacing > 0.0 && !list && !refinement.find("tips"))
      for (const clouds::Refinement& region : regions)
        check_reach(refinement, region, cloud, result.domain, diagnostics);
    const bool finer = std::any_of(regions.begin(), regions.end(), [&](const clouds::Refinement& region) {
      return region.spacing < cloud.spacing;
    });
    cloud.refinements.insert(cloud.refinements.end(), regions.begin(), regions.end());
    if (list || (cloud.pattern == clouds::Pattern::regular && finer))
      diagnostics.add(
          Mistake::conflict, refinement.where, refinement.path,
          fmt::format("found a refinement with pattern = \"{}\", expected it with \"hexagonal\" or "
                      "\"jittered\"",
                      table.get<std::string>("pattern")));
  }
}

void read_windows(const Setting& root, Case& result, Diagnostics& diagnostics) {
  const std::vector<std::string> tools = tool_names(result);
  for (const Setting& table : root.entries("output.windows")) {
    const Setting& setting = *table.find("box");
    const std::array<Vec2, 2> corners = read_box(setting, diagnostics);
    Window window{table.name, corners[0], corners[1]};
    if (const Setting* follow = table.find("follow"))
      window.follow = index_of_tool(*follow, std::get<std::string>(follow->value), tools, diagnostics);
    else if (corners[0] != corners[1])
      check_window(setting, corners, result.domain, diagnostics);
    result.output.windows.push_back(std::move(window));
  }
  if (const auto& view = result.output.drawing.view; view && view->front() != view->back())
    check_window(*root.find("output.drawing.view"), *view, result.domain, diagnostics);
}

} // namespace cnem::input
