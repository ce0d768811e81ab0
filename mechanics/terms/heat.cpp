// The thermal half of a step: plastic and friction heat, conduction and what boundaries exchange, staggered
// behind the mechanics (paper 004, 5.1.4).
#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "mechanics/node_heat.hpp"
#include "mechanics/terms/list.hpp"
#include "thermal/conduction.hpp"
#include "thermal/conduction_interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cnem {

namespace {

template<int dim> class Heat : public Term<dim> {
public:
  std::vector<Energy*> energies() override { return {&content_, &generated_, &exchanged_}; }
  void archive(Archive& archive) override { interval_.archive(archive, "solver/"); }

  void audit(const BodyView<dim>& body) override {
    const NodeState<dim>& node = body.state.node;
    content_.value = 0.0;
    for (std::size_t i = 0; i < node.size(); ++i)
      content_.value +=
          node.heat_capacity[i] *
          curves_of<dim>(body.model, node, i).rise(node.initial_temperature[i], node.temperature[i]);
  }

  void limit(const Body<dim>& body, StepLimit& limit) override {
    constexpr double far = 100.0; // so much longer than a step that no deformation makes it matter
    if (interval_.stable < far * body.state.step_before) interval_.stable = 0.0; // measured anew
    if (body.model.mechanical) return;
    measure_stable_step(body);
    limit.heat = interval_.stable;
  }

  void release() override { conduction_ = Conduction<dim>(); }

  void carried(const Body<dim>&) override { contacts_.clear(); }

  void renew(const Body<dim>&) override { interval_.stable = 0.0; }

  void attach(const Body<dim>& body) override {
    if (!body.model.thermal) return;
    const DiscreteOperators<dim>& op = body.approximation.conduction;
    Field conductivity(index_of(op.points));
    for (std::size_t p = 0; p < conductivity.size(); ++p)
      conductivity[p] = body.material_of_node(op.first_node(p)).conductivity;
    conduction_.set_operators(op, std::move(conductivity));
    quickest_ = body.state.node.heat_capacity;
    for (std::size_t i = 0; i < quickest_.size(); ++i)
      quickest_[i] *= curves_of<dim>(body.model, body.state.node, i).quickest;
  }

  // Dissipation is that of each point's own step. At nodes it is heat at once: what it reads has just been
  // written.
  void begin_stress(const Body<dim>&, const DuePoints& due) override { sums_.assign(due.ranges.size(), 0.0); }
  void after_stress(const Body<dim>& body, const DuePoints& due, const LevelRange& range) override {
    if (!body.model.thermal || !body.operators().nodal) return;
    NodeState<dim>& node = body.state.node;
    double sum = 0.0;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const double q = plastic_heat_of_node(body, i);
      warm<dim>(body.model, node, i, q);
      sum += q;
    }
    sums_[due.index(range)] = sum;
  }
  void end_stress(const Body<dim>& body, const DuePoints& due) override {
    for (const double heat : sums_) generated_.value += heat;
    if (!body.model.thermal || due.whole || body.operators().nodal) return;
    NodeState<dim>& node = body.state.node;
    generated_.value += sum_ranges(body.levels.kicked(due.activity), [&](const LevelRange& range) {
      double sum = 0.0;
      for (std::size_t i = range.begin; i < range.end; ++i) {
        const double q = with_heat_of_points(body, i, due.activity, 0.0);
        warm<dim>(body.model, node, i, q);
        sum += q;
      }
      return sum;
    });
  }

  void end_step(const Body<dim>& body, double dt) override {
    if (!body.model.thermal) return;
    collect_from_contact(body);
    generate(body);
    exchange_in_contacts(body, dt);
    if (interval_.stable == 0.0) measure_stable_step(body);
    hold(body);
    if (const double interval = interval_.add(dt); interval > 0.0) conduct(body, interval);
  }

private:
  /// J/m^(3−dim) of the last step, for points at nodes.
  static double plastic_heat_of_node(const Body<dim>& body, std::size_t i) {
    const plasticity::Material& material = body.material_of(i);
    return material.taylor_quinney * body.state.point.dissipation[i] * body.state.node.mass[i] /
           material.density;
  }

  /// `heat` with what node i takes of points that are due, with the shape functions, J/m^(3−dim).
  static double with_heat_of_points(const Body<dim>& body, std::size_t i, int activity, double heat) {
    const DiscreteOperators<dim>& op = body.operators();
    const PointState<dim>& point = body.state.point;
    for (auto e = index_of(op.col_begin[i]); e < index_of(op.col_begin[i + 1]); ++e) {
      const auto p = index_of(op.point[e]);
      if (body.levels.level_of_point(p) <= activity)
        heat += body.material_of(p).taylor_quinney * point.dissipation[p] * point.stress_free[p] *
                op.weighted_value[e];
    }
    return heat;
  }

  void measure_stable_step(const Body<dim>& body) {
    const NodeState<dim>& node = body.state.node;
    const double decay =
        conduction_.fastest_decay(body.position, quickest_) +
        body.conditions.heat_boundaries.fastest_decay(body.state.time, node.position, quickest_);
    interval_.stable = decay > 0.0 ? 2.0 / decay : std::numeric_limits<double>::infinity();
  }

  /// Friction heat and conductance of the contacts of the step.
  void collect_from_contact(const Body<dim>& body) {
    const contact::RigidContact<dim>& contact = body.conditions.contact;
    if (!contact.active()) return;
    const IndexedVector<BoundaryNodeIndex, NodeIndex>& boundary = contact.boundary_nodes();
    for (const BoundaryNodeIndex b : boundary.indices())
      body.state.node.contact_heat[index_of(boundary[b])] = contact.friction_heat()[b];
    contacts_.clear();
    for (const contact::ContactPoint<dim>& touch : contact.points()) {
      const contact::ToolThermal& thermal = contact.tools()[touch.tool].thermal;
      if (thermal.conductance > 0.0)
        contacts_.tools.push_back({touch.node, thermal.conductance, touch.area, thermal.temperature});
    }
    if (const double conductance = contact.body_law().conductance; conductance > 0.0)
      for (const contact::BodyTouch<dim>& touch : contact.touches())
        contacts_.bodies.push_back({touch.node, touch.facet, touch.weight, conductance, touch.area});
  }

  /// Friction heat, and plastic heat of points that share it out with the shape functions.
  void generate(const Body<dim>& body) {
    NodeState<dim>& node = body.state.node;
    if (body.operators().nodal) {
      for (const NodeIndex touching : body.conditions.contact.boundary_nodes()) {
        const auto i = index_of(touching);
        warm<dim>(body.model, node, i, node.contact_heat[i]);
        generated_.value += node.contact_heat[i];
      }
      return;
    }
    generated_.value += sum_blocks(node.size(), [&](std::size_t begin, std::size_t end) {
      double sum = 0.0;
      for (std::size_t i = begin; i < end; ++i) {
        const double heat = with_heat_of_points(body, i, body.levels.highest(), node.contact_heat[i]);
        warm<dim>(body.model, node, i, heat);
        sum += heat;
      }
      return sum;
    });
  }

  /// What flows to tools and between bodies in a step, in as many sub-steps as are stable.
  void exchange_in_contacts(const Body<dim>& body, double dt) {
    if (contacts_.empty()) return;
    NodeState<dim>& node = body.state.node;
    contacts_.each_node([&](NodeIndex i) { node.heat_flow[index_of(i)] = 0.0; });
    const int substeps = stable_substeps(dt * contacts_.fastest_decay(quickest_));
    const double h = dt / substeps;
    for (int s = 0; s < substeps; ++s) {
      contacts_.add_flow(node.temperature, node.heat_flow);
      contacts_.each_node([&](NodeIndex touching) {
        const auto i = index_of(touching);
        warm<dim>(body.model, node, i, h * node.heat_flow[i]);
        exchanged_.value += h * node.heat_flow[i];
        node.heat_flow[i] = 0.0;
      });
    }
  }

  /// Tied nodes are one place, and what is prescribed holds, in every step.
  void hold(const Body<dim>& body) {
    NodeState<dim>& node = body.state.node;
    share_heat<dim>(body.model, body.conditions.heat_ties, node);
    double heat = 0.0;
    body.conditions.heat_boundaries.hold(body.state.time, [&](NodeIndex held, double value) {
      const auto i = index_of(held);
      heat += node.heat_capacity[i] * curves_of<dim>(body.model, node, i).rise(node.temperature[i], value);
      node.temperature[i] = value;
    });
    exchanged_.value += heat;
  }

  /// Nodes that contact presses on or holds, and where tools are.
  void look_at_exposure(const Body<dim>& body) {
    const contact::RigidContact<dim>& contact = body.conditions.contact;
    exposure_.covered.assign(body.state.node.size(), false);
    exposure_.tool_moved.clear();
    if (!contact.active()) return;
    for (const contact::ContactPoint<dim>& touch : contact.points()) exposure_.covered[touch.node] = true;
    const IndexedVector<BoundaryNodeIndex, NodeIndex>& boundary = contact.boundary_nodes();
    for (const BoundaryNodeIndex b : boundary.indices())
      if (contact.nodal_impulse()[b] != Vec<dim>::Zero()) exposure_.covered[boundary[b]] = true;
    for (std::size_t t = 0; t < contact.tools().size(); ++t)
      exposure_.tool_moved.push_back(contact.displacement(t, body.state.time));
  }

  /// How many steps of conduction an interval takes. Where it would be more than a few, nodes of films and
  /// slivers that are too light for what they pass on are no reason for more.
  int substeps_of(const Body<dim>& body, double dt) {
    constexpr int most = 8;
    conduction_.lift_limit();
    const int substeps = stable_substeps(dt * 2.0 / interval_.stable);
    if (substeps <= most || !body.model.mechanical) return substeps;
    const double of_boundaries =
        body.conditions.heat_boundaries.fastest_decay(body.state.time, body.state.node.position, quickest_);
    const double decay = conduction_.limit_decay(body.position, quickest_, most / dt);
    return stable_substeps(dt * (decay + of_boundaries));
  }

  /// Explicit conduction (58) and boundaries over an interval, in as many sub-steps as are stable.
  void conduct(const Body<dim>& body, double dt) {
    NodeState<dim>& node = body.state.node;
    const ThermalBoundaries<dim>& boundaries = body.conditions.heat_boundaries;
    const std::size_t n = node.size();
    const int substeps = substeps_of(body, dt);
    const double h = dt / substeps;
    if (boundaries.cooled()) look_at_exposure(body);
    for (int s = 0; s < substeps; ++s) {
      std::fill(node.heat_flow.begin(), node.heat_flow.end(), 0.0);
      boundaries.add_flow(body.state.time, node.position, node.temperature, node.heat_flow);
      boundaries.add_coolant_flow(body.state.time, exposure_, node.position, node.temperature,
                                  node.heat_flow);
      const double received = h * sum_blocks(n, [&](std::size_t begin, std::size_t end) {
                                double sum = 0.0;
                                for (std::size_t i = begin; i < end; ++i) sum += node.heat_flow[i];
                                return sum;
                              });
      conduction_.add_flow(body.position, potential<dim>(body.model, node, potential_), node.heat_flow);
      for_each_block(n, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) warm<dim>(body.model, node, i, h * node.heat_flow[i]);
      });
      exchanged_.value += received;
      hold(body);
    }
  }

  Conduction<dim> conduction_;
  HeatContacts<dim> contacts_; ///< of this step
  Exposure<dim> exposure_;     ///< to coolants, scratch
  ConductionInterval interval_;
  Field quickest_;           ///< [node] heat capacities that no exchange goes faster than
  Field potential_;          ///< [node] K, scratch
  std::vector<double> sums_; ///< [range] J/m^(3−dim)
  Energy content_{"heat_content", EnergyKind::heat_held};         ///< Σ C (T − T_start)
  Energy generated_{"heat_generated", EnergyKind::heat_received}; ///< from plastic work and friction
  Energy exchanged_{"heat_exchanged", EnergyKind::heat_received}; ///< received through the boundary
};

} // namespace

template<int dim> std::unique_ptr<Term<dim>> heat(const Model<dim>&) { return std::make_unique<Heat<dim>>(); }

template std::unique_ptr<Term<2>> heat(const Model<2>&);
template std::unique_ptr<Term<3>> heat(const Model<3>&);

} // namespace cnem
