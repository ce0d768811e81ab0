#include "fracture/williams.hpp"

#include <cmath>
#include <numbers>

namespace cnem::fracture {

namespace {

/// ∇(√r g(θ)).
Vec2 gradient_of(double r, double theta, double g, double dg) {
  const double c = std::cos(theta), s = std::sin(theta);
  return Vec2(0.5 * g * c - dg * s, 0.5 * g * s + dg * c) / std::sqrt(r);
}

/// Angular parts and their derivatives.
struct Angular {
  double value, derivative;
};
std::array<Angular, branch_count> angular(double theta) {
  const double s2 = std::sin(0.5 * theta), c2 = std::cos(0.5 * theta), s = std::sin(theta),
               c = std::cos(theta);
  return {
      {{s2, 0.5 * c2}, {c2, -0.5 * s2}, {s2 * s, 0.5 * c2 * s + s2 * c}, {c2 * s, -0.5 * s2 * s + c2 * c}}};
}

} // namespace

PlaneElasticity PlaneElasticity::plane_strain(double young, double poisson) {
  const double mu = young / (2.0 * (1.0 + poisson)), kappa = 3.0 - 4.0 * poisson;
  return {mu, kappa, 8.0 * mu / (kappa + 1.0)};
}

PlaneElasticity PlaneElasticity::plane_stress(double young, double poisson) {
  const double mu = young / (2.0 * (1.0 + poisson)), kappa = (3.0 - poisson) / (1.0 + poisson);
  return {mu, kappa, 8.0 * mu / (kappa + 1.0)};
}

std::array<double, branch_count> branch(double r, double theta) {
  std::array<double, branch_count> f{};
  const auto parts = angular(theta);
  for (std::size_t k = 0; k < branch_count; ++k) f[k] = std::sqrt(r) * parts[k].value;
  return f;
}

std::array<Vec2, branch_count> branch_gradient(double r, double theta) {
  std::array<Vec2, branch_count> f;
  const auto parts = angular(theta);
  for (std::size_t k = 0; k < branch_count; ++k)
    f[k] = gradient_of(r, theta, parts[k].value, parts[k].derivative);
  return f;
}

TipField tip_field(int mode, const PlaneElasticity& elasticity, double r, double theta) {
  const double kappa = elasticity.kappa;
  const double s2 = std::sin(0.5 * theta), c2 = std::cos(0.5 * theta), s = std::sin(theta),
               c = std::cos(theta);
  // u = √(r/2π)/(2μ) g(θ)
  const double scale = 1.0 / (2.0 * elasticity.mu * std::sqrt(2.0 * std::numbers::pi));
  Angular gx, gy;
  if (mode == 0) {
    gx = {c2 * (kappa - c), -0.5 * s2 * (kappa - c) + c2 * s};
    gy = {s2 * (kappa - c), 0.5 * c2 * (kappa - c) + s2 * s};
  } else {
    gx = {s2 * (kappa + 2.0 + c), 0.5 * c2 * (kappa + 2.0 + c) - s2 * s};
    gy = {-c2 * (kappa - 2.0 + c), 0.5 * s2 * (kappa - 2.0 + c) + c2 * s};
  }
  TipField field;
  field.displacement = scale * std::sqrt(r) * Vec2(gx.value, gy.value);
  field.gradient.row(0) = scale * gradient_of(r, theta, gx.value, gx.derivative).transpose();
  field.gradient.row(1) = scale * gradient_of(r, theta, gy.value, gy.derivative).transpose();
  // λ* in terms of κ, for plane strain and plane stress alike.
  const double lambda = elasticity.mu * (3.0 - kappa) / (kappa - 1.0);
  field.stress = elasticity.mu * (field.gradient + field.gradient.transpose()) +
                 lambda * field.gradient.trace() * Mat2::Identity();
  return field;
}

} // namespace cnem::fracture
