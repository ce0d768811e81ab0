#include "report/space_recorder.hpp"

#include "core/index.hpp"
#include "report/picture_source.hpp"
#include "results/fields.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace cnem::report {
namespace {

ColourRange range_of(const input::Case& input, const std::string& field, const Picture& picture) {
  const input::Drawing& drawing = input.output.drawing;
  if (const auto given = drawing.ranges.find(field); given != drawing.ranges.end())
    return {given->second[0], given->second[1]};
  return value_span(picture.map, picture.value, drawing.percentile.value_or(usual_percentile(picture.map)));
}

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
      entry.own = {range_of(*case_, name, picture), whole_window(picture)};
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

/// One range for a field, one view for a section.
std::vector<PictureScale> SpaceRecorder::wanted_scales() const {
  std::map<std::string, ColourRange> range;
  std::map<std::string, PictureWindow> window;
  for (const AlbumEntry& entry : album_.entries()) {
    if (entry.series.empty()) continue;
    const auto [at, fresh] = range.emplace(entry.series, entry.own.range);
    if (!fresh) at->second = joined(at->second, entry.own.range);
    const auto [place, first] = window.emplace(entry.caption, entry.own.view);
    if (!first) place->second = joined(place->second, entry.own.view);
  }
  std::vector<PictureScale> wanted;
  for (const AlbumEntry& entry : album_.entries())
    wanted.push_back(entry.series.empty()
                         ? entry.drawn
                         : PictureScale{widened(field_info<3>(entry.series).shown.map, range[entry.series]),
                                        window[entry.caption]});
  return wanted;
}

void SpaceRecorder::finish(results::FileQueue& files) {
  if (!case_->output.drawing.common || album_.entries().empty()) return;
  const std::vector<PictureScale> wanted = wanted_scales();
  for (const results::FieldFiles& frame : results::read_field_series(folder_)) {
    if (!std::filesystem::exists(folder_ / frame.nodes)) continue; // taken away: pictures stay as they are
    std::optional<SpaceSource> source;                             // read where it is needed
    std::vector<std::shared_ptr<SpaceView>> views;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      const AlbumEntry entry = album_.entries()[k];
      if (entry.time != frame.time || wanted[k] == entry.drawn || entry.tools.size() != case_->tools.size())
        continue; // of an older version: it stays as it is
      if (!source) {
        std::vector<std::string> names;
        for (const std::string& name : case_->output.picture_fields)
          if (results::has_node_field(folder_ / frame.nodes, results::array_in_files(field_info<3>(name))))
            names.push_back(name);
        source = space_source(*case_, folder_, frame, names, entry);
        views = space_views(*case_, *source, tools());
      }
      const auto field = std::ranges::find(source->names, entry.series) - source->names.begin();
      const auto view = std::ranges::find(views, entry.caption, [](const auto& one) { return one->section; });
      if (index_of(field) == source->names.size() || view == views.end()) continue;
      Picture picture = picture_of(*case_, *source, **view, index_of(field));
      picture.range = wanted[k].range;
      picture.window = wanted[k].view;
      album_.replace(
          files, k, wanted[k], [kept = *view, picture] { return draw_png(picture); },
          bytes_of(**view) / source->names.size());
    }
  }
}

} // namespace cnem::report
