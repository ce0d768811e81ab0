#include "app/registry.hpp"
#include "core/index.hpp"

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
  shape.cracks.insert(shape.cracks.end(), domain.cracks.begin(), domain.cracks.end());
  shape.cracks.insert(shape.cracks.end(), domain.interfaces.begin(), domain.interfaces.end());
  return shape;
}

/// The materials in use and which node is of which. region: as region_of_nodes gives it.
void set_materials(const input::Case& input, const std::vector<std::int32_t>& region, Problem<2>& model) {
  std::vector<std::string> names;
  const auto number_of = [&](const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      names.push_back(name);
      model.materials.push_back(input.material(name));
    }
    return static_cast<std::int32_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const std::int32_t everywhere = number_of(input.domain.material);
  std::vector<std::int32_t> of_region;
  for (const input::Region& part : input.domain.regions) of_region.push_back(number_of(part.material));
  if (model.materials.size() == 1) return;
  for (const std::int32_t r : region)
    model.node_material.push_back(r < 0 ? everywhere : of_region[index_of(r)]);
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
    const auto distance = [&](std::int32_t i) { return (cloud.position[index_of(i)] - point).norm(); };
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
      const Vec2 edge = cloud.position[index_of(straight.front().node[1])] -
                        cloud.position[index_of(straight.front().node[0])];
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
  if (spec.convection) {
    all.convections.push_back(*spec.convection);
    all.convections.back().facets = facets;
  }
}

/// Nodes on the axis of revolution stay on it. Throws InputError when the workpiece reaches beyond the axis.
void hold_axis(const input::Case& input, Cloud<2>& cloud, std::vector<Support<2>>& supports,
               std::vector<std::string>& warnings) {
  double size = 0.0;
  for (const Vec2& x : cloud.position) size = std::max(size, x.norm());
  std::vector<std::int32_t> axis;
  for (std::int32_t i = 0; i < cloud.nodes(); ++i) {
    double& r = cloud.position[index_of(i)].x();
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

contact::Tool<2> make_tool(const input::Case& input, const input::Tool& spec) {
  contact::Tool<2> tool = spec;
  try {
    tool.shape = std::make_shared<contact::CurveShape>(spec.outline);
  } catch (const InputError& error) { throw input.error("tools." + spec.name, error.what()); }
  return tool;
}

} // namespace

Setup build(const input::Case& input) {
  clouds::GeneratedCloud generated;
  try {
    generated = clouds::generate_cloud(domain_shape(input.domain), input.cloud, input.cloud);
  } catch (const clouds::SpacingError& error) {
    throw input.error("cloud.spacing", error.what());
  } catch (const GeometryError& error) {
    const bool list = input.cloud.pattern == clouds::Pattern::list;
    throw input.error(list ? "cloud.nodes" : "domain", error.what());
  }
  std::vector<contact::Tool<2>> tools;
  for (const input::Tool& tool : input.tools) tools.push_back(make_tool(input, tool));
  Setup setup;
  setup.warnings = input.warnings;
  setup.warnings.insert(setup.warnings.end(), generated.warnings.begin(), generated.warnings.end());
  Problem<2>& model = setup.problem;
  const Space space = input.analysis.space();
  model.contact = contact::RigidContact<2>(std::move(tools), space, input.contact);
  model.cloud = std::move(generated.cloud);
  model.method = methods::make<2>(input.method.name, input.method.options);
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
  model.local = input.time.local;
  model.mass_scaling = input.time.mass_scaling.value_or(MassScaling{});

  Conditions all;
  for (const input::BoundaryCondition& condition : input.boundary)
    add_condition(input, condition, model.cloud, all);
  if (space == Space::revolution) hold_axis(input, model.cloud, all.supports, setup.warnings);
  // What holds one node of a tie holds them all.
  for (Support<2>& support : all.supports) support.nodes = model.ties.with_partners(std::move(support.nodes));
  for (FixedTemperature& fixed : all.temperatures)
    fixed.nodes = model.heat_ties.with_partners(std::move(fixed.nodes));
  const auto nodes = index_of(model.cloud.nodes());
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
