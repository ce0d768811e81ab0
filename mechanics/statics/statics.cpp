#include "mechanics/statics/statics.hpp"

#include "core/error.hpp"
#include "core/fields/vector_at.hpp"
#include "core/geometry/place_text.hpp"
#include "core/index.hpp"
#include "core/sparse_cholesky.hpp"
#include "mechanics/statics/rigid_motion.hpp"
#include "mechanics/statics/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <utility>

namespace cnem {

namespace {

template<int dim> double norm(const Fields<dim>& f) {
  double sum = 0.0;
  for (const Field& component : f)
    for (const double x : component) sum += x * x;
  return std::sqrt(sum);
}

template<int dim> double dot(const Fields<dim>& a, const Fields<dim>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < dim; ++k)
    for (std::size_t i = 0; i < std::min(a[k].size(), b[k].size()); ++i) sum += a[k][i] * b[k][i];
  return sum;
}

/// K u on all functions, and the energies that go with it.
template<int dim> Fields<dim> internal(const StaticProblem<dim>& problem, StaticSolution<dim>& solution) {
  solution.gradient = gradients<dim>(problem, solution.displacement);
  solution.stress = stresses<dim>(problem, solution.gradient);
  Fields<dim> f = internal_force<dim>(problem, solution.stress);
  double trace = 0.0; // Σ V tr σ
  for (std::size_t p = 0; p < solution.stress[0].size(); ++p)
    trace +=
        problem.operators.volume[p] * (solution.stress[0][p] + solution.stress[1][p] + solution.stress[2][p]);
  solution.thermal_work = -0.5 * problem.thermal_strain * trace;
  solution.strain_energy = 0.5 * dot<dim>(f, solution.displacement) + solution.thermal_work;
  solution.stabilisation_energy = add_defect_force<dim>(problem, solution.displacement, f);
  return f;
}

/// Throws DivergenceError for the first field of a solution that is not a number: loads so large that
/// stresses or energies leave the range of numbers do it.
template<int dim> void check_finite(const StaticProblem<dim>& problem, const StaticSolution<dim>& solution) {
  const auto fail = [&](std::string_view field, std::size_t node, double value, const char* of) {
    throw DivergenceError(
        fmt::format("the {} of the static solution is {} at {} {}, {} m: loads or stiffness "
                    "leave the range of numbers",
                    field, value, of, node, place_text(problem.position[node])),
        static_cast<int>(node), std::string(field));
  };
  const std::size_t nodes = problem.position.size();
  std::size_t moved_most = 0;
  const auto moved = [&](std::size_t i) { return vector_at<dim>(solution.displacement, i).norm(); };
  for (std::size_t i = 0; i < nodes; ++i) {
    for (const Field& component : solution.displacement)
      if (!std::isfinite(component[i])) fail("displacement", i, component[i], "node");
    if (moved(i) > moved(moved_most)) moved_most = i;
  }
  const DiscreteOperators<dim>& op = problem.operators;
  for (const Field& component : solution.stress)
    for (std::size_t p = 0; p < component.size(); ++p)
      if (!std::isfinite(component[p])) {
        const auto* const row = op.node.data();
        const auto* const near = std::min_element(row + op.row_begin[p],
                                                  row + op.row_begin[p + 1]); // functions beyond nodes enrich
        fail("stress", index_of(*near), component[p], "the point of node");
      }
  for (const Field& component : solution.reaction)
    for (std::size_t i = 0; i < nodes; ++i)
      if (!std::isfinite(component[i])) fail("reaction", i, component[i], "node");
  for (const auto& [name, value] : {std::pair("strain energy", solution.strain_energy),
                                    {"stabilisation energy", solution.stabilisation_energy},
                                    {"external work", solution.external_work},
                                    {"residual", solution.residual}})
    if (!std::isfinite(value)) fail(name, moved_most, value, "its largest displacement, that of node");
}

} // namespace

template<int dim> StaticSolution<dim> solve_statics(const StaticProblem<dim>& problem) {
  if (const std::string motion = missing_support(problem.operators, problem.position, problem.supports);
      !motion.empty())
    throw InputError(motion);
  const FreeUnknowns<dim> unknowns(problem);
  const auto functions = index_of(problem.operators.nodes);

  Fields<dim> load = problem.force;
  for (Field& component : load) component.resize(functions, 0.0);
  StaticSolution<dim> solution;
  solution.displacement = unknowns.given();
  const Fields<dim> held = internal(problem, solution);
  Fields<dim> right = load;
  for (std::size_t k = 0; k < dim; ++k)
    for (std::size_t a = 0; a < functions; ++a) right[k][a] -= held[k][a];

  const SparseCholesky cholesky(stiffness(problem, unknowns));
  solution.displacement = unknowns.expand(cholesky.solve(unknowns.restrict(right)));
  solution.condition = cholesky.condition();

  Fields<dim> unbalanced = internal(problem, solution);
  double scale = std::max(norm<dim>(unbalanced), norm<dim>(load));
  if (problem.thermal_strain != 0.0)
    scale = std::max(scale, norm<dim>(held)); // nothing else where it is free
  for (std::size_t k = 0; k < dim; ++k)
    for (std::size_t a = 0; a < functions; ++a) unbalanced[k][a] -= load[k][a];
  solution.residual = scale > 0.0 ? unknowns.restrict(unbalanced).norm() / scale : 0.0;

  resize_all(solution.reaction, problem.position.size());
  for (const auto& p : problem.supports.prescribed()) {
    const auto i = index_of(p.node);
    const double along = p.direction.dot(vector_at<dim>(unbalanced, i));
    for (std::size_t k = 0; k < dim; ++k)
      solution.reaction[k][i] += along * p.direction[static_cast<Eigen::Index>(k)];
  }
  solution.external_work =
      0.5 * (dot<dim>(load, solution.displacement) + dot<dim>(solution.reaction, unknowns.given()));
  check_finite(problem, solution);
  return solution;
}

template StaticSolution<2> solve_statics(const StaticProblem<2>&);
template StaticSolution<3> solve_statics(const StaticProblem<3>&);

} // namespace cnem
