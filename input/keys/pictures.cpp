// How pictures are drawn.
#include "input/case.hpp"
#include "input/keys/keys.hpp"
#include "mechanics/field_catalogue.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::input {

void add_pictures(Keys& k) {
  namespace d = dimension;
  using enum Type;
  k.add("output.pictures", quantities,
        "Times of the pictures in the report, which `fields.pvd` has too; those beyond `time.end` are "
        "skipped.")
      .unit(d::time)
      .in({.low = 0.0})
      .example("\"2 4 5 12 us\"")
      .computed("`time.end`");
  k.add("output.pictures_every", quantity, "Time between further pictures, from 0 on.")
      .unit(d::time)
      .in(positive)
      .example("\"10 us\"");
  k.add("output.picture_fields", choices, "Fields drawn.")
      .one_of(field_names(2))
      .in_space_one_of(field_names(3))
      .or_empty()
      .computed(
          "`[\"plastic_strain\", \"temperature\", \"pressure\"]`, without temperature where no heat is "
          "solved for; `[\"temperature\"]` where heat is alone; `[\"equivalent_stress\", \"displacement_x\", "
          "\"displacement_y\"]` in static analyses, in space with `\"displacement_z\"`");
  k.add("output.drawing", table, "How pictures are drawn.").always();
  k.add("output.drawing.mirror", boolean,
        "Draw halves and quarters whole: mirrored behind straight pieces with `symmetry` and the axis of a "
        "body "
        "of revolution.")
      .fallback("false");
  k.add("output.drawing.common", boolean,
        "All times of a field have one range of colours and show one part of space, so that they compare. "
        "Otherwise each picture has its own.")
      .fallback("true");
  k.add("output.drawing.percentile", quantity,
        "Share of the cells, in per cent, that the colours span from the least value on, of fields with a "
        "sign "
        "by magnitude about zero: a few cells far above the others then hide nothing. Pictures say it.")
      .in({.low = 50.0, .high = 100.0})
      .example("99")
      .computed("100, of fields with a sign 99.9");
  k.add("output.drawing.view", vectors, "Two opposite corners of what pictures of the whole show.")
      .unit(d::length)
      .example("[\"0 0 mm\", \"6 10 mm\"]")
      .computed("the body at all times, and a part of the tools");
  k.add("output.drawing.eye", vector, "From where a body in space is seen: from it towards the eye.")
      .fallback("\"1 -1.6 1\"");
  k.add("output.sections", named_tables,
        "Planes that pictures of a body in space are cut by, beside the whole.");
  k.add("output.sections.*", table, "A plane.");
  k.add("output.sections.*.at", vector, "A point of it.").unit(d::length).required().example("\"0 0 0 mm\"");
  k.add("output.sections.*.normal", vector, "Its normal, towards the eye; of any length.")
      .required()
      .example("\"0 -1 0\"");
  k.add("output.ranges", table, "What the colours of a field span, in its unit, in place of its values.");
  const auto add_range = [&](const auto& info) {
    const std::string path = "output.ranges." + info.name;
    if (std::ranges::find(k.all, path, &Key::path) != k.all.end()) return;
    k.add(path, quantities, fmt::format("Of the {}.", info.shown.label))
        .unit(info.unit.empty() ? d::none : parse_unit(info.unit).dimension)
        .example(info.unit.empty() ? "\"0 1\"" : fmt::format("\"0 1 {}\"", info.unit));
  };
  for (const FieldInfo<2>& info : field_catalogue<2>()) add_range(info);
  for (const FieldInfo<3>& info : field_catalogue<3>()) add_range(info);
}

} // namespace cnem::input
