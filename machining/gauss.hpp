#pragma once
// Gauss-Legendre quadrature on [0, 1], and polynomials through its nodes.
#include <vector>

namespace cnem::machining {

struct GaussRule {
  std::vector<double> node, weight;
};

/// Of `points` points, exact to the degree 2 points − 1; by Newton on Legendre polynomials.
const GaussRule& gauss_rule(int points);

/// Values at x of the Lagrange polynomials through the nodes, which need not lie around x.
std::vector<double> lagrange(const std::vector<double>& node, double x);

} // namespace cnem::machining
