#include "mechanics/terms/list.hpp"

namespace cnem {

template<int dim> std::vector<std::unique_ptr<Term<dim>>> make_terms(const Model<dim>& model) {
  std::vector<std::unique_ptr<Term<dim>>> terms;
  for (const auto make :
       {body_energy<dim>, equation_of_state<dim>, point_damage<dim>, thermal_expansion<dim>,
        bulk_viscosity<dim>, plane_stress<dim>, plies<dim>, contact_and_supports<dim>, cohesive<dim>,
        edge_defect<dim>, reference_energy<dim>, pressure_exchange<dim>, stress_annealing<dim>,
        matter_flow<dim>, applied_loads<dim>, heat<dim>, tool_heat<dim>})
    if (auto term = make(model)) terms.push_back(std::move(term));
  return terms;
}

template std::vector<std::unique_ptr<Term<2>>> make_terms(const Model<2>&);
template std::vector<std::unique_ptr<Term<3>>> make_terms(const Model<3>&);

} // namespace cnem
