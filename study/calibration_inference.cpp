// What curves say of constants: sensitivities, intervals, and what they do not tell.
#include "study/calibration.hpp"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::study {
namespace {

/// A direction is weak along which a constant goes from bound to bound and the curves change by less than
/// this share of their peaks.
constexpr double least_change = 0.005;
/// Or where the 95% interval is as wide as the bounds.
constexpr double widest = 0.5;
/// Of a unit vector, that a constant needs to be named with it.
constexpr double notable = 0.1;

/// Of how many independent ones so many residuals of curves tell: neighbours on a curve err alike. By the
/// correlation of neighbours, as for an autoregressive series.
double independent_residuals(const Eigen::VectorXd& residual, const std::vector<std::size_t>& lengths) {
  double independent = 0.0;
  Eigen::Index from = 0;
  for (const std::size_t length : lengths) {
    const auto n = static_cast<Eigen::Index>(length);
    const Eigen::VectorXd part = residual.segment(from, n);
    const double all = part.squaredNorm();
    const double neighbours = part.head(n - 1).dot(part.tail(n - 1));
    const double correlation = all > 0.0 ? std::clamp(neighbours / all, 0.0, 0.999) : 0.0;
    independent += std::max(2.0, double(length) * (1.0 - correlation) / (1.0 + correlation));
    from += n;
  }
  return independent;
}

/// 97.5% quantile of Student's t, by its expansion about the normal one (Abramowitz and Stegun 26.7.5).
double student(double degrees) {
  constexpr double z = 1.959964;
  const double z3 = z * z * z, z5 = z3 * z * z;
  return z + (z3 + z) / (4.0 * degrees) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * degrees * degrees);
}

/// "0.71 A − 0.70 ln n", of constants that are notable in a direction.
std::string combination(const Calibration& calibration, const Eigen::VectorXd& direction) {
  std::string text;
  for (Eigen::Index k = 0; k < direction.size(); ++k) {
    if (std::abs(direction[k]) < notable) continue;
    const SoughtConstant& constant = calibration.constants[static_cast<std::size_t>(k)];
    const char* sign = text.empty() ? (direction[k] < 0.0 ? "−" : "") : (direction[k] < 0.0 ? " − " : " + ");
    text += fmt::format("{}{:.2f} {}{}", sign, std::abs(direction[k]), constant.logarithmic ? "ln " : "",
                        constant.name);
  }
  return text;
}

std::string weak_words(const Calibration& calibration, const Eigen::VectorXd& direction, double change) {
  std::vector<std::string> names;
  std::size_t leading = 0;
  for (Eigen::Index k = 0; k < direction.size(); ++k) {
    if (std::abs(direction[k]) >= notable)
      names.push_back(calibration.constants[static_cast<std::size_t>(k)].name);
    if (std::abs(direction[k]) > std::abs(direction[static_cast<Eigen::Index>(leading)]))
      leading = static_cast<std::size_t>(k);
  }
  const std::string little = fmt::format("{:.2g}% of their peaks", 100.0 * change);
  if (names.size() < 2) {
    const SoughtConstant& constant = calibration.constants[leading];
    return fmt::format("The curves do not tell {}: from {} to {} they would change by {}.", constant.name,
                       constant.text(constant.low, 4), constant.text(constant.high, 4), little);
  }
  return fmt::format(
      "The curves do not tell {} apart: along {} (each over its range from bound to bound) they "
      "would change by {}.",
      fmt::join(names, " and "), combination(calibration, direction), little);
}

} // namespace

Inference infer(const Calibration& calibration, const Eigen::VectorXd& residual, Eigen::MatrixXd jacobian,
                const std::vector<std::size_t>& curve_lengths) {
  const Eigen::Index n = jacobian.cols();
  Inference result;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeThinU | Eigen::ComputeFullV);
  result.jacobian = std::move(jacobian);
  result.singular = svd.singularValues();
  result.directions = svd.matrixV();
  result.independent = independent_residuals(residual, curve_lengths);
  const double degrees = std::max(1.0, result.independent - double(n));
  // Residuals are weighted by 1/√N: their squared sum is the variance of one of N; as many as are independent
  // stand in the sum of squares of the sensitivities.
  const double variance = residual.squaredNorm() / degrees;
  const double quantile = result.quantile = student(degrees);
  result.weak.resize(static_cast<std::size_t>(n));
  result.told.assign(static_cast<std::size_t>(n), true);
  result.covariance = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double change = result.singular[k];
    const Eigen::VectorXd direction = result.directions.col(k);
    const bool weak = !(change > least_change) || quantile * std::sqrt(variance) / change > widest;
    result.weak[static_cast<std::size_t>(k)] = weak;
    if (!weak) {
      result.covariance += variance / (change * change) * direction * direction.transpose();
      continue;
    }
    for (Eigen::Index c = 0; c < n; ++c)
      if (std::abs(direction[c]) >= notable) result.told[static_cast<std::size_t>(c)] = false;
    result.words.push_back(weak_words(calibration, direction, change));
  }
  result.half_width = quantile * result.covariance.diagonal().cwiseSqrt();
  return result;
}

} // namespace cnem::study
