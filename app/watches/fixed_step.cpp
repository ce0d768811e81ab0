#include "app/watches/fixed_step.hpp"

#include <fmt/format.h>

namespace cnem::app {

template<int dim>
std::vector<std::string> unstable_fixed_step(const input::Case& input, ExplicitSolver<dim>& solver) {
  if (!input.time.fixed) return {};
  const double stable = solver.stable_step().dt, bound = stable / input.time.safety;
  if (*input.time.fixed <= bound) return {};
  return {input
              .error("time.step.fixed",
                     fmt::format(
                         "{:.3g} s is {:.2g} times the longest step with which waves do not grow: expected "
                         "{:.3g} s or less, or none, so that it follows the cells",
                         *input.time.fixed, *input.time.fixed / bound, stable))
              .what()};
}

template std::vector<std::string> unstable_fixed_step(const input::Case&, ExplicitSolver<2>&);
template std::vector<std::string> unstable_fixed_step(const input::Case&, ExplicitSolver<3>&);

} // namespace cnem::app
