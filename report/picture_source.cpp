#include "report/picture_source.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "report/symmetry.hpp"
#include "results/fields.hpp"
#include "results/output_folder.hpp"
#include "results/tool_fields.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::report {
namespace fs = std::filesystem;
namespace {

constexpr const char* of_tools = "temperature [K]";

/// Cells as their file gives them back, places counted from the origin: without values.
results::CellFields as_written(const CellGeometry<2>& cells,
                               const std::array<std::span<const double>, 2>& position, const Vec2& origin) {
  results::CellFields fields;
  fields.cells.begin = cells.begin;
  fields.cells.index = cells.index;
  fields.cells.vertex_begin.push_back(0);
  for (const Vec2& x : results::moved_vertices<2>(cells, position)) {
    const auto v = as<std::int32_t>(fields.cells.vertex.size());
    const Vec2 written = origin + x;
    fields.cells.vertex.push_back(written - origin);
    fields.cells.vertex_node.push_back(as<NodeIndex>(v));
    fields.cells.vertex_weight.push_back(1.0);
    fields.cells.vertex_begin.push_back(v + 1);
    for (std::size_t k = 0; k < 2; ++k) fields.position[k].push_back(fields.cells.vertex.back()[as<int>(k)]);
  }
  return fields;
}

void mirror(PictureSource& source) {
  for (const SymmetryLine& line : source.symmetry) {
    std::vector<double> sign;
    for (const std::string& name : source.names) sign.push_back(image_sign(field_info<2>(name), line));
    add_image(source.fields, line, sign);
    if (source.warm_tools) {
      keep_side(*source.warm_tools, line);
      add_image(*source.warm_tools, line, {1.0});
    }
    const SymmetryLine other{line.at, -line.normal};
    for (std::size_t t = 0, count = source.tools.size(); t < count; ++t) {
      PictureTool image = source.tools[t];
      source.tools[t].kept.push_back(line);
      const Curve& curve = source.images.emplace_back(image.curve->mirrored(line.at, line.normal));
      image.curve = &curve;
      image.displacement = mirrored(image.displacement, Vec2(0, 0), line.normal);
      for (SymmetryLine& kept : image.kept) kept.at = mirrored(kept.at, line.at, line.normal);
      image.kept.push_back(other);
      image.name.clear();
      source.tools.push_back(std::move(image));
    }
  }
}

void add_symmetry(const input::Case& input, PictureSource& source) {
  source.symmetry = symmetry_lines(input);
  if (input.output.drawing.mirror) mirror(source);
}

} // namespace

std::size_t PictureSource::bytes() const {
  return sizeof(double) * (6 * fields.cells.vertex.size() + fields.values.size() * fields.cells.begin.size());
}

template<int dim> Fields<dim> drawn_positions(const results::Snapshot<dim>& shot) {
  Fields<dim> drawn = shot.state.node.position;
  if (shot.displacement_scale != 1.0)
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = 0; i < drawn[k].size(); ++i) {
        const double start = shot.state.node.initial_position[k][i];
        drawn[k][i] = start + shot.displacement_scale * (drawn[k][i] - start);
      }
  return drawn;
}

template Fields<2> drawn_positions<2>(const results::Snapshot<2>&);
template Fields<3> drawn_positions<3>(const results::Snapshot<3>&);

std::string note_of_scale(double displacement_scale) {
  if (displacement_scale == 1.0) return "";
  return fmt::format("Displacements are drawn {:.3g} times as large as they are.", displacement_scale);
}

std::shared_ptr<PictureSource> picture_source(const input::Case& input, const results::Snapshot<2>& shot,
                                              const Fields<2>& position,
                                              const std::vector<std::string>& names) {
  const auto source = std::make_shared<PictureSource>();
  const Vec2 origin = input.origin.head<2>();
  source->time = shot.state.time;
  source->names = names;
  source->fields = as_written(shot.approximation.cells, {position[0], position[1]}, origin);
  for (const std::string& name : names)
    source->fields.values.push_back(results::values_at_points(shot, name));
  if (const auto frame = results::tool_frame(shot, input.origin)) {
    source->warm_tools = as_written(*frame->cells, frame->position, origin);
    const std::span<const double> temperature = frame->cell_scalars.front().values;
    source->warm_tools->values.emplace_back(temperature.begin(), temperature.end());
  }
  for (std::size_t t = 0; t < shot.contact.tools().size(); ++t)
    source->tools.push_back(
        {&input.tools[t].outline, shot.contact.displacement(t, shot.state.time), input.tools[t].name});
  add_symmetry(input, *source);
  return source;
}

std::shared_ptr<PictureSource> picture_source(const input::Case& input, const fs::path& folder,
                                              const results::FieldFiles& files,
                                              const std::vector<std::string>& names) {
  const auto source = std::make_shared<PictureSource>();
  const Vec2 origin = input.origin.head<2>();
  source->time = files.time;
  source->names = names;
  std::vector<results::FileArray> arrays;
  for (const std::string& name : names) arrays.push_back(results::array_in_files(field_info<2>(name)));
  source->fields = results::read_cell_fields(folder / files.cells, arrays, origin);
  if (fs::exists(folder / results::files::tool_fields))
    for (const results::FieldFiles& of_time : results::read_field_series(folder, results::files::tool_fields))
      if (of_time.time == files.time)
        source->warm_tools = results::read_cell_fields(folder / of_time.cells, {{of_tools}}, origin);
  if (files.parts.size() < input.tools.size())
    throw IoError(fmt::format(
        "{} has the outlines of {} tools at t = {:g} s, expected {}: it was written by an older "
        "version, run the case again",
        (folder / results::files::fields).string(), files.parts.size(), files.time, input.tools.size()));
  for (std::size_t t = 0; t < input.tools.size(); ++t)
    source->tools.push_back({&input.tools[t].outline,
                             results::read_tool_displacement(folder / files.parts[t].file),
                             files.parts[t].name});
  add_symmetry(input, *source);
  return source;
}

Picture picture_of(const input::Case& input, PictureSource& source, std::size_t field) {
  Picture picture;
  picture.cells = &source.fields.cells;
  picture.rasters = &source.rasters;
  picture.position = {source.fields.position[0], source.fields.position[1]};
  picture.value = source.fields.values[field];
  show_field(picture, field_info<2>(source.names[field]).shown, results::ShownUnits(input.report.units));
  picture.title = input.title;
  picture.time = source.time;
  picture.tools = source.tools;
  picture.symmetry = source.symmetry;
  if (source.names[field] == "temperature" && source.warm_tools) picture.warm_tools = &*source.warm_tools;
  if (!input.output.drawing.ranges.contains(source.names[field]))
    picture.percentile = input.output.drawing.percentile;
  return picture;
}

ColourRange own_span(const input::Case& input, const std::string& field, const Picture& picture) {
  const input::Drawing& drawing = input.output.drawing;
  if (const auto given = drawing.ranges.find(field); given != drawing.ranges.end())
    return {given->second[0], given->second[1]};
  return value_span(picture.map, picture.value, drawing.percentile.value_or(usual_percentile(picture.map)));
}

} // namespace cnem::report
