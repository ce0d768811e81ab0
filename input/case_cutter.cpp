// Reads milling cutters.
#include "input/case_machining.hpp"
#include "input/case_parts.hpp"
#include "input/triangle_file.hpp"

#include "core/error.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <utility>

namespace cnem::input {
namespace {

enum class End { flat, bull, ball };

void read_end(machining::Cutter& cutter, const Setting& table, Diagnostics& diagnostics) {
  const End end = table.choice<End>("end");
  const Setting* corner = table.find("corner");
  if (end == End::ball) cutter.corner = cutter.radius();
  if (corner && end != End::bull)
    diagnostics.add(Mistake::conflict, corner->where, corner->path,
                    "found a corner of a flat or ball end, expected cutter.end = \"bull\"");
  else if (!corner && end == End::bull)
    diagnostics.add(Mistake::missing_key, table.where, table.path + ".corner",
                    "missing, expected the corner radius of the bull end, e.g. \"2 mm\"");
  else if (corner) {
    cutter.corner = std::get<double>(corner->value);
    if (cutter.corner > cutter.radius())
      diagnostics.add(Mistake::range, corner->where, corner->path,
                      fmt::format("found {:g} m, expected at most the radius of the cutter, {:g} m",
                                  cutter.corner, cutter.radius()));
  }
}

/// The edge of a rake face; none where it is at fault.
std::shared_ptr<const machining::CuttingEdge> read_edge(Setting& table, const std::string& case_path,
                                                        double axial_depth, Diagnostics& diagnostics) {
  for (const char* name : {"helix", "end", "corner", "rake"})
    if (const Setting* other = table.find(name); other && other->given)
      diagnostics.add(
          Mistake::conflict, other->where, other->path,
          "found beside cutter.rake_face, expected one of them: the face has its shape and angles");
  Setting& face = *table.find("rake_face");
  const std::optional<FacetSoup> soup = read_triangles(face, case_path, diagnostics);
  if (!soup) return nullptr;
  TriangleSurface surface = joined(*soup);
  for (Vec3& point : surface.points) point += face.vector("shift");
  bool good = true;
  const auto refuse = [&](const std::string& key, const std::string& why) {
    good = false;
    diagnostics.add(Mistake::geometry, face.where, face.path + "." + key, why);
  };
  std::shared_ptr<const machining::CuttingEdge> edge;
  try {
    edge = std::make_shared<const machining::CuttingEdge>(surface);
  } catch (const GeometryError& error) {
    refuse("file", error.what());
    return nullptr;
  }
  constexpr double close = 1e-3;
  const double diameter = table.get<double>("diameter");
  if (std::abs(2.0 * edge->radius() - diameter) > close * diameter)
    refuse("unit", fmt::format("makes a face that reaches {:g} m from the axis, expected half of "
                               "cutter.diameter = {:g} m",
                               edge->radius(), diameter));
  if (std::abs(edge->bottom()) > close * diameter)
    refuse("shift", fmt::format("puts the lower end of the edge at {:g} m, expected 0, the tip of the cutter",
                                edge->bottom()));
  if (edge->top() < (1.0 - close) * axial_depth)
    refuse("shift", fmt::format("puts the upper end of the edge at {:g} m, expected at least "
                                "milling.axial_depth = {:g} m",
                                edge->top(), axial_depth));
  return good ? edge : nullptr;
}

} // namespace

machining::Cutter read_cutter(Setting& table, const std::string& case_path, double axial_depth,
                              Diagnostics& diagnostics) {
  machining::Cutter cutter;
  cutter.diameter = table.get<double>("diameter");
  const auto teeth = static_cast<std::size_t>(table.get<std::int64_t>("teeth"));
  cutter.pitch = machining::equal_pitch(teeth);
  cutter.helix = table.get<double>("helix");
  cutter.run_out = table.get<double>("run_out");
  cutter.run_out_angle = table.get<double>("run_out_angle");
  if (const Setting* run_out = table.find("run_out"); cutter.run_out >= cutter.radius())
    diagnostics.add(Mistake::range, run_out->where, run_out->path,
                    fmt::format("found {:g} m, expected less than the radius of the cutter, {:g} m",
                                cutter.run_out, cutter.radius()));
  read_end(cutter, table, diagnostics);
  if (table.find("rake_face")) {
    cutter.edge = read_edge(table, case_path, axial_depth, diagnostics);
    for (const char* name : {"helix", "end"}) table.erase(name); // defaults, which resolved cases would give
    if (cutter.edge) cutter.diameter = 2.0 * cutter.edge->radius();
  }
  const Setting* pitch = table.find("pitch");
  if (!pitch) return cutter;
  cutter.pitch = std::get<std::vector<double>>(pitch->value);
  const double sum = std::accumulate(cutter.pitch.begin(), cutter.pitch.end(), 0.0);
  constexpr double close = 1e-6;
  if (cutter.pitch.size() != teeth)
    diagnostics.add(
        Mistake::type, pitch->where, pitch->path,
        fmt::format("found {} angles for {} teeth, expected one a tooth", cutter.pitch.size(), teeth));
  else if (std::abs(sum - machining::full_turn) > close)
    diagnostics.add(Mistake::range, pitch->where, pitch->path,
                    fmt::format("found angles of {:.8g} deg together, expected a whole turn, 360 deg",
                                sum * 360.0 / machining::full_turn));
  for (double& angle : cutter.pitch)
    angle *= machining::full_turn / sum; // "120 120 120 deg" is a turn but for rounding
  return cutter;
}

} // namespace cnem::input
