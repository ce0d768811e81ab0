#include "machining/structure/cells.hpp"

#include "core/index.hpp"
#include "machining/gauss.hpp"

namespace cnem::machining {

namespace {

using Eigen::Index;

/// Values and slopes over x, y, z in [0, 1] of the functions that belong to the nodes of a cell.
struct Shapes {
  Eigen::VectorXd value;
  Eigen::Matrix<double, Eigen::Dynamic, 3> slope;
};

/// Lagrange polynomial i through `order` + 1 equal steps of [0, 1], and its slope.
std::array<double, 2> lagrange_step(int order, int i, double x) {
  double value = 1.0, slope = 0.0;
  for (int k = 0; k <= order; ++k) {
    if (k == i) continue;
    const double scale = static_cast<double>(order) / (i - k), factor = order * x - k;
    slope = slope * factor / (i - k) + value * scale;
    value *= factor / (i - k);
  }
  return {value, slope};
}

/// Serendipity function of the node at (i, j) of the 3 × 3 places round a square, and its slopes.
std::array<double, 3> serendipity(int i, int j, double x, double y) {
  const double xi = 2.0 * x - 1.0, eta = 2.0 * y - 1.0, a = i - 1.0, b = j - 1.0;
  if (i == 1)
    return {0.5 * (1.0 - xi * xi) * (1.0 + eta * b), -2.0 * xi * (1.0 + eta * b), (1.0 - xi * xi) * b};
  if (j == 1)
    return {0.5 * (1.0 + xi * a) * (1.0 - eta * eta), (1.0 - eta * eta) * a, -2.0 * eta * (1.0 + xi * a)};
  const double u = 1.0 + xi * a, v = 1.0 + eta * b, s = xi * a + eta * b - 1.0;
  return {0.25 * u * v * s, 0.5 * a * v * (s + u), 0.5 * b * u * (s + v)};
}

Shapes shapes(PartElement element, const Vec3& at) {
  const ElementForm& form = form_of(element);
  const Index functions = as<Eigen::Index>(form.lattice_node.size());
  Shapes s{Eigen::VectorXd(functions), Eigen::MatrixX3d(functions, 3)};
  for (Index n = 0; n < functions; ++n) {
    const auto& [i, j, k] = form.lattice_node[index_of(n)];
    if (element == PartElement::plate_8) {
      const auto [value, along_x, along_y] = serendipity(i, j, at.x(), at.y());
      s.value[n] = value;
      s.slope.row(n) << along_x, along_y, 0.0;
      continue;
    }
    const auto [x, dx] = lagrange_step(form.order, i, at.x());
    const auto [y, dy] = lagrange_step(form.order, j, at.y());
    const auto [z, dz] = lagrange_step(form.order, k, at.z());
    s.value[n] = x * y * z;
    s.slope.row(n) << dx * y * z, x * dy * z, x * y * dz;
  }
  return s;
}

CellMatrices solid_matrices(PartElement element, const Vec3& size, const ElasticSolid& solid) {
  const ElementForm& form = form_of(element);
  const Index functions = as<Eigen::Index>(form.lattice_node.size());
  CellMatrices m{Eigen::MatrixXd::Zero(3 * functions, 3 * functions),
                 Eigen::MatrixXd::Zero(3 * functions, 3 * functions)};
  const double mu = 0.5 * solid.young / (1.0 + solid.poisson),
               lambda = 2.0 * mu * solid.poisson / (1.0 - 2.0 * solid.poisson);
  Eigen::Matrix<double, 6, 6> d = Eigen::Matrix<double, 6, 6>::Zero();
  d.topLeftCorner<3, 3>().setConstant(lambda);
  d.diagonal() << lambda + 2.0 * mu, lambda + 2.0 * mu, lambda + 2.0 * mu, mu, mu, mu;
  const GaussRule& rule = gauss_rule(form.order + 1); // exact for both matrices of a rectangular cell
  Eigen::MatrixXd b(6, 3 * functions);
  for (std::size_t i = 0; i < rule.node.size(); ++i)
    for (std::size_t j = 0; j < rule.node.size(); ++j)
      for (std::size_t k = 0; k < rule.node.size(); ++k) {
        const Shapes s = shapes(element, Vec3(rule.node[i], rule.node[j], rule.node[k]));
        const double volume = rule.weight[i] * rule.weight[j] * rule.weight[k] * size.prod();
        b.setZero();
        for (Index n = 0; n < functions; ++n) {
          const Vec3 g = s.slope.row(n).transpose().cwiseQuotient(size);
          b.block<6, 3>(0, 3 * n) << g.x(), 0, 0, 0, g.y(), 0, 0, 0, g.z(), g.y(), g.x(), 0, 0, g.z(), g.y(),
              g.z(), 0, g.x();
        }
        m.stiffness.noalias() += volume * b.transpose() * (d * b);
        for (Index n = 0; n < functions; ++n)
          for (Index l = 0; l < functions; ++l)
            m.mass.block<3, 3>(3 * n, 3 * l).diagonal().array() +=
                solid.density * volume * s.value[n] * s.value[l];
      }
  return m;
}

/// Mindlin: u + z βx, v + z βy, w; strains of the surface and curvatures 3 + 3, shear 2.
CellMatrices plate_matrices(const Vec3& size, double low, const ElasticSolid& solid) {
  const ElementForm& form = form_of(PartElement::plate_8);
  const Index functions = as<Eigen::Index>(form.lattice_node.size()), all = 5 * functions;
  CellMatrices m{Eigen::MatrixXd::Zero(all, all), Eigen::MatrixXd::Zero(all, all)};
  const double high = low + size.z(), e = solid.young / (1.0 - solid.poisson * solid.poisson);
  const double h1 = high - low, h2 = (high * high - low * low) / 2.0,
               h3 = (high * high * high - low * low * low) / 3.0;
  Eigen::Matrix3d q;
  q << e, e * solid.poisson, 0.0, e * solid.poisson, e, 0.0, 0.0, 0.0, 0.5 * e * (1.0 - solid.poisson);
  constexpr double shear_correction = 5.0 / 6.0;
  const double shear = shear_correction * 0.5 * solid.young / (1.0 + solid.poisson) * h1;
  const double area = size.x() * size.y();
  Eigen::MatrixXd membrane(3, all), bending(3, all), sliding(2, all);
  const auto each_point = [&](int points, const auto& visit) {
    const GaussRule& rule = gauss_rule(points);
    for (std::size_t i = 0; i < rule.node.size(); ++i)
      for (std::size_t j = 0; j < rule.node.size(); ++j)
        visit(shapes(PartElement::plate_8, Vec3(rule.node[i], rule.node[j], 0.0)),
              rule.weight[i] * rule.weight[j] * area);
  };
  each_point(2, [&](const Shapes& s, double weight) {
    membrane.setZero();
    bending.setZero();
    sliding.setZero();
    for (Index n = 0; n < functions; ++n) {
      const double gx = s.slope(n, 0) / size.x(), gy = s.slope(n, 1) / size.y();
      membrane.block<3, 2>(0, 5 * n) << gx, 0, 0, gy, gy, gx;
      bending.block<3, 2>(0, 5 * n + 3) = membrane.block<3, 2>(0, 5 * n);
      sliding.block<2, 3>(0, 5 * n + 2) << gx, s.value[n], 0, gy, 0, s.value[n];
    }
    m.stiffness.noalias() += weight * membrane.transpose() * q * (h1 * membrane + h2 * bending);
    m.stiffness.noalias() += weight * bending.transpose() * q * (h2 * membrane + h3 * bending);
    m.stiffness.noalias() += weight * shear * sliding.transpose() * sliding;
  });
  each_point(3, [&](const Shapes& s, double weight) {
    for (Index n = 0; n < functions; ++n)
      for (Index l = 0; l < functions; ++l) {
        const double both = solid.density * weight * s.value[n] * s.value[l];
        auto block = m.mass.block<5, 5>(5 * n, 5 * l);
        block(0, 0) += both * h1;
        block(1, 1) += both * h1;
        block(2, 2) += both * h1;
        for (Index k = 0; k < 2; ++k) {
          block(k, 3 + k) += both * h2;
          block(3 + k, k) += both * h2;
          block(3 + k, 3 + k) += both * h3;
        }
      }
  });
  return m;
}

ElementForm lattice(int order, int layers, int freedoms, bool only_round) {
  ElementForm form{.order = order, .freedoms = freedoms, .lattice_node = {}};
  for (int k = 0; k <= layers; ++k)
    for (int j = 0; j <= order; ++j)
      for (int i = 0; i <= order; ++i)
        if (!only_round || i != 1 || j != 1) form.lattice_node.push_back({i, j, k});
  return form;
}

} // namespace

const ElementForm& form_of(PartElement element) {
  static const std::array<ElementForm, 3> forms{lattice(2, 2, 3, false), lattice(1, 1, 3, false),
                                                lattice(2, 0, 5, true)};
  return forms[static_cast<std::size_t>(element)];
}

CellMatrices cell_matrices(PartElement element, const Vec3& size, double low, const ElasticSolid& solid) {
  return element == PartElement::plate_8 ? plate_matrices(size, low, solid)
                                         : solid_matrices(element, size, solid);
}

Eigen::MatrixXd cell_interpolation(PartElement element, const Vec3& place, double height) {
  const ElementForm& form = form_of(element);
  const Shapes s = shapes(element, place);
  const Index functions = s.value.size(), freedoms = form.freedoms;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, freedoms * functions);
  for (Index n = 0; n < functions; ++n) {
    rows.middleCols(freedoms * n, 3).diagonal().setConstant(s.value[n]);
    if (element == PartElement::plate_8)
      rows.block<2, 2>(0, freedoms * n + 3).diagonal().setConstant(height * s.value[n]);
  }
  return rows;
}

} // namespace cnem::machining
