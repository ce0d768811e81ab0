// What the body itself holds and has dissipated, and what changes in that where references are renewed.
#include "core/machine/parallel.hpp"
#include "mechanics/terms/list.hpp"

namespace cnem {

template<int dim> double integral(const BodyView<dim>& body, const Field& density) {
  const Field& volume = body.operators().volume;
  const Field& stress_free = body.state.point.stress_free;
  return sum_blocks(volume.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t p = begin; p < end; ++p) sum += volume[p] * stress_free[p] * density[p];
    return sum;
  });
}

template<int dim> double kinetic_energy(const BodyView<dim>& body) {
  const NodeState<dim>& node = body.state.node;
  const Field& mass = node.inertia();
  return sum_blocks(node.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = begin; i < end; ++i) {
        const double v = node.velocity[k][i];
        sum += 0.5 * mass[i] * v * v + body.half_step * v * node.force[k][i];
      }
    return sum;
  });
}

namespace {

template<int dim> class BodyEnergy : public Term<dim> {
public:
  std::vector<Energy*> energies() override { return {&kinetic_, &elastic_, &plastic_, &inertial_}; }
  void audit(const BodyView<dim>& body) override {
    const NodeState<dim>& node = body.state.node;
    const Field& mass = node.inertia();
    kinetic_.value = kinetic_energy<dim>(body);
    inertial_.value = sum_blocks(node.size(), [&](std::size_t begin, std::size_t end) {
      double sum = 0.0;
      for (std::size_t k = 0; k < dim; ++k)
        for (std::size_t i = begin; i < end; ++i)
          sum += 0.5 * mass[i] * node.velocity[k][i] * node.velocity[k][i];
      return sum;
    });
    elastic_.value = integral<dim>(body, body.state.point.stored_energy);
    plastic_.value = body.plastic_offset + integral<dim>(body, body.state.point.plastic_work);
  }

private:
  Energy kinetic_{"kinetic", EnergyKind::held}; ///< ½ m v_{n−½}² carried to t_n by the known forces
  Energy elastic_{"elastic", EnergyKind::held}; ///< stored, (31)
  Energy plastic_{"plastic", EnergyKind::dissipated}; ///< ∫ σ_eq dε̄p
  Energy inertial_{"inertial", EnergyKind::noted}; ///< Σ ½ m v_{n−½}²: without what known forces add to it
};

template<int dim> class ReferenceEnergy : public Term<dim> {
public:
  std::vector<Energy*> energies() override { return {&rereference_, &resampling_}; }
  void leave(const Body<dim>& body) override {
    elastic_ = integral<dim>(body, body.state.point.stored_energy);
    plastic_ = integral<dim>(body, body.state.point.plastic_work);
    kinetic_ = kinetic_energy<dim>(body);
    left_ = true;
  }
  void settle(const Body<dim>& body, bool resampled, const Booked& booked) override {
    if (!left_) return;
    rereference_.value += elastic_ - booked.elastic - integral<dim>(body, body.state.point.stored_energy);
    body.plastic_offset += plastic_ - integral<dim>(body, body.state.point.plastic_work);
    if (resampled) resampling_.value += kinetic_ - booked.kinetic - kinetic_energy<dim>(body);
    left_ = false;
  }

private:
  /// stored energy lost (gained when negative) as stress-free volumes are measured anew
  Energy rereference_{"rereference", EnergyKind::dissipated};
  /// kinetic energy lost where matter of several nodes took one velocity and the forces of a changed cloud
  /// replaced those before
  Energy resampling_{"resampling", EnergyKind::dissipated};
  double elastic_ = 0.0, plastic_ = 0.0, kinetic_ = 0.0; ///< J/m^(3−dim), of the reference that was left
  bool left_ = false;
};

} // namespace

template<int dim> std::unique_ptr<Term<dim>> body_energy(const Model<dim>&) {
  return std::make_unique<BodyEnergy<dim>>();
}
template<int dim> std::unique_ptr<Term<dim>> reference_energy(const Model<dim>&) {
  return std::make_unique<ReferenceEnergy<dim>>();
}

template std::unique_ptr<Term<2>> body_energy(const Model<2>&);
template std::unique_ptr<Term<3>> body_energy(const Model<3>&);
template std::unique_ptr<Term<2>> reference_energy(const Model<2>&);
template std::unique_ptr<Term<3>> reference_energy(const Model<3>&);
template double integral<2>(const BodyView<2>&, const Field&);
template double integral<3>(const BodyView<3>&, const Field&);
template double kinetic_energy<2>(const BodyView<2>&);
template double kinetic_energy<3>(const BodyView<3>&);

} // namespace cnem
