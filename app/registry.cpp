#include "app/registry.hpp"

#include "app/bodies.hpp"
#include "clouds/generate.hpp"
#include "contact/curve_shape.hpp"
#include "methods/registry.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::app {

namespace {

clouds::DomainShape domain_shape(const input::Domain& domain) {
  clouds::DomainShape shape;
  shape.outer = domain.outer;
  for (const input::Hole& hole : domain.holes) shape.holes.push_back(hole.outline);
  for (const input::Crack& crack : domain.cracks) shape.cracks.push_back({crack.name, crack.points});
  for (const input::Interface& face : domain.interfaces) shape.cracks.push_back({face.name, face.points});
  return shape;
}

clouds::SpacingField spacing_field(const input::CloudSpec& spec) {
  clouds::SpacingField field;
  field.spacing = spec.spacing;
  for (const input::Refinement& refine : spec.refine) {
    clouds::Refinement region;
    region.spacing = refine.spacing;
    region.growth = refine.growth;
    for (const Vec2& tip : refine.tips) {
      region.points = {tip};
      field.refinements.push_back(region);
    }
    if (!refine.tips.empty()) continue;
    if (refine.box) {
      region.region = clouds::Refinement::Region::box;
      region.points = {(*refine.box)[0], (*refine.box)[1]};
    } else {
      region.points = refine.points;
    }
    field.refinements.push_back(std::move(region));
  }
  return field;
}

clouds::CloudOptions cloud_options(const input::CloudSpec& spec) {
  clouds::CloudOptions options;
  switch (spec.pattern) {
  case input::CloudSpec::Pattern::hexagonal:
    options.pattern = clouds::Pattern::hexagonal;
    break;
  case input::CloudSpec::Pattern::regular:
    options.pattern = clouds::Pattern::regular;
    break;
  case input::CloudSpec::Pattern::jittered:
    options.pattern = clouds::Pattern::jittered;
    break;
  case input::CloudSpec::Pattern::list:
    options.pattern = clouds::Pattern::list;
    break;
  }
  options.jitter = spec.jitter;
  options.seed = spec.seed;
  options.nodes = spec.nodes;
  return options;
}

plasticity::Material make_material(const input::Material& spec) {
  plasticity::Material material;
  material.name = spec.name;
  material.density = spec.density;
  material.elasticity = {spec.young, spec.poisson};
  if (const auto* perfect = std::get_if<input::PerfectPlasticity>(&spec.plastic)) {
    material.hardening = plasticity::JohnsonCook{.A = perfect->yield};
  } else if (const auto* linear = std::get_if<input::LinearHardening>(&spec.plastic)) {
    material.hardening = plasticity::JohnsonCook{.A = linear->yield, .B = linear->hardening};
  } else if (const auto* voce = std::get_if<input::Voce>(&spec.plastic)) {
    material.hardening = plasticity::JohnsonCook{.A = voce->yield,
                                                 .B = voce->hardening,
                                                 .saturation = voce->saturation - voce->yield,
                                                 .saturation_exponent = voce->exponent};
  } else if (const auto* jc = std::get_if<input::JohnsonCook>(&spec.plastic)) {
    material.hardening = plasticity::JohnsonCook{.A = jc->A,
                                                 .B = jc->B,
                                                 .n = jc->n,
                                                 .C = jc->C,
                                                 .rate0 = jc->rate0,
                                                 .m = jc->m,
                                                 .T0 = jc->T0,
                                                 .Tmelt = jc->Tmelt};
  }
  if (spec.damage)
    material.damage = plasticity::JohnsonCookDamage{.D1 = spec.damage->D1,
                                                    .D2 = spec.damage->D2,
                                                    .D3 = spec.damage->D3,
                                                    .D4 = spec.damage->D4,
                                                    .D5 = spec.damage->D5,
                                                    .rate0 = spec.damage->rate0,
                                                    .T0 = spec.damage->T0,
                                                    .Tmelt = spec.damage->Tmelt,
                                                    .cut_off = spec.damage->cut_off,
                                                    .fracture_energy = spec.damage->fracture_energy,
                                                    .band = spec.damage->band,
                                                    .residual_strength = spec.damage->residual_strength};
  if (spec.heat) {
    material.specific_heat = spec.heat->specific_heat;
    material.conductivity = spec.heat->conductivity;
    material.taylor_quinney = spec.heat->taylor_quinney;
    material.expansion = spec.heat->expansion;
    material.expansion_reference = spec.heat->reference_temperature;
  }
  return material;
}

/// The materials in use and which node is of which. region: as region_of_nodes gives it.
void set_materials(const input::Case& input, const std::vector<std::int32_t>& region, Model<2>& model) {
  std::vector<std::string> names;
  const auto index_of = [&](const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      names.push_back(name);
      model.materials.push_back(make_material(input.material(name)));
    }
    return static_cast<std::int32_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const std::int32_t everywhere = index_of(input.domain.material);
  std::vector<std::int32_t> of_region;
  for (const input::Region& part : input.domain.regions) of_region.push_back(index_of(part.material));
  if (model.materials.size() == 1) return;
  for (const std::int32_t r : region)
    model.node_material.push_back(r < 0 ? everywhere : of_region[static_cast<std::size_t>(r)]);
}

struct Conditions {
  std::vector<Support<2>> supports;
  std::vector<Traction<2>> tractions;
  std::vector<Pressure<2>> pressures;
  std::vector<FixedTemperature> temperatures;
  std::vector<HeatFlux<2>> fluxes;
  std::vector<Convection<2>> convections;
};

/// The nodes nearest to the points of a condition.
std::vector<std::int32_t> nodes_at(const input::Case& input, const input::BoundaryCondition& spec,
                                   const Cloud<2>& cloud) {
  std::vector<std::int32_t> nodes;
  for (const Vec2& point : spec.points) {
    std::int32_t best = 0;
    const auto distance = [&](std::int32_t i) {
      return (cloud.position[static_cast<std::size_t>(i)] - point).norm();
    };
    for (std::int32_t i = 1; i < cloud.nodes(); ++i)
      if (distance(i) < distance(best)) best = i;
    if (input.cloud.spacing > 0.0 && distance(best) > input.cloud.spacing)
      throw input.error(
          "boundary." + spec.name + ".points",
          fmt::format("found ({:g}, {:g}) m, expected a point of the workpiece: the nearest node "
                      "is {:.3g} m away",
                      point.x(), point.y(), distance(best)));
    nodes.push_back(best);
  }
  return nodes;
}

void add_condition(const input::Case& input, const input::BoundaryCondition& spec, const Cloud<2>& cloud,
                   Conditions& all) {
  const std::vector<Facet<2>> facets = facets_of(cloud, spec.pieces);
  std::vector<std::int32_t> nodes = nodes_of(facets);
  for (const std::int32_t node : nodes_at(input, spec, cloud))
    if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
  const std::vector<std::int32_t> pieces = pieces_of(std::span<const Facet<2>>(facets));
  using Kind = Support<2>::Kind;
  if (spec.symmetry) {
    // One plane per straight piece: pieces of one condition may face different ways.
    for (const std::string& piece : spec.pieces) {
      const std::vector<Facet<2>> straight = facets_of(cloud, {piece});
      if (straight.empty()) continue;
      const Vec2 edge = cloud.position[static_cast<std::size_t>(straight.front().node[1])] -
                        cloud.position[static_cast<std::size_t>(straight.front().node[0])];
      all.supports.push_back({spec.name,
                              Kind::symmetry,
                              right_normal(edge).normalized(),
                              {},
                              nodes_of(straight),
                              pieces_of(std::span<const Facet<2>>(straight))});
    }
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec2 direction = k == 0 ? Vec2(1, 0) : Vec2(0, 1);
    if (spec.velocity[k])
      all.supports.push_back({spec.name, Kind::velocity, direction, *spec.velocity[k], nodes, pieces});
    if (spec.displacement[k])
      all.supports.push_back(
          {spec.name, Kind::displacement, direction, *spec.displacement[k], nodes, pieces});
  }
  if (spec.traction[0] || spec.traction[1])
    all.tractions.push_back({spec.name,
                             {spec.traction[0].value_or(TimeTable()), spec.traction[1].value_or(TimeTable())},
                             facets});
  if (spec.pressure) all.pressures.push_back({spec.name, *spec.pressure, facets});
  if (spec.temperature) all.temperatures.push_back({spec.name, *spec.temperature, nodes, pieces});
  if (spec.heat_flux) all.fluxes.push_back({spec.name, *spec.heat_flux, facets});
  if (spec.convection)
    all.convections.push_back(
        {spec.name, TimeTable(spec.convection->coefficient), spec.convection->ambient, facets});
}

/// Nodes on the axis of revolution stay on it. Throws InputError when the workpiece reaches beyond the axis.
void hold_axis(const input::Case& input, Cloud<2>& cloud, std::vector<Support<2>>& supports,
               std::vector<std::string>& warnings) {
  double size = 0.0;
  for (const Vec2& x : cloud.position) size = std::max(size, x.norm());
  std::vector<std::int32_t> axis;
  for (std::int32_t i = 0; i < cloud.nodes(); ++i) {
    double& r = cloud.position[static_cast<std::size_t>(i)].x();
    if (std::abs(r) <= 1e-12 * size) {
      r = 0.0;
      axis.push_back(i);
    } else if (r < 0.0) {
      throw input.error("domain",
                        fmt::format("found a workpiece that reaches to x = {:.6g} m, expected x >= 0: an "
                                    "axisymmetric body turns about x = 0",
                                    r));
    }
  }
  for (const Support<2>& support : supports) {
    const auto& values = support.value.values();
    const bool moves = support.direction.x() != 0.0 &&
                       std::any_of(values.begin(), values.end(), [](double v) { return v != 0.0; });
    if (moves && std::any_of(support.nodes.begin(), support.nodes.end(),
                             [&](std::int32_t i) { return std::binary_search(axis.begin(), axis.end(), i); }))
      warnings.push_back(fmt::format("boundary.{} moves nodes on the axis along x, where the axis holds them",
                                     support.name));
  }
  if (!axis.empty())
    supports.insert(supports.begin(),
                    {"axis", Support<2>::Kind::symmetry, Vec2(-1, 0), {}, std::move(axis), {}});
}

contact::Friction make_friction(const input::Friction& spec) {
  contact::Friction friction;
  if (spec.law != input::Friction::Law::none) friction.coulomb = spec.coefficient;
  if (spec.law == input::Friction::Law::tresca_limited) friction.shear_factor = spec.shear_factor;
  return friction;
}

contact::Tool<2> make_tool(const input::Case& input, const input::Tool& spec) {
  contact::Tool<2> tool;
  tool.name = spec.name;
  try {
    tool.shape = std::make_shared<contact::CurveShape>(spec.outline);
  } catch (const InputError& error) { throw input.error("tools." + spec.name, error.what()); }
  tool.motion.velocity = spec.velocity;
  tool.friction = make_friction(spec.friction);
  if (spec.drive) {
    contact::ToolDrive<2>& drive = tool.drive.emplace();
    drive.mass = spec.drive->mass;
    drive.force = spec.drive->force;
    drive.initial_velocity = spec.drive->initial_velocity;
    if (spec.drive->direction) drive.free = *spec.drive->direction * spec.drive->direction->transpose();
  }
  if (spec.heat) {
    tool.thermal.conductance = spec.heat->conductance;
    tool.thermal.temperature = spec.heat->temperature;
    tool.thermal.effusivity = spec.heat->effusivity.value_or(0.0);
  }
  return tool;
}

} // namespace

Setup build(const input::Case& input) {
  clouds::GeneratedCloud generated;
  try {
    generated = clouds::generate_cloud(domain_shape(input.domain), spacing_field(input.cloud),
                                       cloud_options(input.cloud));
  } catch (const clouds::SpacingError& error) {
    throw input.error("cloud.spacing", error.what());
  } catch (const GeometryError& error) {
    const bool list = input.cloud.pattern == input::CloudSpec::Pattern::list;
    throw input.error(list ? "cloud.nodes" : "domain", error.what());
  }
  std::vector<contact::Tool<2>> tools;
  for (const input::Tool& tool : input.tools) tools.push_back(make_tool(input, tool));
  Setup setup;
  setup.warnings = input.warnings;
  setup.warnings.insert(setup.warnings.end(), generated.warnings.begin(), generated.warnings.end());
  Model<2>& model = setup.model;
  const Space space = input.analysis.space();
  model.contact = contact::RigidContact<2>(
      std::move(tools), space,
      {input.contact.deformable, make_friction(input.contact.friction), input.contact.conductance});
  model.cloud = std::move(generated.cloud);
  model.method = methods::make(input.method.name, input.method.options);
  const std::vector<std::int32_t> region = region_of_nodes(input, model.cloud);
  set_materials(input, region, model);
  model.strength = strength(input, model.cloud);
  const Pairs pairs = tied_pairs(input, model.cloud);
  model.ties = Ties<2>(pairs.motion, model.cloud.position);
  model.heat_ties = Ties<2>(pairs.heat, model.cloud.position);
  model.stabilisation = input.method.stabilisation;
  model.pressure_exchange = input.method.pressure_exchange;
  model.viscosity = {input.method.viscosity_quadratic, input.method.viscosity_linear};
  model.thermal = input.analysis.thermal;
  model.mechanical = input.analysis.mechanical;
  model.safety = input.time.safety;
  model.local.on = input.time.local;
  model.local.levels = input.time.levels;
  if (const auto& scaling = input.time.mass_scaling)
    model.mass_scaling = {scaling->factor.value_or(1.0), scaling->step.value_or(0.0)};

  Conditions all;
  for (const input::BoundaryCondition& condition : input.boundary)
    add_condition(input, condition, model.cloud, all);
  if (space == Space::revolution) hold_axis(input, model.cloud, all.supports, setup.warnings);
  // What holds one node of a tie holds them all.
  for (Support<2>& support : all.supports) support.nodes = model.ties.with_partners(std::move(support.nodes));
  for (FixedTemperature& fixed : all.temperatures)
    fixed.nodes = model.heat_ties.with_partners(std::move(fixed.nodes));
  const auto nodes = static_cast<std::size_t>(model.cloud.nodes());
  try {
    model.supports = Supports<2>(std::move(all.supports), nodes);
  } catch (const InputError& error) { throw input.error("boundary", error.what()); }
  std::array<TimeTable, 2> acceleration;
  for (std::size_t k = 0; k < 2; ++k) acceleration[k] = input.loads.body_force[k].value_or(TimeTable());
  model.loads =
      Loads<2>(std::move(all.tractions), std::move(all.pressures), acceleration, model.cloud.position, space);
  model.heat_boundaries =
      ThermalBoundaries<2>(std::move(all.temperatures), std::move(all.fluxes), std::move(all.convections),
                           space, conductances(input, model.cloud));

  set_initial_state(input, model.cloud, region, setup.velocity, setup.temperature);
  for (std::string& warning : setup.warnings) warning = input.placed(warning);
  return setup;
}

} // namespace cnem::app
