// Tractions of cohesive interfaces as a term of the step.
#include "mechanics/terms/list.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem {

namespace {

class Cohesive : public Term<2> {
public:
  std::vector<Energy*> energies() override { return {&stored_, &dissipated_}; }

  std::vector<Metric> metrics(const BodyView<2>& body) const override {
    std::vector<Metric> metrics;
    for (const CohesiveInterface& interface : body.conditions.cohesive.interfaces()) {
      const std::string name = fmt::format("cohesive.{}.broken[m]", interface.spec.name);
      metrics.push_back({name, CohesiveFaces::broken_length(interface), name});
    }
    return metrics;
  }

  void limit(const Body<2>& body, StepLimit& limit) override {
    limit.springs +=
        body.conditions.cohesive.frequency_bound(body.state.node.position, body.state.node.inertia());
  }
  void stiffen(const Body<2>& body, Field& rows) override {
    const Field own = body.conditions.cohesive.stiffness_rows(body.state.node.position);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] += own[i];
  }

  void renew(const Body<2>& body) override { leave_to_contact(body); }

  void attach(const Body<2>& body) override { look(body); }

  /// What resampling has taken of the stored energy, or given, goes to what is dissipated.
  void settle(const Body<2>&, bool resampled, const Booked&) override {
    if (resampled) dissipated_.value = before_ - stored_.value;
  }
  void leave(const Body<2>&) override { before_ = stored_.value + dissipated_.value; }

  void begin_forces(const Body<2>& body, int /*activity*/) override {
    look(body);
    if (body.conditions.cohesive.has_broken()) leave_to_contact(body);
  }

  void add_loads(const Body<2>& body, const LevelRange& range) override {
    for (std::size_t k = 0; k < 2; ++k) {
      const Field& push = body.conditions.cohesive.force()[k];
      double* force = body.state.node.force[k].data();
      for (std::size_t i = range.begin; i < range.end; ++i) force[i] += push[i];
    }
  }

private:
  void look(const Body<2>& body) {
    const CohesiveWork work = body.conditions.cohesive.evaluate(body.state.node.position);
    stored_.value = work.stored;
    dissipated_.value += work.dissipated;
  }
  static void leave_to_contact(const Body<2>& body) {
    Conditions<2>& conditions = body.conditions;
    conditions.contact.set_bonds(conditions.cohesive.bonds(conditions.cloud));
  }

  Energy stored_{"cohesive_elastic", EnergyKind::held}; ///< of faces that separate or are pressed together
  Energy dissipated_{"cohesive_damage", EnergyKind::dissipated}; ///< by the growth of their damage
  double before_ = 0.0; ///< J/m, both under the reference that is left
};

} // namespace

template<> std::unique_ptr<Term<2>> cohesive(const Model<2>& model) {
  if (!model.separating) return nullptr;
  return std::make_unique<Cohesive>();
}
template<> std::unique_ptr<Term<3>> cohesive(const Model<3>&) { return nullptr; }

} // namespace cnem
