#include "report/cutting_page.hpp"

#include "core/index.hpp"
#include "report/html.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <utility>

namespace cnem::report {
namespace {

using results::HistoryTable;
using results::ShownUnits;

std::string angle_text(double angle) {
  const double tenths = std::round(1800.0 * angle / std::numbers::pi);
  return fmt::format("{}{:.1f}°", tenths < 0.0 ? "−" : "", std::abs(tenths) / 10.0);
}

/// Rows of what is known, under a title; "" when nothing is.
class CutTable {
public:
  CutTable(std::string title, const ShownUnits& units) : title_(std::move(title)), units_(units) {}
  void add(const std::string& name, const std::string& value) {
    rows_ +=
        fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", html_escape(name), html_escape(value));
  }
  void add(const std::string& name, double value, const std::string& unit) {
    if (std::isfinite(value)) add(name, units_.format(value, unit));
  }
  void angle(const std::string& name, double value) {
    if (std::isfinite(value)) add(name, angle_text(value));
  }
  std::string html() const {
    return rows_.empty()
               ? ""
               : fmt::format("<div><h3>{}</h3>\n<table>\n{}</table>\n</div>\n", html_escape(title_), rows_);
  }

private:
  std::string title_, rows_;
  const ShownUnits& units_;
};

std::string force_text(const evaluate::CuttingResult& result, double mean, double spread,
                       const ShownUnits& units) {
  const double force = result.in_newton(mean);
  const results::DisplayUnit unit = units.of(std::abs(force), "N");
  return fmt::format("{} ± {} {} ({})", results::number_format(unit.shown(force)),
                     results::number_format(unit.shown(result.in_newton(spread)), 2), unit.unit,
                     units.format(mean, "N/m"));
}

std::string force_table_html(const evaluate::CuttingResult& result, const ShownUnits& units) {
  CutTable table("Forces", units);
  if (result.breaks) {
    table.add("Chip", result.chip_completed
                          ? fmt::format("completed after {} of cut", units.format(result.completed_at, "m"))
                          : "not completed");
    table.add("Fully engaged", fmt::format("from {} to {} of cut", units.format(result.engaged_at, "m"),
                                           units.format(result.released_at, "m")));
    table.add("Largest Fc until then", result.in_newton(result.Fc_peak), "N");
    table.add("Fc from first touch to completion, mean", result.in_newton(result.Fc_of_chip), "N");
    table.add("Largest Ft until then", result.in_newton(result.Ft_peak), "N");
  } else
    table.add("Steady", result.steady
                            ? fmt::format("from {} to {} of cut", units.format(result.steady_from, "m"),
                                          units.format(result.steady_to, "m"))
                            : "not steady");
  if (result.debonds && !result.breaks) {
    table.add("Largest Fc", result.in_newton(result.Fc_peak), "N");
    table.add("Largest Ft", result.in_newton(result.Ft_peak), "N");
  }
  if (result.debonds) {
    table.add("Debonded", result.debonded_length, "m");
    table.add("Debonded below the cut, deepest", result.debonded_depth, "m");
  }
  if (std::isfinite(result.Fc)) {
    table.add("Cutting force Fc", force_text(result, result.Fc, result.Fc_spread, units));
    table.add("Thrust force Ft", force_text(result, result.Ft, result.Ft_spread, units));
    table.add("Fc on edge and flank", result.in_newton(result.edge_Fc), "N");
    table.add("Ft on edge and flank", result.in_newton(result.edge_Ft), "N");
    table.add("Specific cutting energy", result.specific_energy, "J/m^3");
  }
  table.angle("Friction angle of the whole force", result.friction_angle);
  table.add("Shear stress at the shear angle", result.shear_stress, "Pa");
  table.add("Cut", result.cut, "m");
  table.add("Feed", result.feed, "m");
  table.add("Width", result.width, "m");
  table.angle("Rake", result.rake);
  table.add("Speed", result.speed, "m/s");
  return table.html();
}

std::string chip_table_html(const evaluate::CuttingResult& result, const ShownUnits& units) {
  CutTable table("Chip", units);
  table.add("Thickness, mean", result.chip_thickness, "m");
  table.add("Thickness, peak", result.chip_peak, "m");
  table.add("Thickness, valley", result.chip_valley, "m");
  if (std::isfinite(result.chip_ratio))
    table.add("Compression ratio", results::number_format(result.chip_ratio));
  table.angle("Shear angle, from the thickness", result.shear_angle);
  table.angle("Shear angle, from the jump of speed", result.shear_angle_speed);
  table.angle("Shear angle, from the rates of strain", result.shear_angle_rate);
  table.add("Shear plane, length", result.shear_plane, "m");
  table.angle("Shear plane, angle", result.shear_plane_angle);
  table.add("Chip length", result.chip_length, "m");
  table.add("Speed on the rake face", result.chip_speed, "m/s");
  table.add("Curl radius", result.curl_radius, "m");
  table.angle("Plane that it broke off along", result.chip_plane);
  table.add("Tooth spacing", result.tooth_spacing, "m");
  table.add("Tooth frequency", result.tooth_frequency, "1/s");
  return table.html();
}

std::string face_table_html(const evaluate::CuttingResult& result, const ShownUnits& units) {
  CutTable table("Rake face and machined surface", units);
  table.add("Contact length", result.contact_length, "m");
  table.add("Interface temperature, mean", result.interface_temperature, "K");
  table.add("Largest temperature", result.temperature_max, "K");
  table.add("Largest temperature of the tool", result.tool_temperature_max, "K");
  table.add("Wear rate (Usui), mean", result.wear_rate, "m/s");
  table.add("Wear rate (Usui), largest", result.wear_rate_max, "m/s");
  table.add("Roughness", result.roughness, "m");
  table.add("Rz", result.Rz, "m");
  table.add("Fibres damaged to a depth of", result.fibre_depth, "m");
  table.add("Matrix damaged to a depth of", result.matrix_depth, "m");
  table.add("Area of damaged fibres", result.fibre_damage, "m^2");
  table.add("Area of damaged matrix", result.matrix_damage, "m^2");
  table.add("Mean height over the tool's lowest point", result.surface_height, "m");
  table.add("Residual stress at the surface, along the cut", result.residual_stress_surface, "Pa");
  if (std::isfinite(result.residual_yield))
    table.add("Largest residual stress over flow stress", results::number_format(result.residual_yield));
  if (std::isfinite(result.surface_from))
    table.add("Measured behind the tool", fmt::format("{} to {}", units.format(result.surface_from, "m"),
                                                      units.format(result.surface_to, "m")));
  return table.html();
}

/// One column over the first; none where it has no number.
void add_series(Chart& chart, const HistoryTable& table, const std::string& name, const std::string& label,
                int colour, bool faint = false) {
  const int k = table.find(name);
  if (k < 0) return;
  const std::vector<double>& y = table.column[index_of(k)];
  if (std::none_of(y.begin(), y.end(), [](double value) { return std::isfinite(value); })) return;
  ChartSeries series;
  series.label = label;
  series.x = table.column.front();
  series.y = y;
  series.colour = colour;
  series.faint = faint;
  chart.series.push_back(std::move(series));
}

Chart chart_of(std::string title, std::string x_label, std::string y_label, std::string y_unit) {
  Chart chart;
  chart.title = std::move(title);
  chart.x_label = std::move(x_label);
  chart.x_unit = "m";
  chart.y_label = std::move(y_label);
  chart.y_unit = std::move(y_unit);
  return chart;
}

Chart force_chart(const evaluate::CuttingResult& result, const ShownUnits& units) {
  Chart chart = chart_of("Forces over the cut", "length of cut", "force per width", "N/m");
  add_series(chart, result.forces, "Fc", "", 0, true);
  add_series(chart, result.forces, "Ft", "", 1, true);
  add_series(chart, result.forces, "Fc.filtered", "Fc", 0);
  add_series(chart, result.forces, "Ft.filtered", "Ft", 1);
  if (result.steady)
    for (const auto& [mean, colour] : {std::pair{result.Fc, 0}, {result.Ft, 1}}) {
      ChartSeries mark;
      mark.x = {result.steady_from, result.steady_to};
      mark.y = {mean, mean};
      mark.colour = colour;
      mark.dashed = true;
      chart.series.push_back(std::move(mark));
    }
  chart.note =
      fmt::format("Fc along the way of the tool, Ft > 0 into the workpiece. Pale: means between rows; "
                  "full: centred mean over {} of cut; dashed: mean of the steady part.",
                  units.format(result.filter, "m"));
  return chart;
}

/// The columns of cutting.csv over the cut instead of over time.
HistoryTable over_cut(HistoryTable course) {
  const int cut = course.find("cut");
  if (cut < 0) return {};
  std::swap(course.names.front(), course.names[index_of(cut)]);
  std::swap(course.column.front(), course.column[index_of(cut)]);
  return course;
}

} // namespace

std::vector<Chart> cutting_charts(const evaluate::CuttingResult& result, const ShownUnits& units) {
  const HistoryTable course = over_cut(result.course);
  std::vector<Chart> charts{force_chart(result, units)};
  Chart sizes = chart_of("Chip over the cut", "length of cut", "length", "m");
  add_series(sizes, course, "chip_thickness", "thickness, fresh", 0);
  add_series(sizes, course, "contact_length", "contact length", 1);
  add_series(sizes, course, "shear_plane", "shear plane", 2);
  charts.push_back(std::move(sizes));
  Chart heat = chart_of("Temperature over the cut", "length of cut", "temperature", "K");
  add_series(heat, course, "temperature_max", "largest", 0);
  add_series(heat, course, "interface_temperature", "interface, mean", 1);
  add_series(heat, course, "tool_temperature_max", "tool, largest", 2);
  charts.push_back(std::move(heat));
  Chart thickness =
      chart_of("Thickness along the chip", "along the rake side from the tip", "thickness", "m");
  add_series(thickness, result.chip, "thickness", "thickness", 0);
  charts.push_back(std::move(thickness));
  Chart stress = chart_of("Stress on the rake face", "from the tip", "stress", "Pa");
  add_series(stress, result.rake_face, "normal_stress", "normal", 0);
  add_series(stress, result.rake_face, "shear_stress", "shear", 1);
  stress.note =
      "Means over the part of the cut that forces are taken from; shear > 0 along the way of the chip.";
  charts.push_back(std::move(stress));
  Chart reach = chart_of("Reach of temperatures in the tool", "temperature", "length", "m");
  reach.x_unit = "K";
  add_series(reach, result.isotherms, "depth", "depth below the rake face", 0);
  add_series(reach, result.isotherms, "face_to", "along the rake face from the tip", 1);
  reach.note = "At the end of the run, without the coating: what is at least as warm.";
  charts.push_back(std::move(reach));
  Chart residual = chart_of("Stress below the machined surface", "depth", "stress", "Pa");
  add_series(residual, result.depth, "residual_along", "along the cut", 0);
  add_series(residual, result.depth, "residual_away", "normal to the surface", 1);
  add_series(residual, result.depth, "residual_across", "out of the plane", 2);
  add_series(residual, result.depth, "stress_along", "", 0, true);
  add_series(residual, result.depth, "stress_away", "", 1, true);
  add_series(residual, result.depth, "stress_across", "", 2, true);
  residual.note =
      fmt::format("Means over layers of {} and the measured length. Full: unloaded and cooled; pale: at "
                  "the end of the run, tool and supports in place.",
                  units.format(result.layer, "m", 3));
  charts.push_back(std::move(residual));
  Chart strain =
      chart_of("Plastic strain below the machined surface", "depth", "equivalent plastic strain", "");
  add_series(strain, result.depth, "plastic_strain", "plastic strain", 0);
  charts.push_back(std::move(strain));
  Chart below =
      chart_of("Temperature below the machined surface at the end of the run", "depth", "temperature", "K");
  add_series(below, result.depth, "temperature", "temperature", 0);
  charts.push_back(std::move(below));
  std::erase_if(charts,
                [](const Chart& chart) { return chart.series.empty() || chart.series.front().x.size() < 2; });
  return charts;
}

std::string render_cutting(const evaluate::CuttingResult& result, const ShownUnits& units) {
  std::string html;
  if (!result.steady) html += fmt::format("<p>Not steady: {}.</p>\n", html_escape(result.steady_note));
  for (const std::string* note : {&result.chip_note, &result.surface_note, &result.residual_note})
    if (!note->empty()) html += fmt::format("<p>{}</p>\n", html_escape(*note));
  html += fmt::format("<div class=\"tables\">\n{}{}{}</div>\n", force_table_html(result, units),
                      chip_table_html(result, units), face_table_html(result, units));
  html += "<div class=\"charts\">\n";
  for (const Chart& chart : cutting_charts(result, units)) {
    html += fmt::format("<figure><h3>{}</h3>\n{}", html_escape(chart.title), svg_chart(chart, units));
    if (!chart.note.empty()) html += fmt::format("<figcaption>{}</figcaption>", html_escape(chart.note));
    html += "</figure>\n";
  }
  html += "</div>\n";
  if (result.breaks) return html;
  return html + "<p>Any model with Johnson-Cook's law and Coulomb's friction gives feed forces 30 to 40% "
                "too small and chip ratios 15 to 30% too large against experiments.</p>\n";
}

} // namespace cnem::report
