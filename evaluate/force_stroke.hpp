#pragma once
// Forces of tools over their stroke, from the columns of a history.
#include "evaluate/blanking_result.hpp"
#include "results/history_writer.hpp"

#include <optional>
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
  std::vector<double> time, stroke;                   ///< s, m, of each row
  std::vector<double> force;                          ///< N/m (N), of each row
  std::vector<double> even_time, even_stroke, smooth; ///< low-passed, at even times
  std::size_t largest = 0;                            ///< index of the largest size in `smooth`
  double work = 0.0; ///< J/m (J), done by the tool: the last value of its column
};

/// along: unit vector of the cutting direction, in which the stroke counts too. The history has at least one
/// row and the columns force, displacement and work of the tool, with components z in space; the displacement
/// of the dies' mean is taken off the stroke.
ForceCurve force_curve(const results::HistoryTable& history, const std::string& tool,
                       const std::string& punch, const std::vector<std::string>& dies, const Vec3& along);

/// Names of the tools, or of the supports as "support.NAME", that a history has forces of.
std::vector<std::string> tools_of(const results::HistoryTable& history);
std::vector<std::string> supports_of(const results::HistoryTable& history);
/// The tool with the longest stroke; none where no tool moves.
std::optional<std::string> moving_tool(const results::HistoryTable& history);

/// The force that says most of a run.
struct LeadingForce {
  std::string of;                     ///< a tool, or "support.NAME"
  Vec3 along{0, 0, 0};                ///< unit vector
  bool over_stroke = false;           ///< else over time
  std::vector<std::string> against{}; ///< the mean displacement of these tools is taken off the stroke
};

/// That of the tool that moves farthest, along its way at the end; where none moves, of the tool or else the
/// support with the largest impulse, along the axis on which it is: peaks of waves come and go. None where
/// nothing has a force.
std::optional<LeadingForce> leading_force(const results::HistoryTable& history);
/// That of the punch along the cut.
LeadingForce leading_force(const BlankingResult& result);

/// Its curve in a history, which has its columns; without `over_stroke` the strokes are empty, and the work
/// of a support is not-a-number.
ForceCurve force_curve(const results::HistoryTable& history, const LeadingForce& force);

/// Largest force, where, and work.
ToolForce largest_force(const ForceCurve& curve, const std::string& tool);

} // namespace cnem::evaluate
