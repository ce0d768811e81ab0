// What is written of a cutting law: for cases, programs, spreadsheets and people.
#include "input/schema/document.hpp"
#include "report/chart.hpp"
#include "report/html.hpp"
#include "results/json_number.hpp"
#include "results/si_format.hpp"
#include "study/coefficients.hpp"
#include "study/page.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>

namespace cnem::study {
namespace {

using Json = nlohmann::ordered_json;
using machining::Estimate;
using machining::OrthogonalCut;

/// A unit in which users read a number: that many SI units.
struct ShownUnit {
  const char* name;
  double size;
};
constexpr ShownUnit mm{"mm", 1e-3}, megapascal{"MPa", 1e6}, per_edge{"N/mm", 1e3},
    degrees{"deg", std::numbers::pi / 180.0}, speed_unit{"m/s", 1.0}, plain{"", 1.0};

/// A constant as a law has it.
struct NamedEstimate {
  const char* key;
  ShownUnit unit;
  Estimate estimate;
};
struct NamedLaw {
  const char* name;
  std::vector<NamedEstimate> constants;
};

std::string number(double value) { return fmt::format("{:.7g}", value + 0.0); }

std::string in_toml(double value, const ShownUnit& unit) {
  const std::string text = number(value / unit.size);
  return *unit.name ? fmt::format("\"{} {}\"", text, unit.name) : text;
}

std::string list_in_toml(const std::vector<double>& values, const ShownUnit& unit) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(number(value / unit.size));
  return fmt::format("\"{} {}\"", fmt::join(texts, " "), unit.name);
}

NamedLaw linear_of(const LawFit& fit) {
  const auto& [t, r, none] = fit.linear;
  return {"linear",
          {{"Ktc", megapascal, t.slope},
           {"Krc", megapascal, r.slope},
           {"Kte", per_edge, t.intercept},
           {"Kre", per_edge, r.intercept}}};
}

NamedLaw kienzle_of(const machining::KienzleFit& fit) {
  NamedLaw law{"kienzle",
               {{"Kt1", megapascal, fit.tangential.pressure}, {"mt", plain, fit.tangential.exponent}}};
  if (fit.radial) {
    law.constants.push_back({"Kr1", megapascal, fit.radial->pressure});
    law.constants.push_back({"mr", plain, fit.radial->exponent});
  }
  return law;
}

/// The friction angle that an oblique law can have: none below 0, which noise gives without friction.
NamedLaw oblique_of(const LawFit& fit) {
  const machining::ShearPlaneFit& plane = *fit.shear_plane;
  Estimate friction = plane.friction_angle;
  friction.value = std::max(0.0, friction.value);
  return {"oblique",
          {{"shear_stress", megapascal, plane.shear_stress},
           {"friction_angle", degrees, friction},
           {"rake", degrees, {fit.cuts.front().rake, std::nan("")}},
           {"chip_ratio", plain, plane.chip_ratio},
           {"Kte", per_edge, fit.linear.tangential.intercept},
           {"Kre", per_edge, fit.linear.radial.intercept}}};
}

std::vector<NamedLaw> laws_of(const LawFit& fit) {
  std::vector<NamedLaw> laws{linear_of(fit)};
  if (fit.kienzle) laws.push_back(kienzle_of(*fit.kienzle));
  if (fit.shear_plane) laws.push_back(oblique_of(fit));
  return laws;
}

/// Largest distance of a cut from a line, N/m.
double largest(const std::vector<double>& residual) {
  double most = 0.0;
  for (const double r : residual) most = std::max(most, std::abs(r));
  return most;
}

template<class Get> std::pair<double, double> ends(const std::vector<OrthogonalCut>& cuts, const Get& get) {
  const auto less = [&](const OrthogonalCut& a, const OrthogonalCut& b) { return get(a) < get(b); };
  const auto [low, high] = std::minmax_element(cuts.begin(), cuts.end(), less);
  return {get(*low), get(*high)};
}

std::string range_text(const std::vector<OrthogonalCut>& cuts) {
  std::string text = "\n[range]\n";
  const auto add = [&](const char* key, const std::pair<double, double>& range, const ShownUnit& unit) {
    text += fmt::format("{} = {}\n", key, list_in_toml({range.first, range.second}, unit));
  };
  add("thickness", ends(cuts, [](const OrthogonalCut& cut) { return cut.thickness; }), mm);
  add("speed", ends(cuts, [](const OrthogonalCut& cut) { return cut.speed; }), speed_unit);
  add("rake", ends(cuts, [](const OrthogonalCut& cut) { return cut.rake; }), degrees);
  return text;
}

std::string table_text(const machining::CutTable& table) {
  std::string text = fmt::format("\n[table]\nthickness = {}\n", list_in_toml(table.thickness, mm));
  if (table.speed.size() > 1) text += fmt::format("speed = {}\n", list_in_toml(table.speed, speed_unit));
  if (table.rake.size() > 1) text += fmt::format("rakes = {}\n", list_in_toml(table.rake, degrees));
  return text + fmt::format("Ft = {}\nFr = {}\n", list_in_toml(table.tangential, per_edge),
                            list_in_toml(table.radial, per_edge));
}

std::string fit_text(const LawFit& fit) {
  const auto& [t, r, none] = fit.linear;
  return fmt::format("cuts = {}\ndegrees_of_freedom = {}\nr_squared_tangential = {}\nr_squared_radial = {}\n"
                     "largest_residual_tangential = {}\nlargest_residual_radial = {}\n",
                     fit.cuts.size(), t.degrees, number(t.r_squared), number(r.r_squared),
                     in_toml(largest(t.residual), per_edge), in_toml(largest(r.residual), per_edge));
}

std::string shear_text(const machining::ShearPlaneFit& plane) {
  std::string text;
  for (const auto& [key, unit, estimate] : {NamedEstimate{"shear_stress", megapascal, plane.shear_stress},
                                            {"shear_angle", degrees, plane.shear_angle},
                                            {"friction_angle", degrees, plane.friction_angle}}) {
    text += fmt::format("{} = {}\n", key, in_toml(estimate.value, unit));
    if (std::isfinite(estimate.error))
      text += fmt::format("{}_error = {}\n", key, in_toml(estimate.error, unit));
  }
  return text;
}

std::string errors_of(const NamedLaw& law) {
  std::string text;
  for (const auto& [key, unit, estimate] : law.constants)
    if (std::isfinite(estimate.error)) text += fmt::format("{} = {}\n", key, in_toml(estimate.error, unit));
  return text.empty() ? "" : fmt::format("\n[errors.{}]\n{}", law.name, text);
}

std::string law_text(const CuttingCoefficients& found, const std::string& version) {
  std::string text = fmt::format(
      "# A cutting law of {} orthogonal cuts by `cnem coefficients`, cnem {}. In a milling case:\n"
      "#   [cutting]\n#   law = \"law.toml\"\nlaw = \"{}\"\n",
      found.all.cuts.size(), version, found.law);
  text += range_text(found.all.cuts);
  const std::vector<NamedLaw> laws = laws_of(found.all);
  for (const NamedLaw& law : laws) {
    text += fmt::format("\n[{}]\n", law.name);
    for (const auto& [key, unit, estimate] : law.constants)
      text += fmt::format("{} = {}\n", key, in_toml(estimate.value, unit));
  }
  if (found.table) text += table_text(*found.table);
  for (const NamedLaw& law : laws) text += errors_of(law);
  text += "\n[fit] # of the linear law\n" + fit_text(found.all);
  if (found.all.shear_plane) text += shear_text(*found.all.shear_plane);
  if (found.all.kienzle)
    text += fmt::format("r_squared_kienzle = {}\n", number(found.all.kienzle->tangential.r_squared));
  std::vector<std::string> quoted;
  for (const LeftOut& run : found.left_out)
    quoted.push_back(input::toml_quoted(fmt::format("{}: {}", run.run, run.reason)));
  text += fmt::format("left_out = [{}]\n", fmt::join(quoted, ", "));
  if (found.groups.size() < 2) return text;
  for (const LawFit& group : found.groups) {
    text +=
        fmt::format("\n[[groups]]\nname = {}\nrake = {}\nspeed = {}\n", input::toml_quoted(group.name),
                    in_toml(group.cuts.front().rake, degrees), in_toml(group.cuts.front().speed, speed_unit));
    for (const auto& [key, unit, estimate] : linear_of(group).constants) {
      text += fmt::format("{} = {}\n", key, in_toml(estimate.value, unit));
      if (std::isfinite(estimate.error))
        text += fmt::format("{}_error = {}\n", key, in_toml(estimate.error, unit));
    }
    text += fit_text(group);
    if (group.shear_plane) text += shear_text(*group.shear_plane);
  }
  return text;
}

Json json_of_fit(const LawFit& fit) {
  Json json{{"name", fit.name}, {"cuts", fit.cuts.size()}};
  for (const NamedLaw& law : laws_of(fit)) {
    Json& one = json[law.name] = Json::object();
    for (const auto& [key, unit, estimate] : law.constants)
      one[key] = {{"value", results::json_number(estimate.value)},
                  {"error", results::json_number(estimate.error)}};
  }
  if (fit.shear_plane)
    json["shear_angle"] = {{"value", results::json_number(fit.shear_plane->shear_angle.value)},
                           {"error", results::json_number(fit.shear_plane->shear_angle.error)}};
  for (const auto& [name, line] :
       {std::pair{"tangential", &fit.linear.tangential}, {"radial", &fit.linear.radial}})
    json["fit"][name] = {{"r_squared", results::json_number(line->r_squared)},
                         {"degrees_of_freedom", line->degrees},
                         {"covariance", results::json_number(line->covariance)},
                         {"deviation_between_cuts", results::json_number(line->between)},
                         {"largest_residual", largest(line->residual)}};
  if (fit.kienzle)
    json["fit"]["kienzle"] = {{"r_squared", results::json_number(fit.kienzle->tangential.r_squared)}};
  return json;
}

std::string json_text(const CuttingCoefficients& found, const std::string& version) {
  Json json{{"source", found.source}, {"version", version}, {"law", found.law}};
  json["all"] = json_of_fit(found.all);
  json["groups"] = Json::array();
  for (const LawFit& group : found.groups) {
    Json one = json_of_fit(group);
    one["rake"] = group.cuts.front().rake;
    one["speed"] = group.cuts.front().speed;
    json["groups"].push_back(std::move(one));
  }
  json["left_out"] = Json::array();
  for (const LeftOut& run : found.left_out)
    json["left_out"].push_back({{"run", run.run}, {"reason", run.reason}});
  json["notes"] = found.notes;
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Cuts with what each law leaves of them.
std::string residuals_csv(const CuttingCoefficients& found) {
  std::string csv = "run,thickness[m],speed[m/s],rake[rad],tangential[N/m],tangential_error[N/m],radial[N/m],"
                    "radial_error[N/m],chip_thickness[m],residual_tangential[N/m],residual_radial[N/m],"
                    "residual_kienzle[N/m]";
  for (const LawFit& group : found.groups)
    for (std::size_t k = 0; k < group.cuts.size(); ++k) {
      const OrthogonalCut& cut = group.cuts[k];
      csv += fmt::format("\n{},{},{},{},{},{},{},{},{},{},{},{}", cut.name, cut.thickness, cut.speed,
                         cut.rake, cut.tangential.value, cut.tangential.error, cut.radial.value,
                         cut.radial.error, cut.chip_thickness, group.linear.tangential.residual[k],
                         group.linear.radial.residual[k],
                         group.kienzle ? group.kienzle->tangential.residual[k] : std::nan(""));
    }
  return csv + "\n";
}

/// Cuts as crosses, whose upright stroke is two standard errors either way, or a hundredth of the forces.
report::ChartSeries crosses(const std::vector<OrthogonalCut>& cuts, Estimate OrthogonalCut::*which,
                            int colour) {
  report::ChartSeries series;
  series.label = "";
  series.colour = colour;
  double thickest = 0.0, strongest = 0.0;
  for (const OrthogonalCut& cut : cuts) {
    thickest = std::max(thickest, cut.thickness);
    strongest = std::max(strongest, std::abs((cut.*which).value));
  }
  const double gap = std::nan("");
  for (const OrthogonalCut& cut : cuts) {
    const Estimate& force = cut.*which;
    const double dx = 0.01 * thickest, dy = std::max(0.01 * strongest, 2.0 * force.error);
    series.x.insert(series.x.end(),
                    {cut.thickness - dx, cut.thickness + dx, gap, cut.thickness, cut.thickness, gap});
    series.y.insert(series.y.end(), {force.value, force.value, gap, force.value - dy, force.value + dy, gap});
  }
  return series;
}

report::Chart picture_of(const CuttingCoefficients& found) {
  report::Chart chart;
  chart.title = "Forces per length of edge over the uncut chip thickness";
  chart.x_label = "chip thickness";
  chart.x_unit = "m";
  chart.y_label = "force";
  chart.y_unit = "N/m";
  chart.note = "Crosses are cuts, lines the linear law, from 0 on; dashed is Kienzle's.";
  constexpr int pieces = 40;
  int colour = 0;
  for (const LawFit& group : found.groups)
    for (const bool tangential : {true, false}) {
      const machining::LineFit& line = tangential ? group.linear.tangential : group.linear.radial;
      const double last = group.cuts.back().thickness;
      report::ChartSeries straight;
      straight.label = fmt::format("{}{}", tangential ? "tangential" : "radial",
                                   found.groups.size() > 1 ? ", " + group.name : "");
      straight.x = {0.0, last};
      straight.y = {line.at(0.0), line.at(last)};
      straight.colour = colour;
      chart.series.push_back(std::move(straight));
      chart.series.push_back(
          crosses(group.cuts, tangential ? &OrthogonalCut::tangential : &OrthogonalCut::radial, colour));
      if (const machining::PowerFit* power = !group.kienzle          ? nullptr
                                             : tangential            ? &group.kienzle->tangential
                                             : group.kienzle->radial ? &*group.kienzle->radial
                                                                     : nullptr) {
        report::ChartSeries curve;
        curve.colour = colour;
        curve.dashed = true;
        for (int k = 1; k <= pieces; ++k) {
          const double h = last * k / pieces;
          curve.x.push_back(h);
          curve.y.push_back(power->pressure.value * 1e-3 * std::pow(h / 1e-3, 1.0 - power->exponent.value));
        }
        chart.series.push_back(std::move(curve));
      }
      ++colour;
    }
  return chart;
}

std::string shown(const NamedEstimate& one) {
  const auto& [key, unit, estimate] = one;
  return fmt::format(
      "{}{}{}", results::number_format(estimate.value / unit.size, 5),
      std::isfinite(estimate.error) ? " ± " + results::number_format(estimate.error / unit.size, 2) : "",
      *unit.name ? std::string(" ") + unit.name : "");
}

std::string report_of(const CuttingCoefficients& found, const report::Chart& chart,
                      const std::string& version) {
  std::string rows = "<tr>" + cell("cuts", "th") + cell("law", "th") + cell("constant", "th") +
                     cell("value ± standard error", "th") + "</tr>\n";
  std::vector<const LawFit*> fits;
  for (const LawFit& group : found.groups) fits.push_back(&group);
  if (found.groups.size() > 1) fits.push_back(&found.all);
  const auto row = [&](const std::string& name, const std::string& law, const std::string& key,
                       const std::string& text) {
    rows += "<tr>" + cell(name) + cell(law) + cell(key) + cell(text) + "</tr>\n";
  };
  for (const LawFit* fit : fits) {
    for (const NamedLaw& law : laws_of(*fit))
      for (const NamedEstimate& one : law.constants) row(fit->name, law.name, one.key, shown(one));
    if (fit->shear_plane)
      row(fit->name, "", "shear angle", shown({"", degrees, fit->shear_plane->shear_angle}));
    row(fit->name, "", "R², tangential", results::number_format(fit->linear.tangential.r_squared, 6));
    row(fit->name, "", "R², radial", results::number_format(fit->linear.radial.r_squared, 6));
  }
  std::string cuts = "<tr>" + cell("run", "th") + cell("thickness, mm", "th") +
                     cell("tangential, N/mm", "th") + cell("off the line", "th") +
                     cell("radial, N/mm", "th") + cell("off the line", "th") + "</tr>\n";
  for (const LawFit& group : found.groups)
    for (std::size_t k = 0; k < group.cuts.size(); ++k) {
      const OrthogonalCut& cut = group.cuts[k];
      cuts += "<tr>" + cell(cut.name) + cell(results::number_format(cut.thickness / mm.size)) +
              cell(shown({"", {"", per_edge.size}, cut.tangential})) +
              cell(results::number_format(group.linear.tangential.residual[k] / per_edge.size, 3)) +
              cell(shown({"", {"", per_edge.size}, cut.radial})) +
              cell(results::number_format(group.linear.radial.residual[k] / per_edge.size, 3)) + "</tr>\n";
    }
  std::string words;
  for (const LeftOut& run : found.left_out)
    words += fmt::format("<li>left out: {}</li>\n", report::html_escape(run.run + ": " + run.reason));
  for (const std::string& note : found.notes)
    words += fmt::format("<li>{}</li>\n", report::html_escape(note));
  const auto section = [](const char* id, const char* title, const std::string& table) {
    return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n<div class=\"runs\"><table>\n{}</table></div>\n"
                       "</section>\n",
                       id, title, table);
  };
  return page({.title = "A cutting law from chips",
               .version = version,
               .verdict = fmt::format("{} cuts, {} left out; the law of law.toml is {}",
                                      found.all.cuts.size(), found.left_out.size(), found.law),
               .good = found.left_out.empty() && found.notes.empty()},
              section("constants", "Constants", rows) +
                  (words.empty() ? ""
                                 : "<section id=\"notes\">\n<h2>To be known</h2>\n<ul class=\"warnings\">\n" +
                                       words + "</ul>\n</section>\n") +
                  chart_section({chart}, {}, "fit", "Cuts and laws") + section("cuts", "Cuts", cuts));
}

} // namespace

CoefficientsFiles coefficients_files(const CuttingCoefficients& found, const std::string& version) {
  const report::Chart chart = picture_of(found);
  return {.law = law_text(found, version),
          .json = json_text(found, version),
          .table = residuals_csv(found),
          .picture = report::svg_file(chart),
          .report = report_of(found, chart, version)};
}

} // namespace cnem::study
