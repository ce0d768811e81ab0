#include "evaluate/cutting_forces.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace cnem::evaluate {
namespace {

constexpr double breaks_out = 2.5; ///< feeds before the end of a workpiece: docs/cutting.md
constexpr double grid = 0.125;     ///< of the feed: parts begin and end on such places
constexpr double of_whole = 0.005; ///< or of the cut, where that is more

/// A column at a length of cut, linear between rows.
double value_at(const std::vector<double>& cut, const std::vector<double>& column, double at) {
  const auto upper = std::upper_bound(cut.begin(), cut.end(), at);
  const auto k = index_of(std::clamp<std::ptrdiff_t>(upper - cut.begin(), 1, std::ssize(cut) - 1));
  const double s = std::clamp((at - cut[k - 1]) / (cut[k] - cut[k - 1]), 0.0, 1.0);
  return (1.0 - s) * column[k - 1] + s * column[k];
}

/// A part of a cut as it is judged.
struct Judged {
  CutForce mean, spread;
  std::string fault; ///< empty: it is steady
};

/// Rise of a force over a part, by least squares, and scatter about the line.
struct Trend {
  double rise = 0.0, scatter = 0.0, spread = 0.0;
};
Trend trend_of(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, syy = 0.0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double u = x[k] - x.front(), v = y[k] - y.front();
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
    syy += v * v;
  }
  const double xx = sxx - sx * sx / n, xy = sxy - sx * sy / n, yy = std::max(0.0, syy - sy * sy / n);
  Trend trend;
  trend.spread = std::sqrt(yy / n);
  if (!(xx > 0.0)) return trend;
  trend.rise = xy / xx * (x.back() - x.front());
  trend.scatter = std::sqrt(std::max(0.0, yy - xy * xy / xx) / n);
  return trend;
}

class Judge {
public:
  Judge(const CutImpulse& impulse, const SteadyRule& rule)
      : impulse_(impulse), rule_(rule), filtered_(filtered_forces(impulse, rule.window)) {}

  Judged operator()(double from, double to) const {
    Judged part;
    part.mean = mean_force(impulse_, from, to);
    std::vector<double> cut;
    std::array<std::vector<double>, 2> force;
    for (std::size_t k = 0; k < impulse_.rows(); ++k) {
      if (impulse_.cut[k] < from || impulse_.cut[k] > to) continue;
      cut.push_back(impulse_.cut[k]);
      force[0].push_back(filtered_[k].Fc);
      force[1].push_back(filtered_[k].Ft);
    }
    if (cut.size() < 6) {
      part.fault = "forces are recorded at fewer than six places of it";
      return part;
    }
    const double allowed = rule_.tolerance * std::abs(part.mean.Fc);
    const std::array<const char*, 2> name{"Fc", "Ft"};
    for (std::size_t c = 0; c < 2; ++c) {
      const double mean = c == 0 ? part.mean.Fc : part.mean.Ft;
      const Trend trend = trend_of(cut, force[c]);
      (c == 0 ? part.spread.Fc : part.spread.Ft) = trend.spread;
      if (!part.fault.empty()) continue;
      const auto off = [&](double begin, double end) {
        const CutForce own = mean_force(impulse_, begin, end);
        return std::abs((c == 0 ? own.Fc : own.Ft) - mean);
      };
      const double third = (to - from) / 3.0, end = rule_.tooth > 0.0 ? rule_.tooth : rule_.feed;
      const double thirds =
          std::max({off(from, from + third), off(from + third, to - third), off(to - third, to)});
      const double ends = std::max(off(from, from + end), off(to - end, to));
      const double whole = std::abs(part.mean.Fc);
      if (thirds > allowed)
        part.fault = fmt::format("a third of it has a mean {} that is off by {:.0f}% of Fc", name[c],
                                 100.0 * thirds / whole);
      else if (ends > 2.0 * allowed)
        part.fault =
            fmt::format("{} at one of its ends is off by {:.0f}% of Fc", name[c], 100.0 * ends / whole);
      else if (std::abs(trend.rise) > std::max(allowed, trend.scatter))
        part.fault = fmt::format("{} {} by {:.2g}% of Fc over it, more than its scatter of {:.2g}%", name[c],
                                 trend.rise > 0.0 ? "rises" : "falls", 100.0 * std::abs(trend.rise) / whole,
                                 100.0 * trend.scatter / whole);
    }
    return part;
  }

private:
  const CutImpulse& impulse_;
  const SteadyRule& rule_;
  std::vector<CutForce> filtered_;
};

/// Where the tool has met the workpiece: the last row before a force.
double met(const CutImpulse& impulse) {
  const auto touched =
      std::ranges::find_if(impulse.Fc, [&](double sum) { return sum != impulse.Fc.front(); });
  const auto row = touched - impulse.Fc.begin();
  return impulse.cut[index_of(std::clamp<std::ptrdiff_t>(row - 1, 0, std::ssize(impulse.cut) - 1))];
}

SteadyPart taken(const Judged& judged, double from, double to) {
  return {judged.fault.empty(), judged.fault, from, to, judged.mean, judged.spread};
}

} // namespace

CutForce mean_force(const CutImpulse& impulse, double from, double to) {
  const auto difference = [&](const std::vector<double>& column) {
    return value_at(impulse.cut, column, to) - value_at(impulse.cut, column, from);
  };
  const double duration = difference(impulse.time);
  return {difference(impulse.Fc) / duration, difference(impulse.Ft) / duration};
}

std::vector<CutForce> filtered_forces(const CutImpulse& impulse, double window) {
  std::vector<CutForce> filtered;
  const double first = impulse.cut.front(), last = impulse.cut.back();
  for (std::size_t k = 0; k < impulse.rows(); ++k) {
    // At least from row to row: between them nothing is known.
    const double before = std::min(impulse.cut[k] - 0.5 * window, impulse.cut[k > 0 ? k - 1 : 0]);
    const double after =
        std::max(impulse.cut[k] + 0.5 * window, impulse.cut[std::min(k + 1, impulse.rows() - 1)]);
    filtered.push_back(mean_force(impulse, std::max(first, before), std::min(last, after)));
  }
  return filtered;
}

SteadyPart steady_part(const CutImpulse& impulse, const SteadyRule& rule) {
  SteadyPart none;
  if (impulse.rows() < 2 || !(impulse.cut.back() > impulse.cut.front())) {
    none.note = "the tool has not moved";
    return none;
  }
  const double begin = met(impulse);
  const double last = std::max(std::min(impulse.cut.back(), rule.end - breaks_out * rule.feed),
                               begin + 0.5 * (impulse.cut.back() - begin));
  const double first = begin + rule.feed; // before that there is no chip
  // Each third is of whole teeth.
  const double fine = std::max(grid * rule.feed, of_whole * (last - begin));
  const double unit = rule.tooth > 0.0 ? 3.0 * rule.tooth : fine;
  const double least = std::ceil(rule.feeds * rule.feed / unit - 1e-9) * unit;
  const Judge judge(impulse, rule);
  if (last - first < least * (1.0 - 1e-9)) {
    const double from = 0.5 * (begin + last);
    none = taken(judge(from, last), from, last);
    none.steady = false;
    none.note = fmt::format("the cut is {:.3g} feeds long, {:.3g} are needed, one of them for the entry",
                            (last - begin) / rule.feed, least / rule.feed + 1.0);
    return none;
  }
  for (double length = std::floor((last - first) / unit + 1e-9) * unit; length >= least * (1.0 - 1e-9);
       length -= unit)
    for (double to = last; to - length >= first - 1e-9 * last; to -= fine) {
      const double from = std::max(first, to - length);
      if (const Judged judged = judge(from, to); judged.fault.empty()) return taken(judged, from, to);
    }
  none = taken(judge(last - least, last), last - least, last);
  none.note =
      fmt::format("no {:.3g} feeds of the cut are steady; of the last: {}", least / rule.feed, none.note);
  return none;
}

} // namespace cnem::evaluate
