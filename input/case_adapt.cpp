// Adaptation, and what it cannot be combined with.
#include "input/case_parts.hpp"
#include "mechanics/field_catalogue.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::input {

namespace {

/// What the plane alone has.
void read_plane(const Setting& table, Adaptation& rules) {
  rules.cracks = table.get<bool>("cracks");
  rules.thinnest_film = table.get<double>("thinnest_film");
  rules.placement = table.choice<adapt::Placement>("placement");
  rules.surface_spacing = table.maybe<double>("surface_spacing");
  rules.rest_factor = table.get<double>("rest_factor");
}

void read_indicator(const Setting& table, Adaptation& rules) {
  rules.growth = table.get<double>("growth");
  rules.indicator = adapt::indicated_field(table.get<std::string>("indicator.field"));
  rules.tolerance = table.get<double>("indicator.tolerance");
  rules.coarsen = table.get<double>("indicator.coarsen");
  rules.h_min = table.maybe<double>("indicator.h_min").value_or(0.0);
  rules.h_max = table.maybe<double>("indicator.h_max").value_or(0.0);
  rules.max_nodes = table.get<std::int64_t>("indicator.max_nodes");
}

} // namespace

void read_adaptation(Setting& root, Case& result, Diagnostics& diagnostics) {
  if (result.cloud.spacing > 0.0) {
    root.set_default("adapt.indicator.h_min", 0.25 * result.cloud.spacing);
    root.set_default("adapt.indicator.h_max", result.cloud.spacing);
  }
  const Setting& table = *root.find("adapt");
  Adaptation& rules = result.adapt;
  rules.resample = table.get<bool>("resample");
  rules.separate = table.get<bool>("separate");
  rules.tool_spacing = table.maybe<double>("tool_spacing");
  rules.quiet_every = static_cast<int>(table.get<std::int64_t>("quiet_every"));
  if (result.analysis.dimensions() == 2) read_plane(table, rules);
  read_indicator(table, rules);

  using Needs = adapt::IndicatedField::Needs;
  const bool refines = rules.indicator != nullptr;
  const Needs needs = refines ? rules.indicator->needs : Needs::nothing;
  const auto conflict = [&](std::string_view path, const std::string& why) {
    const Setting* key = root.find(path);
    if (key) diagnostics.add(Mistake::conflict, key->where, key->path, why);
  };
  const auto flat = [](const Tool& tool) { return tool.solid->shape == ToolSolid::Shape::half_space; };
  if (rules.tool_spacing && result.analysis.dimensions() == 3 &&
      std::all_of(result.tools.begin(), result.tools.end(), flat))
    conflict("adapt.tool_spacing",
             "found a spacing at tools none of which has an edge, expected a tool of another "
             "shape than \"half-space\"");
  const bool damage =
      std::any_of(result.materials.begin(), result.materials.end(),
                  [](const plasticity::Material& material) { return material.damage.has_value(); });
  if (needs == Needs::damage && !damage)
    conflict("adapt.indicator.field",
             fmt::format("found \"{}\" where no material has a damage law, expected materials.NAME.damage",
                         rules.indicator->name));
  const bool failure =
      std::any_of(result.materials.begin(), result.materials.end(),
                  [](const plasticity::Material& material) { return material.failure.has_value(); });
  if (rules.separate && !damage && !failure)
    conflict("adapt.separate",
             "found true where no material has a damage law, expected materials.NAME.damage, or failure of a "
             "ply: nothing would ever break");
  if (rules.separate && !result.contact.active)
    conflict("adapt.separate",
             "found true without contact.deformable, expected contact.deformable = true: the new faces would "
             "go through each other");
  if (rules.cracks && !rules.separate)
    conflict("adapt.cracks",
             "found true where adapt.separate is false, expected true: cracks are a part of separation");
  if (rules.thinnest_film > 0.0 && !rules.separate)
    conflict("adapt.thinnest_film",
             "found a thickness where adapt.separate is false, expected true: films are cut by separation");
  const std::vector<std::string> pieces = result.domain.piece_names();
  if (rules.separate && std::find(pieces.begin(), pieces.end(), Adaptation::fracture_piece) != pieces.end())
    conflict("adapt.separate",
             fmt::format("found true in a domain with a piece \"{0}\", expected another name for it: the "
                         "faces that separation makes are the piece \"{0}\"",
                         Adaptation::fracture_piece));
  if (!rules.resample) {
    if (rules.separate)
      conflict("adapt.separate",
               "found true where adapt.resample is false, expected true: the cloud is cut at new "
               "references alone");
    if (refines)
      conflict("adapt.indicator.field",
               "found an indicator where adapt.resample is false, expected true: without "
               "resampling no node is added");
    if (rules.quiet_every > 0)
      conflict(
          "adapt.quiet_every",
          "found an interval between passes where adapt.resample is false, expected true: there are none");
    if (rules.tool_spacing)
      conflict(
          "adapt.tool_spacing",
          "found a spacing at tools where adapt.resample is false, expected true: without resampling no node "
          "is added");
    if (rules.surface_spacing)
      conflict("adapt.surface_spacing",
               "found a spacing of surfaces where adapt.resample is false, expected true: without resampling "
               "no node is added");
    if (rules.rest_factor > 0.0)
      conflict("adapt.rest_factor",
               "found a spacing of matter at rest where adapt.resample is false, expected true: without "
               "resampling no node is removed");
    for (const FieldInfo<2>& field : field_catalogue<2>())
      if (field.adaptive &&
          std::find(result.output.picture_fields.begin(), result.output.picture_fields.end(), field.name) !=
              result.output.picture_fields.end())
        conflict("output.picture_fields",
                 fmt::format(
                     "found \"{}\" where adapt.resample is false, expected fields of the material: the cloud "
                     "is not adapted",
                     field.name));
    return;
  }
  if (const int every = result.method.rereference_every; rules.quiet_every > 0 && rules.quiet_every < every)
    conflict("adapt.quiet_every",
             fmt::format("found {} steps, expected at least method.rereference.every = {}: it is where the "
                         "interval begins",
                         rules.quiet_every, every));
  if (rules.quiet_every > 0 && result.method.rereference_every == 0)
    conflict("adapt.quiet_every",
             "found an interval where method.rereference.every is 0, expected steps there: "
             "passes do not come by count");
  if (const Setting* least = table.find("indicator.h_min"); refines && least && !(rules.h_min < rules.h_max))
    diagnostics.add(Mistake::range, least->where, least->path,
                    fmt::format("found {:g} m, expected less than adapt.indicator.h_max = {:g} m",
                                rules.h_min, rules.h_max));
  if (needs == Needs::heat && !result.analysis.thermal)
    conflict("adapt.indicator.field",
             fmt::format("found \"{}\" in an analysis without heat, expected it with analysis.thermal = true",
                         rules.indicator->name));
}

} // namespace cnem::input
