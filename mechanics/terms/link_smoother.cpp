#include "mechanics/terms/link_smoother.hpp"

#include "core/index.hpp"
#include "core/operators/side_by_side.hpp"
#include "core/vec.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace cnem {

namespace {

constexpr int iterations = 20;
constexpr double least_eigenvalue = 0.05; ///< of the largest one

template<int dim> Mat<dim> pseudo_inverse(const Mat<dim>& matrix) {
  const Eigen::SelfAdjointEigenSolver<Mat<dim>> solver(matrix);
  const double least = least_eigenvalue * solver.eigenvalues()[dim - 1];
  Mat<dim> result = Mat<dim>::Zero();
  for (Eigen::Index k = 0; k < dim; ++k) {
    const double value = solver.eigenvalues()[k];
    if (value >= least)
      result += solver.eigenvectors().col(k) * solver.eigenvectors().col(k).transpose() / value;
  }
  return result;
}

} // namespace

template<int dim>
LinkSmoother<dim>::LinkSmoother(const StabilisationLinks<dim>& links, const Field& reference,
                                const Field& share, const std::vector<std::int32_t>& kind, const Field& mass,
                                double strength) {
  const std::size_t n = share.size();
  const auto joined = [&](std::size_t i, std::size_t j) {
    return share[i] > 0.0 && share[j] > 0.0 && kind[i] == kind[j];
  };
  const auto each_link = [&](std::size_t i, auto&& act) {
    for (std::int32_t e = links.begin[i]; e < links.begin[i + 1]; ++e)
      if (const auto j = index_of(links.neighbour[index_of(e)]); joined(i, j))
        act(j, links.weight[index_of(e)]);
  };
  std::vector<std::int32_t> place(n, -1);
  for (std::size_t i = 0; i < n; ++i) {
    bool linked = false;
    each_link(i, [&](std::size_t, double) { linked = true; });
    if (!linked) continue;
    place[i] = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back(static_cast<std::int32_t>(i));
    mass_.push_back(mass[i]);
  }
  begin_.push_back(0);
  for (const std::int32_t node : nodes_) {
    const auto i = index_of(node);
    Mat<dim> matrix = Mat<dim>::Zero();
    each_link(i, [&](std::size_t j, double length) {
      Vec<dim> way;
      for (std::size_t k = 0; k < dim; ++k)
        way[static_cast<Eigen::Index>(k)] = reference[beside<dim> * j + k] - reference[beside<dim> * i + k];
      const double distance2 = way.squaredNorm();
      matrix += way * way.transpose() / distance2;
      links_.push_back(
          {place[j], strength * length * distance2 * std::min(share[i], share[j]), 1.0 / distance2, way});
    });
    begin_.push_back(links_.size());
    inverse_.push_back(pseudo_inverse<dim>(matrix));
  }
}

template<int dim>
std::vector<typename LinkSmoother<dim>::Values> LinkSmoother<dim>::apply(const std::vector<Values>& x) const {
  const std::size_t n = nodes_.size();
  std::vector<Gradient> gradient(n), moment(n);
  std::vector<Values> result(n);
  const auto outer = [](const Values& v, const Vec<dim>& X) -> Gradient {
    return (v.matrix() * X.transpose()).array();
  };
  const auto along = [](const Gradient& g, const Vec<dim>& X) -> Values { return (g.matrix() * X).array(); };
  for (std::size_t a = 0; a < n; ++a) {
    Gradient sum = Gradient::Zero();
    for (std::size_t e = begin_[a]; e < begin_[a + 1]; ++e) {
      const Link& link = links_[e];
      sum += link.near * outer(x[index_of(link.other)] - x[a], link.way);
    }
    gradient[a] = solved(a, sum);
  }
  for (std::size_t a = 0; a < n; ++a) {
    Values pull = Values::Zero();
    Gradient sum = Gradient::Zero();
    for (std::size_t e = begin_[a]; e < begin_[a + 1]; ++e) {
      const Link& link = links_[e];
      const auto b = index_of(link.other);
      const Values defect = link.weight * (x[b] - x[a] - 0.5 * along(gradient[a] + gradient[b], link.way));
      pull -= defect;
      sum -= 0.5 * outer(defect, link.way);
    }
    result[a] = pull;
    moment[a] = solved(a, sum);
  }
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t e = begin_[a]; e < begin_[a + 1]; ++e) {
      const Link& link = links_[e];
      result[a] -= link.near * along(moment[a] + moment[index_of(link.other)], link.way);
    }
  return result;
}

template<int dim>
std::vector<typename LinkSmoother<dim>::Values>
LinkSmoother<dim>::change(const std::vector<Values>& x) const {
  const std::size_t n = nodes_.size();
  std::vector<Values> result(n, Values::Zero()), residual = apply(x), direction(n);
  Values product = Values::Zero();
  for (std::size_t a = 0; a < n; ++a) {
    residual[a] = -residual[a];
    direction[a] = residual[a] / mass_[a];
    product += residual[a] * direction[a];
  }
  for (int k = 0; k < iterations; ++k) {
    std::vector<Values> image = apply(direction);
    Values curvature = Values::Zero();
    for (std::size_t a = 0; a < n; ++a) {
      image[a] += mass_[a] * direction[a];
      curvature += direction[a] * image[a];
    }
    const Values step = (curvature > 0.0).select(product / curvature, 0.0);
    Values next = Values::Zero();
    for (std::size_t a = 0; a < n; ++a) {
      result[a] += step * direction[a];
      residual[a] -= step * image[a];
      next += residual[a].square() / mass_[a];
    }
    const Values share = (product > 0.0).select(next / product, 0.0);
    for (std::size_t a = 0; a < n; ++a) direction[a] = residual[a] / mass_[a] + share * direction[a];
    product = next;
  }
  return result;
}

template class LinkSmoother<2>;
template class LinkSmoother<3>;

} // namespace cnem
