#include "machining/structure/newmark.hpp"

#include <cassert>
#include <utility>

namespace cnem::machining {

namespace {

constexpr double alpha = 0.25, delta = 0.5;

} // namespace

NewmarkStep::NewmarkStep(double step)
    : dt(step), a0(1.0 / (alpha * dt * dt)), a1(delta / (alpha * dt)), a2(1.0 / (alpha * dt)),
      a3(0.5 / alpha - 1.0), a4(delta / alpha - 1.0), a5((0.5 * delta / alpha - 1.0) * dt) {}

SparseMatrix NewmarkStep::effective(const Matrices& of) const {
  assert(of.mass.nonZeros() == of.stiffness.nonZeros() && of.damping.nonZeros() == of.stiffness.nonZeros());
  SparseMatrix sum = of.stiffness;
  sum.coeffs() += a0 * of.mass.coeffs() + a1 * of.damping.coeffs();
  return sum;
}

Eigen::VectorXd NewmarkStep::carried(const Motion& from, const Matrices& of) const {
  return of.mass * (a3 * from.acceleration + a2 * from.velocity + a0 * from.q) +
         of.damping * (a5 * from.acceleration + a4 * from.velocity + a1 * from.q);
}

Motion NewmarkStep::arrive(const Motion& from, Eigen::VectorXd q) const {
  Motion to;
  to.acceleration = a0 * (q - from.q) - a2 * from.velocity - a3 * from.acceleration;
  to.velocity = from.velocity + dt * ((1.0 - delta) * from.acceleration + delta * to.acceleration);
  to.q = std::move(q);
  return to;
}

} // namespace cnem::machining
