#include "report/experiment_page.hpp"

#include "report/html.hpp"
#include "results/si_format.hpp"

#include <cmath>
#include <fmt/format.h>

namespace cnem::report {
namespace {

/// As people at presses and machine tools write it: base unit = factor × unit.
struct ShownUnit {
  double factor;
  const char* unit;
  std::string show(double value) const {
    return fmt::format("{} {}", results::number_format(value / factor, 4), unit);
  }
};

ShownUnit abscissa_unit(const evaluate::ExperimentResult& result) {
  if (!result.over_stroke) return {1e-3, "ms"};
  return {1e-3, "mm"};
}

ShownUnit force_unit(const evaluate::ExperimentResult& result) {
  if (result.force_unit != "N") return {1e3, "N/mm"};
  const bool large = result.difference.peak_measured >= 1e3;
  return large ? ShownUnit{1e3, "kN"} : ShownUnit{1.0, "N"};
}

std::string signed_percent(double share) {
  std::string text = results::number_format(100.0 * share, 3) + " %";
  return share > 0.0 ? "+" + text : text;
}

std::string cells(const std::string& name, const std::string& measured, const std::string& computed,
                  const std::string& difference) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n", name, measured,
                     computed, difference);
}

std::string difference_table(const evaluate::ExperimentResult& result) {
  const evaluate::CurveDifference& d = result.difference;
  const ShownUnit x = abscissa_unit(result), force = force_unit(result);
  const char* stroke = result.over_stroke ? "Stroke" : "Time";
  std::string html = "<table class=\"measured\">\n<tr><th></th><td>measured</td><td>computed</td>"
                     "<td>difference</td></tr>\n";
  html += cells("Largest force", force.show(d.peak_measured), force.show(d.peak_computed),
                signed_percent(d.peak_computed / d.peak_measured - 1.0));
  html += cells(fmt::format("{} there", stroke), x.show(d.at_measured), x.show(d.at_computed),
                x.show(d.at_computed - d.at_measured));
  if (d.common()) {
    if (result.over_stroke)
      html += cells("Work", results::si_format(d.area_measured, result.work_unit),
                    results::si_format(d.area_computed, result.work_unit),
                    signed_percent(d.area_computed / d.area_measured - 1.0));
    html +=
        cells("Root mean square of the difference", "", force.show(d.rms),
              fmt::format("{} % of the peak", results::number_format(100.0 * d.rms / d.peak_measured, 3)));
    html += fmt::format("<tr><th scope=\"row\">Compared from</th><td colspan=\"3\">{} to {}</td></tr>\n",
                        x.show(d.from), x.show(d.to));
  }
  return html + "</table>\n";
}

} // namespace

Chart experiment_chart(const evaluate::ExperimentResult& result) {
  const ShownUnit x = abscissa_unit(result), force = force_unit(result);
  Chart chart;
  const bool named = result.name != "measured"; // as a single one is called
  chart.title = fmt::format("Force of {}, measured and computed{}", words(result.tool),
                            named ? ": " + words(result.name) : "");
  chart.x_label = result.over_stroke ? "stroke" : "time";
  chart.x_unit = x.unit;
  chart.y_label = "force";
  chart.y_unit = force.unit;
  const auto add = [&](const char* label, const evaluate::ComparedCurve& curve, int colour, bool dashed) {
    ChartSeries& series = chart.series.emplace_back();
    series.label = label;
    series.colour = colour;
    series.dashed = dashed;
    for (const double value : curve.x) series.x.push_back(value / x.factor);
    for (const double value : curve.y) series.y.push_back(value / force.factor);
  };
  add("computed", result.computed, 0, false);
  add("measured", result.measured, 1, true);
  if (result.factor != 1.0)
    chart.note = fmt::format("Computed: the force of the model {} {}, low-passed as in the other charts.",
                             result.force_unit == "N" ? "per thickness times" : "times",
                             result.force_unit == "N" ? results::number_format(1e3 * result.factor, 4) + " mm"
                                                      : results::number_format(result.factor, 4));
  return chart;
}

std::string render_experiments(const std::vector<evaluate::ExperimentResult>& experiments) {
  std::string figures;
  for (const evaluate::ExperimentResult& result : experiments) {
    const Chart chart = experiment_chart(result);
    figures += fmt::format("<figure><h3>{}</h3>\n<div>{}{}</div>\n", html_escape(chart.title),
                           svg_chart(chart), difference_table(result));
    for (const std::string& note : {result.note, chart.note})
      if (!note.empty()) figures += fmt::format("<figcaption>{}</figcaption>", html_escape(note));
    figures += "</figure>\n";
  }
  return figures.empty() ? "" : fmt::format("<div class=\"charts experiments\">\n{}</div>\n", figures);
}

} // namespace cnem::report
