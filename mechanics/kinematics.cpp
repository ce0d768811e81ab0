#include "mechanics/kinematics.hpp"

#include "core/index.hpp"
#include "core/machine/isa.hpp"
#include "mechanics/step_kernels.hpp"

#include <algorithm>

namespace cnem {

namespace {

template<int dim>
void deformation_rows_of(const DiscreteOperators<dim>& op, const double* position, double* const* deformation,
                         std::ptrdiff_t begin, std::ptrdiff_t end) {
  const auto rows = sparse_rows<dim>(op.row_begin, op.node, op.gradient);
  CNEM_ON_ACTIVE_ISA(deformation_rows(rows, position, deformation, begin, end));
}

template<int dim>
void force_columns_of(const DiscreteOperators<dim>& op, const double* stress, double* const* force,
                      std::ptrdiff_t begin, std::ptrdiff_t end) {
  const auto columns = sparse_rows<dim>(op.col_begin, op.point, op.weighted_gradient);
  CNEM_ON_ACTIVE_ISA(force_columns(columns, stress, force, begin, end));
}

} // namespace

template<int dim>
void deformation_gradient(const DiscreteOperators<dim>& operators, const Field& position,
                          Fields<tensor_size<dim>>& deformation, std::size_t begin, std::size_t end) {
  deformation_rows_of(operators, position.data(), pointers(deformation).data(),
                      static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end));
  if constexpr (dim == 2) {
    if (!operators.of_revolution()) return;
    for (std::size_t p = begin; p < end; ++p) {
      double stretch = 0.0;
      for (std::size_t e = index_of(operators.row_begin[p]); e < index_of(operators.row_begin[p + 1]); ++e)
        stretch += operators.hoop[e] * position[beside<dim> * index_of(operators.node[e])];
      deformation[4][p] = stretch;
    }
  }
}

template<int dim>
void interpolate(const DiscreteOperators<dim>& operators, const Field& nodal, Field& at_points,
                 std::size_t begin, std::size_t end) {
  if (operators.nodal) {
    std::copy(nodal.begin() + static_cast<std::ptrdiff_t>(begin),
              nodal.begin() + static_cast<std::ptrdiff_t>(end),
              at_points.begin() + static_cast<std::ptrdiff_t>(begin));
    return;
  }
  for (std::size_t p = begin; p < end; ++p) {
    double sum = 0.0;
    for (std::size_t e = index_of(operators.row_begin[p]); e < index_of(operators.row_begin[p + 1]); ++e)
      sum += operators.value[e] * nodal[index_of(operators.node[e])];
    at_points[p] = sum;
  }
}

template<int dim>
double average_at_node(const DiscreteOperators<dim>& operators, const Field& at_points, NodeIndex node) {
  if (operators.nodal) return at_points[index_of(point_of(node))];
  double sum = 0.0, weight = 0.0;
  const std::size_t j = index_of(node);
  for (std::size_t e = index_of(operators.col_begin[j]); e < index_of(operators.col_begin[j + 1]); ++e) {
    sum += operators.weighted_value[e] * at_points[index_of(operators.point[e])];
    weight += operators.weighted_value[e];
  }
  return sum / weight;
}

template<int dim> Field average_at_nodes(const DiscreteOperators<dim>& operators, const Field& at_points) {
  Field nodal(index_of(operators.nodes));
  for (std::size_t i = 0; i < nodal.size(); ++i)
    nodal[i] = average_at_node(operators, at_points, as<NodeIndex>(i));
  return nodal;
}

template<int dim> void copy_stress_columns(const Fields<tensor_size<dim>>& piola, ColumnStress<dim>& stress) {
  const std::size_t n = piola[0].size();
  stress.columns.resize(column_stress<dim> * n);
  for (std::size_t p = 0; p < n; ++p)
    for (std::size_t i = 0; i < dim; ++i)
      for (std::size_t k = 0; k < dim; ++k)
        stress.columns[(p * dim + k) * beside<dim> + i] = piola[i * dim + k][p];
  if constexpr (dim == 2) stress.out_of_plane = piola[4];
}

template<int dim>
void subtract_internal_force(const DiscreteOperators<dim>& operators, const ColumnStress<dim>& stress,
                             Fields<dim>& force, std::size_t begin, std::size_t end) {
  force_columns_of(operators, stress.columns.data(), pointers(force).data(),
                   static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end));
  if constexpr (dim == 2) {
    if (!operators.of_revolution()) return;
    for (std::size_t j = begin; j < end; ++j) {
      double f = 0.0;
      for (std::size_t e = index_of(operators.col_begin[j]); e < index_of(operators.col_begin[j + 1]); ++e)
        f += stress.out_of_plane[index_of(operators.point[e])] * operators.weighted_hoop[e];
      force[0][j] -= f;
    }
  }
}

template<> void push_forward<2>(PointState<2>& point) {
  constexpr int xx = 0, yy = 1, zz = 2, xy = 3;
  for (std::size_t p = 0; p < point.size(); ++p) {
    const double f11 = point.deformation[0][p], f12 = point.deformation[1][p], f21 = point.deformation[2][p],
                 f22 = point.deformation[3][p], f33 = point.deformation[4][p];
    const double c11 = point.inverse_plastic_cauchy_green[xx][p],
                 c22 = point.inverse_plastic_cauchy_green[yy][p],
                 c12 = point.inverse_plastic_cauchy_green[xy][p];
    point.inverse_plastic_cauchy_green[xx][p] = f11 * f11 * c11 + 2.0 * f11 * f12 * c12 + f12 * f12 * c22;
    point.inverse_plastic_cauchy_green[yy][p] = f21 * f21 * c11 + 2.0 * f21 * f22 * c12 + f22 * f22 * c22;
    point.inverse_plastic_cauchy_green[xy][p] =
        f11 * f21 * c11 + (f11 * f22 + f12 * f21) * c12 + f12 * f22 * c22;
    point.inverse_plastic_cauchy_green[zz][p] *= f33 * f33;
    if (!point.oriented.on()) continue;
    Fields<5>& earlier = point.earlier_deformation;
    for (std::size_t k = 0; k < 2; ++k) {
      const double upper = earlier[k][p], lower = earlier[2 + k][p];
      earlier[k][p] = f11 * upper + f12 * lower;
      earlier[2 + k][p] = f21 * upper + f22 * lower;
    }
    earlier[4][p] *= f33;
  }
}

template<> void push_forward<3>(PointState<3>& point) {
  constexpr int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}; // of components of a symmetric tensor
  for (std::size_t p = 0; p < point.size(); ++p) {
    Mat<3> f, c;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        f(i, k) = point.deformation[index_of(3 * i + k)][p];
        c(i, k) = point.inverse_plastic_cauchy_green[index_of(place[i][k])][p];
      }
    const Mat<3> pushed = f * c * f.transpose();
    for (int i = 0; i < 3; ++i)
      for (int k = i; k < 3; ++k) point.inverse_plastic_cauchy_green[index_of(place[i][k])][p] = pushed(i, k);
    if (!point.oriented.on()) continue;
    Mat<3> earlier;
    for (int i = 0; i < 9; ++i) earlier(i / 3, i % 3) = point.earlier_deformation[index_of(i)][p];
    const Mat<3> total = f * earlier;
    for (int i = 0; i < 9; ++i) point.earlier_deformation[index_of(i)][p] = total(i / 3, i % 3);
  }
}

template<int dim>
std::array<double, tensor_size<dim>> cofactors(const Fields<tensor_size<dim>>& f, std::size_t p) {
  std::array<double, tensor_size<dim>> c{};
  if constexpr (dim == 2) {
    c = {f[3][p] * f[4][p], -f[2][p] * f[4][p], -f[1][p] * f[4][p], f[0][p] * f[4][p],
         f[0][p] * f[3][p] - f[1][p] * f[2][p]};
  } else {
    const auto at = [&](std::size_t i, std::size_t k) { return f[i % 3 * 3 + k % 3][p]; };
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        c[i * 3 + k] = at(i + 1, k + 1) * at(i + 2, k + 2) - at(i + 1, k + 2) * at(i + 2, k + 1);
  }
  return c;
}

template<> double jacobian<2>(const Fields<5>& f, std::size_t p) {
  return (f[0][p] * f[3][p] - f[1][p] * f[2][p]) * f[4][p];
}

template<> double jacobian<3>(const Fields<9>& f, std::size_t p) {
  return f[0][p] * (f[4][p] * f[8][p] - f[5][p] * f[7][p]) -
         f[1][p] * (f[3][p] * f[8][p] - f[5][p] * f[6][p]) +
         f[2][p] * (f[3][p] * f[7][p] - f[4][p] * f[6][p]);
}

#define CNEM_INSTANTIATE(dim)                                                                                \
  template std::array<double, tensor_size<dim>> cofactors<dim>(const Fields<tensor_size<dim>>&,              \
                                                               std::size_t);                                 \
  template void deformation_gradient<dim>(const DiscreteOperators<dim>&, const Field&,                       \
                                          Fields<tensor_size<dim>>&, std::size_t, std::size_t);              \
  template void interpolate<dim>(const DiscreteOperators<dim>&, const Field&, Field&, std::size_t,           \
                                 std::size_t);                                                               \
  template double average_at_node<dim>(const DiscreteOperators<dim>&, const Field&, NodeIndex);              \
  template Field average_at_nodes<dim>(const DiscreteOperators<dim>&, const Field&);                         \
  template void copy_stress_columns<dim>(const Fields<tensor_size<dim>>&, ColumnStress<dim>&);               \
  template void subtract_internal_force<dim>(const DiscreteOperators<dim>&, const ColumnStress<dim>&,        \
                                             Fields<dim>&, std::size_t, std::size_t);
CNEM_INSTANTIATE(2)
CNEM_INSTANTIATE(3)
#undef CNEM_INSTANTIATE

} // namespace cnem
