#include "mechanics/explicit_solver.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "mechanics/kinematics.hpp"
#include "plasticity/return_map.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace cnem {

namespace {

/// b_e = F C_p⁻¹ Fᵀ in place of C_p⁻¹, and F = 1.
template<int dim> void push_forward(PointState<dim>& point) {
  constexpr int xx = 0, yy = 1, zz = 2, xy = 3;
  static_assert(dim == 2, "the 3D push-forward comes with 3D cells");
  for (std::size_t p = 0; p < point.size(); ++p) {
    const double f11 = point.deformation[0][p], f12 = point.deformation[1][p], f21 = point.deformation[2][p],
                 f22 = point.deformation[3][p], f33 = point.deformation[4][p];
    const double c11 = point.elastic[xx][p], c22 = point.elastic[yy][p], c12 = point.elastic[xy][p];
    point.elastic[xx][p] = f11 * f11 * c11 + 2.0 * f11 * f12 * c12 + f12 * f12 * c22;
    point.elastic[yy][p] = f21 * f21 * c11 + 2.0 * f21 * f22 * c12 + f22 * f22 * c22;
    point.elastic[xy][p] = f11 * f21 * c11 + (f11 * f22 + f12 * f21) * c12 + f12 * f22 * c22;
    point.elastic[zz][p] *= f33 * f33;
  }
}

template<int dim> void set_identity(Fields<tensor_size<dim>>& f, std::size_t size) {
  resize_all(f, size, 0.0);
  if constexpr (dim == 2)
    for (const std::size_t k : {0U, 3U, 4U}) f[k].assign(size, 1.0);
  else
    for (const std::size_t k : {0U, 4U, 8U}) f[k].assign(size, 1.0);
}

/// Σ_p V_p s_p w_p: an energy per stress-free volume over the body.
template<int dim> double integrate(const PointState<dim>& point, const Field& volume, const Field& density) {
  return sum_blocks(point.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t p = begin; p < end; ++p) sum += volume[p] * point.stress_free[p] * density[p];
    return sum;
  });
}

} // namespace

template<int dim>
ExplicitSolver<dim>::ExplicitSolver(Model<dim> model, Fields<dim> velocity, Field temperature)
    : model_(std::move(model)), edge_defect_(model_.stabilisation) {
  NodeState<dim>& node = state_.node;
  const auto n = static_cast<std::size_t>(model_.cloud.nodes());
  resize_all(node.position, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < dim; ++k)
      node.position[k][i] = model_.cloud.position[i][static_cast<Eigen::Index>(k)];
  initial_position_ = node.position;
  node.velocity = std::move(velocity);
  velocity_before_ = node.velocity;
  node.temperature = std::move(temperature);
  initial_temperature_ = node.temperature;
  contact_heat_.assign(n, 0.0);
  heat_flow_.assign(n, 0.0);
  resize_all(node.force, n);
  prepare();
  running_.initial = ledger().total();
}

template<int dim> void ExplicitSolver<dim>::prepare() {
  NodeState<dim>& node = state_.node;
  PointState<dim>& point = state_.point;
  const plasticity::Material& material = model_.material;
  const bool start = references_ == 0;

  Cloud<dim> cloud = model_.cloud;
  for (std::size_t i = 0; i < node.size(); ++i)
    for (std::size_t k = 0; k < dim; ++k)
      cloud.position[i][static_cast<Eigen::Index>(k)] = node.position[k][i];
  Approximation<dim> rebuilt = model_.method->rebuild(cloud);

  double elastic_before = 0.0, plastic_before = 0.0;
  if (!start) {
    elastic_before = integrate(point, approximation_.mechanics.volume, point.stored_energy);
    plastic_before = integrate(point, approximation_.mechanics.volume, point.plastic_work);
    running_.penalty_release += running_.stabilisation;
    push_forward(point);
  }
  model_.cloud = std::move(cloud);
  approximation_ = std::move(rebuilt);
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  const auto points = static_cast<std::size_t>(op.points);
  node.reference = node.position;
  if (start) {
    const Field volume = op.node_volume();
    node.mass.resize(volume.size());
    node.heat_capacity.resize(volume.size());
    for (std::size_t i = 0; i < volume.size(); ++i) {
      node.mass[i] = material.density * volume[i];
      node.heat_capacity[i] = node.mass[i] * material.specific_heat;
    }
    resize_all(point.elastic, points, 0.0);
    for (std::size_t k = 0; k < 3; ++k) point.elastic[k].assign(points, 1.0);
    resize_all(point.piola, points);
    resize_all(total_stress_, points);
    for (Field* field : {&point.plastic_strain, &point.plastic_rate, &point.equivalent_stress,
                         &point.pressure, &point.stored_energy, &point.plastic_work, &point.dissipation,
                         &point.temperature, &viscous_pressure_, &jacobian_})
      field->assign(points, 0.0);
    point.stress_free.assign(points, 1.0);
    point.material.assign(points, 0);
    shear_modulus_.assign(points, material.elasticity.mu());
    wave_modulus_.assign(points, material.elasticity.lambda() + 2.0 * material.elasticity.mu());
    density_.assign(points, material.density);
    flow_stress_.assign(points, std::numeric_limits<double>::infinity());
    interpolate<dim>(op, node.temperature, point.temperature, 0, points);
    if (material.hardening)
      for (std::size_t p = 0; p < points; ++p)
        flow_stress_[p] =
            material.hardening->flow_stress(0.0, material.hardening->rate0, point.temperature[p]);
  }
  set_identity<dim>(point.deformation, points);
  jacobian_.assign(points, 1.0);
  const auto stress_points = plasticity::stress_points(point);
  const std::ptrdiff_t bad =
      plasticity::update_stress(material, stress_points, 0, static_cast<std::ptrdiff_t>(points), 0.0);
  if (bad >= 0) diverged(static_cast<std::size_t>(bad), "elastic strain");
  for (std::size_t p = 0; p < points; ++p) density_[p] = material.density * point.stress_free[p];

  edge_defect_.reset(shear_modulus_);
  model_.contact.set_boundary(model_.cloud.facets, node.size(), model_.supports.constraints());
  if (model_.thermal) set_conduction();
  conduction_step_ = 0.0;
  if (!start) {
    running_.rereference += elastic_before - integrate(point, op.volume, point.stored_energy);
    plastic_offset_ += plastic_before - integrate(point, op.volume, point.plastic_work);
  }
  for (std::size_t k = 0; k < total_stress_.size(); ++k) total_stress_[k] = point.piola[k];
  running_.stabilisation = 0.0;
  assemble_forces();
  ++references_;
}

template<int dim> void ExplicitSolver<dim>::set_conduction() {
  const DiscreteOperators<dim>& op = approximation_.conduction;
  conduction_.set_operators(op, Field(static_cast<std::size_t>(op.points), model_.material.conductivity));
}

template<int dim> void ExplicitSolver<dim>::advance(double dt) {
  const double dt_mean = 0.5 * (state_.step_before + dt);
  accelerate_and_move(dt, dt_mean); // (i)   (54), (55), corrected by supports and contact
  strain_and_stress(dt);            // (ii)  Box 2
  state_.time += dt;
  state_.step_before = dt;
  ++state_.step;
  assemble_forces();               // (iii) (52), (53)
  if (model_.thermal) conduct(dt); // (58), staggered
}

template<int dim> void ExplicitSolver<dim>::accelerate_and_move(double dt, double dt_mean) {
  NodeState<dim>& node = state_.node;
  model_.contact.remember(node.velocity);
  std::swap(velocity_before_, node.velocity);
  for_each_block(node.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = begin; i < end; ++i)
        node.velocity[k][i] = velocity_before_[k][i] + dt_mean * node.force[k][i] / node.mass[i];
  });
  model_.supports.apply(state_.time, dt, dt_mean, node.mass, velocity_before_, node.velocity);
  running_.supports = model_.supports.work();
  for_each_block(node.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = begin; i < end; ++i) node.position[k][i] += dt * node.velocity[k][i];
  });

  correct_contact(dt, dt_mean);

  if (!model_.loads.empty()) {
    const Fields<dim>& f = model_.loads.force();
    running_.loads += sum_blocks(node.size(), [&](std::size_t begin, std::size_t end) {
      double sum = 0.0;
      for (std::size_t k = 0; k < dim; ++k)
        for (std::size_t i = begin; i < end; ++i)
          sum += 0.5 * dt_mean * f[k][i] * (velocity_before_[k][i] + node.velocity[k][i]);
      return sum;
    });
  }
}

template<int dim> void ExplicitSolver<dim>::correct_contact(double dt, double dt_mean) {
  contact::RigidContact<dim>& contact = model_.contact;
  if (contact.tools().empty()) return;
  NodeState<dim>& node = state_.node;
  const std::vector<std::int32_t>& boundary = contact.boundary_nodes();
  std::vector<double> flow_stress;
  if (contact.flow_stress_needed()) {
    flow_stress.reserve(boundary.size());
    for (const std::int32_t i : boundary)
      flow_stress.push_back(
          average_at_node<dim>(approximation_.mechanics, flow_stress_, static_cast<std::size_t>(i)));
  }
  const plasticity::Material& material = model_.material;
  const std::vector<double> effusivity(
      model_.thermal ? boundary.size() : 0,
      std::sqrt(material.conductivity * material.density * material.specific_heat));
  contact.correct({.time = state_.time,
                   .dt = dt,
                   .dt_mean = dt_mean,
                   .position = node.position,
                   .velocity = node.velocity,
                   .mass = node.mass,
                   .flow_stress = flow_stress,
                   .effusivity = effusivity});
  running_.tools = running_.friction = running_.impact = running_.recovery = 0.0;
  for (const contact::ToolResult<dim>& tool : contact.results()) {
    running_.tools += tool.total.tool;
    running_.recovery += tool.total.recovery;
    running_.friction += tool.total.friction;
    running_.impact += tool.total.impact;
  }
  if (!model_.thermal) return;
  for (std::size_t b = 0; b < boundary.size(); ++b)
    contact_heat_[static_cast<std::size_t>(boundary[b])] = contact.friction_heat()[b];
  tool_conductance_.clear();
  for (const contact::ContactPoint<dim>& touch : contact.points()) {
    const contact::ToolThermal& thermal = contact.tools()[static_cast<std::size_t>(touch.tool)].thermal;
    if (thermal.conductance > 0.0)
      tool_conductance_.push_back({touch.node, thermal.conductance, touch.area, thermal.temperature});
  }
}

template<int dim> void ExplicitSolver<dim>::strain_and_stress(double dt) {
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  PointState<dim>& point = state_.point;
  const auto stress_points = plasticity::stress_points(point);
  const std::size_t n = point.size();
  const bool penalised = edge_defect_.active(approximation_.links);
  std::vector<std::ptrdiff_t> bad(blocks(n), -1);
  std::vector<double> damping(blocks(n), 0.0);
  running_.viscosity += sum_blocks(n, [&](std::size_t begin, std::size_t end) {
    deformation_gradient<dim>(op, state_.node.position, point.deformation, begin, end);
    interpolate<dim>(op, state_.node.temperature, point.temperature, begin, end);
    bad[begin / block_size] =
        plasticity::update_stress(model_.material, stress_points, static_cast<std::ptrdiff_t>(begin),
                                  static_cast<std::ptrdiff_t>(end), dt);
    for (std::size_t p = begin; p < end; ++p)
      if (point.plastic_rate[p] > 0.0) flow_stress_[p] = point.equivalent_stress[p];
    for (std::size_t k = 0; k < total_stress_.size(); ++k)
      std::copy(point.piola[k].begin() + static_cast<std::ptrdiff_t>(begin),
                point.piola[k].begin() + static_cast<std::ptrdiff_t>(end),
                total_stress_[k].begin() + static_cast<std::ptrdiff_t>(begin));
    if (penalised)
      edge_defect_.update_modulus(shear_modulus_, flow_stress_, point.plastic_strain, begin, end);
    if (!model_.viscosity.active()) return 0.0;
    const ViscousBlock viscous =
        add_bulk_viscosity<dim>(model_.viscosity, op, point.deformation, density_, wave_modulus_, dt,
                                jacobian_, viscous_pressure_, total_stress_, begin, end);
    damping[begin / block_size] = viscous.damping;
    return viscous.dissipated;
  });
  viscosity_ratio_ = *std::max_element(damping.begin(), damping.end());
  for (const std::ptrdiff_t p : bad)
    if (p >= 0) diverged(static_cast<std::size_t>(p), "deformation gradient");
}

template<int dim> void ExplicitSolver<dim>::assemble_forces() {
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  NodeState<dim>& node = state_.node;
  const std::size_t n = node.size();
  model_.loads.evaluate(state_.time, node.position, node.mass);
  for (std::size_t k = 0; k < dim; ++k) {
    if (model_.loads.empty())
      std::fill(node.force[k].begin(), node.force[k].end(), 0.0);
    else
      node.force[k] = model_.loads.force()[k];
  }
  if (edge_defect_.active(approximation_.links)) {
    std::vector<typename EdgeDefect<dim>::Energy> energy(blocks(n));
    for_each_block(n, [&](std::size_t begin, std::size_t end) {
      energy[begin / block_size] =
          edge_defect_.apply(approximation_.links, op, node.reference, node.position,
                             state_.point.deformation, total_stress_, node.force, begin, end);
    });
    running_.stabilisation = 0.0;
    for (const auto& e : energy) {
      running_.stabilisation += e.stored;
      running_.penalty_release += e.released;
    }
  }
  for_each_block(n, [&](std::size_t begin, std::size_t end) {
    subtract_internal_force<dim>(op, total_stress_, node.force, begin, end);
  });
}

template<int dim> void ExplicitSolver<dim>::conduct(double dt) {
  NodeState<dim>& node = state_.node;
  const PointState<dim>& point = state_.point;
  const plasticity::Material& material = model_.material;
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  const std::size_t n = node.size();
  // Plastic heat: local, per unit mass (nodal), or shared out with the shape functions.
  running_.heat_generated += sum_blocks(n, [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      double heat = contact_heat_[i];
      if (op.nodal) {
        heat += material.taylor_quinney * point.dissipation[i] * node.mass[i] / material.density;
      } else {
        for (auto e = static_cast<std::size_t>(op.col_begin[i]);
             e < static_cast<std::size_t>(op.col_begin[i + 1]); ++e) {
          const auto p = static_cast<std::size_t>(op.point[e]);
          heat +=
              material.taylor_quinney * point.dissipation[p] * point.stress_free[p] * op.weighted_value[e];
        }
      }
      node.temperature[i] += heat / node.heat_capacity[i];
      sum += heat;
    }
    return sum;
  });
  if (conduction_step_ == 0.0) {
    const double decay = conduction_.fastest_decay(node.position, node.heat_capacity) +
                         model_.heat_boundaries.fastest_decay(state_.time, node.position, node.heat_capacity);
    conduction_step_ = decay > 0.0 ? 2.0 / decay : std::numeric_limits<double>::infinity();
  }
  const int substeps = std::max(1, static_cast<int>(std::ceil(dt / (0.9 * conduction_step_))));
  const double h = dt / substeps;
  for (int s = 0; s < substeps; ++s) {
    std::fill(heat_flow_.begin(), heat_flow_.end(), 0.0);
    model_.heat_boundaries.add_flow(state_.time, node.position, node.temperature, tool_conductance_,
                                    heat_flow_);
    double received = 0.0;
    for (const double q : heat_flow_) received += h * q;
    conduction_.add_flow(node.position, node.temperature, heat_flow_);
    for (std::size_t i = 0; i < n; ++i) node.temperature[i] += h * heat_flow_[i] / node.heat_capacity[i];
    received += model_.heat_boundaries.hold(state_.time, node.heat_capacity, node.temperature);
    running_.heat_exchanged += received;
  }
}

template<int dim> EnergyLedger ExplicitSolver<dim>::ledger() const {
  const NodeState<dim>& node = state_.node;
  const PointState<dim>& point = state_.point;
  EnergyLedger ledger = running_;
  const double half = 0.5 * state_.step_before;
  const Fields<dim>& load = model_.loads.force();
  ledger.kinetic = sum_blocks(node.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = begin; i < end; ++i) {
        const double v = node.velocity[k][i];
        sum += 0.5 * node.mass[i] * v * v + half * v * node.force[k][i];
      }
    return sum;
  });
  if (!model_.loads.empty())
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = 0; i < node.size(); ++i) ledger.loads += half * node.velocity[k][i] * load[k][i];
  ledger.elastic = integrate(point, approximation_.mechanics.volume, point.stored_energy);
  ledger.plastic = plastic_offset_ + integrate(point, approximation_.mechanics.volume, point.plastic_work);
  for (std::size_t i = 0; i < node.size(); ++i)
    ledger.heat_content += node.heat_capacity[i] * (node.temperature[i] - initial_temperature_[i]);
  return ledger;
}

template<int dim> std::array<double, 2> ExplicitSolver<dim>::mass_balance() const {
  std::array<double, 2> range{1.0, 1.0};
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  if (!op.nodal) return range;
  for (std::size_t i = 0; i < state_.node.size(); ++i) {
    const double r =
        model_.material.density * op.volume[i] * state_.point.stress_free[i] / state_.node.mass[i];
    range = {std::min(range[0], r), std::max(range[1], r)};
  }
  return range;
}

template class ExplicitSolver<2>;

} // namespace cnem
