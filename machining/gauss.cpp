#include "machining/gauss.hpp"

#include "core/index.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace cnem::machining {

namespace {

constexpr int most_points = 24;

GaussRule make_rule(int points) {
  GaussRule rule;
  for (int i = 0; i < points; ++i) {
    double x = std::cos(std::numbers::pi * (points - i - 0.25) / (points + 0.5)), slope = 1.0;
    for (int iteration = 0; iteration < 50; ++iteration) {
      double before = 1.0, value = x;
      for (int n = 2; n <= points; ++n) {
        const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
        before = value;
        value = next;
      }
      if (points == 1) before = 1.0;
      slope = points * (x * value - before) / (x * x - 1.0);
      const double step = value / slope;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    rule.node.push_back(0.5 * (1.0 + x));
    rule.weight.push_back(1.0 / ((1.0 - x * x) * slope * slope));
  }
  return rule;
}

} // namespace

const GaussRule& gauss_rule(int points) {
  static const std::array<GaussRule, most_points + 1> rules = [] {
    std::array<GaussRule, most_points + 1> all;
    for (int n = 1; n <= most_points; ++n) all[index_of(n)] = make_rule(n);
    return all;
  }();
  return rules.at(index_of(points));
}

std::vector<double> lagrange(const std::vector<double>& node, double x) {
  std::vector<double> value(node.size(), 1.0);
  for (std::size_t l = 0; l < node.size(); ++l)
    for (std::size_t m = 0; m < node.size(); ++m)
      if (m != l) value[l] *= (x - node[m]) / (node[l] - node[m]);
  return value;
}

} // namespace cnem::machining
