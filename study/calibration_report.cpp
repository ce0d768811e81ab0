#include "study/calibration_report.hpp"

#include "report/chart.hpp"
#include "report/html.hpp"
#include "results/si_format.hpp"
#include "study/page.hpp"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::study {
namespace {

std::string percent(double share) { return results::number_format(100.0 * share, 3) + " %"; }

std::string row(const std::vector<std::string>& cells, const char* tag = "td") {
  std::string html = "<tr>";
  for (const std::string& text : cells) html += cell(text, tag);
  return html + "</tr>\n";
}

std::string table_section(const std::string& id, const std::string& title, const std::string& rows,
                          const std::string& note = "") {
  return fmt::format(
      "<section id=\"{}\">\n<h2>{}</h2>\n<div class=\"runs\"><table>\n{}</table></div>\n{}</section>\n", id,
      title, rows, note.empty() ? "" : fmt::format("<p>{}</p>\n", report::html_escape(note)));
}

std::string constants_section(const Calibration& calibration, const CalibrationResult& result) {
  std::string rows = row({"constant", "key", "start", "found", "95% interval", "bounds"}, "th");
  for (std::size_t k = 0; k < calibration.constants.size(); ++k) {
    const SoughtConstant& constant = calibration.constants[k];
    const auto at = static_cast<Eigen::Index>(k);
    const double place = result.best.place[at], width = result.inference.half_width[at];
    const bool told = result.inference.told[k], bound = place < 1e-3 || place > 1.0 - 1e-3;
    std::string interval = "not told by the curves";
    if (told && !result.inference.intervals())
      interval = "none";
    else if (told)
      interval = fmt::format("{} to {}{}", constant.text(constant.at(place - width), 4),
                             constant.text(constant.at(place + width), 4),
                             place - width < 0.0 || place + width > 1.0 ? " (cut at the bounds)" : "");
    rows += row({constant.name, constant.key, constant.text(constant.start, 5),
                 constant.text(constant.at(place), 5) + (bound ? " (at a bound)" : ""), interval,
                 fmt::format("{} to {}{}", constant.text(constant.low, 4), constant.text(constant.high, 4),
                             constant.logarithmic ? ", logarithmic" : "")});
  }
  return table_section("constants", "Constants", rows);
}

std::string words_section(const char* id, const char* heading, const std::vector<std::string>& list) {
  if (list.empty()) return "";
  std::string html = fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n<ul class=\"warnings\">\n", id, heading);
  for (const std::string& words : list) html += fmt::format("<li>{}</li>\n", report::html_escape(words));
  return html + "</ul>\n</section>\n";
}

std::string curves_section(const CalibrationResult& result) {
  std::string rows = row({"curve", "before", "after"}, "th");
  for (const CalibratedCurve& curve : result.best.curves) {
    const CalibratedCurve* before = result.start.curve(curve.name);
    rows += row({curve.name + (curve.fitted ? "" : " (left out)"),
                 before ? percent(before->rms_share) : "failed", percent(curve.rms_share)});
  }
  rows += row({"all, by weight", result.start.good() ? percent(std::sqrt(result.start.misfit)) : "failed",
               percent(std::sqrt(result.best.misfit))});
  if (const auto misfit = result.best.left_out_misfit()) {
    const auto before = result.start.left_out_misfit();
    rows += row({"all that are left out", before ? percent(*before) : "failed", percent(*misfit)});
  }
  std::string note =
      "Root mean square of computed − measured over the measured curve, as a share of its peak.";
  for (const CalibratedCurve& curve : result.best.curves)
    if (!curve.note.empty()) note += fmt::format(" {}: {}", curve.name, curve.note);
  return table_section("misfit", "Misfit", rows, note);
}

std::string cuts_section(const CalibrationResult& result) {
  std::string rows;
  for (const CalibratedCurve& curve : result.best.curves) {
    if (!curve.single_number()) continue;
    const CalibratedCurve* before = result.start.curve(curve.name);
    const double measured = curve.measured.y.front();
    const auto shown = [&](const CalibratedCurve& one) {
      return results::si_format(one.computed.y.front(), curve.y_unit);
    };
    rows += row({curve.name + (curve.fitted ? "" : " (left out)"), results::si_format(measured, curve.y_unit),
                 percent(curve.relative_error), before ? shown(*before) : "failed", shown(curve),
                 fmt::format("{:+.1f} %", 100.0 * (curve.computed.y.front() - measured) / curve.peak)});
  }
  if (rows.empty()) return "";
  return table_section("cuts", "Cuts",
                       row({"number", "measured", "standard error", "before", "after", "difference"}, "th") +
                           rows);
}

std::string searches_section(const CalibrationResult& result) {
  std::string rows =
      row({"start", "evaluations", "misfit at its start", "least misfit", "ended because"}, "th");
  const auto shown = [](const VisitedPlace& place) {
    return place.good ? percent(std::sqrt(place.misfit)) : std::string("failed");
  };
  for (std::size_t k = 0; k < result.searches.size(); ++k) {
    const SearchEnd& search = result.searches[k];
    rows += row({std::to_string(k + 1), std::to_string(search.course.size()), shown(search.course.front()),
                 shown(search.course[search.best]), search.reason});
  }
  return table_section("searches", "Searches", rows,
                       result.failures > 0 ? fmt::format("{} of {} evaluations failed and counted as {:g} %.",
                                                         result.failures, result.evaluations,
                                                         100.0 * std::sqrt(failed_misfit))
                                           : "");
}

std::string sensitivity_section(const Calibration& calibration, const Inference& inference,
                                const Eigen::VectorXd& logarithmic) {
  std::vector<std::string> head{"singular value"};
  for (const SoughtConstant& constant : calibration.constants) head.push_back(constant.name);
  head.emplace_back("");
  std::string rows = row(head, "th");
  for (Eigen::Index k = 0; k < inference.singular.size(); ++k) {
    std::vector<std::string> cells{percent(inference.singular[k])};
    for (Eigen::Index c = 0; c < inference.directions.rows(); ++c)
      cells.push_back(fmt::format("{:+.2f}", inference.directions(c, k)));
    cells.emplace_back(inference.weak[static_cast<std::size_t>(k)] ? "not told" : "");
    rows += row(cells);
  }
  return table_section(
      "sensitivity", "Sensitivity", rows,
      "How much the curves change, as a share of their peaks, along each direction per range from "
      "bound to bound; each direction is a combination of the constants. Singular values of the logarithms "
      "of "
      "the curves by those of the constants: " +
          fmt::format("{:.3g}", fmt::join(logarithmic, ", ")) + ".");
}

std::string correlation_section(const Calibration& calibration, const Inference& inference) {
  std::vector<std::string> head{""};
  for (const SoughtConstant& constant : calibration.constants) head.push_back(constant.name);
  std::string rows = row(head, "th");
  const Eigen::MatrixXd& covariance = inference.covariance;
  for (Eigen::Index k = 0; k < covariance.rows(); ++k) {
    std::vector<std::string> cells{calibration.constants[static_cast<std::size_t>(k)].name};
    for (Eigen::Index c = 0; c < covariance.cols(); ++c) {
      const double scale = std::sqrt(covariance(k, k) * covariance(c, c));
      const bool told =
          inference.told[static_cast<std::size_t>(k)] && inference.told[static_cast<std::size_t>(c)];
      cells.push_back(told && scale > 0.0 ? fmt::format("{:+.2f}", covariance(k, c) / scale) : "–");
    }
    rows += row(cells);
  }
  return table_section(
      "correlations", "Correlations", rows,
      fmt::format("Of the errors of the constants. Intervals count neighbours on a curve that err "
                  "alike as one: {:.0f} residuals are independent.",
                  inference.independent));
}

report::ChartSeries series(std::string label, const evaluate::ComparedCurve& curve, int colour,
                           bool dashed = false) {
  report::ChartSeries line;
  line.label = std::move(label);
  line.x = curve.x;
  line.y = curve.y;
  line.colour = colour;
  line.dashed = dashed;
  return line;
}

std::vector<report::Chart> curve_charts(const CalibrationResult& result) {
  std::vector<report::Chart> charts;
  for (const CalibratedCurve& curve : result.best.curves) {
    if (curve.single_number()) continue; // it stands in a table
    report::Chart chart;
    chart.title = curve.name + (curve.fitted ? "" : " (left out)");
    chart.x_label = curve.of_point ? "strain" : curve.over_stroke ? "stroke" : "time";
    chart.x_unit = curve.x_unit;
    chart.y_label = curve.of_point ? "stress" : "force";
    chart.y_unit = curve.y_unit;
    chart.series.push_back(series("measured", curve.measured, 1, true));
    chart.series.push_back(series("after", curve.computed, 0));
    if (const CalibratedCurve* before = result.start.curve(curve.name))
      chart.series.push_back(series("before", before->computed, 7));
    charts.push_back(std::move(chart));
  }
  return charts;
}

std::vector<report::Chart> band_charts(const std::vector<FlowBand>& bands) {
  std::vector<report::Chart> charts;
  for (const FlowBand& band : bands) {
    report::Chart chart;
    chart.title =
        fmt::format("Flow stress of {} at {} 1/s and {} K", band.name, results::number_format(band.rate, 3),
                    results::number_format(band.temperature, 4));
    chart.x_label = "plastic strain";
    chart.x_unit = "";
    chart.y_label = "flow stress";
    chart.y_unit = "Pa";
    chart.series.push_back(series("flow stress", {band.strain, band.stress}, 0));
    for (const double way : {-1.0, 1.0}) {
      if (band.half_width.empty()) break;
      evaluate::ComparedCurve edge{band.strain, band.stress};
      for (std::size_t k = 0; k < edge.y.size(); ++k) edge.y[k] += way * band.half_width[k];
      chart.series.push_back(series(way < 0.0 ? "95% band" : "", edge, 0, true));
    }
    charts.push_back(std::move(chart));
  }
  return charts;
}

} // namespace

std::string calibration_report(const Calibration& calibration, const CalibrationResult& result,
                               const std::vector<FlowBand>& bands, const std::string& version) {
  const bool told = result.inference.words.empty();
  const std::string verdict =
      fmt::format("Misfit {}, {} before; {}", percent(std::sqrt(result.best.misfit)),
                  result.start.good() ? percent(std::sqrt(result.start.misfit)) : "failed",
                  told ? "the curves tell all constants" : "the curves do not tell all constants");
  return page({.title = calibration.title.empty() ? calibration.name : calibration.title,
               .version = version,
               .verdict = verdict,
               .good = told},
              constants_section(calibration, result) +
                  words_section("untold", "What the curves do not tell", result.inference.words) +
                  words_section("warnings", "Warnings", warnings_of(calibration, result)) +
                  curves_section(result) + cuts_section(result) +
                  chart_section(curve_charts(result), {}, "curves", "Measured and computed") +
                  chart_section(band_charts(bands), {}, "flow", "Flow stress over what the targets meet") +
                  sensitivity_section(calibration, result.inference, result.logarithmic) +
                  correlation_section(calibration, result.inference) + searches_section(result));
}

} // namespace cnem::study
