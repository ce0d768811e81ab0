#include "report/experiment_page.hpp"

#include "report/html.hpp"
#include "results/si_format.hpp"

#include <cmath>
#include <fmt/format.h>

namespace cnem::report {
namespace {

/// As people at presses and machine tools write it, where nothing else is chosen.
results::ShownUnits usual(const evaluate::ExperimentResult& result, const results::ShownUnits& chosen) {
  const bool large = result.difference.peak_measured >= 1e3; // N
  return chosen.otherwise({"mm", "ms", result.force_unit != "N" ? "N/mm" : large ? "kN" : "N"});
}

const char* abscissa_unit(const evaluate::ExperimentResult& result) { return result.over_stroke ? "m" : "s"; }

std::string signed_percent(double share) {
  std::string text = results::number_format(100.0 * share, 3) + " %";
  return share > 0.0 ? "+" + text : text;
}

std::string cells(const std::string& name, const std::string& measured, const std::string& computed,
                  const std::string& difference) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n", name, measured,
                     computed, difference);
}

std::string difference_table(const evaluate::ExperimentResult& result, const results::ShownUnits& units) {
  const evaluate::CurveDifference& d = result.difference;
  if (result.computed.x.empty()) return "";
  const auto x = [&](double value) { return units.format(value, abscissa_unit(result)); };
  const auto force = [&](double value) { return units.format(value, result.force_unit); };
  const auto work = [&](double value) { return units.format(value, result.work_unit); };
  const char* stroke = result.over_stroke ? "Stroke" : "Time";
  std::string html =
      "<div class=\"scroll\"><table class=\"measured\">\n<tr><th></th><td>measured</td><td>computed</td>"
      "<td>difference</td></tr>\n";
  html += cells("Largest force", force(d.peak_measured), force(d.peak_computed),
                signed_percent(d.peak_computed / d.peak_measured - 1.0));
  html += cells(fmt::format("{} there", stroke), x(d.at_measured), x(d.at_computed),
                (d.at_computed > d.at_measured ? "+" : "") + x(d.at_computed - d.at_measured));
  if (d.common()) {
    if (result.over_stroke)
      html += cells("Work", work(d.area_measured), work(d.area_computed),
                    signed_percent(d.area_computed / d.area_measured - 1.0));
    html += cells("Root mean square of the difference", "", "",
                  fmt::format("{}, {} % of the peak", force(d.rms),
                              results::number_format(100.0 * d.rms / d.peak_measured, 3)));
    html += fmt::format("<tr><th scope=\"row\">Compared from</th><td colspan=\"3\">{} to {}</td></tr>\n",
                        x(d.from), x(d.to));
  }
  return html + "</table></div>\n";
}

} // namespace

Chart experiment_chart(const evaluate::ExperimentResult& result, const results::ShownUnits& units) {
  Chart chart;
  const bool named = result.name != "measured"; // as a single one is called
  chart.title = fmt::format("Force of {}, measured and computed{}", words(result.tool),
                            named ? ": " + words(result.name) : "");
  chart.x_label = result.over_stroke ? "stroke" : "time";
  chart.x_unit = abscissa_unit(result);
  chart.y_label = "force";
  chart.y_unit = result.force_unit;
  const auto add = [&](const char* label, const evaluate::ComparedCurve& curve, int colour, bool dashed) {
    ChartSeries& series = chart.series.emplace_back();
    series.label = label;
    series.colour = colour;
    series.dashed = dashed;
    series.x = curve.x;
    series.y = curve.y;
  };
  add("computed", result.computed, 0, false);
  add("measured", result.measured, 1, true);
  if (result.factor != 1.0)
    chart.note = fmt::format("Computed: the force of the model {} {}, low-passed as in the other charts.",
                             result.force_unit == "N" ? "per thickness times" : "times",
                             result.force_unit == "N" ? units.format(result.factor, "m")
                                                      : results::number_format(result.factor, 4));
  return chart;
}

std::string render_experiments(const std::vector<evaluate::ExperimentResult>& experiments,
                               const results::ShownUnits& chosen) {
  std::string figures;
  for (const evaluate::ExperimentResult& result : experiments) {
    const results::ShownUnits units = usual(result, chosen);
    const Chart chart = experiment_chart(result, units);
    figures += fmt::format("<figure><h3>{}</h3>\n<div>{}{}</div>\n", html_escape(chart.title),
                           svg_chart(chart, units), difference_table(result, units));
    for (const std::string& note : {result.note, chart.note})
      if (!note.empty()) figures += fmt::format("<figcaption>{}</figcaption>", html_escape(note));
    figures += "</figure>\n";
  }
  return figures.empty() ? "" : fmt::format("<div class=\"charts experiments\">\n{}</div>\n", figures);
}

} // namespace cnem::report
