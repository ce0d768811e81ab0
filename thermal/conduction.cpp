#include "thermal/conduction.hpp"

#include "core/index.hpp"
#include "core/machine/isa.hpp"
#include "core/machine/parallel.hpp"
#include "core/operators/leading_simplices.hpp"
#include "core/operators/side_by_side.hpp"
#include "core/vec.hpp"
#include "thermal/conduction_kernels.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cnem {

namespace {

template<int dim> struct Row {
  Mat<dim> deformation = Mat<dim>::Zero();
  double hoop = 1.0; ///< r/R of revolution
};

template<int dim>
Row<dim> row_of(const DiscreteOperators<dim>& operators, std::size_t unread, const Field& position,
                std::size_t p) {
  Row<dim> row;
  if (operators.of_revolution()) row.hoop = 0.0;
  for (auto e = index_of(operators.row_begin[p]); e < index_of(operators.row_begin[p + 1]); ++e) {
    const auto j = index_of(operators.node[e]);
    if (operators.of_revolution()) row.hoop += operators.hoop[e] * position[beside<dim> * j];
    for (int k = 0; k < dim; ++k) {
      const double b = operators.gradient[index_of(k)][e - unread];
      for (int i = 0; i < dim; ++i) row.deformation(i, k) += position[beside<dim> * j + index_of(i)] * b;
    }
  }
  return row;
}

} // namespace

template<int dim>
void Conduction<dim>::set_operators(const DiscreteOperators<dim>& operators, Field conductivity) {
  operators_ = &operators;
  conductivity_ = given_ = std::move(conductivity);
  limited_ = false;
  corner_.clear();
  simplices_ = operators.of_revolution() || operators.nodal ? 0 : leading_simplices(operators);
  if (dim == 2 && simplices_ < index_of(operators.points)) simplices_ = 0; // in the plane all rows or none
  unread_ = operators.node.size() - operators.gradient[0].size();
  flux_.assign(dim * (index_of(operators.points) - simplices_), 0.0);
  const bool by_entries = dim == 3 ? !operators.nodal : simplices_ > 0;
  heat_.assign(by_entries ? operators.node.size() : 0, 0.0);
  if (by_entries) number_corners();
}

namespace {

template<int dim>
void flux(const OperatorRows<dim>& rows, std::size_t unread, const double* hoop, const Field& position,
          const Field& temperature, const Field& conductivity, double* flux, std::size_t begin,
          std::size_t end) {
  CNEM_ON_ACTIVE_ISA(conduction_flux(rows, static_cast<std::ptrdiff_t>(unread), hoop, position.data(),
                                     temperature.data(), conductivity.data(), flux,
                                     static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end)));
}

template<int dim>
void subtract_flow(const OperatorColumns<dim>& columns, const Field& flux, Field& flow, std::size_t begin,
                   std::size_t end) {
  CNEM_ON_ACTIVE_ISA(conduction_flow(columns, flux.data(), flow.data(), static_cast<std::ptrdiff_t>(begin),
                                     static_cast<std::ptrdiff_t>(end)));
}

template<int dim>
void simplex_heat(const std::vector<NodeIndex>& corner, const Field& position, const Field& temperature,
                  const Field& conductivity, Field& heat, std::size_t begin, std::size_t end) {
  const auto first = static_cast<std::ptrdiff_t>(begin), last = static_cast<std::ptrdiff_t>(end);
  if constexpr (dim == 2) {
    CNEM_ON_ACTIVE_ISA(conduction_triangles(corner.data(), position.data(), temperature.data(),
                                            conductivity.data(), heat.data(), first, last));
  } else {
    CNEM_ON_ACTIVE_ISA(conduction_tetrahedra(corner.data(), position.data(), temperature.data(),
                                             conductivity.data(), heat.data(), first, last));
  }
}

template<int dim>
void add_corners(const DiscreteOperators<dim>& op, const std::vector<std::int32_t>& corner, const Field& heat,
                 Field& flow, std::size_t begin, std::size_t end) {
  CNEM_ON_ACTIVE_ISA(conduction_corners(op.col_begin.data(), corner.data(), heat.data(), flow.data(),
                                        static_cast<std::ptrdiff_t>(begin),
                                        static_cast<std::ptrdiff_t>(end)));
}

} // namespace

/// Where each entry of a column finds its corner, and triangles counter-clockwise. Tetrahedra conduct as well
/// from either side.
template<int dim> void Conduction<dim>::number_corners() {
  const DiscreteOperators<dim>& op = *operators_;
  if constexpr (dim == 2) {
    triangle_ = op.node;
    for (std::size_t first = 0; first < op.node.size(); first += 3) {
      const Field &bx = op.gradient[0], &by = op.gradient[1];
      const bool clockwise = bx[first] * by[first + 1] - by[first] * bx[first + 1] < 0.0;
      if (clockwise) std::swap(triangle_[first + 1], triangle_[first + 2]);
    }
  }
  const std::vector<NodeIndex>& node = dim == 2 ? triangle_ : op.node;
  corner_.resize(node.size());
  std::vector<std::int32_t> next(op.col_begin.begin(), op.col_begin.end() - 1);
  for (std::size_t e = 0; e < node.size(); ++e) // by increasing row, as columns are
    corner_[index_of(next[index_of(node[e])]++)] = as<std::int32_t>(e);
}

template<int dim>
void Conduction<dim>::add_simplex_flow(const Field& position, const Field& temperature, Field& flow) {
  const DiscreteOperators<dim>& op = *operators_;
  const std::vector<NodeIndex>& corner = dim == 2 ? triangle_ : op.node;
  for_each_block(simplices_, [&](std::size_t begin, std::size_t end) {
    simplex_heat<dim>(corner, position, temperature, conductivity_, heat_, begin, end);
  });
  heat_other_rows(position, temperature);
  for_each_block(index_of(op.nodes), [&](std::size_t begin, std::size_t end) {
    add_corners(op, corner_, heat_, flow, begin, end);
  });
}

/// Rows behind the linear simplices: flat tetrahedra together with their neighbours.
template<int dim> void Conduction<dim>::heat_other_rows(const Field& position, const Field& temperature) {
  const DiscreteOperators<dim>& op = *operators_;
  if (simplices_ == index_of(op.points)) return;
  const auto rows = sparse_rows<dim>(op.row_begin, op.node, op.gradient);
  for_each_block(index_of(op.points) - simplices_, [&](std::size_t begin, std::size_t end) {
    flux(rows, unread_, nullptr, position, temperature, conductivity_, flux_.data() + dim * begin,
         simplices_ + begin, simplices_ + end);
    for (std::size_t p = simplices_ + begin; p < simplices_ + end; ++p) {
      const double* q = flux_.data() + dim * (p - simplices_);
      for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
        double along = 0.0;
        for (std::size_t k = 0; k < dim; ++k) along += q[k] * op.gradient[k][e - unread_];
        heat_[e] = -op.volume[p] * along;
      }
    }
  });
}

template<int dim>
void Conduction<dim>::add_flow(const Field& position, const Field& temperature, Field& flow) {
  if (!corner_.empty()) return add_simplex_flow(position, temperature, flow);
  const DiscreteOperators<dim>& op = *operators_;
  const auto rows = sparse_rows<dim>(op.row_begin, op.node, op.gradient);
  const auto columns = sparse_rows<dim>(op.col_begin, op.point, op.weighted_gradient);
  const double* hoop = op.of_revolution() ? op.hoop.data() : nullptr;
  for_each_block(index_of(op.points), [&](std::size_t begin, std::size_t end) {
    flux(rows, unread_, hoop, position, temperature, conductivity_, flux_.data() + dim * begin, begin, end);
  });
  for_each_block(index_of(op.nodes), [&](std::size_t begin, std::size_t end) {
    subtract_flow(columns, flux_, flow, begin, end);
  });
}

/// det F with which the kernels let a row of the plane conduct.
template<int dim> double Conduction<dim>::conducting_determinant(const Mat2& f, std::size_t p) const {
  const DiscreteOperators<dim>& op = *operators_;
  if (corner_.empty()) return conducting(f.determinant(), least_of_square * f.squaredNorm());
  double squares = 0.0; // a side of a triangle is 2A |F⁻ᵀ b|, b the gradient opposite to it
  for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
    const double bx = op.gradient[0][e], by = op.gradient[1][e];
    squares += Vec2(f(1, 1) * bx - f(1, 0) * by, f(0, 0) * by - f(0, 1) * bx).squaredNorm();
  }
  return conducting(f.determinant(), least_of_sides * 2.0 * op.volume[p] * squares);
}

/// ∇φ of the corners of a tetrahedron and 6V, with which the kernels let it conduct.
std::pair<std::array<Vec3, 4>, double> conducting_gradients(const NodeIndex* corner, const Field& position) {
  Vec3 x[4];
  for (int c = 0; c < 4; ++c) x[c] = Vec3::Map(position.data() + beside<3> * index_of(corner[c]));
  const Vec3 opposite[3] = {(x[2] - x[0]).cross(x[3] - x[0]), (x[3] - x[0]).cross(x[1] - x[0]),
                            (x[1] - x[0]).cross(x[2] - x[0])};
  double squares = 0.0;
  for (int c = 0; c < 4; ++c)
    for (int d = c + 1; d < 4; ++d) squares += (x[d] - x[c]).squaredNorm();
  const double carrying =
      conducting((x[1] - x[0]).dot(opposite[0]), least_of_edges * squares * std::sqrt(squares));
  const Vec3 sum = opposite[0] + opposite[1] + opposite[2];
  return {{-sum / carrying, opposite[0] / carrying, opposite[1] / carrying, opposite[2] / carrying},
          carrying};
}

/// Gershgorin's bound as for waves, with b = F⁻ᵀ b_r and V = V_r det F (mechanics/stable_step.hpp): |b| of
/// the entries, Σ V k |b| and Σ V of the nodes.
template<int dim> void Conduction<dim>::look_at_transfer(const Field& position) {
  const DiscreteOperators<dim>& op = *operators_;
  transfer_.assign(index_of(op.nodes), 0.0);
  around_.assign(index_of(op.nodes), 0.0);
  norm_.resize(op.node.size());
  for (std::size_t p = 0; p < index_of(op.points); ++p) {
    if constexpr (dim == 3)
      if (p < simplices_) {
        const auto [gradient, carrying] = conducting_gradients(op.node.data() + 4 * p, position);
        for (std::size_t e = 4 * p; e < 4 * p + 4; ++e) {
          norm_[e] = gradient[e % 4].norm();
          transfer_[index_of(op.node[e])] += carrying / 6.0 * conductivity_[p] * norm_[e];
          around_[index_of(op.node[e])] += carrying / 6.0;
        }
        continue;
      }
    const Row<dim> row = row_of<dim>(op, unread_, position, p);
    Mat<dim> inverse_transpose = row.deformation.inverse().transpose();
    double determinant = row.deformation.determinant();
    if constexpr (dim == 2)
      if (const double conducting = conducting_determinant(row.deformation, p); conducting != determinant) {
        determinant = conducting;
        const Mat2& f = row.deformation;
        inverse_transpose << f(1, 1), -f(1, 0), -f(0, 1), f(0, 0);
        inverse_transpose /= conducting;
      }
    if constexpr (dim == 3) {
      const Mat<dim>& f = row.deformation;
      determinant = conducting(determinant, least_of_cube * f.squaredNorm() * f.norm());
      for (int k = 0; k < 3; ++k)
        inverse_transpose.col(k) = f.col((k + 1) % 3).cross(f.col((k + 2) % 3)) / determinant;
    }
    const double volume = op.volume[p] * determinant * row.hoop;
    for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
      Vec<dim> b;
      for (int k = 0; k < dim; ++k) b[k] = op.gradient[index_of(k)][e - unread_];
      norm_[e] = (inverse_transpose * b).norm();
      transfer_[index_of(op.node[e])] += volume * conductivity_[p] * norm_[e];
      around_[index_of(op.node[e])] += volume;
    }
  }
}

template<int dim> double Conduction<dim>::fastest_decay(const Field& position, const Field& heat_capacity) {
  lift_limit();
  look_at_transfer(position);
  const double decay = decay_bound(heat_capacity);
  norm_ = Field();
  return decay;
}

template<int dim> double Conduction<dim>::decay_bound(const Field& heat_capacity) const {
  const DiscreteOperators<dim>& op = *operators_;
  double worst = 0.0;
  for (std::size_t p = 0; p < index_of(op.points); ++p) {
    double sum = 0.0;
    for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
      const auto j = index_of(op.node[e]);
      sum += norm_[e] * transfer_[j] / heat_capacity[j];
    }
    worst = std::max(worst, sum);
  }
  return worst;
}

template<int dim> void Conduction<dim>::lift_limit() {
  if (limited_) conductivity_ = given_;
  limited_ = false;
}

template<int dim>
double Conduction<dim>::limit_decay(const Field& position, const Field& heat_capacity, double decay) {
  const DiscreteOperators<dim>& op = *operators_;
  lift_limit();
  look_at_transfer(position);
  constexpr double light = 0.05;
  Field density(index_of(op.nodes));
  for (std::size_t j = 0; j < density.size(); ++j) density[j] = heat_capacity[j] / around_[j];
  Field ordered = density;
  const auto middle = ordered.begin() + std::ssize(ordered) / 2;
  std::nth_element(ordered.begin(), middle, ordered.end());
  const double usual = *middle;
  // Each entry of a row may take an equal share of the rate. All rows of a node conduct less by the node's
  // factor at least, so that its transfer is.
  Field factor(index_of(op.nodes), 1.0);
  const auto each_entry = [&](auto&& act) {
    for (std::size_t p = 0; p < index_of(op.points); ++p)
      for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e)
        act(p, e, index_of(op.node[e]));
  };
  each_entry([&](std::size_t p, std::size_t e, std::size_t j) {
    const double share = decay / static_cast<double>(op.row_begin[p + 1] - op.row_begin[p]);
    if (!(density[j] < light * usual)) return;
    if (const double taken = norm_[e] * transfer_[j] / heat_capacity[j]; taken > share)
      factor[j] = std::min(factor[j], share / taken);
  });
  if (std::all_of(factor.begin(), factor.end(), [](double f) { return f == 1.0; }))
    return decay_bound(heat_capacity);
  limited_ = true;
  each_entry([&](std::size_t p, std::size_t, std::size_t j) {
    conductivity_[p] = std::min(conductivity_[p], given_[p] * factor[j]);
  });
  look_at_transfer(position);
  return decay_bound(heat_capacity);
}

template class Conduction<2>;
template class Conduction<3>;

} // namespace cnem
