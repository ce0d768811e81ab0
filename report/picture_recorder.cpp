#include "report/picture_recorder.hpp"

#include "core/index.hpp"
#include "results/output_folder.hpp"
#include "results/vtk_reader.hpp"

#include <algorithm>
#include <cmath>
#include <map>
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

/// Of all entries: the common one, of windows with their own place.
std::vector<PictureScale> PictureRecorder::wanted_scales() const {
  std::map<std::string, ColourRange> range;
  std::optional<PictureWindow> view;
  for (const AlbumEntry& entry : album_.entries()) {
    if (entry.series.empty()) continue;
    const auto [at, fresh] = range.emplace(entry.series, entry.own.range);
    if (!fresh) at->second = joined(at->second, entry.own.range);
    if (entry.caption.empty()) view = view ? joined(*view, entry.own.view) : entry.own.view;
  }
  std::vector<PictureScale> wanted;
  for (const AlbumEntry& entry : album_.entries()) {
    wanted.push_back(entry.drawn);
    if (entry.series.empty()) continue;
    wanted.back().range = widened(field_info<2>(entry.series).shown.map, range[entry.series]);
    if (entry.caption.empty()) wanted.back().view = *view;
  }
  return wanted;
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
  const std::vector<PictureScale> wanted = wanted_scales();
  const std::vector<std::string>& names = case_->output.picture_fields;
  for (const results::FieldFiles& frame : results::read_field_series(folder_)) {
    if (!std::filesystem::exists(folder_ / frame.cells)) continue; // taken away: pictures stay as they are
    Source source;                                                 // read where it is needed
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      const AlbumEntry& entry = album_.entries()[k];
      if (entry.time != frame.time || wanted[k] == entry.drawn) continue;
      if (!source) source = picture_source(*case_, folder_, frame, names_in(folder_ / frame.cells, names));
      const auto field =
          std::find(source->names.begin(), source->names.end(), entry.series) - source->names.begin();
      if (index_of(field) == source->names.size()) continue; // zero everywhere, and in no file
      Picture picture = picture_of(*case_, *source, index_of(field));
      picture.range = wanted[k].range;
      picture.window = wanted[k].view;
      album_.replace(
          files, k, wanted[k], [source, picture] { return draw_png(picture); }, source->bytes() / 2);
    }
  }
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
