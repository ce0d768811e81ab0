#include "mechanics/statics/statics.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "mechanics/statics/rigid_motion.hpp"
#include "mechanics/statics/sparse_solver.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <utility>

namespace cnem {

namespace {

using Vector = Eigen::VectorXd;

double lame_lambda(const StaticProblem& problem, std::size_t point) {
  const double lambda = problem.at_point(point).lambda(), mu = problem.at_point(point).mu();
  return problem.out_of_plane == OutOfPlane::stress_free ? 2.0 * lambda * mu / (lambda + 2.0 * mu) : lambda;
}

/// Unknowns q: what supports leave free of the coefficients u_a, u = T q + u0.
class FreeUnknowns {
public:
  explicit FreeUnknowns(const StaticProblem& problem) {
    const auto functions = index_of(problem.operators.nodes);
    map_.resize(functions);
    resize_all(given_, functions);
    std::vector<int> held(functions, 0);
    for (const auto& p : problem.supports.prescribed()) {
      const auto i = index_of(p.node);
      const double value = problem.supports.displacement(p.support, problem.time);
      for (std::size_t k = 0; k < 2; ++k) given_[k][i] += value * p.direction[static_cast<Eigen::Index>(k)];
      ++held[i];
    }
    std::vector<Mat<2>> free(functions, Mat<2>::Identity());
    for (const auto& constraint : problem.supports.constraints())
      free[index_of(constraint.node)] = constraint.free;
    for (std::size_t a = 0; a < functions; ++a) {
      Mat<2> rest = free[a];
      for (int d = held[a]; d < 2; ++d) {
        // The free directions: columns of the projector, made orthogonal one after another.
        Eigen::Index column = 0;
        rest.colwise().norm().maxCoeff(&column);
        const Vec<2> direction = rest.col(column).normalized();
        rest -= direction * (direction.transpose() * rest);
        map_[a].push_back({static_cast<int>(size_++), direction});
      }
    }
  }

  Eigen::Index size() const { return size_; }
  const Fields<2>& given() const { return given_; }

  /// visit(q, T_{(a,k) q}) for the unknowns that coefficient k of function a depends on.
  template<class Visit> void each(std::size_t a, std::size_t k, Visit&& visit) const {
    for (const auto& [q, direction] : map_[a])
      if (const double c = direction[static_cast<Eigen::Index>(k)]; c != 0.0) visit(q, c);
  }

  /// u = T q + u0.
  Fields<2> expand(const Vector& q) const {
    Fields<2> u = given_;
    for (std::size_t a = 0; a < map_.size(); ++a)
      for (std::size_t k = 0; k < 2; ++k) each(a, k, [&](int i, double c) { u[k][a] += c * q[i]; });
    return u;
  }

  /// Tᵀ f.
  Vector restrict(const Fields<2>& f) const {
    Vector q = Vector::Zero(size_);
    for (std::size_t a = 0; a < f[0].size(); ++a)
      for (std::size_t k = 0; k < 2; ++k) each(a, k, [&](int i, double c) { q[i] += c * f[k][a]; });
    return q;
  }

private:
  std::vector<std::vector<std::pair<int, Vec<2>>>> map_; ///< [function] free directions
  Fields<2> given_;                                      ///< [k][function] u0, m
  Eigen::Index size_ = 0;
};

/// Gradients of all points from coefficients: the strain out of the plane is filled in by stresses().
Fields<5> gradients(const StaticProblem& problem, const Fields<2>& u) {
  const DiscreteOperators<2>& op = problem.operators;
  Fields<5> g;
  resize_all(g, index_of(op.points));
  for (std::size_t p = 0; p < g[0].size(); ++p)
    for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
      const auto a = index_of(op.node[e]);
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t k = 0; k < 2; ++k) g[i * 2 + k][p] += u[i][a] * op.gradient[k][e];
      if (op.of_revolution()) g[4][p] += u[0][a] * op.hoop[e];
    }
  return g;
}

/// σ = λ* tr ε 1 + 2μ ε − 3κ* θ 1, θ the thermal strain; fills the out-of-plane component of ∇u where no hoop
/// strain is there. Without stress out of the plane λ* and 3κ* are 2μ/(λ + 2μ) of λ and 3κ.
Fields<4> stresses(const StaticProblem& problem, Fields<5>& g) {
  Fields<4> s;
  resize_all(s, g[0].size());
  for (std::size_t p = 0; p < g[0].size(); ++p) {
    const double lambda = problem.at_point(p).lambda(), mu = problem.at_point(p).mu(),
                 in_plane = lame_lambda(problem, p);
    const double trace = g[0][p] + g[3][p] + g[4][p];
    const double heat = (3.0 * lambda + 2.0 * mu) * problem.thermal_strain;
    const bool stress_free = problem.out_of_plane == OutOfPlane::stress_free;
    const double pressing = stress_free ? 2.0 * mu / (lambda + 2.0 * mu) * heat : heat;
    s[0][p] = in_plane * trace + 2.0 * mu * g[0][p] - pressing;
    s[1][p] = in_plane * trace + 2.0 * mu * g[3][p] - pressing;
    s[3][p] = mu * (g[1][p] + g[2][p]);
    if (stress_free)
      g[4][p] = (heat - lambda * trace) / (lambda + 2.0 * mu);
    else
      s[2][p] = lambda * trace + 2.0 * mu * g[4][p] - heat;
  }
  return s;
}

/// −Σ V σ b: minus the internal force of the stress points, on all functions.
Fields<2> internal_force(const StaticProblem& problem, const Fields<4>& stress) {
  const DiscreteOperators<2>& op = problem.operators;
  Fields<2> f;
  resize_all(f, index_of(op.nodes));
  for (std::size_t a = 0; a < f[0].size(); ++a)
    for (auto e = index_of(op.col_begin[a]); e < index_of(op.col_begin[a + 1]); ++e) {
      const auto p = index_of(op.point[e]);
      const double bx = op.weighted_gradient[0][e], by = op.weighted_gradient[1][e];
      f[0][a] += stress[0][p] * bx + stress[3][p] * by;
      f[1][a] += stress[3][p] * bx + stress[1][p] * by;
      if (op.of_revolution()) f[0][a] += stress[2][p] * op.weighted_hoop[e];
    }
  return f;
}

/// Rows of the edge defect, r = u_j − u_i − ½(∇u_i + ∇u_j) X_ij scaled by √(α μ L/d), one scalar row per link
/// i < j: visit(row, function, coefficient).
template<class Visit> std::size_t each_defect(const StaticProblem& problem, Visit&& visit) {
  const DiscreteOperators<2>& op = problem.link_points;
  std::size_t row = 0;
  if (problem.stabilisation <= 0.0 || problem.links.neighbour.empty()) return row;
  for (std::size_t i = 0; i + 1 < problem.links.begin.size(); ++i)
    for (auto l = index_of(problem.links.begin[i]); l < index_of(problem.links.begin[i + 1]); ++l) {
      const auto j = index_of(problem.links.neighbour[l]);
      if (j < i) continue;
      const double mu = 0.5 * (problem.at_point(i).mu() + problem.at_point(j).mu());
      const double root = std::sqrt(problem.stabilisation * mu * problem.links.weight[l]);
      const Vec<2> X = problem.position[j] - problem.position[i];
      visit(row, j, root);
      visit(row, i, -root);
      for (const std::size_t p : {i, j})
        for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
          double along = 0.0;
          for (std::size_t k = 0; k < 2; ++k) along += op.gradient[k][e] * X[static_cast<Eigen::Index>(k)];
          visit(row, index_of(op.node[e]), -0.5 * root * along);
        }
      ++row;
    }
  return row;
}

using Triplets = std::vector<Eigen::Triplet<double>>;

SparseMatrix matrix(std::size_t rows, Eigen::Index columns, const Triplets& entries) {
  SparseMatrix m(static_cast<Eigen::Index>(rows), columns);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

/// Σ Bᵀ (V D) B over the points [begin, end).
SparseMatrix elastic_stiffness(const StaticProblem& problem, const FreeUnknowns& unknowns, std::size_t begin,
                               std::size_t end) {
  const DiscreteOperators<2>& op = problem.operators;
  Triplets strain, stress; // rows per point: xx, yy, the engineering shear, and the hoop where there is one
  const int rows = op.of_revolution() ? 4 : 3;
  for (std::size_t p = begin; p < end; ++p) {
    const double lambda = lame_lambda(problem, p), mu = problem.at_point(p).mu();
    for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
      const auto a = index_of(op.node[e]);
      const double bx = op.gradient[0][e], by = op.gradient[1][e], V = op.volume[p];
      const double hoop = op.of_revolution() ? op.hoop[e] : 0.0;
      const auto row = rows * static_cast<int>(p - begin);
      const double b[2][4] = {{bx, 0.0, by, hoop}, {0.0, by, bx, 0.0}};
      for (std::size_t k = 0; k < 2; ++k)
        unknowns.each(a, k, [&](int q, double c) {
          const double* s = b[k];
          for (int r = 0; r < rows; ++r)
            if (s[r] != 0.0) strain.emplace_back(row + r, q, c * s[r]);
          const double volumetric = lambda * (s[0] + s[1] + s[3]);
          stress.emplace_back(row, q, V * c * (volumetric + 2.0 * mu * s[0]));
          stress.emplace_back(row + 1, q, V * c * (volumetric + 2.0 * mu * s[1]));
          if (s[2] != 0.0) stress.emplace_back(row + 2, q, V * c * mu * s[2]);
          if (rows == 4) stress.emplace_back(row + 3, q, V * c * (volumetric + 2.0 * mu * s[3]));
        });
    }
  }
  const std::size_t all = index_of(rows) * (end - begin);
  return matrix(all, unknowns.size(), strain).transpose() * matrix(all, unknowns.size(), stress);
}

/// Tᵀ K T with the edge defect. Points go in portions, so that memory follows K and not their number.
SparseMatrix stiffness(const StaticProblem& problem, const FreeUnknowns& unknowns) {
  constexpr std::size_t portion = 50000;
  const auto points = index_of(problem.operators.points);
  SparseMatrix K(unknowns.size(), unknowns.size());
  for (std::size_t begin = 0; begin < points; begin += portion)
    K += elastic_stiffness(problem, unknowns, begin, std::min(begin + portion, points));
  Triplets defect;
  const std::size_t rows = each_defect(problem, [&](std::size_t row, std::size_t a, double value) {
    for (std::size_t k = 0; k < 2; ++k)
      unknowns.each(
          a, k, [&](int q, double c) { defect.emplace_back(static_cast<int>(2 * row + k), q, c * value); });
  });
  if (rows > 0) {
    const SparseMatrix D = matrix(2 * rows, unknowns.size(), defect);
    K += SparseMatrix(D.transpose() * D);
  }
  return K;
}

/// Adds K_s u of the edge defect to `force` and returns its energy ½ uᵀ K_s u.
double add_defect_force(const StaticProblem& problem, const Fields<2>& u, Fields<2>& force) {
  Fields<2> r;
  const std::size_t rows = each_defect(problem, [](std::size_t, std::size_t, double) {});
  resize_all(r, rows);
  each_defect(problem, [&](std::size_t row, std::size_t a, double value) {
    for (std::size_t k = 0; k < 2; ++k) r[k][row] += value * u[k][a];
  });
  each_defect(problem, [&](std::size_t row, std::size_t a, double value) {
    for (std::size_t k = 0; k < 2; ++k) force[k][a] += value * r[k][row];
  });
  double energy = 0.0;
  for (const Field& component : r)
    for (const double x : component) energy += 0.5 * x * x;
  return energy;
}

double norm(const Fields<2>& f) {
  double sum = 0.0;
  for (const Field& component : f)
    for (const double x : component) sum += x * x;
  return std::sqrt(sum);
}

double dot(const Fields<2>& a, const Fields<2>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < std::min(a[k].size(), b[k].size()); ++i) sum += a[k][i] * b[k][i];
  return sum;
}

/// K u on all functions, and the energies that go with it.
Fields<2> internal(const StaticProblem& problem, StaticSolution& solution) {
  solution.gradient = gradients(problem, solution.displacement);
  solution.stress = stresses(problem, solution.gradient);
  Fields<2> f = internal_force(problem, solution.stress);
  double trace = 0.0; // Σ V tr σ
  for (std::size_t p = 0; p < solution.stress[0].size(); ++p)
    trace +=
        problem.operators.volume[p] * (solution.stress[0][p] + solution.stress[1][p] + solution.stress[2][p]);
  solution.thermal_work = -0.5 * problem.thermal_strain * trace;
  solution.strain_energy = 0.5 * dot(f, solution.displacement) + solution.thermal_work;
  solution.stabilisation_energy = add_defect_force(problem, solution.displacement, f);
  return f;
}

/// Throws DivergenceError for the first field of a solution that is not a number: loads so large that
/// stresses or energies leave the range of numbers do it.
void check_finite(const StaticProblem& problem, const StaticSolution& solution) {
  const auto fail = [&](std::string_view field, std::size_t node, double value, const char* of) {
    throw DivergenceError(
        fmt::format("the {} of the static solution is {} at {} {}, ({:.6g}, {:.6g}) m: loads "
                    "or stiffness leave the range of numbers",
                    field, value, of, node, problem.position[node].x(), problem.position[node].y()),
        static_cast<int>(node), std::string(field));
  };
  const std::size_t nodes = problem.position.size();
  const auto& [ux, uy] = solution.displacement;
  std::size_t moved_most = 0;
  for (std::size_t i = 0; i < nodes; ++i) {
    for (const double u : {ux[i], uy[i]})
      if (!std::isfinite(u)) fail("displacement", i, u, "node");
    if (std::hypot(ux[i], uy[i]) > std::hypot(ux[moved_most], uy[moved_most])) moved_most = i;
  }
  const DiscreteOperators<2>& op = problem.operators;
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

StaticSolution solve_statics(const StaticProblem& problem) {
  if (const std::string motion = missing_support(problem.operators, problem.position, problem.supports);
      !motion.empty())
    throw InputError(motion);
  const FreeUnknowns unknowns(problem);
  const auto functions = index_of(problem.operators.nodes);

  Fields<2> load = problem.force;
  for (Field& component : load) component.resize(functions, 0.0);
  StaticSolution solution;
  solution.displacement = unknowns.given();
  const Fields<2> held = internal(problem, solution);
  Fields<2> right = load;
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t a = 0; a < functions; ++a) right[k][a] -= held[k][a];

  const SparseCholesky cholesky(stiffness(problem, unknowns));
  solution.displacement = unknowns.expand(cholesky.solve(unknowns.restrict(right)));
  solution.condition = cholesky.condition();

  Fields<2> unbalanced = internal(problem, solution);
  double scale = std::max(norm(unbalanced), norm(load));
  if (problem.thermal_strain != 0.0) scale = std::max(scale, norm(held)); // nothing else where it is free
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t a = 0; a < functions; ++a) unbalanced[k][a] -= load[k][a];
  solution.residual = scale > 0.0 ? unknowns.restrict(unbalanced).norm() / scale : 0.0;

  resize_all(solution.reaction, problem.position.size());
  for (const auto& p : problem.supports.prescribed()) {
    const auto i = index_of(p.node);
    const double along = p.direction.x() * unbalanced[0][i] + p.direction.y() * unbalanced[1][i];
    solution.reaction[0][i] += along * p.direction.x();
    solution.reaction[1][i] += along * p.direction.y();
  }
  solution.external_work =
      0.5 * (dot(load, solution.displacement) + dot(solution.reaction, unknowns.given()));
  check_finite(problem, solution);
  return solution;
}

} // namespace cnem
