// Workpieces in space that are made of outlines or come from a file, of the case reader.
#include "clouds/space/facet_tree.hpp"
#include "clouds/space/faceted.hpp"
#include "core/geometry/box.hpp"
#include "core/geometry/facets.hpp"
#include "input/case_parts.hpp"
#include "input/curve_checks.hpp"
#include "input/space_domain.hpp"
#include "input/triangle_file.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace cnem::input {

namespace {

/// As names of outlines, and those with a '+' that pieces in space have of themselves.
void check_piece_name(const Setting& setting, Diagnostics& diagnostics) {
  const auto& name = std::get<std::string>(setting.value);
  if (name == "x+" || name == "y+" || name == "z+" || name == "theta+") return;
  if (const std::string fault = fault_of_piece_name(name); !fault.empty())
    diagnostics.add(Mistake::type, setting.where, setting.path, fault);
}

/// Names of the ends, as written.
std::array<std::string, 2> end_names(const Setting& table, Diagnostics& diagnostics) {
  for (const char* end : {"low", "high"}) check_piece_name(*table.find(end), diagnostics);
  return {table.get<std::string>("low"), table.get<std::string>("high")};
}

/// Names of pieces, those on parallel planes first, and how many these are.
std::pair<std::vector<std::string>, std::size_t> faceted_names(const Cloud<3>& surface) {
  std::map<std::string, std::pair<Vec3, bool>> normal; // and whether all are along it
  std::vector<std::string> order;
  for (const Facet<3>& facet : surface.facets) {
    const std::string& name = surface.piece_names[facet.piece];
    const Vec3 n = area_normal<3>(corners_of(facet, surface.position)).normalized();
    const auto [found, fresh] = normal.try_emplace(name, n, true);
    if (fresh) order.push_back(name);
    if (found->second.first.cross(n).norm() > 1e-5) found->second.second = false; // STL has six digits
  }
  const auto round = std::stable_partition(order.begin(), order.end(),
                                           [&](const std::string& n) { return normal[n].second; });
  return {order, static_cast<std::size_t>(round - order.begin())};
}

/// Each place is on the surface, and pieces have one name.
void check_names(const Setting& names, const clouds::Faceted& faceted, const Cloud<3>& surface,
                 Diagnostics& diagnostics) {
  const Box<3> box = box_of<3>(surface.position);
  const double far = 0.01 * (box.high - box.low).norm(); // round faces lie a little off their triangles
  const clouds::FacetTree tree(surface);
  std::map<PieceIndex, std::size_t> named;
  for (std::size_t k = 0; k < faceted.names.size(); ++k) {
    const clouds::Faceted::Name& given = faceted.names[k];
    const Setting &at = *names.members[k].find("at"), &name = *names.members[k].find("name");
    const auto nearest = tree.nearest(given.at, std::numeric_limits<double>::max());
    if (std::abs(nearest.distance) > far)
      diagnostics.add(
          Mistake::geometry, at.where, at.path,
          fmt::format("found {}, expected a place on the surface: its nearest point, {}, is {:.3g} "
                      "m away",
                      show(given.at), show(nearest.point), std::abs(nearest.distance)));
    const auto [first, fresh] = named.try_emplace(surface.facets[CloudFacetIndex{nearest.facet}].piece, k);
    if (const std::string& other = faceted.names[first->second].name; !fresh && other != given.name)
      diagnostics.add(Mistake::conflict, name.where, name.path,
                      fmt::format("found \"{}\" for the piece that {} calls \"{}\", expected one name for a "
                                  "piece",
                                  given.name, names.members[first->second].path, other));
  }
}

} // namespace

Sweep read_extrusion(const Setting& table, Diagnostics& diagnostics) {
  Sweep sweep;
  sweep.from = table.get<double>("from");
  sweep.to = table.get<double>("to");
  sweep.ends = end_names(table, diagnostics);
  if (const Setting& to = *table.find("to"); !(sweep.to > sweep.from))
    diagnostics.add(Mistake::geometry, to.where, to.path,
                    fmt::format("an outline drawn from z = {:g} to {:g} m has no volume, expected from < to",
                                sweep.from, sweep.to));
  return sweep;
}

Sweep read_revolution(const Setting& table, Diagnostics& diagnostics) {
  Sweep sweep;
  sweep.turned = true;
  sweep.angle = table.get<double>("angle");
  sweep.origin = table.vector("origin");
  sweep.ends = end_names(table, diagnostics);
  return sweep;
}

void read_faceted(Setting& table, Case& result, Diagnostics& diagnostics) {
  std::optional<FacetSoup> soup = read_triangles(table, result.path, diagnostics);
  if (!soup) return;
  const Setting& file = *table.find("file");
  clouds::Faceted faceted;
  faceted.crease_angle = table.get<double>("crease_angle");
  for (const Setting& entry : table.find("names") ? table.find("names")->members : std::vector<Setting>{}) {
    check_piece_name(*entry.find("name"), diagnostics);
    faceted.names.push_back({entry.vector("at"), entry.get<std::string>("name")});
  }
  try {
    faceted.soup = std::move(*soup);
    const Vec3 shift = table.vector("shift");
    for (auto& triangle : faceted.soup.triangles)
      for (Vec3& x : triangle.corner) x += shift;
    const Cloud<3> surface = clouds::divided_surface(faceted);
    if (const Setting* names = table.find("names")) check_names(*names, faceted, surface, diagnostics);
    std::tie(result.domain.faceted_pieces, result.domain.plane_pieces) = faceted_names(surface);
    result.domain.faceted = std::move(faceted);
  } catch (const GeometryError& error) {
    diagnostics.add(Mistake::geometry, file.where, file.path, error.what());
  }
}

} // namespace cnem::input
