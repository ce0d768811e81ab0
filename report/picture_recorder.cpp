#include "report/picture_recorder.hpp"

#include "core/index.hpp"
#include "results/output_folder.hpp"
#include "results/vtk_reader.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace cnem::report {

PictureWindow window_at(const input::Window& window, const std::vector<PictureTool>& tools) {
  const Vec2 moved = window.follow ? tools[*window.follow].displacement : Vec2(0, 0);
  return {window.lower + moved, window.upper + moved};
}

std::string PictureRecorder::draw(results::FileQueue& files, const Source& source, Picture picture,
                                  const std::string& key, AlbumEntry entry) {
  entry.field = picture.label;
  entry.time = picture.time;
  entry.drawn = {widened(picture.map, entry.own.range), entry.own.view};
  picture.range = entry.drawn.range;
  picture.window = entry.drawn.view;
  return album_.add(
      files, key, std::move(entry), [source, picture] { return draw_png(picture); },
      source->bytes() / 2); // shared with the others of its time
}

std::string PictureRecorder::note_of(double time, const std::string& field) const {
  for (const input::PictureNote& note : case_->output.notes)
    if (note.field == field && std::abs(note.at - time) <= 1e-9 * case_->time.end) return note.text;
  return "";
}

void PictureRecorder::record(results::FileQueue& files, const results::Snapshot<2>& shot) {
  const input::Output& output = case_->output;
  const Source source = picture_source(*case_, shot, drawn_positions<2>(shot), output.picture_fields);
  for (std::size_t f = 0; f < source->names.size(); ++f) {
    const std::string& name = source->names[f];
    const Picture picture = picture_of(*case_, *source, f);
    AlbumEntry entry{.field = {}, .caption = "", .note = note_of(shot.state.time, name), .series = name};
    if (const std::string scaled = note_of_scale(shot.displacement_scale); !scaled.empty())
      entry.note += (entry.note.empty() ? "" : " ") + scaled;
    entry.own.range = own_span(*case_, name, picture);
    entry.own.view = output.drawing.view
                         ? PictureWindow{output.drawing.view->front(), output.drawing.view->back()}
                         : whole_window(picture);
    draw(files, source, picture, name, entry);
    for (const input::Window& window : output.windows) {
      entry.caption = window.name;
      entry.own.view = window_at(window, picture.tools);
      draw(files, source, picture, name + "_" + window.name, entry);
    }
  }
}

namespace {

/// Those of the fields that a file has: others are of laws that no material of the case follows.
std::vector<std::string> names_in(const std::filesystem::path& cells, const std::vector<std::string>& names) {
  std::vector<std::string> list;
  for (const std::string& name : names)
    if (results::has_cell_field(cells, results::array_in_files(field_info<2>(name)))) list.push_back(name);
  return list;
}

} // namespace

void PictureRecorder::finish(results::FileQueue& files) {
  if (!case_->output.drawing.common || album_.entries().empty()) return;
  const auto wanted =
      album_.common_scales([](const std::string& series) { return field_info<2>(series).shown.map; },
                           [](const AlbumEntry& entry) { return entry.caption.empty(); });
  const auto open = [&](const results::FieldFiles& frame, const AlbumEntry&) -> PictureAlbum::Drawer {
    if (!std::filesystem::exists(folder_ / frame.cells)) return {}; // taken away
    const Source source =
        picture_source(*case_, folder_, frame, names_in(folder_ / frame.cells, case_->output.picture_fields));
    return [this, source](const AlbumEntry& entry,
                          const PictureScale& scale) -> std::optional<PictureAlbum::Drawing> {
      const auto field = std::ranges::find(source->names, entry.series) - source->names.begin();
      if (index_of(field) == source->names.size()) return std::nullopt; // zero everywhere, and in no file
      Picture picture = picture_of(*case_, *source, index_of(field));
      picture.range = scale.range;
      picture.window = scale.view;
      return PictureAlbum::Drawing{[source, picture] { return draw_png(picture); }, source->bytes() / 2};
    };
  };
  album_.redraw(files, wanted, results::read_field_series(folder_), open);
}

std::string PictureRecorder::record_place(results::FileQueue& files, const results::Snapshot<2>& shot,
                                          const Vec2& centre, double radius) {
  const NodeState<2>& node = shot.state.node;
  Fields<2> position = node.position;
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < node.size(); ++i)
      if (!std::isfinite(position[k][i])) position[k][i] = node.reference[k][i];
  const Source source = picture_source(*case_, shot, position, {"plastic_strain"});
  for (double& value : source->fields.values.front())
    if (!std::isfinite(value)) value = 0.0;
  Picture picture = picture_of(*case_, *source, 0);
  picture.edges = true;
  AlbumEntry entry{.field = {}, .caption = "where it went wrong"};
  entry.own = {own_span(*case_, "plastic_strain", picture),
               {centre.array() - radius, centre.array() + radius}};
  return draw(files, source, std::move(picture), "post_mortem", std::move(entry));
}

} // namespace cnem::report
