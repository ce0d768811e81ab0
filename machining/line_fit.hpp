#pragma once
// Straight lines through means that have errors of their own and scatter beyond them.
#include <span>
#include <vector>

namespace cnem::machining {

/// A number and its standard error; an error that is not known is not-a-number.
struct Estimate {
  double value = 0.0, error = 0.0;
};

/// y = intercept + slope x. Errors are standard errors.
struct LineFit {
  Estimate intercept, slope;
  double covariance = 0.0;      ///< of intercept and slope
  double between = 0.0;         ///< standard deviation of points about the line beyond their own errors
  double r_squared = 1.0;       ///< 1 − Σ w r²/Σ w (y − ȳ)²; 1 where all y are the same and met
  std::vector<double> residual; ///< y − line, of each point
  int degrees = 0;              ///< of freedom: points less parameters

  double at(double x) const { return intercept.value + slope.value * x; }
};

/// Weighted least squares with the weights 1/(e² + s²): e the standard error of each point, s that between
/// points, so large that the weighted squares of the residuals come to their number less that of parameters
/// (Paule and Mandel 1982, J. Res. NBS 87, 377); s = 0 where the errors alone explain them. Errors that are
/// no positive numbers count as none. through_origin: the intercept is 0 exactly. With as many parameters as
/// points errors are those that e gives, or not known. As many x, y and e, two different x at least (one that
/// is not 0 through the origin).
LineFit fit_line(std::span<const double> x, std::span<const double> y, std::span<const double> error,
                 bool through_origin = false);

/// The mean with the same weights.
Estimate weighted_mean(std::span<const double> y, std::span<const double> error);

} // namespace cnem::machining
