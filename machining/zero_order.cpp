#include "machining/zero_order.hpp"

#include "machining/engaged_edges.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace cnem::machining {

namespace {

using Complex = std::complex<double>;
using ComplexFactors = Eigen::Matrix3cd;
using Eigenvalues = std::array<Complex, 3>;

/// Eigenvalues of factors times receptance. Where no chip knows of z, the third is 0.
Eigenvalues eigenvalues(const ComplexFactors& factors, std::span<const Mode> modes, double omega) {
  // u = Φ F and F = a W u have the eigenvalues of (Φ W).
  ComplexFactors product = ComplexFactors::Zero();
  for (const Mode& mode : modes) {
    const double r = omega / mode.omega();
    const Vec3 p = mode.participation();
    const Complex receptance = 1.0 / (mode.stiffness * Complex(1.0 - r * r, 2.0 * mode.damping * r));
    product += receptance * (p.cast<Complex>() * (p.transpose().cast<Complex>() * factors));
  }
  if (factors.col(2).isZero(0.0)) {
    const Complex half = 0.5 * (product(0, 0) + product(1, 1));
    const Complex root =
        std::sqrt(half * half - product(0, 0) * product(1, 1) + product(0, 1) * product(1, 0));
    return {half + root, half - root, 0.0};
  }
  const Eigen::ComplexEigenSolver<ComplexFactors> solver(product, false);
  return {solver.eigenvalues()[0], solver.eigenvalues()[1], solver.eigenvalues()[2]};
}

/// In the order of those before.
Eigenvalues followed(Eigenvalues now, const Eigenvalues& before) {
  for (std::size_t k = 0; k < now.size(); ++k) {
    const auto nearest = std::min_element(now.begin() + std::ptrdiff_t(k), now.end(), [&](auto& a, auto& b) {
      return std::abs(a - before[k]) < std::abs(b - before[k]);
    });
    std::iter_swap(now.begin() + std::ptrdiff_t(k), nearest);
  }
  return now;
}

/// Calls visit(ω, λ) for the eigenvalues of factors(ω) along the frequencies at which modes may chatter.
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
  Eigenvalues value = eigenvalues(factors(low), modes, low);
  for (std::int64_t i = 0; i <= count; ++i) {
    const double omega = low + (high - low) * static_cast<double>(i) / static_cast<double>(count);
    value = followed(eigenvalues(factors(omega), modes, omega), value);
    visit(omega, value);
  }
}

/// The smallest depth at the margin with these means per depth.
std::optional<ZeroOrderLimit> limit_of(const MillingCut& cut, std::span<const Mode> modes, double spindle,
                                       const DirectionalFactors& mean, const DirectionalFactors& damping) {
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
  Eigenvalues value_before{};
  const double longest = *std::max_element(cut.cutter.pitch.begin(), cut.cutter.pitch.end()) / spindle;
  scan(factors, modes, 0.05 / longest, [&](double omega, const Eigenvalues& value) {
    for (std::size_t k = 0; before > 0.0 && k < value.size(); ++k) {
      double low = before, high = omega;
      Complex at_low = value_before[k] * scale(low);
      Complex at_high = value[k] * scale(high);
      if ((at_low.imag() > 0.0) == (at_high.imag() > 0.0)) continue;
      if (at_low.real() <= 0.0 && at_high.real() <= 0.0) continue;
      Complex at = at_high;
      for (int i = 0; i < 60 && high - low > 1e-13 * high; ++i) {
        const double middle = 0.5 * (low + high);
        const Eigenvalues there = eigenvalues(factors(middle), modes, middle);
        at = *std::min_element(there.begin(), there.end(), [&](const Complex& a, const Complex& b) {
          return std::abs(a - value[k]) < std::abs(b - value[k]);
        }) * scale(middle);
        ((at.imag() > 0.0) == (at_low.imag() > 0.0) ? low : high) = middle;
      }
      constexpr double rounding = 1e-12; // modes along one line have one eigenvalue, the others are 0
      double largest = 0.0;
      for (const Complex& other : value) largest = std::max(largest, std::abs(other * scale(high)));
      if (at.real() > rounding * largest && (!least || 1.0 / at.real() < least->depth))
        least = ZeroOrderLimit{1.0 / at.real(), high};
    }
    before = omega;
    value_before = value;
  });
  return least;
}

/// 1/(2 max Re λ) with this mean per depth.
std::optional<ZeroOrderLimit> minimum_of(std::span<const Mode> modes, const DirectionalFactors& mean) {
  std::optional<ZeroOrderLimit> least;
  scan([&](double) -> ComplexFactors { return mean.cast<Complex>(); }, modes, infinite,
       [&](double omega, const Eigenvalues& value) {
         for (const Complex& lambda : value)
           if (lambda.real() > 0.0 && (!least || 0.5 / lambda.real() < least->depth))
             least = ZeroOrderLimit{0.5 / lambda.real(), omega};
       });
  return least;
}

/// Edges at one radius have the same mean per depth at any. Of others the first depth that is no less than
/// the limit with its own mean, at(depth).
template<class At> std::optional<ZeroOrderLimit> first_limit(const Cutter& cutter, const At& at) {
  if (!cutter.rounded()) return at(cutter.radius());
  constexpr double first = 1e-3, step = 1.25, most = 20.0; // of the radius
  const double end = std::min(cutter.top(), most * cutter.radius());
  double low = 0.0;
  for (double depth = std::min(first * cutter.radius(), end);; depth = std::min(step * depth, end)) {
    std::optional<ZeroOrderLimit> limit = at(depth);
    if (limit && limit->depth <= depth) {
      constexpr double close = 1e-7;
      for (double high = depth; high - low > close * high;) {
        const double middle = 0.5 * (low + high);
        if (const auto there = at(middle); there && there->depth <= middle) {
          high = middle;
          limit = there;
        } else
          low = middle;
      }
      return limit;
    }
    if (depth >= end) return std::nullopt;
    low = depth;
  }
}

} // namespace

std::optional<ZeroOrderLimit> zero_order_limit(const MillingCut& cut, std::span<const Mode> modes,
                                               double spindle) {
  if (modes.empty()) return std::nullopt;
  return first_limit(cut.cutter, [&](double depth) {
    const EngagedEdges edges(cut, depth, spindle);
    return limit_of(cut, modes, spindle, edges.mean_factors() / depth, edges.mean_damping() / depth);
  });
}

std::optional<ZeroOrderLimit> zero_order_minimum(const MillingCut& cut, std::span<const Mode> modes,
                                                 double spindle) {
  if (modes.empty()) return std::nullopt;
  return first_limit(cut.cutter, [&](double depth) {
    return minimum_of(modes, EngagedEdges(cut, depth, spindle).mean_factors() / depth);
  });
}

} // namespace cnem::machining
