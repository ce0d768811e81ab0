#pragma once
// Forces of tools over their stroke, from the columns of a history.
#include "evaluate/blanking_result.hpp"
#include "results/history_writer.hpp"

#include <string>
#include <vector>

namespace cnem::evaluate {

/// Evenly spread times, enough for a smooth curve: as many as there are, at most 600.
std::vector<double> even_times(const std::vector<double>& t);
/// y(t), linear between increasing times, at other times.
std::vector<double> interpolated(const std::vector<double>& t, const std::vector<double>& y,
                                 const std::vector<double>& at);
/// Standard deviation, s, of the Gaussian low-pass that forces are shown and judged with: a hundredth of the
/// run.
double force_filter(const std::vector<double>& t);

/// Low-pass of the series y(t) at uneven, increasing times by a Gaussian of standard deviation `sigma` (unit
/// of t), evaluated at `at`. Samples weigh as much as the interval they stand for and the weights are
/// normalised, so that constants stay, up to the ends. Not-a-number is left out.
std::vector<double> gaussian_filter(const std::vector<double>& t, const std::vector<double>& y, double sigma,
                                    const std::vector<double>& at);

/// The force of a tool along a direction over the stroke of the punch.
struct ForceCurve {
  std::vector<double> time, stroke;        ///< s, m, of each row
  std::vector<double> force;               ///< N/m (N), of each row
  std::vector<double> even_stroke, smooth; ///< low-passed, at even times
  std::size_t largest = 0;                 ///< index of the largest size in `smooth`
  double work = 0.0;                       ///< J/m (J), done by the tool: the last value of its column
};

/// along: unit vector of the cutting direction, in which the stroke counts too. The history has at least one
/// row and the columns force, displacement and work of the tool; the displacement of the dies' mean is taken
/// off the stroke.
ForceCurve force_curve(const results::HistoryTable& history, const std::string& tool,
                       const std::string& punch, const std::vector<std::string>& dies, const Vec2& along);

/// Largest force, where, and work.
ToolForce largest_force(const ForceCurve& curve, const std::string& tool);

} // namespace cnem::evaluate
