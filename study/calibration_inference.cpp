// What curves say of constants: sensitivities, intervals, and what they do not tell.
#include "study/calibration.hpp"

#include <Eigen/SVD>
#include <boost/math/distributions/students_t.hpp>

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

/// Of how many independent ones so many residuals of curves tell: near ones on a curve err alike. N/(1 + 2 Σ
/// ρ) by their correlations ρ up to the first that is not positive (Geyer 1992: pair); two at least of each.
double independent_residuals(const Eigen::VectorXd& residual, const std::vector<std::size_t>& lengths) {
  double independent = 0.0;
  Eigen::Index from = 0;
  for (const std::size_t length : lengths) {
    const auto n = static_cast<Eigen::Index>(length);
    const Eigen::VectorXd part = residual.segment(from, n);
    const double all = part.squaredNorm();
    double sum = 0.0;
    for (Eigen::Index apart = 1; apart < n; ++apart) {
      const double correlation = part.head(n - apart).dot(part.tail(n - apart)) / all;
      if (!(correlation > 0.0)) break;
      sum += correlation;
    }
    independent += std::max(std::min(2.0, double(length)), double(length) / (1.0 + 2.0 * sum));
    from += n;
  }
  return independent;
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

/// Columns whose sensitivity is known.
std::vector<Eigen::Index> known_columns(const Eigen::MatrixXd& jacobian) {
  std::vector<Eigen::Index> known;
  for (Eigen::Index k = 0; k < jacobian.cols(); ++k)
    if (jacobian.col(k).allFinite()) known.push_back(k);
  return known;
}

/// Fills singular values, falling, and directions [constant][direction], as many as there are known columns.
void decompose(Inference& result, const std::vector<Eigen::Index>& known) {
  const auto n = static_cast<Eigen::Index>(known.size());
  result.singular = Eigen::VectorXd::Zero(n); // fewer residuals than constants leave some at 0
  result.directions = Eigen::MatrixXd::Zero(result.jacobian.cols(), n);
  if (n == 0) return;
  const Eigen::MatrixXd part = result.jacobian(Eigen::all, known);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(part, Eigen::ComputeFullV);
  result.singular.head(svd.singularValues().size()) = svd.singularValues();
  result.directions(known, Eigen::all) = svd.matrixV();
}

std::string unknown_words(const SoughtConstant& constant) {
  return fmt::format(
      "How the curves depend on {} is not known, because the evaluations beside what was found "
      "failed: it has no interval, and those of other constants take it as given.",
      constant.name);
}

} // namespace

double student_quantile(double degrees) {
  constexpr double largest = 1e9; // far beyond any use, and finite
  using Policy = boost::math::policies::policy<
      boost::math::policies::overflow_error<boost::math::policies::ignore_error>>;
  return std::min(
      largest, boost::math::quantile(boost::math::students_t_distribution<double, Policy>(degrees), 0.975));
}

Eigen::VectorXd logarithmic_values(const Calibration& calibration, const Eigen::VectorXd& place,
                                   const Eigen::MatrixXd& jacobian) {
  const std::vector<Eigen::Index> known = known_columns(jacobian);
  if (known.empty()) return {};
  Eigen::MatrixXd part = jacobian(Eigen::all, known) * std::sqrt(double(jacobian.rows()));
  for (std::size_t c = 0; c < known.size(); ++c) {
    const SoughtConstant& constant = calibration.constants[static_cast<std::size_t>(known[c])];
    part.col(static_cast<Eigen::Index>(c)) *=
        constant.logarithmic ? 1.0 / std::log(constant.high / constant.low)
                             : constant.at(place[known[c]]) / (constant.high - constant.low);
  }
  return Eigen::JacobiSVD<Eigen::MatrixXd>(part).singularValues();
}

Inference infer(const Calibration& calibration, const Eigen::VectorXd& residual, Eigen::MatrixXd jacobian,
                const std::vector<std::size_t>& curve_lengths, double known_variance) {
  const Eigen::Index n = jacobian.cols();
  Inference result;
  result.jacobian = std::move(jacobian);
  const std::vector<Eigen::Index> known = known_columns(result.jacobian);
  decompose(result, known);
  result.independent = independent_residuals(residual, curve_lengths);
  result.degrees = std::max(0.0, result.independent - double(n));
  // Residuals are weighted by 1/√N: their squared sum is the variance of one of N; as many as are independent
  // stand in the sum of squares of the sensitivities.
  const bool scatter = result.degrees > 0.0;
  const double variance = std::max(known_variance, scatter ? residual.squaredNorm() / result.degrees : 0.0);
  constexpr double normal = 1.959963984540054; // what Student's t comes to where errors are known
  const double quantile = result.quantile = scatter                ? student_quantile(result.degrees)
                                            : known_variance > 0.0 ? normal
                                                                   : 0.0;
  if (!result.intervals())
    result.words.push_back(fmt::format(
        "There are no intervals: the curves come to {:.1f} independent residuals for {} constants.",
        result.independent, n));
  result.told.assign(static_cast<std::size_t>(n), false);
  for (const Eigen::Index k : known) result.told[static_cast<std::size_t>(k)] = true;
  for (std::size_t k = 0; k < result.told.size(); ++k)
    if (!result.told[k]) result.words.push_back(unknown_words(calibration.constants[k]));
  result.covariance = Eigen::MatrixXd::Zero(n, n);
  // Along a direction that is not told places may lie anywhere between the bounds, and take a told constant a
  // little way with them.
  Eigen::VectorXd astray = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 0; k < result.singular.size(); ++k) {
    const double change = result.singular[k];
    const Eigen::VectorXd direction = result.directions.col(k);
    const bool weak = !(change > least_change) || quantile * std::sqrt(variance) / change > widest;
    result.weak.push_back(weak);
    if (!weak) {
      result.covariance += variance / (change * change) * direction * direction.transpose();
      continue;
    }
    astray += widest * widest * direction.cwiseAbs2();
    for (Eigen::Index c = 0; c < n; ++c)
      if (std::abs(direction[c]) >= notable) result.told[static_cast<std::size_t>(c)] = false;
    result.words.push_back(weak_words(calibration, direction, change));
  }
  result.half_width =
      result.intervals()
          ? Eigen::VectorXd((quantile * quantile * result.covariance.diagonal() + astray).cwiseSqrt())
          : Eigen::VectorXd::Zero(n);
  return result;
}

} // namespace cnem::study
