// What holds, ties and guides nodes: supports, ties, and contact with tools and other bodies.
#include "core/indexed.hpp"
#include "mechanics/kinematics.hpp"
#include "mechanics/terms/list.hpp"

#include <algorithm>
#include <cmath>

namespace cnem {

namespace {

template<int dim> class ContactAndSupports : public Term<dim> {
public:
  explicit ContactAndSupports(const Model<dim>& model) : sprung_tools_(model.sprung_tools) {
    for (const plasticity::Material& material : model.materials)
      melting_.push_back(material.melting_temperature());
  }

  std::vector<Energy*> energies() override {
    std::vector<Energy*> all{&tool_kinetic_, &friction_, &impact_, &tools_, &drives_, &recovery_, &supports_};
    if (sprung_tools_) all.insert(all.begin() + 1, {&springs_, &damping_});
    return all;
  }
  void audit(const BodyView<dim>& body) override {
    const contact::DriveEnergy drives = body.conditions.contact.drive_energy();
    tool_kinetic_.value = drives.kinetic;
    drives_.value = drives.work;
    springs_.value = drives.springs;
    damping_.value = drives.damping;
  }
  void limit(const Body<dim>& body, StepLimit& limit) override {
    limit.tools = std::min(limit.tools, body.conditions.contact.stable_step(body.state.time));
  }

  void renew(const Body<dim>& body) override {
    body.conditions.contact.set_boundary(body.conditions.cloud.facets, body.state.node.size(),
                                         body.conditions.supports.constraints(),
                                         body.conditions.ties.group());
  }

  void set_levels(const Body<dim>& body) override {
    const contact::RigidContact<dim>& contact = body.conditions.contact;
    window_.clear();
    if (!body.levels.on() || !contact.flow_stress_needed()) return;
    for (int a = 0; a <= body.levels.highest(); ++a) {
      IndexedVector<BoundaryNodeIndex, double>& window = window_.emplace_back();
      for (const NodeIndex i : contact.boundary_nodes())
        window.push_back(body.levels.window(body.operators(), i, a));
    }
  }

  void guide(const Body<dim>& body, double dt, double dt_mean) override {
    NodeState<dim>& node = body.state.node;
    if (!body.conditions.ties.empty())
      for (Field& component : node.velocity) body.conditions.ties.share(node.inertia(), component);
    body.conditions.supports.apply(body.state.time, dt, dt_mean, node.inertia(), node.velocity_before,
                                   node.velocity);
    supports_.value = body.conditions.supports.work();
  }

  void correct(const Body<dim>& body, int activity, double dt, double dt_mean) override {
    NodeState<dim>& node = body.state.node;
    if (body.conditions.contact.active())
      touch(body, window_.empty() ? contact::BoundaryValues() : window_[index_of(activity)], dt, dt_mean);
    body.conditions.ties.align(node.position);
  }

private:
  void touch(const Body<dim>& body, contact::BoundaryValues window, double dt, double dt_mean) {
    contact::RigidContact<dim>& contact = body.conditions.contact;
    NodeState<dim>& node = body.state.node;
    const IndexedVector<BoundaryNodeIndex, NodeIndex>& boundary = contact.boundary_nodes();
    IndexedVector<BoundaryNodeIndex, double> flow_stress;
    if (contact.flow_stress_needed()) {
      flow_stress.reserve(boundary.size());
      for (const NodeIndex i : boundary)
        flow_stress.push_back(average_at_node<dim>(body.operators(), body.state.point.flow_stress, i));
    }
    IndexedVector<BoundaryNodeIndex, double> temperature, melting;
    if (contact.rubs())
      for (const NodeIndex i : boundary) {
        temperature.push_back(node.temperature[index_of(i)]);
        melting.push_back(melting_[index_of(node.material[index_of(i)])]);
      }
    IndexedVector<BoundaryNodeIndex, std::int32_t> of_material;
    if (contact.by_material())
      for (const NodeIndex i : boundary) of_material.push_back(node.material[index_of(i)]);
    IndexedVector<BoundaryNodeIndex, double> effusivity;
    if (body.model.thermal)
      for (const NodeIndex i : boundary) {
        const plasticity::Material& material = body.material_of_node(i);
        effusivity.push_back(std::sqrt(material.conductivity * material.density * material.specific_heat));
      }
    contact.correct({.time = body.state.time,
                     .dt = dt,
                     .dt_mean = dt_mean,
                     .position = node.position,
                     .velocity = node.velocity,
                     .mass = node.inertia(),
                     .material = of_material,
                     .flow_stress = flow_stress,
                     .temperature = temperature,
                     .melting = melting,
                     .effusivity = effusivity,
                     .window = window});
    const contact::ContactWork& bodies = contact.body_result().total;
    tools_.value = 0.0;
    recovery_.value = bodies.recovery;
    friction_.value = bodies.friction;
    impact_.value = bodies.impact;
    for (std::size_t t = 0; t < contact.tools().size(); ++t) {
      const contact::ToolResult<dim>& tool = contact.results()[t];
      if (!contact.tools()[t].drive) tools_.value += tool.total.tool;
      recovery_.value += tool.total.recovery;
      friction_.value += tool.total.friction;
      impact_.value += tool.total.impact;
    }
  }

  Energy tool_kinetic_{"tool_kinetic", EnergyKind::held};     ///< of tools with a mass of their own
  Energy springs_{"tool_springs", EnergyKind::held};          ///< of tools that hang on them
  Energy damping_{"tool_damping", EnergyKind::dissipated};    ///< in their dampers
  Energy friction_{"friction", EnergyKind::dissipated};       ///< sliding on tools and bodies
  Energy impact_{"contact_impact", EnergyKind::dissipated};   ///< lost where nodes meet tools
  Energy tools_{"tool_work", EnergyKind::received};           ///< along the tools' prescribed motion
  Energy drives_{"drive_work", EnergyKind::received};         ///< on tools with a mass of their own
  Energy recovery_{"contact_recovery", EnergyKind::received}; ///< pushing nodes out of tools
  Energy supports_{"support_work", EnergyKind::received};     ///< of prescribed boundary motion
  bool sprung_tools_;
  std::vector<double> melting_;                                  ///< [material] K
  std::vector<IndexedVector<BoundaryNodeIndex, double>> window_; ///< [activity] as contact takes it
};

} // namespace

template<int dim> std::unique_ptr<Term<dim>> contact_and_supports(const Model<dim>& model) {
  return std::make_unique<ContactAndSupports<dim>>(model);
}

template std::unique_ptr<Term<2>> contact_and_supports(const Model<2>&);
template std::unique_ptr<Term<3>> contact_and_supports(const Model<3>&);

} // namespace cnem
