#include "report/space_source.hpp"

#include "core/error.hpp"
#include "core/geometry/clip_polygon.hpp"
#include "core/geometry/facets.hpp"
#include "core/geometry/plane_section.hpp"
#include "core/index.hpp"
#include "input/space_domain.hpp"
#include "input/tool_surface.hpp"
#include "report/picture_source.hpp"
#include "results/fields.hpp"
#include "results/polyhedra.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::report {
namespace {

/// Planes of symmetry that the body ends at, each by the mean of its facets.
std::vector<KeptSide> symmetry_sides(const input::Case& input, const results::Snapshot<3>& shot) {
  std::vector<KeptSide> sides;
  for (const input::BoundaryCondition& condition : input.boundary) {
    if (!condition.symmetry) continue;
    for (const std::string& piece : condition.pieces) {
      Vec3 normal = Vec3::Zero(), moment = Vec3::Zero();
      double area = 0.0;
      for (const Facet<3>& facet : shot.cloud.facets) {
        if (shot.cloud.piece_names[facet.piece] != piece) continue;
        const auto corner = corners_of<3>(facet, shot.state.node.position);
        const Vec3 n = area_normal<3>(corner);
        normal += n;
        area += n.norm();
        moment += n.norm() * (corner[0] + corner[1] + corner[2]) / 3.0;
      }
      if (normal.norm() > 0.5 * area) sides.push_back({Vec3(moment / area), normal.normalized()});
    }
  }
  return sides;
}

/// The place of a section with axes that are those of the picture.
CutPlane plane_of(const input::Section& section) {
  const Mat<3> axes = BodyView{section.normal}.axes();
  const Vec3 towards = axes.row(2);
  return {towards.dot(section.at) * towards, axes.row(0), axes.row(1)};
}

void add_outlines(const input::Case& input, const SpaceSource& source,
                  const std::vector<TriangleSurface>& tools, const input::Section& section, SpaceView& view) {
  const CutPlane plane = plane_of(section);
  std::vector<Vec2> scratch;
  for (std::size_t t = 0; t < tools.size(); ++t) {
    CutPlane before = plane; // as the tool has it at t = 0
    before.at -= source.tools[t];
    bool named = false;
    for (const SectionLoop& loop : cut(tools[t], before)) {
      std::vector<Vec2> polygon = loop.point;
      for (const KeptSide& side : source.sides) {
        const Vec2 along(side.normal.dot(plane.right), side.normal.dot(plane.up));
        const double level = side.normal.dot(side.at - plane.at);
        clip_polygon(polygon, scratch, [&](const Vec2& x) { return along.dot(x) - level; });
      }
      if (polygon.size() < 3) continue;
      Curve& curve = view.outlines.emplace_back();
      for (std::size_t k = 0; k < polygon.size(); ++k)
        curve.pieces.push_back({polygon[k], polygon[(k + 1) % polygon.size()], {0, 0}, 0.0, false, ""});
      view.tools.push_back({&curve, Vec2(0, 0), named ? "" : input.tools[t].name});
      named = true;
    }
  }
}

} // namespace

SpaceSource space_source(const input::Case& input, const results::Snapshot<3>& shot,
                         const std::vector<std::string>& names) {
  SpaceSource source{.time = shot.state.time,
                     .tetrahedra = results::tetrahedra_of(shot.approximation.cells),
                     .position = drawn_positions<3>(shot),
                     .names = names};
  for (std::size_t k = 0; k < 3; ++k) // as their files give them back
    for (double& x : source.position[k]) {
      const double origin = input.origin[static_cast<Eigen::Index>(k)], written = origin + x;
      x = written - origin;
    }
  for (const std::string& name : names) source.values.push_back(results::values_at_nodes(shot, name));
  for (std::size_t t = 0; t < input.tools.size(); ++t)
    source.tools.push_back(shot.contact.displacement(t, shot.state.time));
  source.sides = symmetry_sides(input, shot);
  return source;
}

SpaceSource space_source(const input::Case& input, const std::filesystem::path& folder,
                         const results::FieldFiles& files, const std::vector<std::string>& names,
                         const AlbumEntry& entry) {
  std::vector<results::FileArray> arrays;
  for (const std::string& name : names) arrays.push_back(results::array_in_files(field_info<3>(name)));
  results::NodeFields fields =
      results::read_node_fields(folder / files.cells, folder / files.nodes, arrays, input.origin);
  return {.time = files.time,
          .tetrahedra = std::move(fields.tetrahedra),
          .position = std::move(fields.position),
          .names = names,
          .values = std::move(fields.values),
          .tools = entry.tools,
          .sides = entry.sides};
}

std::vector<TriangleSurface> tool_surfaces(const input::Case& input) {
  std::vector<TriangleSurface> surfaces;
  if (input.tools.empty()) return surfaces;
  const auto [low, high] = input::space_bounds(input.domain);
  for (const input::Tool& tool : input.tools)
    surfaces.push_back(input::tool_surface(*tool.solid, {low, high}));
  return surfaces;
}

std::vector<std::shared_ptr<SpaceView>> space_views(const input::Case& input, const SpaceSource& source,
                                                    const std::vector<TriangleSurface>& tools) {
  std::vector<std::shared_ptr<SpaceView>> views;
  const auto add = [&](std::shared_ptr<SpaceView> view) {
    if (view->scene.node.empty()) return;
    for (const Field& at_nodes : source.values) view->values.push_back(view->scene.values(at_nodes));
    views.push_back(std::move(view));
  };
  const BodyView eye{input.output.drawing.eye};
  auto whole = std::make_shared<SpaceView>();
  whole->scene = surface_scene(boundary_of(source.tetrahedra), source.position, eye);
  for (std::size_t t = 0; t < tools.size(); ++t) {
    TriangleSurface moved = tools[t];
    for (Vec3& x : moved.points) x += source.tools[t];
    add_solid(whole->solids, moved, source.sides, eye);
  }
  add(std::move(whole));
  const SectionCells cells =
      input.method.options.cells == scni::CellKind::voronoi ? SectionCells::voronoi : SectionCells::median;
  for (const input::Section& section : input.output.sections) {
    auto view = std::make_shared<SpaceView>();
    view->section = section.name;
    view->scene = section_scene(source.tetrahedra, source.position, section.at, section.normal, cells);
    add_outlines(input, source, tools, section, *view);
    add(std::move(view));
  }
  return views;
}

Picture picture_of(const input::Case& input, const SpaceSource& source, SpaceView& view, std::size_t field) {
  const std::string& name = source.names[field];
  Picture picture;
  show_field(picture, field_info<3>(name).shown, results::ShownUnits(input.report.units));
  picture.title = input.title;
  picture.time = source.time;
  picture.cells = &view.scene.cells;
  picture.rasters = &view.rasters;
  picture.position = {view.scene.position[0], view.scene.position[1]};
  picture.value = view.values[field];
  picture.darkness = view.scene.darkness;
  picture.depth = view.scene.depth;
  if (!view.scene.depth.empty()) {
    picture.solids = &view.solids;
    picture.edges = false;
  }
  picture.tools = view.tools;
  if (!input.output.drawing.ranges.contains(name)) picture.percentile = input.output.drawing.percentile;
  return picture;
}

} // namespace cnem::report
