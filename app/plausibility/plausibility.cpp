#include "app/plausibility/plausibility.hpp"

#include "app/plausibility/list.hpp"

namespace cnem::app {

std::vector<std::string> doubts(const input::Case& input) {
  Doubts list;
  doubt_materials(input, list);
  doubt_output(input, list);
  return list;
}

template<int dim>
std::vector<std::string> doubts(const input::Case& input, const ExplicitSolver<dim>& solver) {
  Doubts list = doubts(input);
  doubt_motions(input, solver, list);
  if constexpr (dim == 2) {
    doubt_edges(input, solver, list);
    doubt_bodies(input, solver, list);
  }
  return list;
}

template std::vector<std::string> doubts(const input::Case&, const ExplicitSolver<2>&);
template std::vector<std::string> doubts(const input::Case&, const ExplicitSolver<3>&);

} // namespace cnem::app
