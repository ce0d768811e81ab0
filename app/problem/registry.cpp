#include "app/problem/registry.hpp"
#include "core/index.hpp"

#include "app/places.hpp"
#include "app/problem/bodies.hpp"
#include "app/problem/tool_overlap.hpp"
#include "app/problem/tool_sections.hpp"
#include "app/problem/tool_solid.hpp"
#include "app/problem/workpiece.hpp"
#include "contact/curve_shape.hpp"
#include "core/geometry/facets.hpp"
#include "methods/registry.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::app {

namespace {

/// The names of the materials in use, each once; points and nodes have their numbers.
std::vector<std::string> materials_in_use(const input::Case& input) {
  std::vector<std::string> names{input.domain.material};
  for (const input::Region& part : input.domain.regions)
    if (std::find(names.begin(), names.end(), part.material) == names.end()) names.push_back(part.material);
  return names;
}

/// The materials in use and which node is of which. region: as region_of_nodes gives it.
template<int dim>
void set_materials(const input::Case& input, const IndexedVector<NodeIndex, std::int32_t>& region,
                   Problem<dim>& model) {
  const std::vector<std::string> names = materials_in_use(input);
  for (const std::string& name : names) model.materials.push_back(input.material(name));
  const auto number_of = [&](const std::string& name) {
    return as<std::int32_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const std::int32_t everywhere = number_of(input.domain.material);
  std::vector<std::int32_t> of_region;
  for (const input::Region& part : input.domain.regions) of_region.push_back(number_of(part.material));
  if (model.materials.size() == 1) return;
  for (const std::int32_t r : region)
    model.node_material.push_back(r < 0 ? everywhere : of_region[index_of(r)]);
}

template<int dim> struct Conditions {
  std::vector<Support<dim>> supports;
  std::vector<Traction<dim>> tractions;
  std::vector<Pressure<dim>> pressures;
  std::vector<FixedTemperature> temperatures;
  std::vector<HeatFlux<dim>> fluxes;
  std::vector<Convection<dim>> convections;
};

/// The nodes nearest to the points of a condition.
template<int dim>
std::vector<NodeIndex> nodes_at(const input::Case& input, const input::BoundaryCondition& spec,
                                const Cloud<dim>& cloud) {
  std::vector<NodeIndex> nodes;
  for (const Vec3& given : spec.points) {
    const Vec<dim> point = given.head<dim>();
    NodeIndex best{};
    const auto distance = [&](NodeIndex i) { return (cloud.position[i] - point).norm(); };
    for (const NodeIndex i : cloud.position.indices())
      if (distance(i) < distance(best)) best = i;
    if (input.cloud.spacing > 0.0 && distance(best) > input.cloud.spacing)
      throw input.error(
          "boundary." + spec.name + ".points",
          fmt::format("found {}, expected a point of the workpiece: the nearest node is {:.3g} m away",
                      show_place<dim>(point), distance(best)));
    nodes.push_back(best);
  }
  return nodes;
}

/// The first components of a function over time, those that are absent as zero.
template<int dim> std::array<TimeTable, dim> components_of(const input::VectorFunction& function) {
  std::array<TimeTable, dim> components;
  for (std::size_t k = 0; k < dim; ++k) components[k] = function[k].value_or(TimeTable());
  return components;
}

template<int dim>
void add_condition(const input::Case& input, const input::BoundaryCondition& spec, const Cloud<dim>& cloud,
                   Conditions<dim>& all) {
  const std::vector<Facet<dim>> facets = facets_of(cloud, spec.pieces);
  std::vector<NodeIndex> nodes = nodes_of(facets);
  for (const NodeIndex node : nodes_at(input, spec, cloud))
    if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
  const std::vector<PieceIndex> pieces = pieces_of(std::span<const Facet<dim>>(facets));
  using Kind = typename Support<dim>::Kind;
  if (spec.symmetry) {
    // One plane per straight piece: pieces of one condition may face different ways.
    for (const std::string& piece : spec.pieces) {
      const std::vector<Facet<dim>> straight = facets_of(cloud, {piece});
      if (straight.empty()) continue;
      all.supports.push_back(
          {spec.name,
           Kind::symmetry,
           area_normal<dim>(corners_of<dim>(straight.front(), cloud.position)).normalized(),
           {},
           nodes_of(straight),
           pieces_of(std::span<const Facet<dim>>(straight))});
    }
  }
  for (std::size_t k = 0; k < dim; ++k) {
    const Vec<dim> direction = Vec<dim>::Unit(static_cast<Eigen::Index>(k));
    if (spec.velocity[k])
      all.supports.push_back({spec.name, Kind::velocity, direction, *spec.velocity[k], nodes, pieces});
    if (spec.displacement[k])
      all.supports.push_back(
          {spec.name, Kind::displacement, direction, *spec.displacement[k], nodes, pieces});
  }
  if (std::any_of(spec.traction.begin(), spec.traction.end(), [](const auto& t) { return t.has_value(); }))
    all.tractions.push_back({spec.name, components_of<dim>(spec.traction), facets});
  if (spec.pressure) all.pressures.push_back({spec.name, *spec.pressure, facets});
  if (spec.temperature) all.temperatures.push_back({spec.name, *spec.temperature, nodes, pieces});
  if (spec.heat_flux) all.fluxes.push_back({spec.name, *spec.heat_flux, facets});
  if (spec.convection) all.convections.push_back({*spec.convection, facets});
}

/// Pieces of the boundary that lie on the axis: new nodes on them are held as well. Throws InputError when
/// the cloud will be resampled and a piece leaves the axis.
std::vector<PieceIndex> pieces_on_axis(const input::Case& input, const Cloud<2>& cloud) {
  std::vector<PieceIndex> pieces;
  for (const PieceIndex piece : cloud.piece_names.indices()) {
    bool on = false, off = false;
    for (const Facet<2>& facet : cloud.facets)
      if (facet.piece == piece) {
        const auto [a, b] = facet.node;
        (cloud.position[a].x() == 0.0 && cloud.position[b].x() == 0.0 ? on : off) = true;
      }
    if (on && off && input.adapt.resample)
      throw input.error("domain", fmt::format("found the piece '{}' on the axis and beside it, expected a "
                                              "name of its own for what lies on the axis: its new nodes stay",
                                              cloud.piece_names[piece]));
    if (on) pieces.push_back(piece);
  }
  return pieces;
}

/// Nodes on the axis of revolution stay on it. Throws InputError when the workpiece reaches beyond the axis.
void hold_axis(const input::Case& input, Cloud<2>& cloud, std::vector<Support<2>>& supports,
               std::vector<std::string>& warnings) {
  double size = 0.0;
  for (const Vec2& x : cloud.position) size = std::max(size, x.norm());
  std::vector<NodeIndex> axis;
  for (const NodeIndex i : cloud.position.indices()) {
    double& r = cloud.position[i].x();
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
                             [&](NodeIndex i) { return std::binary_search(axis.begin(), axis.end(), i); }))
      warnings.push_back(fmt::format("boundary.{} moves nodes on the axis along x, where the axis holds them",
                                     support.name));
  }
  if (!axis.empty())
    supports.insert(
        supports.begin(),
        {"axis", Support<2>::Kind::symmetry, Vec2(-1, 0), {}, std::move(axis), pieces_on_axis(input, cloud)});
}

/// The first components of the drive of a tool.
template<int dim> contact::ToolDrive<dim> drive_of(const contact::ToolDrive<3>& spec) {
  contact::ToolDrive<dim> drive;
  drive.mass = spec.mass;
  for (std::size_t k = 0; k < dim; ++k) drive.force[k] = spec.force[k];
  drive.initial_velocity = spec.initial_velocity.template head<dim>();
  drive.free = spec.free.template topLeftCorner<dim, dim>();
  if (spec.spring) drive.spring = {spec.spring->spring, spec.spring->along.template head<dim>()};
  drive.damping = spec.damping;
  return drive;
}

template<int dim>
contact::Tool<dim> make_tool(const input::Case& input, const input::Tool& spec, const Cloud<dim>& cloud) {
  contact::Tool<dim> tool;
  static_cast<contact::ToolSurface&>(tool) = spec;
  if (!spec.friction_on.empty())
    for (const std::string& material : materials_in_use(input)) {
      const auto found = spec.friction_on.find(material);
      tool.friction_by_material.push_back(found == spec.friction_on.end() ? spec.friction : found->second);
    }
  if (spec.section) tool.thermal.conductance = 0.0; // its section exchanges heat, not one temperature
  tool.motion.velocity = components_of<dim>(spec.velocity);
  if (spec.drive) tool.drive = drive_of<dim>(*spec.drive);
  try {
    if constexpr (dim == 2)
      tool.shape = std::make_shared<contact::CurveShape>(spec.outline);
    else
      tool.shape = make_solid(*spec.solid, cloud);
  } catch (const InputError& error) { throw input.error("tools." + spec.name, error.what()); }
  return tool;
}

/// The workpiece has no place where a tool is; the reader has seen to outlines. Overlaps of less than half a
/// spacing are left to contact.
void check_overlap(const input::Case& input, const contact::Tool<3>& tool, const Cloud<3>& cloud) {
  if (const auto found = overlap_at_start(*tool.shape, cloud, 0.5 * input.cloud.spacing))
    throw input.error("tools." + tool.name,
                      fmt::format("the tool lies {:.3g} m deep in the workpiece at {}, expected it outside "
                                  "at the start",
                                  found->depth, show_place<3>(found->place)));
}

std::vector<Coolant<2>> coolants(const input::Case& input) {
  std::vector<Coolant<2>> list;
  for (const input::Coolant& spec : input.coolants)
    list.push_back({spec, spec.box, spec.follow ? as<ToolIndex>(*spec.follow) : ToolIndex::none});
  return list;
}

template<int dim> void set_ties(const input::Case& input, Problem<dim>& model) {
  const Pairs pairs = tied_pairs(input, model.cloud);
  model.ties = Ties<dim>(pairs.motion, model.cloud.position, pairs.motion_pieces);
  model.heat_ties = Ties<dim>(pairs.heat, model.cloud.position, pairs.heat_pieces);
}

/// What only workpieces of the plane have: regions, imperfections, facets that belong together.
void set_parts(const input::Case& input, Problem<2>& model, IndexedVector<NodeIndex, std::int32_t>& region) {
  region = region_of_nodes(input, model.cloud);
  model.strength = strength(input, model.cloud);
  pair_facets(input, model.cloud);
  std::vector<CohesiveSpec> specs = cohesive_specs(input, model.cloud);
  model.separating = !specs.empty();
  if (!specs.empty()) model.cohesive = CohesiveFaces(std::move(specs), model.cloud, input.contact.active);
}

} // namespace

template<int dim> Setup<dim> build(const input::Case& input) {
  Workpiece<dim> workpiece = make_workpiece<dim>(input);
  std::vector<contact::Tool<dim>> tools;
  for (const input::Tool& tool : input.tools) tools.push_back(make_tool(input, tool, workpiece.cloud));
  if constexpr (dim == 3)
    for (const contact::Tool<3>& tool : tools) check_overlap(input, tool, workpiece.cloud);
  Setup<dim> setup;
  setup.warnings = input.warnings;
  setup.warnings.insert(setup.warnings.end(), workpiece.warnings.begin(), workpiece.warnings.end());
  Problem<dim>& model = setup.problem;
  const Space space = input.analysis.space();
  for (const contact::Tool<dim>& tool : tools)
    model.sprung_tools |= tool.drive && (tool.drive->spring || tool.drive->damping > 0.0);
  model.contact = contact::RigidContact<dim>(std::move(tools), space, input.contact);
  model.cloud = std::move(workpiece.cloud);
  model.method = methods::make<dim>(input.method.name, workpiece.options);
  IndexedVector<NodeIndex, std::int32_t> region;
  set_ties(input, model);
  if constexpr (dim == 3)
    model.contact.repeat(repetition(input, model.cloud));
  else {
    set_parts(input, model, region);
    model.tool_sections = tool_sections(input, setup.warnings);
  }
  set_materials(input, region, model);
  model.stabilisation = input.method.stabilisation;
  model.pressure_exchange = input.method.pressure_exchange;
  model.stress_annealing = input.method.stress_annealing;
  model.viscosity = {input.method.viscosity_quadratic, input.method.viscosity_linear};
  model.plane_stress = input.analysis.kinematics == input::Analysis::Kinematics::plane_stress;
  model.thermal = input.analysis.thermal;
  model.open = input.adapt.window.has_value();
  model.mechanical = input.analysis.mechanical;
  model.safety = input.time.safety;
  for (const input::Tool& tool : input.tools)
    model.safety = std::min(model.safety, input.time.safety * tool.response.step_share());
  model.local = input.time.local;
  model.mass_scaling = input.time.mass_scaling.value_or(MassScaling{});

  Conditions<dim> all;
  for (const input::BoundaryCondition& condition : input.boundary)
    add_condition(input, condition, model.cloud, all);
  if constexpr (dim == 2)
    if (space == Space::revolution) hold_axis(input, model.cloud, all.supports, setup.warnings);
  // What holds one node of a tie holds them all.
  for (Support<dim>& support : all.supports)
    support.nodes = model.ties.with_partners(std::move(support.nodes));
  for (FixedTemperature& fixed : all.temperatures)
    fixed.nodes = model.heat_ties.with_partners(std::move(fixed.nodes));
  const auto nodes = index_of(model.cloud.nodes());
  try {
    model.supports = Supports<dim>(std::move(all.supports), nodes);
  } catch (const InputError& error) { throw input.error("boundary", error.what()); }
  model.loads = Loads<dim>(std::move(all.tractions), std::move(all.pressures),
                           components_of<dim>(input.loads.body_force), model.cloud.position, space);
  std::vector<ContactConductance<dim>> interfaces;
  if constexpr (dim == 2) interfaces = conductances(input, model.cloud);
  model.heat_boundaries = ThermalBoundaries<dim>(std::move(all.temperatures), std::move(all.fluxes),
                                                 std::move(all.convections), space, std::move(interfaces));
  if constexpr (dim == 2) model.heat_boundaries.cool(coolants(input), model.cloud);

  set_initial_state<dim>(input, model.cloud, region, setup.velocity, setup.temperature);
  for (std::string& warning : setup.warnings) warning = input.placed(warning);
  return setup;
}

template Setup<2> build(const input::Case& input);
template Setup<3> build(const input::Case& input);

} // namespace cnem::app
