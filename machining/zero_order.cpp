#include "machining/zero_order.hpp"

#include "core/index.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace cnem::machining {

namespace {

using Complex = std::complex<double>;
using ComplexFactors = Eigen::Matrix<Complex, 3, 2>;
using EigenvaluePair = std::array<Complex, 2>;

/// Eigenvalues of factors times receptance, of which the directions across the axis count.
EigenvaluePair eigenvalues(const ComplexFactors& factors, std::span<const Mode> modes, double omega) {
  // u = Φ F and F = a W u have the eigenvalues of (Φ W), which is 2 × 2.
  Eigen::Matrix<Complex, 2, 2> product = Eigen::Matrix<Complex, 2, 2>::Zero();
  for (const Mode& mode : modes) {
    const double r = omega / mode.omega();
    const Vec3 p = mode.participation();
    const Complex receptance = 1.0 / (mode.stiffness * Complex(1.0 - r * r, 2.0 * mode.damping * r));
    product += receptance * (p.head<2>().cast<Complex>() * (p.transpose().cast<Complex>() * factors));
  }
  const Complex half = 0.5 * (product(0, 0) + product(1, 1));
  const Complex root = std::sqrt(half * half - product(0, 0) * product(1, 1) + product(0, 1) * product(1, 0));
  return {half + root, half - root};
}

/// In the order of those before.
EigenvaluePair followed(EigenvaluePair now, const EigenvaluePair& before) {
  const double kept = std::abs(now[0] - before[0]) + std::abs(now[1] - before[1]);
  const double turned = std::abs(now[1] - before[0]) + std::abs(now[0] - before[1]);
  if (turned < kept) std::swap(now[0], now[1]);
  return now;
}

/// Calls visit(ω, λ) for both eigenvalues of factors(ω) along the frequencies at which modes may chatter.
template<class Factors, class Visit>
void scan(const Factors& factors, std::span<const Mode> modes, double step_bound, Visit&& visit) {
  double low = infinite, high = 0.0, step = step_bound;
  for (const Mode& mode : modes) {
    low = std::min(low, mode.omega());
    high = std::max(high, mode.omega());
    step = std::min(step, 0.1 * std::max(mode.damping, 1e-4) * mode.omega());
  }
  low *= 0.2;
  high *= 2.5;
  const auto count = static_cast<std::int64_t>(std::ceil((high - low) / step));
  EigenvaluePair value = eigenvalues(factors(low), modes, low);
  for (std::int64_t i = 0; i <= count; ++i) {
    const double omega = low + (high - low) * static_cast<double>(i) / static_cast<double>(count);
    value = followed(eigenvalues(factors(omega), modes, omega), value);
    visit(omega, value);
  }
}

} // namespace

std::optional<ZeroOrderLimit> zero_order_limit(const MillingCut& cut, std::span<const Mode> modes,
                                               double spindle) {
  if (modes.empty()) return std::nullopt;
  const DirectionalFactors mean = mean_factors(cut, spindle), damping = mean_damping(cut, spindle);
  const auto regeneration = [&](double omega) {
    Complex sum = 0.0;
    for (const double pitch : cut.cutter.pitch) sum += 1.0 - std::exp(Complex(0.0, -omega * pitch / spindle));
    return sum / static_cast<double>(cut.cutter.teeth());
  };
  const bool ploughs = cut.flank.presses();
  // Where flanks damp, of the whole, which no regeneration brings to nothing; else of what it multiplies.
  const auto factors = [&](double omega) -> ComplexFactors {
    if (!ploughs) return mean.cast<Complex>();
    return mean.cast<Complex>() * regeneration(omega) + damping.cast<Complex>() * Complex(0.0, omega);
  };
  const auto scale = [&](double omega) { return ploughs ? Complex(1.0) : regeneration(omega); };
  std::optional<ZeroOrderLimit> least;
  double before = 0.0;
  EigenvaluePair value_before{};
  const double longest = *std::max_element(cut.cutter.pitch.begin(), cut.cutter.pitch.end()) / spindle;
  scan(factors, modes, 0.05 / longest, [&](double omega, const EigenvaluePair& value) {
    for (std::size_t k = 0; before > 0.0 && k < 2; ++k) {
      double low = before, high = omega;
      Complex at_low = value_before[k] * scale(low);
      Complex at_high = value[k] * scale(high);
      if ((at_low.imag() > 0.0) == (at_high.imag() > 0.0)) continue;
      if (at_low.real() <= 0.0 && at_high.real() <= 0.0) continue;
      Complex at = at_high;
      for (int i = 0; i < 60 && high - low > 1e-13 * high; ++i) {
        const double middle = 0.5 * (low + high);
        const EigenvaluePair pair = eigenvalues(factors(middle), modes, middle);
        const std::size_t near = std::abs(pair[0] - value[k]) <= std::abs(pair[1] - value[k]) ? 0 : 1;
        at = pair[near] * scale(middle);
        ((at.imag() > 0.0) == (at_low.imag() > 0.0) ? low : high) = middle;
      }
      constexpr double rounding = 1e-12; // modes along one line have one eigenvalue, the other is 0
      const double other = std::abs(value[1 - k] * scale(high));
      if (at.real() > rounding * other && (!least || 1.0 / at.real() < least->depth))
        least = ZeroOrderLimit{1.0 / at.real(), high};
    }
    before = omega;
    value_before = value;
  });
  return least;
}

std::optional<ZeroOrderLimit> zero_order_minimum(const MillingCut& cut, std::span<const Mode> modes,
                                                 double spindle) {
  std::optional<ZeroOrderLimit> least;
  if (modes.empty()) return least;
  const ComplexFactors mean = mean_factors(cut, spindle).cast<Complex>();
  scan([&](double) -> const ComplexFactors& { return mean; }, modes, infinite,
       [&](double omega, const EigenvaluePair& value) {
         for (const Complex& lambda : value)
           if (lambda.real() > 0.0 && (!least || 0.5 / lambda.real() < least->depth))
             least = ZeroOrderLimit{0.5 / lambda.real(), omega};
       });
  return least;
}

} // namespace cnem::machining
