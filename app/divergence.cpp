#include "app/divergence.hpp"

#include "app/places.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::app {

namespace {

/// Distance to the nearest node around in the reference, m.
template<int dim> double spacing_at(const ExplicitSolver<dim>& solver, std::size_t node) {
  const DiscreteOperators<dim>& op = solver.approximation().mechanics;
  const Fields<dim>& X = solver.state().node.reference;
  double nearest = std::numeric_limits<double>::infinity();
  for (auto c = index_of(op.col_begin[node]); c < index_of(op.col_begin[node + 1]); ++c) {
    const auto p = index_of(op.point[c]);
    for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
      const auto j = index_of(op.node[e]);
      const double d = (vector_at<dim>(X, j) - vector_at<dim>(X, node)).norm();
      if (j != node && d > 0.0) nearest = std::min(nearest, d);
    }
  }
  return nearest;
}

template<int dim> double strain_of(const PointState<dim>& point, std::size_t p) {
  double sum = 0.0;
  for (std::size_t k = 0; k < point.deformation.size(); ++k) {
    // The diagonal of F: components 0, 3 and 4 (out of plane) in the plane, 0, 4 and 8 in space.
    const bool diagonal = dim == 2 ? k == 0 || k >= 3 : k % 4 == 0;
    const double strain = point.deformation[k][p] - (diagonal ? 1.0 : 0.0);
    sum += strain * strain;
  }
  return std::sqrt(sum);
}

/// What a user has chosen that makes runs diverge.
void blame_settings(const input::Case& input, const std::string& field, std::vector<std::string>& causes) {
  if (input.time.fixed)
    causes.push_back(
        fmt::format("The step is fixed at {:.3g} s (time.step.fixed), whatever is stable: without "
                    "this key the stable step is taken.",
                    *input.time.fixed));
  if (input.time.safety > 0.95)
    causes.push_back(fmt::format("time.step.safety = {:.3g} leaves no room between two looks at the stable "
                                 "step: take 0.9 or less.",
                                 input.time.safety));
  if (methods::entry(input.method.name).promises.keep(Promise::one_point_per_node) &&
      input.method.stabilisation == 0.0)
    causes.push_back(
        "method.stabilisation = 0 leaves the zigzag modes of nodal integration free: take 0.05.");
  if (field == "tool velocity")
    causes.push_back(
        "Tool and workpiece pass each other faster than their contact can be seen: make the tool "
        "thicker, one that forces drive heavier, or time.step.max smaller.");
  if (field == "energy residual" && input.method.energy_tolerance < 0.005)
    causes.push_back(fmt::format("method.energy_tolerance = {:.3g} is less than what a good run may leave.",
                                 input.method.energy_tolerance));
}

/// What the place tells.
template<int dim>
void blame_place(const input::Case& input, const ExplicitSolver<dim>& solver, std::size_t node,
                 std::vector<std::string>& causes) {
  const State<dim>& state = solver.state();
  const DiscreteOperators<dim>& op = solver.approximation().mechanics;
  const auto point = index_of(op.point[index_of(op.col_begin[node])]);
  const Place<dim> place = place_of(solver, node);
  const double spacing = spacing_at(solver, node);
  const auto& contact = solver.conditions().contact;
  for (std::size_t t = 0; t < contact.tools().size(); ++t) {
    const auto& tool = contact.tools()[t];
    const Vec<dim> seen = place.centre - contact.displacement(t, state.time);
    if (std::abs(tool.shape->closest(seen).distance) < 3.0 * spacing)
      causes.push_back(
          fmt::format("It lies at tool '{}': a sharp corner, or a tool that moves more than a cell "
                      "in a few steps, turns cells inside out. Round the corner (fillet), refine "
                      "there, or move the tool more slowly.",
                      tool.name));
  }
  const auto& facets = solver.conditions().cloud.facets;
  if (std::any_of(facets.begin(), facets.end(), [&](const Facet<dim>& facet) {
        return std::find(facet.node.begin(), facet.node.end(), as<NodeIndex>(node)) != facet.node.end();
      }))
    causes.push_back("It lies on the boundary, which folds over itself where it stretches or buckles most: "
                     "refine there (cloud.refine), or end the run earlier.");
  const double strain = solver.state().point.size() > point ? strain_of(state.point, point) : 0.0;
  if (strain > 1.0 && input.method.lagrangian == input::Method::Lagrangian::total)
    causes.push_back(fmt::format("Its cell has strained by {:.2g} since the start and method.lagrangian is "
                                 "\"total\": \"periodic\" renews the reference in time.",
                                 strain));
  else if (strain > 1.0)
    causes.push_back(fmt::format("Its cell has strained by {:.2g} since the last reference: a smaller "
                                 "method.rereference.strain renews it sooner.",
                                 strain));
  if (const double plastic = state.point.plastic_strain[point]; plastic > 3.0)
    causes.push_back(
        fmt::format("The material there has flowed by a plastic strain of {:.2g}, more than this "
                    "cloud can follow: refine there.",
                    plastic));
  const auto& materials = solver.model().materials;
  const auto& hardening = materials[index_of(state.point.material[point])].hardening;
  if (hardening && hardening->homologous_temperature(state.point.temperature[point]) > 0.95)
    causes.push_back(fmt::format("The material there is at {:.4g} K, where it melts ({:.4g} K) and has no "
                                 "strength left.",
                                 state.point.temperature[point], hardening->melting_temperature()));
}

} // namespace

template<int dim> std::size_t node_of(const ExplicitSolver<dim>& solver, std::size_t point) {
  return index_of(solver.approximation().mechanics.first_node(point));
}

template<int dim>
DivergenceError step_collapse(const ExplicitSolver<dim>& solver, std::size_t point, double dt,
                              const std::string& least) {
  const State<dim>& state = solver.state();
  const std::size_t node = node_of(solver, point);
  return {
      fmt::format("the stable step has fallen to {:.3g} s, below {}, at step {}, t = {:.6g} s, because of "
                  "node {} at {}",
                  dt, least, state.step, state.time, node, show_place<dim>(state.node.position, node)),
      static_cast<int>(node), "stable step"};
}

template<int dim> void check_finite(const State<dim>& state) {
  const NodeState<dim>& node = state.node;
  const auto check = [&](const char* name, const Field& values) {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!std::isfinite(values[i]))
        throw DivergenceError(
            fmt::format("the {} of node {} is not a number at step {}, t = {:.6g} s; it started "
                        "from {} at the last reference",
                        name, i, state.step, state.time, show_place<dim>(node.reference, i)),
            static_cast<int>(i), name);
  };
  check("temperature", node.temperature);
  constexpr double rounding = 1.0; // K
  for (std::size_t i = 0; i < node.temperature.size(); ++i)
    if (node.temperature[i] < -rounding)
      throw DivergenceError(
          fmt::format(
              "node {} at {} is at {:.5g} K, below absolute zero, at step {}, t = {:.6g} s: more heat "
              "is taken from it than it has",
              i, show_place<dim>(node.position, i), node.temperature[i], state.step, state.time),
          static_cast<int>(i), "temperature");
  for (const Field& component : node.velocity) check("velocity", component);
  for (const Field& component : node.position) check("position", component);
}

template<int dim>
void check_energy(double residual, const EnergyScale& scale, double tolerance, const State<dim>& state) {
  const double share = std::abs(residual) / scale.energy;
  // The error of a gentle start falls with the square of the steps while it is compared with next to nothing.
  constexpr std::int64_t first_judged = 10;
  if (state.step < first_judged || share <= tolerance) return;
  const auto speed = [&](std::size_t i) { return vector_at<dim>(state.node.velocity, i).norm(); };
  std::size_t fastest = 0;
  for (std::size_t i = 0; i < state.node.size(); ++i)
    if (!(speed(i) <= speed(fastest))) fastest = i;
  constexpr double at_rest = 1e-8; // m/s: what moves is rounding
  if (speed(fastest) < at_rest) return;
  throw DivergenceError(
      fmt::format("the energy residual is {:.3g} of {}, more than method.energy_tolerance = {:.3g} "
                  "allows, at step {}, t = {:.6g} s; the fastest node is {} at {} with {:.3g} m/s",
                  share, scale.what, tolerance, state.step, state.time, fastest,
                  show_place<dim>(state.node.position, fastest), speed(fastest)),
      static_cast<int>(fastest), "energy residual");
}

template<int dim>
DivergenceError lost_reference(const ExplicitSolver<dim>& solver, const GeometryError& error) {
  const State<dim>& state = solver.state();
  std::size_t worst = 0;
  for (std::size_t p = 1; p < state.point.size(); ++p)
    if (strain_of(state.point, p) > strain_of(state.point, worst)) worst = p;
  const std::size_t node = node_of(solver, worst);
  return {fmt::format(
              "the cloud could not be rebuilt at step {}, t = {:.6g} s: {}; the most strained cell is that "
              "of node {} at {}",
              state.step, state.time, error.what(), node, show_place<dim>(state.node.position, node)),
          static_cast<int>(node), "geometry"};
}

template<int dim> Place<dim> place_of(const ExplicitSolver<dim>& solver, std::size_t node) {
  const NodeState<dim>& nodes = solver.state().node;
  constexpr double cells_around = 8.0, lost = 30.0;
  const double spacing = spacing_at(solver, node);
  const Vec<dim> reference = vector_at<dim>(nodes.reference, node);
  const Vec<dim> now = vector_at<dim>(nodes.position, node);
  // A node that has flown away shows nothing: then the place is where it came from.
  return {now.allFinite() && (now - reference).norm() < lost * spacing ? now : reference,
          cells_around * spacing};
}

template<int dim>
results::PostMortem post_mortem(const DivergenceError& error, const input::Case& input,
                                const ExplicitSolver<dim>& solver) {
  const State<dim>& state = solver.state();
  results::PostMortem dead;
  dead.step = state.step;
  dead.time = state.time;
  dead.node = error.node;
  dead.field = error.field;
  dead.text = input.placed(error.what());
  blame_settings(input, error.field, dead.causes);
  if (error.node >= 0) {
    const auto node = index_of(error.node);
    const Vec<dim> place = input.origin.head<dim>() + vector_at<dim>(state.node.position, node);
    dead.x = place.x();
    dead.y = place.y();
    if constexpr (dim == 3) dead.z = place.z();
    blame_place(input, solver, node, dead.causes);
  }
  if (dead.causes.empty())
    dead.causes.push_back(
        "None of the usual causes shows. Try half the spacing there and time.step.safety = 0.5; "
        "if it fails at the same place, look at the loads and the material there.");
  return dead;
}

template std::size_t node_of(const ExplicitSolver<2>&, std::size_t);
template DivergenceError step_collapse(const ExplicitSolver<2>&, std::size_t, double, const std::string&);
template void check_finite(const State<2>&);
template void check_energy(double, const EnergyScale&, double, const State<2>&);
template DivergenceError lost_reference(const ExplicitSolver<2>&, const GeometryError&);
template results::PostMortem post_mortem(const DivergenceError&, const input::Case&,
                                         const ExplicitSolver<2>&);
template Place<2> place_of(const ExplicitSolver<2>&, std::size_t);
template std::size_t node_of(const ExplicitSolver<3>&, std::size_t);
template DivergenceError step_collapse(const ExplicitSolver<3>&, std::size_t, double, const std::string&);
template void check_finite(const State<3>&);
template void check_energy(double, const EnergyScale&, double, const State<3>&);
template DivergenceError lost_reference(const ExplicitSolver<3>&, const GeometryError&);
template results::PostMortem post_mortem(const DivergenceError&, const input::Case&,
                                         const ExplicitSolver<3>&);
template Place<3> place_of(const ExplicitSolver<3>&, std::size_t);

} // namespace cnem::app
