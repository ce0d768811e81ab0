#include "study/laminate.hpp"

#include "core/index.hpp"
#include "input/schema/units.hpp"
#include "report/html.hpp"
#include "results/fields.hpp"
#include "results/si_format.hpp"
#include "study/page.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace cnem::study {
namespace {

constexpr const char* premise =
    "Plies do not interact: each is cut alone, with its share of the edge, as if its neighbours were not "
    "there. They neither hold each other nor bend together, and interfaces between them have no strength: a "
    "difference of damaged depths says where they would come apart first, not that they do.";

/// Of the numbers that are known; not-a-number where none is.
double largest_of(const std::vector<double>& values) {
  double most = std::numeric_limits<double>::quiet_NaN();
  for (const double value : values)
    if (!(value <= most) && std::isfinite(value)) most = value;
  return most;
}

std::string shown_number(double value, const results::DisplayUnit& unit) {
  return std::isfinite(value) ? results::number_format(unit.shown(value), 4) : "";
}

/// Why there is no largest sum.
std::string early_end(const LaminateCut& cut) {
  return fmt::format("a chip is not off after {}, where the shortest cut of a ply ends",
                     results::si_format(cut.common, "m"));
}

/// A column of the table of plies: of each and of the laminate.
struct PlyColumn {
  std::string head, unit;
  std::vector<double> ply;
  double all;

  double size() const {
    double most = std::isfinite(all) ? std::abs(all) : 0.0;
    for (const double value : ply)
      if (std::isfinite(value)) most = std::max(most, std::abs(value));
    return most;
  }
};

/// [interface] as a column of the plies above.
std::vector<double> below(const std::vector<double>& interfaces) {
  std::vector<double> column = interfaces;
  column.push_back(std::numeric_limits<double>::quiet_NaN());
  return column;
}

std::vector<PlyColumn> ply_columns(const LaminateCut& cut) {
  std::vector<PlyColumn> columns{{"Fc", "N", cut.Fc, cut.Fc_sum},
                                 {"Ft", "N", cut.Ft, cut.Ft_sum},
                                 {"Fc_peak", "N", cut.Fc_peak, cut.peak}};
  for (const LaminateColumn& column : cut.columns)
    columns.push_back({column.name, column.unit, column.ply, column.mean});
  columns.push_back({"damage_depth", "m", cut.damage_depth, largest_of(cut.damage_depth)});
  columns.push_back({"delamination", "m", below(cut.delamination), largest_of(cut.delamination)});
  return columns;
}

} // namespace

std::string laminate_table(const Study& study, const std::vector<std::size_t>& run, const LaminateCut& cut) {
  const std::vector<LaminatePly>& plies = study.laminate->plies;
  const std::vector<PlyColumn> columns = ply_columns(cut);
  std::string csv = "ply,angle[deg],thickness[m],run";
  for (const PlyColumn& column : columns)
    csv += "," + csv_field(results::with_unit(column.head, column.unit));
  const auto number = [](double value) {
    return std::isfinite(value) ? "," + input::format_number(value) : std::string(",");
  };
  for (std::size_t k = 0; k < plies.size(); ++k) {
    csv += "\n" + csv_field(plies[k].name) +
           fmt::format(",{:.12g}", plies[k].angle * 180.0 / std::numbers::pi) + number(plies[k].thickness) +
           "," + csv_field(study.runs[run[k]].name);
    for (const PlyColumn& column : columns) csv += number(column.ply[k]);
  }
  csv += "\nlaminate," + number(cut.thickness) + ",";
  for (const PlyColumn& column : columns) csv += number(column.all);
  return csv + "\n";
}

std::string laminate_section(const Study& study, const std::vector<std::size_t>& run, const LaminateCut& cut,
                             const results::ShownUnits& units) {
  const std::vector<LaminatePly>& plies = study.laminate->plies;
  const std::vector<PlyColumn> columns = ply_columns(cut);
  std::string rows = "<tr>" + cell("ply", "th") + cell("angle [°]", "th");
  const results::DisplayUnit thickness = units.of(cut.thickness, "m");
  rows += cell("thickness [" + thickness.unit + "]", "th") + cell("run", "th");
  std::vector<results::DisplayUnit> shown;
  for (const PlyColumn& column : columns) {
    shown.push_back(units.of(column.size(), column.unit));
    const std::string& unit = shown.back().unit;
    rows += cell(report::words(column_name(column.head)) + (unit.empty() ? "" : " [" + unit + "]"), "th");
  }
  rows += "</tr>\n";
  for (std::size_t k = 0; k < plies.size(); ++k) {
    rows += "<tr>" + cell(plies[k].name) +
            cell(results::number_format(plies[k].angle * 180.0 / std::numbers::pi, 6)) +
            cell(shown_number(plies[k].thickness, thickness)) + cell(study.runs[run[k]].name);
    for (std::size_t c = 0; c < columns.size(); ++c) rows += cell(shown_number(columns[c].ply[k], shown[c]));
    rows += "</tr>\n";
  }
  rows +=
      "<tr>" + cell("laminate", "th") + cell("") + cell(shown_number(cut.thickness, thickness)) + cell("");
  for (std::size_t c = 0; c < columns.size(); ++c) rows += cell(shown_number(columns[c].all, shown[c]), "th");
  rows += "</tr>\n";
  const std::string text = fmt::format(
      "<p>{}</p>\n<p>Forces in N are those of the shares of the edge and of the whole; the peak of the "
      "laminate is that of their sum at the same length of cut. Plies are fully engaged at different lengths "
      "of cut, so that it may lie below the sum of their means. Other numbers of the laminate are means over "
      "the thickness, but the damaged depth and the delamination indicator, the difference to the depth of "
      "the next ply, of which the largest stands there.</p>\n",
      premise);
  const std::string missing =
      cut.ends_early()
          ? fmt::format("<p>The largest sum of the laminate is not known: {}.</p>\n", early_end(cut))
          : "";
  const std::string chart =
      cut.forces.series.empty()
          ? ""
          : fmt::format("<div class=\"charts\">\n<figure><h3>{}</h3>\n{}</figure>\n</div>\n",
                        report::html_escape(cut.forces.title), report::svg_chart(cut.forces, units));
  return fmt::format("<section id=\"laminate\">\n<h2>Laminate</h2>\n{}<div class=\"runs\"><table>\n{}"
                     "</table></div>\n{}</section>\n",
                     text + missing, rows, chart);
}

std::string laminate_line(const LaminateCut& cut) {
  if (!std::isfinite(cut.Fc_sum)) return "laminate: a ply has no forces yet\n";
  std::string text = fmt::format("laminate of {}: Fc {}, Ft {}", results::si_format(cut.thickness, "m"),
                                 results::si_format(cut.Fc_sum, "N"), results::si_format(cut.Ft_sum, "N"));
  if (std::isfinite(cut.peak))
    text += fmt::format(", largest sum {} after {} of cut", results::si_format(cut.peak, "N"),
                        results::si_format(cut.peak_at, "m"));
  if (cut.ends_early()) text += ", largest sum not known: " + early_end(cut);
  if (const double most = largest_of(cut.delamination); std::isfinite(most))
    text += fmt::format(", damaged depths of neighbours differ by up to {}", results::si_format(most, "m"));
  return text + " (plies do not interact)\n";
}

} // namespace cnem::study
