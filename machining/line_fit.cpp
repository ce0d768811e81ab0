#include "machining/line_fit.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace cnem::machining {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Which of intercept and slope are free.
enum class Form { line, through_origin, constant };

int parameters_of(Form form) { return form == Form::line ? 2 : 1; }

class WeightedLine {
public:
  WeightedLine(std::span<const double> x, std::span<const double> y, std::span<const double> error, Form form)
      : x_(x), y_(y), form_(form), own_(x.size(), 0.0) {
    for (std::size_t k = 0; k < own_.size(); ++k)
      if (error[k] > 0.0 && std::isfinite(error[k])) own_[k] = error[k] * error[k];
  }

  LineFit fit() {
    LineFit line;
    line.degrees = static_cast<int>(x_.size()) - parameters_of(form_);
    const bool all_known = std::all_of(own_.begin(), own_.end(), [](double e) { return e > 0.0; });
    if (line.degrees <= 0) {
      solve(line, 0.0, !all_known);
      if (!all_known) line.intercept.error = line.slope.error = line.covariance = unknown;
      return line;
    }
    line.between = std::sqrt(variance_between(line, all_known));
    return line;
  }

private:
  /// The line with this variance between points, or with even weights; returns Σ w r².
  double solve(LineFit& line, double between, bool even) const {
    double n = 0.0, sx = 0.0, sy = 0.0;
    const auto weight = [&](std::size_t k) { return even ? 1.0 : 1.0 / (own_[k] + between); };
    for (std::size_t k = 0; k < x_.size(); ++k) {
      n += weight(k);
      sx += weight(k) * x_[k];
      sy += weight(k) * y_[k];
    }
    const double x0 = form_ == Form::line ? sx / n : 0.0, mean = sy / n;
    double sxx = 0.0, sxy = 0.0;
    for (std::size_t k = 0; k < x_.size(); ++k) {
      sxx += weight(k) * (x_[k] - x0) * (x_[k] - x0);
      sxy += weight(k) * (x_[k] - x0) * y_[k];
    }
    line.slope = form_ == Form::constant ? Estimate{} : Estimate{sxy / sxx, 1.0 / std::sqrt(sxx)};
    line.intercept = {};
    line.covariance = 0.0;
    if (form_ == Form::constant) line.intercept = {mean, 1.0 / std::sqrt(n)};
    if (form_ == Form::line) {
      line.intercept = {mean - line.slope.value * x0, std::sqrt(1.0 / n + x0 * x0 / sxx)};
      line.covariance = -x0 / sxx;
    }
    double squares = 0.0, about_mean = 0.0;
    line.residual.resize(x_.size());
    for (std::size_t k = 0; k < x_.size(); ++k) {
      line.residual[k] = y_[k] - line.at(x_[k]);
      squares += weight(k) * line.residual[k] * line.residual[k];
      about_mean += weight(k) * (y_[k] - mean) * (y_[k] - mean);
    }
    line.r_squared = about_mean > 0.0 ? 1.0 - squares / about_mean : 1.0;
    return squares;
  }

  /// Leaves the line that goes with it.
  double variance_between(LineFit& line, bool all_known) const {
    const double degrees = line.degrees;
    if (all_known && solve(line, 0.0, false) <= degrees) return 0.0;
    // The squares fall with the variance; at n times their even mean they are below the degrees surely.
    const double even = solve(line, 0.0, true);
    if (!(even > 0.0)) { // a line without any scatter: nothing is to be said beyond
      line.intercept.error = line.slope.error = line.covariance = 0.0;
      return 0.0;
    }
    double low = 0.0, high = even;
    for (int k = 0; k < 200 && high - low > 1e-14 * high; ++k) {
      const double middle = 0.5 * (low + high);
      (solve(line, middle, false) > degrees ? low : high) = middle;
    }
    solve(line, high, false);
    return high;
  }

  std::span<const double> x_, y_;
  Form form_;
  std::vector<double> own_; ///< squares of errors
};

} // namespace

LineFit fit_line(std::span<const double> x, std::span<const double> y, std::span<const double> error,
                 bool through_origin) {
  assert(x.size() == y.size() && x.size() == error.size() && !x.empty());
  return WeightedLine(x, y, error, through_origin ? Form::through_origin : Form::line).fit();
}

Estimate weighted_mean(std::span<const double> y, std::span<const double> error) {
  assert(y.size() == error.size() && !y.empty());
  const std::vector<double> x(y.size(), 0.0);
  return WeightedLine(x, y, error, Form::constant).fit().intercept;
}

} // namespace cnem::machining
