// What comes and goes with matter where a window moves with a tool: energies in the ledger, masses and
// momenta beside it.
#include "core/fields/vector_at.hpp"
#include "core/index.hpp"
#include "mechanics/node_heat.hpp"
#include "mechanics/terms/list.hpp"

namespace cnem {

namespace {

template<int dim> class MatterFlow : public Term<dim> {
public:
  std::vector<Energy*> energies() override { return {&energy_, &heat_}; }

  std::vector<Metric> metrics(const BodyView<dim>& body) const override {
    const Departed<dim>& gone = body.state.departed;
    return {{"", gone.mass, "matter.mass"}, {"", gone.volume, "matter.volume"}};
  }

  void exchange(const Body<dim>& body, const Resampling<dim>& change, Booked& booked) override {
    const NodeState<dim>& node = body.state.node;
    Departed<dim>& gone = body.state.departed;
    Booked left;
    for (std::size_t i = 0; i < change.gain.size(); ++i) {
      const double share = -change.gain[i]; // of the node, that goes
      if (share == 0.0) continue;
      const auto p = index_of(point_of(as<NodeIndex>(i)));
      const Vec<dim> velocity = vector_at<dim>(node.velocity, i), force = vector_at<dim>(node.force, i);
      take(body, i, share, share * node.heat_capacity[i] * enthalpy(body, i, node.temperature[i]));
      left.kinetic +=
          share * (0.5 * node.inertia()[i] * velocity.squaredNorm() + body.half_step * velocity.dot(force));
      left.elastic += share * body.operators().volume[p] * body.state.point.stress_free[p] *
                      body.state.point.stored_energy[p];
      heat_.value -=
          share * node.heat_capacity[i] *
          curves_of<dim>(body.model, node, i).rise(node.initial_temperature[i], node.temperature[i]);
    }
    for (const NodeIndex p : change.virgin) {
      const auto [model, share] = change.model_of(p);
      const auto i = index_of(model);
      take(body, i, -share, -share * node.heat_capacity[i] * enthalpy(body, i, node.initial_temperature[i]));
      left.kinetic -= share * 0.5 * node.inertia()[i] * vector_at<dim>(node.velocity, i).squaredNorm();
    }
    gone.volume +=
        enclosed_measure<dim>(body.conditions.cloud.facets,
                              [&](NodeIndex i) -> const Vec<dim>& { return change.old_position[i]; }) -
        enclosed_measure<dim>(change.cloud);
    energy_.value += left.elastic + left.kinetic;
    booked.elastic += left.elastic;
    booked.kinetic += left.kinetic;
  }

private:
  static double enthalpy(const Body<dim>& body, std::size_t i, double temperature) {
    return curves_of<dim>(body.model, body.state.node, i).enthalpy(temperature);
  }

  /// A share of node i goes, with its velocity and `heat`, J/m^(3−dim).
  static void take(const Body<dim>& body, std::size_t i, double share, double heat) {
    const NodeState<dim>& node = body.state.node;
    Departed<dim>& gone = body.state.departed;
    gone.mass += share * node.mass[i];
    gone.momentum += share * node.inertia()[i] * vector_at<dim>(node.velocity, i);
    gone.enthalpy += heat;
  }

  /// elastic and kinetic, that left with matter taken off, less what came with matter fed in
  Energy energy_{"matter", EnergyKind::dissipated};
  Energy heat_{"heat_matter", EnergyKind::heat_received}; ///< C (T − T_start) of matter, which went
};

} // namespace

template<int dim> std::unique_ptr<Term<dim>> matter_flow(const Model<dim>& model) {
  return model.open ? std::make_unique<MatterFlow<dim>>() : nullptr;
}

template std::unique_ptr<Term<2>> matter_flow(const Model<2>&);
template std::unique_ptr<Term<3>> matter_flow(const Model<3>&);

} // namespace cnem
