#include "report/space_recorder.hpp"

#include "core/index.hpp"
#include "report/picture_source.hpp"
#include "results/fields.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace cnem::report {
namespace {

std::size_t bytes_of(const SpaceView& view) {
  return sizeof(double) * (6 * view.scene.cells.vertex.size() + 9 * view.solids.corner.size() +
                           view.values.size() * view.scene.node.size());
}

} // namespace

const std::vector<TriangleSurface>& SpaceRecorder::tools() {
  if (tools_.empty()) tools_ = tool_surfaces(*case_);
  return tools_;
}

void SpaceRecorder::record(results::FileQueue& files, const results::Snapshot<3>& shot) {
  const SpaceSource source = space_source(*case_, shot, case_->output.picture_fields);
  const auto views = space_views(*case_, source, tools());
  for (std::size_t f = 0; f < source.names.size(); ++f)
    for (const auto& view : views) {
      const std::string& name = source.names[f];
      Picture picture = picture_of(*case_, source, *view, f);
      AlbumEntry entry{
          .field = picture.label, .time = picture.time, .caption = view->section, .series = name};
      if (shot.displacement_scale != 1.0) { // which its files do not tell
        entry.note = note_of_scale(shot.displacement_scale);
        entry.series.clear();
      }
      entry.own = {own_span(*case_, name, picture), whole_window(picture)};
      entry.drawn = {widened(picture.map, entry.own.range), entry.own.view};
      entry.tools = source.tools;
      entry.sides = source.sides;
      picture.range = entry.drawn.range;
      picture.window = entry.drawn.view;
      album_.add(
          files, view->section.empty() ? name : name + "_" + view->section, std::move(entry),
          [view, picture] { return draw_png(picture); }, bytes_of(*view) / source.names.size());
    }
}

void SpaceRecorder::finish(results::FileQueue& files) {
  if (!case_->output.drawing.common || album_.entries().empty()) return;
  const auto wanted =
      album_.common_scales([](const std::string& series) { return field_info<3>(series).shown.map; },
                           [](const AlbumEntry&) { return true; });
  const auto open = [&](const results::FieldFiles& frame, const AlbumEntry& first) -> PictureAlbum::Drawer {
    if (!std::filesystem::exists(folder_ / frame.nodes)) return {}; // taken away
    if (first.tools.size() != case_->tools.size()) return {};       // of an older version
    std::vector<std::string> names;
    for (const std::string& name : case_->output.picture_fields)
      if (results::has_node_field(folder_ / frame.nodes, results::array_in_files(field_info<3>(name))))
        names.push_back(name);
    const auto source =
        std::make_shared<const SpaceSource>(space_source(*case_, folder_, frame, names, first));
    return [this, source, views = space_views(*case_, *source, tools())](
               const AlbumEntry& entry, const PictureScale& scale) -> std::optional<PictureAlbum::Drawing> {
      const auto field = std::ranges::find(source->names, entry.series) - source->names.begin();
      const auto view = std::ranges::find(views, entry.caption, [](const auto& one) { return one->section; });
      if (index_of(field) == source->names.size() || view == views.end()) return std::nullopt;
      Picture picture = picture_of(*case_, *source, **view, index_of(field));
      picture.range = scale.range;
      picture.window = scale.view;
      return PictureAlbum::Drawing{[kept = *view, picture] { return draw_png(picture); },
                                   bytes_of(**view) / source->names.size()};
    };
  };
  album_.redraw(files, wanted, results::read_field_series(folder_), open);
}

} // namespace cnem::report
