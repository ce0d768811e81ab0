#include "report/chart.hpp"
#include "report/html.hpp"
#include "results/si_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cnem::report {
namespace {

// Text of this size is read on a phone, where a chart is 340 px wide, and beside two other charts on a desk.
constexpr double width = 520, left = 64, right = 20, plot_height = 250, bottom = 56, row = 22, text_size = 15;

constexpr int colours = 8; ///< of the palette: further series are dashed

struct Axis {
  double low = 0.0, high = 1.0; ///< in the displayed unit
  results::DisplayUnit unit;
  bool logarithmic = false;
  results::Ticks ticks;

  double fraction(double value) const {
    return logarithmic ? (std::log10(value) - std::log10(low)) / (std::log10(high) - std::log10(low))
                       : (value - low) / (high - low);
  }
};

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return low > high; }
};

results::Ticks decade_ticks(double low, double high) {
  results::Ticks ticks;
  const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9));
  const int last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
  const int every = std::max(1, (last - first) / 6);
  for (int n = first; n <= last; n += every) {
    ticks.value.push_back(std::pow(10.0, n));
    ticks.label.push_back(results::number_format(ticks.value.back(), 3));
  }
  return ticks;
}

// A prefix where the unit takes one, else a power of ten: tick labels must stay short.
results::DisplayUnit axis_unit(double magnitude, const std::string& unit, const results::ShownUnits& units) {
  results::DisplayUnit display = units.of(magnitude, unit);
  if (display.offset != 0.0) return display;
  const double shown = magnitude / display.factor;
  if (!(shown > 0.0) || (shown >= 1e-2 && shown < 1e5)) return display;
  const double power = std::pow(10.0, 3.0 * std::floor(std::log10(shown) / 3.0));
  display.factor *= power;
  display.unit = unit.empty() ? results::number_format(power, 1)
                              : fmt::format("{} {}", results::number_format(power, 1), display.unit);
  return display;
}

Axis make_axis(const Extent& extent, const std::string& unit, bool logarithmic, bool padded,
               const results::ShownUnits& units) {
  Axis axis;
  axis.logarithmic = logarithmic;
  axis.unit =
      axis_unit(extent.empty() ? 1.0 : std::max(std::abs(extent.low), std::abs(extent.high)), unit, units);
  if (!extent.empty()) {
    axis.low = axis.unit.shown(extent.low);
    axis.high = axis.unit.shown(extent.high);
  }
  if (logarithmic) {
    if (!(axis.low < axis.high)) axis.low = axis.high / 10.0;
    axis.low = std::max(axis.low, axis.high * 1e-16) / 1.3;
    axis.high *= 1.3;
    axis.ticks = decade_ticks(axis.low, axis.high);
    if (axis.ticks.value.size() < 2) axis.ticks = results::round_ticks(axis.low, axis.high, 4);
    return axis;
  }
  if (padded) {
    if (axis.low > 0.0 && axis.low < 0.5 * axis.high) axis.low = 0.0;
    if (axis.high < 0.0 && axis.high > 0.5 * axis.low) axis.high = 0.0;
    const double pad = 0.05 * (axis.high - axis.low);
    if (axis.low != 0.0) axis.low -= pad;
    if (axis.high != 0.0) axis.high += pad;
  }
  // A constant to rounding is a constant: no ticks of 1e-16.
  const double least = std::max(1e-9 * std::max(std::abs(axis.low), std::abs(axis.high)), 1e-300);
  if (!(axis.high - axis.low > least)) {
    const double middle = 0.5 * (axis.low + axis.high), half = middle == 0.0 ? 1.0 : 0.5 * std::abs(middle);
    axis.low = middle - half;
    axis.high = middle + half;
  }
  axis.ticks = results::round_ticks(axis.low, axis.high, 6);
  return axis;
}

struct Frame {
  Axis x, y;
  double top = 0.0;

  double px(double value) const { return left + x.fraction(x.unit.shown(value)) * (width - left - right); }
  double py(double value) const { return top + plot_height * (1.0 - y.fraction(y.unit.shown(value))); }
};

bool drawable(const Chart& chart, const ChartSeries& series, std::size_t k) {
  return std::isfinite(series.x[k]) && std::isfinite(series.y[k]) && (!chart.log_x || series.x[k] > 0.0) &&
         (!chart.log_y || series.y[k] > 0.0);
}

// The path of a series: of all samples that fall on one column of pixels, first, least, greatest and last.
std::string path_of(const Chart& chart, const ChartSeries& series, const Frame& frame) {
  std::string path;
  bool pen_down = false;
  const auto to = [&](std::size_t k) {
    path +=
        fmt::format("{}{:.1f} {:.1f}", pen_down ? "L" : "M", frame.px(series.x[k]), frame.py(series.y[k]));
    pen_down = true;
  };
  const std::size_t count = std::min(series.x.size(), series.y.size());
  for (std::size_t k = 0; k < count;) {
    if (!drawable(chart, series, k)) {
      pen_down = false;
      ++k;
      continue;
    }
    const double column = std::floor(frame.px(series.x[k]));
    std::size_t end = k + 1, low = k, high = k;
    for (; end < count && drawable(chart, series, end) && std::floor(frame.px(series.x[end])) == column;
         ++end) {
      if (series.y[end] < series.y[low]) low = end;
      if (series.y[end] > series.y[high]) high = end;
    }
    std::vector<std::size_t> kept{k, low, high, end - 1};
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    for (const std::size_t sample : kept) to(sample);
    k = end;
  }
  return path;
}

std::string axis_label(const std::string& label, const results::DisplayUnit& unit) {
  return html_escape(unit.unit.empty() ? label : fmt::format("{} [{}]", label, unit.unit));
}

struct LegendPlace {
  double x, y;
};

std::string classes(const ChartSeries& series) {
  return fmt::format("line s{}{}{}", series.colour % colours, series.faint ? " faint" : "",
                     series.dashed || series.colour >= colours ? " dashed" : "");
}

// Left to right, wrapped; returns the place of each listed series and the number of rows.
std::vector<LegendPlace> place_legend(const Chart& chart, int& rows) {
  std::vector<LegendPlace> places;
  double x = left;
  rows = 0;
  for (const ChartSeries& series : chart.series) {
    if (series.label.empty()) {
      places.push_back({0, -1});
      continue;
    }
    const double room = 48.0 + 0.56 * text_size * static_cast<double>(series.label.size());
    if (rows == 0) rows = 1;
    if (x > left && x + room > width - right) {
      x = left;
      ++rows;
    }
    places.push_back({x, row * rows});
    x += room;
  }
  return places;
}

} // namespace

std::string svg_chart(const Chart& chart, const results::ShownUnits& units) {
  Extent x, y;
  for (const ChartSeries& series : chart.series)
    for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k)
      if (drawable(chart, series, k)) {
        x.add(series.x[k]);
        y.add(series.y[k]);
      }
  int legend_rows = 0;
  const std::vector<LegendPlace> legend = place_legend(chart, legend_rows);
  Frame frame{make_axis(x, chart.x_unit, chart.log_x, false, units),
              make_axis(y, chart.y_unit, chart.log_y, true, units), 30.0 + (row + 2) * legend_rows};
  const double base = frame.top + plot_height, end = width - right;

  std::string svg = fmt::format("<svg class=\"chart\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
                                "font-size=\"{:.0f}\">\n<title>{}</title>\n",
                                width, base + bottom, text_size, html_escape(chart.title));
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const ChartSeries& series = chart.series[k];
    if (series.label.empty()) continue;
    const double at = legend[k].y - 4;
    svg += fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}h22\"/>"
                       "<text class=\"key\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                       classes(series), legend[k].x, at, legend[k].x + 28, legend[k].y,
                       html_escape(series.label));
  }
  svg += fmt::format("<text class=\"label\" x=\"{:.0f}\" y=\"{:.1f}\">{}</text>\n", left, frame.top - 9,
                     axis_label(chart.y_label, frame.y.unit));
  for (std::size_t k = 0; k < frame.y.ticks.value.size(); ++k) {
    const double value = frame.y.ticks.value[k], at = base - plot_height * frame.y.fraction(value);
    svg += fmt::format("<path class=\"{}\" d=\"M{:.0f} {:.1f}H{:.0f}\"/><text class=\"tick\" x=\"{:.0f}\" "
                       "y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n",
                       value == 0.0 ? "zero" : "grid", left, at, end, left - 8, at + 4.5,
                       frame.y.ticks.label[k]);
  }
  for (std::size_t k = 0; k < frame.x.ticks.value.size(); ++k) {
    const double at = left + frame.x.fraction(frame.x.ticks.value[k]) * (end - left);
    svg += fmt::format(
        "<path class=\"axis\" d=\"M{:.1f} {:.1f}v5\"/><text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" "
        "text-anchor=\"middle\">{}</text>\n",
        at, base, at, base + 19, frame.x.ticks.label[k]);
  }
  svg += fmt::format("<path class=\"axis\" d=\"M{:.0f} {:.1f}H{:.0f}\"/>\n", left, base, end);
  svg += fmt::format("<text class=\"label\" x=\"{:.0f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", end,
                     base + 41, axis_label(chart.x_label, frame.x.unit));
  // Raw data first, so that the filtered curve lies above it.
  for (const bool faint : {true, false})
    for (const ChartSeries& series : chart.series)
      if (series.faint == faint)
        svg += fmt::format("<path class=\"{}\" d=\"{}\"/>\n", classes(series), path_of(chart, series, frame));
  return svg + "</svg>\n";
}

std::string svg_file(const Chart& chart, const results::ShownUnits& units) {
  constexpr const char* head = R"(<svg xmlns="http://www.w3.org/2000/svg" font-family="sans-serif")";
  constexpr const char* style =
      "\n<style>svg { background: #fff; fill: #5c6675 } path { fill: none } .grid { stroke: #e8ebef } .zero, "
      ".axis { stroke: #5c6675 } .label, .key { fill: #171b22 } .line { stroke-width: 1.9 } .s0 { stroke: "
      "#1f5fbf } .s1 { stroke: #d1495b } .s2 { stroke: #2a9d6f } .s3 { stroke: #b7791f } .s4 { stroke: "
      "#7b4fb5 "
      "} .s5 { stroke: #0f8b8d } .s6 { stroke: #8a5a44 } .s7 { stroke: #5c6675 } .faint { stroke-width: 1; "
      "stroke-opacity: 0.3 } .dashed { stroke-dasharray: 6 4 }</style>";
  std::string svg = svg_chart(chart, units);
  svg.insert(svg.find('>') + 1, style);
  return head + svg.substr(4); // behind "<svg"
}

} // namespace cnem::report
