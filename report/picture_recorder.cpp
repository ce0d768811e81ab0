#include "report/picture_recorder.hpp"

#include "report/cell_raster.hpp"
#include "results/fields.hpp"
#include "results/tool_fields.hpp"

#include <cmath>
#include <deque>
#include <utility>
#include <vector>

namespace cnem::report {

namespace {

std::array<std::span<const double>, 2> spans(const Fields<2>& field) { return {field[0], field[1]}; }

} // namespace

PictureWindow window_at(const input::Window& window, const std::vector<PictureTool>& tools) {
  const Vec2 moved = window.follow ? tools[*window.follow].displacement : Vec2(0, 0);
  return {window.lower + moved, window.upper + moved};
}

/// What the pictures of one time are drawn from, while the run goes on.
struct PictureRecorder::Kept {
  CellGeometry<2> cells;
  Fields<2> position;
  std::deque<Field> values;
  CellRasters rasters;

  Kept(CellGeometry<2> of_cells, Fields<2> at) : cells(std::move(of_cells)), position(std::move(at)) {}
  std::size_t bytes() const {
    return sizeof(double) * (4 * cells.vertex.size() + 2 * cells.vertex_weight.size() +
                             (2 + values.size()) * position[0].size());
  }
};

Picture PictureRecorder::picture_of(const results::Snapshot<2>& shot, const std::string& field, Kept& kept,
                                    Field values) const {
  const FieldInfo<2>& info = field_info<2>(field);
  Picture picture;
  picture.cells = &kept.cells;
  picture.rasters = &kept.rasters;
  picture.position = spans(kept.position);
  picture.value = kept.values.emplace_back(std::move(values));
  show_field(picture, info.shown);
  picture.title = case_->title;
  picture.time = shot.state.time;
  if (field == "temperature") picture.warm_tools = results::tool_frame(shot, {0, 0, 0});
  const auto& contact = shot.contact;
  for (std::size_t t = 0; t < contact.tools().size(); ++t)
    picture.tools.push_back(
        {&case_->tools[t].outline, contact.displacement(t, shot.state.time), case_->tools[t].name});
  return picture;
}

std::string PictureRecorder::draw(results::FileQueue& files, const std::shared_ptr<const Kept>& kept,
                                  const Picture& picture, const std::string& key, const std::string& caption,
                                  const std::string& note) {
  return album_.add(
      files, key, {.field = picture.label, .time = picture.time, .caption = caption, .note = note},
      [kept, picture] { return draw_png(picture); },
      kept->bytes() / 2); // shared with the others of its time
}

std::string PictureRecorder::note_of(double time, const std::string& field) const {
  for (const input::PictureNote& note : case_->output.notes)
    if (note.field == field && std::abs(note.at - time) <= 1e-9 * case_->time.end) return note.text;
  return "";
}

void PictureRecorder::record(results::FileQueue& files, const results::Snapshot<2>& shot) {
  const auto kept = std::make_shared<Kept>(shot.approximation.cells, shot.state.node.position);
  Fields<2>& drawn = kept->position;
  if (shot.displacement_scale != 1.0)
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t i = 0; i < drawn[k].size(); ++i) {
        const double start = shot.state.node.initial_position[k][i];
        drawn[k][i] = start + shot.displacement_scale * (drawn[k][i] - start);
      }
  std::vector<Picture> pictures;
  for (const std::string& name : case_->output.picture_fields)
    pictures.push_back(picture_of(shot, name, *kept, results::values_at_points(shot, name)));
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    const std::string& name = case_->output.picture_fields[k];
    const std::string note = note_of(shot.state.time, name);
    draw(files, kept, pictures[k], name, "", note);
    for (const input::Window& window : case_->output.windows) {
      pictures[k].window = window_at(window, pictures[k].tools);
      draw(files, kept, pictures[k], name + "_" + window.name, window.name, note);
    }
  }
}

std::string PictureRecorder::record_place(results::FileQueue& files, const results::Snapshot<2>& shot,
                                          const Vec2& centre, double radius) {
  const NodeState<2>& node = shot.state.node;
  const auto kept = std::make_shared<Kept>(shot.approximation.cells, node.position);
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < node.size(); ++i)
      if (!std::isfinite(kept->position[k][i])) kept->position[k][i] = node.reference[k][i];
  Field values = results::values_at_points(shot, "plastic_strain");
  for (double& value : values)
    if (!std::isfinite(value)) value = 0.0;
  Picture picture = picture_of(shot, "plastic_strain", *kept, std::move(values));
  picture.window = PictureWindow{centre.array() - radius, centre.array() + radius};
  picture.edges = true;
  return draw(files, kept, picture, "post_mortem", "where it went wrong");
}

} // namespace cnem::report
