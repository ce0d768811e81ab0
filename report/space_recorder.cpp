#include "report/space_recorder.hpp"

#include "core/index.hpp"
#include "report/body_view.hpp"
#include "report/picture_source.hpp"
#include "results/fields.hpp"

#include <fmt/format.h>
#include <memory>
#include <utility>
#include <vector>

namespace cnem::report {
namespace {

/// Corners of the tetrahedra that are drawn as cells.
std::vector<std::array<NodeIndex, 4>> tetrahedra_of(const CellGeometry<3>& cells) {
  std::vector<std::array<NodeIndex, 4>> list;
  for (std::size_t c = 0; c + 1 < cells.begin.size(); ++c) {
    std::array<NodeIndex, 4> corner;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto vertex = index_of(cells.index[index_of(cells.begin[c]) + k]);
      corner[k] = cells.vertex_node[index_of(cells.vertex_begin[vertex])];
    }
    list.push_back(corner);
  }
  return list;
}

Picture picture_of(const input::Case& input, const std::string& field, double time) {
  Picture picture;
  show_field(picture, field_info<3>(field).shown, results::ShownUnits(input.report.units));
  picture.title = input.title;
  picture.time = time;
  if (!input.output.drawing.ranges.contains(field)) picture.percentile = input.output.drawing.percentile;
  return picture;
}

ColourRange range_of(const input::Case& input, const std::string& field, const Picture& picture) {
  const input::Drawing& drawing = input.output.drawing;
  if (const auto given = drawing.ranges.find(field); given != drawing.ranges.end())
    return {given->second[0], given->second[1]};
  return value_span(picture.map, picture.value, drawing.percentile.value_or(usual_percentile(picture.map)));
}

} // namespace

void SpaceRecorder::record(results::FileQueue& files, const results::Snapshot<3>& shot) {
  const input::Output& output = case_->output;
  const Fields<3> position = drawn_positions<3>(shot);
  const auto tetrahedra = tetrahedra_of(shot.approximation.cells);
  const SectionCells cells =
      case_->method.options.cells == scni::CellKind::voronoi ? SectionCells::voronoi : SectionCells::median;
  for (const std::string& name : output.picture_fields) {
    const Field value = results::values_at_nodes(shot, name);
    const auto draw = [&](Scene made, const std::string& key, std::string caption) {
      const auto scene = std::make_shared<const Scene>(std::move(made));
      if (scene->value.empty()) return;
      Picture picture = picture_of(*case_, name, shot.state.time);
      picture.cells = &scene->cells;
      picture.position = {scene->position[0], scene->position[1]};
      picture.value = scene->value;
      picture.darkness = scene->darkness;
      picture.edges = scene->darkness.empty() ? picture.edges : false;
      AlbumEntry entry{.field = picture.label,
                       .time = picture.time,
                       .caption = std::move(caption),
                       .note = note_of_scale(shot.displacement_scale)};
      entry.own = {range_of(*case_, name, picture), whole_window(picture)};
      entry.drawn = {widened(picture.map, entry.own.range), entry.own.view};
      picture.range = entry.drawn.range;
      picture.window = entry.drawn.view;
      album_.add(
          files, key, std::move(entry), [scene, picture] { return draw_png(picture); },
          sizeof(double) * 6 * scene->cells.vertex.size());
    };
    draw(surface_scene(shot.cloud.facets, position, value, {output.drawing.eye}), name, "");
    for (const input::Section& section : output.sections)
      draw(section_scene(tetrahedra, position, value, section.at, section.normal, cells),
           name + "_" + section.name, section.name);
  }
}

} // namespace cnem::report
