// Tractions, pressures and body forces as a term of the step.
#include "mechanics/terms/list.hpp"

namespace cnem {

namespace {

template<int dim> class AppliedLoads : public Term<dim> {
public:
  std::vector<Energy*> energies() override { return {&work_}; }
  void archive(Archive& archive) override { archive.number("solver/energy/load_work_done", "J/m", done_); }

  void audit(const BodyView<dim>& body) override {
    const NodeState<dim>& node = body.state.node;
    const Fields<dim>& load = body.conditions.loads.force();
    work_.value = done_;
    if (body.conditions.loads.empty()) return;
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = 0; i < node.size(); ++i)
        work_.value += body.half_step * body.load_weight(i) * node.velocity[k][i] * load[k][i];
  }

  void attach(const Body<dim>& body) override { begin_forces(body, 0); }

  void moved(const Body<dim>& body, int activity, double dt_mean) override {
    if (body.conditions.loads.empty()) return;
    const NodeState<dim>& node = body.state.node;
    const Fields<dim>& f = body.conditions.loads.force();
    done_ += sum_ranges(body.levels.kicked(activity), [&](const LevelRange& range) {
      double sum = 0.0;
      for (std::size_t k = 0; k < dim; ++k)
        for (std::size_t i = range.begin; i < range.end; ++i)
          sum += 0.5 * dt_mean * body.load_weight(i) * f[k][i] *
                 (node.velocity_before[k][i] + node.velocity[k][i]);
      return sum;
    });
  }

  void begin_forces(const Body<dim>& body, int /*activity*/) override {
    body.conditions.loads.evaluate(body.state.time, body.state.node.position, body.state.node.mass);
  }

  void add_loads(const Body<dim>& body, const LevelRange& range) override {
    if (body.conditions.loads.empty()) return;
    const double steps = 1 << range.level;
    for (std::size_t k = 0; k < dim; ++k) {
      const Field& load = body.conditions.loads.force()[k];
      double* force = body.state.node.force[k].data();
      for (std::size_t i = range.begin; i < range.end; ++i) force[i] += steps * load[i];
    }
  }

private:
  Energy work_{"load_work", EnergyKind::received};
  double done_ = 0.0; ///< J/m^(3−dim) in the steps made, up to t_{n−½}
};

} // namespace

template<int dim> std::unique_ptr<Term<dim>> applied_loads(const Model<dim>&) {
  return std::make_unique<AppliedLoads<dim>>();
}

template std::unique_ptr<Term<2>> applied_loads(const Model<2>&);
template std::unique_ptr<Term<3>> applied_loads(const Model<3>&);

} // namespace cnem
