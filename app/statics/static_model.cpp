#include "app/statics/static_model.hpp"

#include "app/plausibility/plausibility.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "mechanics/kinematics.hpp"
#include "plasticity/ply_return.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace cnem::app {

namespace {

/// Rows and columns of the components of a symmetric tensor that a state keeps, in space all six.
constexpr std::array<std::array<Eigen::Index, 2>, 6> component{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

/// Fields of the plane hold the component out of it behind the others.
template<int dim> Mat<3> tensor_at(const Fields<tensor_size<dim>>& field, std::size_t p) {
  Mat<3> tensor = Mat<3>::Zero();
  for (Eigen::Index i = 0; i < dim; ++i)
    for (Eigen::Index k = 0; k < dim; ++k) tensor(i, k) = field[index_of(dim * i + k)][p];
  if constexpr (dim == 2) tensor(2, 2) = field[4][p];
  return tensor;
}

template<int dim> void set_tensor(Fields<tensor_size<dim>>& field, std::size_t p, const Mat<3>& tensor) {
  for (Eigen::Index i = 0; i < dim; ++i)
    for (Eigen::Index k = 0; k < dim; ++k) field[index_of(dim * i + k)][p] = tensor(i, k);
  if constexpr (dim == 2) field[4][p] = tensor(2, 2);
}

template<int dim> Mat<3> stress_at(const Fields<symmetric_size<dim>>& stress, std::size_t p) {
  Mat<3> tensor = Mat<3>::Zero();
  for (std::size_t k = 0; k < stress.size(); ++k) {
    const auto [i, j] = component[k];
    tensor(i, j) = tensor(j, i) = stress[k][p];
  }
  return tensor;
}

double von_mises(const Mat<3>& stress) {
  const Mat<3> deviator = stress - stress.trace() / 3.0 * Mat<3>::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

/// The stress point of the approximation that a point of the static problem is part of.
template<int dim> std::size_t cell_of(const StaticModel<dim>& model, std::size_t p) {
  if constexpr (dim == 2)
    return index_of(model.cracks.enriched.cell[p]);
  else
    return p;
}

std::optional<plasticity::PlaneStiffness> ply_stiffness(const plasticity::Material& material,
                                                        bool stress_free) {
  if (!material.ply) return std::nullopt;
  return plasticity::plane_stiffness(*material.ply, stress_free);
}

template<int dim> Approximation<dim> approximate(const input::Case& input, const Problem<dim>& model) {
  try {
    return model.method->rebuild(model.cloud);
  } catch (const GeometryError& error) { throw input.error("domain", error.what()); }
}

} // namespace

bool plane_stress(const input::Case& input) {
  return input.analysis.kinematics == input::Analysis::Kinematics::plane_stress;
}

template<int dim>
StaticModel<dim>::StaticModel(const input::Case& in)
    : input(in), setup(build<dim>(in)), approximation(approximate(in, setup.problem)),
      cracks(in, setup.problem.cloud, approximation) {
  for (std::string& doubt : doubts(in)) setup.warnings.push_back(std::move(doubt));
  if (const plasticity::Material& metal = setup.problem.materials.front();
      metal.expansion != 0.0 && metal.thermal_strain(in.initial.temperature) == 0.0)
    setup.warnings.push_back(fmt::format(
        "material '{}' has a heat.expansion and does not expand: initial.temperature is that at which it has "
        "no thermal strain, {:g} K; say from which it comes with heat.reference_temperature",
        metal.name, metal.expansion_reference));
  Problem<dim>& model = setup.problem;
  const Cloud<dim>& cloud = model.cloud;
  resize_all(position, index_of(cloud.nodes()));
  Field mass = approximation.mechanics.node_volume();
  for (double& m : mass) m *= model.materials.front().density;
  for (std::size_t i = 0; i < index_of(cloud.nodes()); ++i)
    for (std::size_t k = 0; k < dim; ++k) position[k][i] = cloud.position[i][static_cast<Eigen::Index>(k)];
  model.loads.evaluate(input.time.end, position, mass);
  if constexpr (dim == 2)
    force = cracks.load(input, model, position);
  else
    force = model.loads.force();
}

template<int dim> const DiscreteOperators<dim>& StaticModel<dim>::operators() const {
  if constexpr (dim == 2)
    return cracks.enriched.operators;
  else
    return approximation.mechanics;
}

template<int dim> const StabilisationLinks<dim>& StaticModel<dim>::links() const {
  if constexpr (dim == 2)
    return cracks.enriched.links;
  else
    return approximation.links;
}

template<int dim> StaticProblem<dim> StaticModel<dim>::problem() const {
  return {.operators = operators(),
          .position = setup.problem.cloud.position,
          .links = links(),
          .link_points = approximation.mechanics,
          .elasticity = setup.problem.materials.front().elasticity,
          .ply = ply_stiffness(setup.problem.materials.front(), plane_stress(input)),
          .out_of_plane = plane_stress(input) ? OutOfPlane::stress_free : OutOfPlane::strain_free,
          .stabilisation = setup.problem.stabilisation,
          .supports = setup.problem.supports,
          .thermal_strain = setup.problem.materials.front().thermal_strain(input.initial.temperature),
          .time = input.time.end,
          .force = force};
}

template<int dim>
std::string beyond_yield(const StaticModel<dim>& model, const StaticSolution<dim>& solution) {
  const plasticity::Material& material = model.setup.problem.materials.front();
  if (!material.hardening) return "";
  const double yield = material.hardening->flow_stress(0.0, 0.0, model.input.initial.temperature);
  const Field& volume = model.operators().volume;
  double all = 0.0, beyond = 0.0;
  for (std::size_t p = 0; p < volume.size(); ++p) {
    double s[6] = {};
    for (std::size_t k = 0; k < solution.stress.size(); ++k) s[k] = solution.stress[k][p];
    all += volume[p];
    if ((material.ply          ? plasticity::ply_yield_stress(*material.ply, material.yield_coefficients(), s)
         : material.anisotropy ? hill_stress(material.anisotropy->form(), s)
                               : von_mises(stress_at<dim>(solution.stress, p))) > yield)
      beyond += volume[p];
  }
  if (beyond == 0.0) return "";
  return fmt::format("static analyses are elastic: the stress is above the yield stress of {}, {:.3g} Pa, in "
                     "{:.2g}% of the body",
                     material.name, yield, 100.0 * beyond / all);
}

template<int dim> State<dim> as_state(const StaticModel<dim>& model, const StaticSolution<dim>& solution) {
  const DiscreteOperators<dim>& op = model.approximation.mechanics;
  State<dim> state;
  state.time = model.input.time.end;
  const auto nodes = index_of(op.nodes), points = index_of(op.points);
  NodeState<dim>& node = state.node;
  node.reference = node.position = node.initial_position = model.position;
  for (std::size_t k = 0; k < dim; ++k)
    for (std::size_t i = 0; i < nodes; ++i) node.position[k][i] += solution.displacement[k][i];
  resize_all(node.velocity, nodes);
  node.force = model.force;
  for (Field& along : node.force) along.resize(nodes);
  node.mass = op.node_volume();
  for (double& m : node.mass) m *= model.setup.problem.materials.front().density;
  node.temperature = model.setup.temperature;

  PointState<dim>& point = state.point;
  Fields<tensor_size<dim>> gradient;
  Fields<symmetric_size<dim>> stress;
  resize_all(gradient, points);
  resize_all(stress, points);
  for (std::size_t p = 0; p < index_of(model.operators().points); ++p) {
    const std::size_t cell = cell_of(model, p);
    const double share = model.operators().volume[p] / op.volume[cell];
    for (std::size_t k = 0; k < gradient.size(); ++k) gradient[k][cell] += share * solution.gradient[k][p];
    for (std::size_t k = 0; k < stress.size(); ++k) stress[k][cell] += share * solution.stress[k][p];
  }
  point.deformation = gradient;
  resize_all(point.piola, points);
  resize_all(point.inverse_plastic_cauchy_green, points);
  for (Field* field : {&point.plastic_strain, &point.plastic_rate, &point.equivalent_stress, &point.pressure,
                       &point.stored_energy, &point.plastic_work, &point.dissipation, &point.temperature})
    field->assign(points, 0.0);
  point.stress_free.assign(points, 1.0);
  interpolate<dim>(op, node.temperature, point.temperature, 0, points);
  for (std::size_t p = 0; p < points; ++p) {
    const Mat<3> F = tensor_at<dim>(gradient, p) + Mat<3>::Identity(), sigma = stress_at<dim>(stress, p);
    set_tensor<dim>(point.deformation, p, F);
    const double J = jacobian<dim>(point.deformation, p);
    set_tensor<dim>(point.piola, p, J * sigma * F.inverse().transpose());
    point.pressure[p] = -J * sigma.trace() / 3.0;
    point.equivalent_stress[p] = J * von_mises(sigma);
  }
  return state;
}

template struct StaticModel<2>;
template struct StaticModel<3>;
template std::string beyond_yield(const StaticModel<2>&, const StaticSolution<2>&);
template std::string beyond_yield(const StaticModel<3>&, const StaticSolution<3>&);
template State<2> as_state(const StaticModel<2>&, const StaticSolution<2>&);
template State<3> as_state(const StaticModel<3>&, const StaticSolution<3>&);

} // namespace cnem::app
