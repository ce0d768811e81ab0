#include "mechanics/statics/stiffness.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cnem {
namespace {

template<int dim> double lame_lambda(const StaticProblem<dim>& problem, std::size_t point) {
  const double lambda = problem.at_point(point).lambda(), mu = problem.at_point(point).mu();
  return problem.out_of_plane == OutOfPlane::stress_free ? 2.0 * lambda * mu / (lambda + 2.0 * mu) : lambda;
}

using Triplets = std::vector<Eigen::Triplet<double>>;

SparseMatrix matrix(std::size_t rows, Eigen::Index columns, const Triplets& entries) {
  SparseMatrix m(static_cast<Eigen::Index>(rows), columns);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

/// Rows of strain at a point. In the plane xx, yy, the engineering shear, and the hoop where there is one; in
/// space xx, yy, zz, and the engineering shears xy, yz, zx.
template<int dim> struct StrainRows;
template<> struct StrainRows<2> {
  static constexpr int most = 4;
  static constexpr std::array<int, 3> normal{0, 1, 3};
  static int count(const DiscreteOperators<2>& op) { return op.of_revolution() ? 4 : 3; }
  static bool is_shear(int row) { return row == 2; }
  /// What displacement along k does, [k][row], 1/m.
  static std::array<std::array<double, most>, 2> of(const DiscreteOperators<2>& op, std::size_t e) {
    const double bx = op.gradient[0][e], by = op.gradient[1][e];
    const double hoop = op.of_revolution() ? op.hoop[e] : 0.0;
    return {{{bx, 0.0, by, hoop}, {0.0, by, bx, 0.0}}};
  }
};
template<> struct StrainRows<3> {
  static constexpr int most = 6;
  static constexpr std::array<int, 3> normal{0, 1, 2};
  static int count(const DiscreteOperators<3>&) { return most; }
  static bool is_shear(int row) { return row > 2; }
  static std::array<std::array<double, most>, 3> of(const DiscreteOperators<3>& op, std::size_t e) {
    const double bx = op.gradient[0][e], by = op.gradient[1][e], bz = op.gradient[2][e];
    return {{{bx, 0.0, 0.0, by, 0.0, bz}, {0.0, by, 0.0, bx, bz, 0.0}, {0.0, 0.0, bz, 0.0, by, bx}}};
  }
};

/// Rows of the edge defect, r = u_j − u_i − ½(∇u_i + ∇u_j) X_ij scaled by √(α μ w), w the weight of the link:
/// one scalar row per link i < j: visit(row, function, coefficient).
template<int dim, class Visit> std::size_t each_defect(const StaticProblem<dim>& problem, Visit&& visit) {
  const DiscreteOperators<dim>& op = problem.link_points;
  std::size_t row = 0;
  if (problem.stabilisation <= 0.0 || problem.links.neighbour.empty()) return row;
  for (std::size_t i = 0; i + 1 < problem.links.begin.size(); ++i)
    for (auto l = index_of(problem.links.begin[i]); l < index_of(problem.links.begin[i + 1]); ++l) {
      const auto j = index_of(problem.links.neighbour[l]);
      if (j < i) continue;
      const double mu = 0.5 * (problem.shear_modulus(i) + problem.shear_modulus(j));
      const double root = std::sqrt(problem.stabilisation * mu * problem.links.weight[l]);
      const Vec<dim> X = problem.position[j] - problem.position[i];
      visit(row, j, root);
      visit(row, i, -root);
      for (const std::size_t p : {i, j})
        for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
          double along = 0.0;
          for (std::size_t k = 0; k < dim; ++k) along += op.gradient[k][e] * X[static_cast<Eigen::Index>(k)];
          visit(row, index_of(op.node[e]), -0.5 * root * along);
        }
      ++row;
    }
  return row;
}

void ply_stresses(const plasticity::PlaneStiffness& ply, Fields<5>& g, Fields<4>& s) {
  for (std::size_t p = 0; p < g[0].size(); ++p) {
    const double strain[3] = {g[0][p], g[3][p], g[1][p] + g[2][p]};
    const auto over = [&](const double(&row)[3]) {
      return row[0] * strain[0] + row[1] * strain[1] + row[2] * strain[2];
    };
    s[0][p] = over(ply.D[0]);
    s[1][p] = over(ply.D[1]);
    s[3][p] = over(ply.D[2]);
    s[2][p] = over(ply.zz);
    g[4][p] = over(ply.thickness);
  }
}

/// Σ Bᵀ (V D) B over the points [begin, end).
template<int dim>
SparseMatrix elastic_stiffness(const StaticProblem<dim>& problem, const FreeUnknowns<dim>& unknowns,
                               std::size_t begin, std::size_t end) {
  using Rows = StrainRows<dim>;
  const DiscreteOperators<dim>& op = problem.operators;
  Triplets strain, stress;
  const int rows = Rows::count(op);
  for (std::size_t p = begin; p < end; ++p) {
    const double lambda = lame_lambda(problem, p), mu = problem.at_point(p).mu(), V = op.volume[p];
    for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
      const auto a = index_of(op.node[e]);
      const auto row = rows * static_cast<int>(p - begin);
      const auto b = Rows::of(op, e);
      for (std::size_t k = 0; k < dim; ++k)
        unknowns.each(a, k, [&](int q, double c) {
          const auto& s = b[k];
          double trace = 0.0;
          for (const int r : Rows::normal) trace += s[index_of(r)];
          for (int r = 0; r < rows; ++r) {
            const double component = s[index_of(r)];
            if (component != 0.0) strain.emplace_back(row + r, q, c * component);
            if (problem.ply) {
              const auto& D = problem.ply->D[r];
              stress.emplace_back(row + r, q, V * c * (D[0] * s[0] + D[1] * s[1] + D[2] * s[2]));
            } else if (!Rows::is_shear(r))
              stress.emplace_back(row + r, q, V * c * (lambda * trace + 2.0 * mu * component));
            else if (component != 0.0)
              stress.emplace_back(row + r, q, V * c * mu * component);
          }
        });
    }
  }
  const std::size_t all = index_of(rows) * (end - begin);
  return matrix(all, unknowns.size(), strain).transpose() * matrix(all, unknowns.size(), stress);
}

} // namespace

template<int dim> FreeUnknowns<dim>::FreeUnknowns(const StaticProblem<dim>& problem) {
  const auto functions = index_of(problem.operators.nodes);
  map_.resize(functions);
  resize_all(given_, functions);
  std::vector<int> held(functions, 0);
  for (const auto& p : problem.supports.prescribed()) {
    const auto i = index_of(p.node);
    const double value = problem.supports.displacement(p.support, problem.time);
    for (std::size_t k = 0; k < dim; ++k) given_[k][i] += value * p.direction[static_cast<Eigen::Index>(k)];
    ++held[i];
  }
  std::vector<Mat<dim>> free(functions, Mat<dim>::Identity());
  for (const auto& constraint : problem.supports.constraints())
    free[index_of(constraint.node)] = constraint.free;
  for (std::size_t a = 0; a < functions; ++a) {
    Mat<dim> rest = free[a];
    for (int d = held[a]; d < dim; ++d) {
      // The free directions: columns of the projector, made orthogonal one after another.
      Eigen::Index column = 0;
      rest.colwise().norm().maxCoeff(&column);
      const Vec<dim> direction = rest.col(column).normalized();
      rest -= direction * (direction.transpose() * rest);
      map_[a].push_back({static_cast<int>(size_++), direction});
    }
  }
}

template<int dim> Fields<dim> FreeUnknowns<dim>::expand(const Eigen::VectorXd& q) const {
  Fields<dim> u = given_;
  for (std::size_t a = 0; a < map_.size(); ++a)
    for (std::size_t k = 0; k < dim; ++k) each(a, k, [&](int i, double c) { u[k][a] += c * q[i]; });
  return u;
}

template<int dim> Eigen::VectorXd FreeUnknowns<dim>::restrict(const Fields<dim>& f) const {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(size_);
  for (std::size_t a = 0; a < f[0].size(); ++a)
    for (std::size_t k = 0; k < dim; ++k) each(a, k, [&](int i, double c) { q[i] += c * f[k][a]; });
  return q;
}

template<int dim>
SparseMatrix stiffness(const StaticProblem<dim>& problem, const FreeUnknowns<dim>& unknowns) {
  constexpr std::size_t portion = 50000; // so that memory follows K and not the number of points
  const auto points = index_of(problem.operators.points);
  SparseMatrix K(unknowns.size(), unknowns.size());
  for (std::size_t begin = 0; begin < points; begin += portion)
    K += elastic_stiffness(problem, unknowns, begin, std::min(begin + portion, points));
  Triplets defect;
  const std::size_t rows = each_defect(problem, [&](std::size_t row, std::size_t a, double value) {
    for (std::size_t k = 0; k < dim; ++k)
      unknowns.each(
          a, k, [&](int q, double c) { defect.emplace_back(static_cast<int>(dim * row + k), q, c * value); });
  });
  if (rows > 0) {
    const SparseMatrix D = matrix(dim * rows, unknowns.size(), defect);
    K += SparseMatrix(D.transpose() * D);
  }
  return K;
}

template<int dim>
Fields<tensor_size<dim>> gradients(const StaticProblem<dim>& problem, const Fields<dim>& u) {
  const DiscreteOperators<dim>& op = problem.operators;
  Fields<tensor_size<dim>> g;
  resize_all(g, index_of(op.points));
  for (std::size_t p = 0; p < g[0].size(); ++p)
    for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
      const auto a = index_of(op.node[e]);
      for (std::size_t i = 0; i < dim; ++i)
        for (std::size_t k = 0; k < dim; ++k) g[i * dim + k][p] += u[i][a] * op.gradient[k][e];
      if constexpr (dim == 2)
        if (op.of_revolution()) g[4][p] += u[0][a] * op.hoop[e];
    }
  return g;
}

template<> Fields<4> stresses<2>(const StaticProblem<2>& problem, Fields<5>& g) {
  Fields<4> s;
  resize_all(s, g[0].size());
  if (problem.ply) {
    ply_stresses(*problem.ply, g, s);
    return s;
  }
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

template<> Fields<6> stresses<3>(const StaticProblem<3>& problem, Fields<9>& g) {
  Fields<6> s;
  resize_all(s, g[0].size());
  for (std::size_t p = 0; p < g[0].size(); ++p) {
    const double lambda = problem.at_point(p).lambda(), mu = problem.at_point(p).mu();
    const double pressure_part =
        lambda * (g[0][p] + g[4][p] + g[8][p]) - (3.0 * lambda + 2.0 * mu) * problem.thermal_strain;
    for (std::size_t k = 0; k < 3; ++k) s[k][p] = pressure_part + 2.0 * mu * g[4 * k][p];
    s[3][p] = mu * (g[1][p] + g[3][p]);
    s[4][p] = mu * (g[5][p] + g[7][p]);
    s[5][p] = mu * (g[6][p] + g[2][p]);
  }
  return s;
}

template<int dim>
Fields<dim> internal_force(const StaticProblem<dim>& problem, const Fields<symmetric_size<dim>>& stress) {
  const DiscreteOperators<dim>& op = problem.operators;
  Fields<dim> f;
  resize_all(f, index_of(op.nodes));
  for (std::size_t a = 0; a < f[0].size(); ++a)
    for (auto e = index_of(op.col_begin[a]); e < index_of(op.col_begin[a + 1]); ++e) {
      const auto p = index_of(op.point[e]);
      const double bx = op.weighted_gradient[0][e], by = op.weighted_gradient[1][e];
      if constexpr (dim == 2) {
        f[0][a] += stress[0][p] * bx + stress[3][p] * by;
        f[1][a] += stress[3][p] * bx + stress[1][p] * by;
        if (op.of_revolution()) f[0][a] += stress[2][p] * op.weighted_hoop[e];
      } else {
        const double bz = op.weighted_gradient[2][e];
        f[0][a] += stress[0][p] * bx + stress[3][p] * by + stress[5][p] * bz;
        f[1][a] += stress[3][p] * bx + stress[1][p] * by + stress[4][p] * bz;
        f[2][a] += stress[5][p] * bx + stress[4][p] * by + stress[2][p] * bz;
      }
    }
  return f;
}

template<int dim>
double add_defect_force(const StaticProblem<dim>& problem, const Fields<dim>& u, Fields<dim>& force) {
  Fields<dim> r;
  const std::size_t rows = each_defect(problem, [](std::size_t, std::size_t, double) {});
  resize_all(r, rows);
  each_defect(problem, [&](std::size_t row, std::size_t a, double value) {
    for (std::size_t k = 0; k < dim; ++k) r[k][row] += value * u[k][a];
  });
  each_defect(problem, [&](std::size_t row, std::size_t a, double value) {
    for (std::size_t k = 0; k < dim; ++k) force[k][a] += value * r[k][row];
  });
  double energy = 0.0;
  for (const Field& component : r)
    for (const double x : component) energy += 0.5 * x * x;
  return energy;
}

template class FreeUnknowns<2>;
template class FreeUnknowns<3>;
template SparseMatrix stiffness(const StaticProblem<2>&, const FreeUnknowns<2>&);
template SparseMatrix stiffness(const StaticProblem<3>&, const FreeUnknowns<3>&);
template Fields<5> gradients<2>(const StaticProblem<2>&, const Fields<2>&);
template Fields<9> gradients<3>(const StaticProblem<3>&, const Fields<3>&);
template Fields<2> internal_force<2>(const StaticProblem<2>&, const Fields<4>&);
template Fields<3> internal_force<3>(const StaticProblem<3>&, const Fields<6>&);
template double add_defect_force<2>(const StaticProblem<2>&, const Fields<2>&, Fields<2>&);
template double add_defect_force<3>(const StaticProblem<3>&, const Fields<3>&, Fields<3>&);

} // namespace cnem
