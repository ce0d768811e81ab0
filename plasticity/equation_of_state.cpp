#include "plasticity/equation_of_state.hpp"

#include <cmath>

namespace cnem::plasticity {

namespace {

/// A power series in μ that ends.
template<std::size_t n> using Series = std::array<double, n>;

template<std::size_t n> Series<n> product(const Series<n>& a, const Series<n>& b) {
  Series<n> c{};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; i + k < n; ++k) c[i + k] += a[i] * b[k];
  return c;
}

/// a / b, b[0] = 1.
template<std::size_t n> Series<n> quotient(const Series<n>& a, const Series<n>& b) {
  Series<n> c = a;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 1; k <= i; ++k) c[i] -= b[k] * c[i - k];
  return c;
}

} // namespace

CompressionCurve::CompressionCurve(const MieGruneisen& law, double kappa) : law_(law), kappa_(kappa) {
  constexpr std::size_t n = terms;
  Series<n> top{}, bottom{};
  top[1] = 1.0;
  top[2] = 1.0 - 0.5 * law.gamma0;
  top[3] = -0.5 * law.b;
  bottom[0] = 1.0;
  bottom[1] = 1.0 - law.S1;
  for (std::size_t i = 2; i < n; ++i) bottom[i] = i % 2 == 0 ? -law.S2 : law.S2;
  for (std::size_t i = 3; i < n; ++i)
    bottom[i] += (i % 2 == 0 ? 1.0 : -1.0) * law.S3 * static_cast<double>(i - 2);
  const Series<n> cold = quotient(top, product(bottom, bottom));
  // (1 + μ)² E' = p, power by power
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const auto power = static_cast<double>(i);
    cold_[i + 1] =
        (cold[i] + (law.gamma0 - 2.0 * power) * cold_[i] + (law.b - (power - 1.0)) * cold_[i - 1]) /
        (power + 1.0);
  }
}

CompressionCurve::Compressed CompressionCurve::at(double mu, double heat) const {
  const double by = 1.0 / (1.0 + mu), share = mu * by;
  double energy = 0.0, slope = 0.0; // of E/κ
  for (std::size_t i = terms; i-- > 0;) {
    slope = slope * mu + energy;
    energy = energy * mu + cold_[i];
  }
  const double top = mu * (1.0 + mu * (1.0 - 0.5 * law_.gamma0 - 0.5 * law_.b * mu));
  const double top_slope = 1.0 + mu * (2.0 - law_.gamma0 - 1.5 * law_.b * mu);
  const double bottom = 1.0 - (law_.S1 - 1.0) * mu - share * mu * (law_.S2 + law_.S3 * share);
  const double bottom_slope =
      1.0 - law_.S1 - share * (1.0 + by) * law_.S2 - share * share * (1.0 + 2.0 * by) * law_.S3;
  const double gamma = law_.gamma0 + law_.b * mu, held = heat / kappa_;
  const double pressure = top / (bottom * bottom) + gamma * (energy + held);
  const double rise = (top_slope * bottom - 2.0 * top * bottom_slope) / (bottom * bottom * bottom) +
                      law_.b * (energy + held) + gamma * slope;
  const double of_heat = held * ((law_.gamma0 - law_.b) * share + law_.b * std::log1p(mu));
  return {kappa_ * pressure * by, kappa_ * (energy + of_heat), kappa_ * (rise - pressure * by)};
}

} // namespace cnem::plasticity
