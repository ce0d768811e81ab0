#include "report/blanking_page.hpp"

#include "evaluate/force_stroke.hpp"
#include "evaluate/round_cut.hpp"
#include "report/html.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cnem::report {
namespace {

using evaluate::BlankingResult;
using evaluate::ShearedFace;
using evaluate::Zone;
using results::ShownUnits;

constexpr double degree = std::numbers::pi / 180.0;

std::string degrees(double angle) {
  return fmt::format("{}{:.2f}°", angle < 0.0 ? "−" : "", std::abs(angle) / degree);
}

/// The zones of a face and their heights.
struct Height {
  evaluate::Zone zone;
  const char* name;
  double ShearedFace::*size;
};
constexpr std::array<Height, 7> heights{
    {{Zone::rollover, "Rollover", &ShearedFace::rollover},
     {Zone::burnish, "Burnish", &ShearedFace::burnish},
     {Zone::broken, "Broken, not open", &ShearedFace::broken},
     {Zone::fracture, "Fracture", &ShearedFace::fracture},
     {Zone::second_burnish, "Second burnish", &ShearedFace::second_burnish},
     {Zone::hole, "Wall of a hole", &ShearedFace::hole},
     {Zone::burr, "Burr", &ShearedFace::burr}}};

/// A stretch of depth that one zone takes, m.
struct Stretch {
  const Height* of;
  double from, to;
};

/// The zones as they come along the face, in depth.
std::vector<Stretch> stretches(const ShearedFace& face) {
  std::vector<Stretch> list;
  double reached = 0.0;
  for (std::size_t k = 0; k < face.zone.size(); ++k) {
    const auto height = std::find_if(heights.begin(), heights.end(),
                                     [&](const Height& one) { return one.zone == face.zone[k]; });
    const double to = face.profile[k + 1].y();
    if (height == heights.end() || !(to > reached)) continue;
    if (!list.empty() && list.back().of == &*height)
      list.back().to = to;
    else
      list.push_back({&*height, reached, to});
    reached = to;
  }
  return list;
}

std::string title_of(const evaluate::ShearedFace& face) {
  return face.cut.empty() ? face.body : fmt::format("{}, {}", face.body, face.cut);
}

std::string table_row(const std::string& name, const std::string& value) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", html_escape(name),
                     html_escape(value));
}

/// measured: of the face, or nullptr.
std::string table_of(const ShearedFace& face, const evaluate::MeasuredHeights* measured,
                     const ShownUnits& units) {
  std::string html = "<table>\n";
  const evaluate::MeasuredHeights nothing, &there = measured ? *measured : nothing;
  const auto with_share = [&](double size) {
    return fmt::format("{}  ({:.1f} %)", units.format(size, "m", 3), 100.0 * size / face.thickness);
  };
  const auto beside = [](const std::string& computed, bool known, const std::string& measured_text) {
    return known ? fmt::format("{}, measured {}", computed, measured_text) : computed;
  };
  const auto in_experiment = [&](Zone zone) {
    switch (zone) {
    case Zone::rollover:
      return there.rollover;
    case Zone::burnish:
      return there.burnish;
    case Zone::fracture:
      return there.fracture;
    case Zone::burr:
      return there.burr;
    default:
      return std::nan("");
    }
  };
  for (const Height& height : heights) {
    const bool usual = height.zone == Zone::rollover || height.zone == Zone::burnish ||
                       height.zone == Zone::fracture || height.zone == Zone::burr;
    if (!usual && !(face.*height.size > 0.0)) continue;
    const double other = in_experiment(height.zone);
    html += table_row(height.name,
                      beside(with_share(face.*height.size), std::isfinite(other), with_share(other)));
  }
  html += table_row("Width of the rollover", with_share(face.rollover_width));
  if (std::isfinite(face.fracture_angle))
    html +=
        table_row("Fracture angle", beside(degrees(face.fracture_angle), std::isfinite(there.fracture_angle),
                                           degrees(there.fracture_angle)));
  html += table_row("Tilt of the body", degrees(face.tilt));
  html += table_row("Thickness of the sheet before", units.format(face.thickness, "m"));
  return html + "</table>\n";
}

std::string drawn_face(const BlankingResult& result, const ShearedFace& face, const ShownUnits& units) {
  const std::string where = std::isfinite(face.angle) ? fmt::format(" at {:.1f}°", face.angle / degree) : "";
  std::string html =
      fmt::format("<figure class=\"face\"><h3>Face of the {}{}</h3>\n<div>{}{}</div>",
                  html_escape(title_of(face)), where, face.profile.size() > 1 ? face_drawing(face) : "",
                  face.found() ? table_of(face, evaluate::measured_of(result, face), units) : "");
  if (!face.note.empty()) html += fmt::format("<figcaption>{}</figcaption>", html_escape(face.note));
  return html + "</figure>\n";
}

/// In space the first face of each body that was measured.
std::string faces(const BlankingResult& result, const ShownUnits& units) {
  std::string html;
  for (const auto& body : evaluate::faces_of_bodies(result)) {
    const auto measured =
        std::find_if(body.begin(), body.end(), [](auto* face) { return face->measured && face->found(); });
    html += drawn_face(result, **(measured == body.end() ? body.begin() : measured), units);
  }
  return html.empty() ? "" : "<div class=\"charts faces\">\n" + html + "</div>\n";
}

std::string figure_of(const Chart& chart, const ShownUnits& units) {
  return fmt::format("<figure><h3>{}</h3>\n{}<figcaption>{}</figcaption></figure>\n",
                     html_escape(chart.title), svg_chart(chart, units), html_escape(chart.note));
}

std::string force_table(const evaluate::BlankingResult& result, const ShownUnits& units) {
  if (result.forces.empty()) return "";
  std::string html = "<div><h3>Forces along the cut, work</h3>\n<table>\n";
  for (const evaluate::ToolForce& force : result.forces) {
    html += table_row(fmt::format("Largest force of {}", force.tool),
                      fmt::format("{} at a stroke of {}", units.format(force.largest, result.force_unit),
                                  units.format(force.stroke, "m")));
    if (force.work != 0.0)
      html += table_row(fmt::format("Work of {}", force.tool), units.format(force.work, result.work_unit));
  }
  html += table_row("Stroke at the end", units.format(result.stroke, "m"));
  return html + "</table>\n</div>\n";
}

std::string springback_table(const evaluate::BlankingResult& result, const ShownUnits& units) {
  if (result.springback.empty()) return "";
  std::string html = "<div><h3>Springback</h3>\n<table>\n";
  for (const evaluate::BodySpringback& body : result.springback) {
    const std::string name = words(body.body);
    html += table_row(fmt::format("Largest displacement of {}", name), units.format(body.largest, "m"));
    if (std::isfinite(body.angle_change))
      html += table_row(fmt::format("Angle of {}", name),
                        fmt::format("{} before, {}° by letting go", degrees(body.angle_before),
                                    results::number_format(body.angle_change / degree, 3)));
    if (std::isfinite(body.dishing_change))
      html += table_row(fmt::format("Dishing of {}", name),
                        fmt::format("{} before, {} by letting go", units.format(body.dishing_before, "m"),
                                    units.format(body.dishing_change, "m")));
  }
  return html + "</table>\n</div>\n";
}

} // namespace

std::optional<Chart> force_stroke_chart(const evaluate::BlankingResult& result,
                                        const results::HistoryTable& history, const ShownUnits& units) {
  if (result.forces.empty() || history.rows() < 2) return std::nullopt;
  Chart chart;
  chart.title = "Force along the cut against stroke";
  chart.x_label = fmt::format("stroke of {}", result.punch);
  chart.x_unit = std::string("m");
  chart.y_label = "force along the cut";
  chart.y_unit = result.force_unit;
  for (std::size_t k = 0; k < result.forces.size(); ++k) {
    const evaluate::ToolForce& force = result.forces[k];
    if (!(force.largest > 0.0)) continue;
    const evaluate::ForceCurve curve =
        evaluate::force_curve(history, force.tool, result.punch, result.dies,
                              Vec3(result.direction_x, result.direction_y, result.direction_z));
    ChartSeries raw, smooth, mark;
    raw.x = curve.stroke;
    raw.y = curve.force;
    raw.faint = true;
    smooth.label = force.tool;
    smooth.x = curve.even_stroke;
    smooth.y = curve.smooth;
    raw.colour = smooth.colour = mark.colour = static_cast<int>(k);
    const double most = curve.smooth[curve.largest];
    mark.x = {0.0, force.stroke, force.stroke};
    mark.y = {most, most, 0.0};
    mark.dashed = true;
    chart.series.insert(chart.series.end(), {raw, smooth, mark});
  }
  if (chart.series.empty()) return std::nullopt;
  chart.note = fmt::format(
      "Of the tools on the workpiece, positive with the motion of the punch. Pale: every recorded "
      "value; full: Gaussian low-pass in time, σ = {}; dashed: the largest of it.",
      units.format(evaluate::force_filter(history.column.front()), "s", 3));
  return chart;
}

std::vector<Chart> round_charts(const BlankingResult& result, const ShownUnits& units) {
  std::vector<Chart> charts;
  const evaluate::CutAxis axis{.direction = {result.direction_x, result.direction_y, result.direction_z}};
  for (const auto& faces : evaluate::faces_of_bodies(result)) {
    if (!std::isfinite(faces.front()->angle)) continue;
    Chart chart;
    chart.title = fmt::format("Heights of the {} round the punch", title_of(*faces.front()));
    chart.x_label = "angle";
    chart.x_unit = "°";
    chart.y_label = "height";
    chart.y_unit = "m";
    chart.note = "Means with their standard deviations:";
    for (std::size_t k = 0; k < heights.size(); ++k) {
      const auto [mean, spread] = evaluate::round_height(faces, heights[k].size);
      if (!(mean > 0.0)) continue;
      ChartSeries line, level;
      line.label = heights[k].name;
      line.colour = level.colour = static_cast<int>(k);
      level.dashed = true;
      for (const ShearedFace* face : faces) {
        line.x.push_back(face->angle / degree);
        line.y.push_back(face->measured ? face->*heights[k].size : std::nan(""));
      }
      level.x = {line.x.front(), line.x.back()};
      level.y = {mean, mean};
      chart.note += fmt::format("{} {} {} ± {}", chart.series.empty() ? "" : ",", heights[k].name,
                                units.format(mean, "m", 3), units.format(spread, "m", 2));
      chart.series.insert(chart.series.end(), {line, level});
    }
    chart.note +=
        fmt::format(". Dashed: the means. Angles count from {}, counter-clockwise as seen from where "
                    "the punch comes from.",
                    axis.counts_from());
    if (faces.size() > 1 && !chart.series.empty()) charts.push_back(std::move(chart));
  }
  return charts;
}

std::string face_drawing(const ShearedFace& face) {
  constexpr double high = 320.0, wide = 240.0, width = 490.0, top = 40.0, left = 12.0, font = 15.0,
                   line = 20.0;
  double low_u = 0.0, high_u = 0.0, deep = face.parted ? face.thickness : 0.0;
  for (const Vec2& x : face.profile) {
    low_u = std::min(low_u, x.x());
    high_u = std::max(high_u, x.x());
    deep = std::max(deep, x.y());
  }
  deep *= 1.02;
  const double scale = std::min(high / deep, wide / (high_u - low_u));
  const auto px = [&](double v) { return left + (v - low_u) * scale; };
  const auto py = [&](double w) { return top + w * scale; };
  const double right = px(high_u) + 24.0;

  std::string svg =
      fmt::format("<svg class=\"chart\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" font-size=\"{:.0f}\">\n"
                  "<title>Sheared face of the {}</title>\n",
                  width, py(deep) + 30.0, font, html_escape(title_of(face)));
  std::string body;
  for (std::size_t k = 0; k < face.profile.size(); ++k)
    body += fmt::format("{}{:.1f} {:.1f}", k ? "L" : "M", px(face.profile[k].x()), py(face.profile[k].y()));
  if (!face.parted) body += fmt::format("V{:.1f}", py(deep)); // the sheet goes on below
  svg += fmt::format("<path class=\"body\" d=\"{}H{:.1f}V{:.1f}Z\"/>\n", body, px(low_u),
                     py(face.profile.front().y()));
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">surface on the side of the {}</text>\n", px(low_u),
                     top - 12.0, face.body == "slug" ? "die" : "punch");
  const double edge = px(0.0);
  const std::vector<Stretch> zones = stretches(face);
  double text = top - line;
  for (const Stretch& stretch : zones) {
    const double from = py(stretch.from), to = py(stretch.to);
    svg += fmt::format(
        "<path class=\"line {0}\" d=\"M{1:.1f} {2:.1f}V{3:.1f}\"/><path class=\"grid\" d=\"M{4:.1f} "
        "{2:.1f}H{1:.1f}M{4:.1f} {3:.1f}H{1:.1f}\"/>\n",
        evaluate::zone_name(stretch.of->zone), right, from, to, edge);
    // Each zone is named once, beside its longest stretch.
    const bool longest = std::none_of(zones.begin(), zones.end(), [&](const Stretch& other) {
      const double more = (other.to - other.from) - (stretch.to - stretch.from);
      return other.of == stretch.of && (more > 0.0 || (more == 0.0 && other.from < stretch.from));
    });
    if (!longest) continue;
    text = std::max(text + line, 0.5 * (from + to) + 5.0);
    svg += fmt::format("<text class=\"key\" x=\"{:.1f}\" y=\"{:.1f}\">{} {:.1f} %</text>\n", right + 8.0,
                       text, html_escape(stretch.of->name), 100.0 * face.*stretch.of->size / face.thickness);
  }
  // One path for each stretch of a zone.
  for (std::size_t k = 0; k < face.zone.size();) {
    std::string path = fmt::format("M{:.1f} {:.1f}", px(face.profile[k].x()), py(face.profile[k].y()));
    const evaluate::Zone zone = face.zone[k];
    for (; k < face.zone.size() && face.zone[k] == zone; ++k)
      path += fmt::format("L{:.1f} {:.1f}", px(face.profile[k + 1].x()), py(face.profile[k + 1].y()));
    svg += fmt::format("<path class=\"line {}\" d=\"{}\"/>\n", evaluate::zone_name(zone), path);
  }
  return svg + "</svg>\n";
}

std::string render_blanking(const evaluate::BlankingResult& result, const std::optional<Chart>& forces,
                            const ShownUnits& units) {
  std::string html;
  if (!result.note.empty()) html += fmt::format("<p>{}</p>\n", html_escape(result.note));
  html += faces(result, units);
  std::string charts;
  for (const Chart& chart : round_charts(result, units)) charts += figure_of(chart, units);
  if (forces) charts += figure_of(*forces, units);
  if (!charts.empty()) html += fmt::format("<div class=\"charts wide\">\n{}</div>\n", charts);
  const std::string tables = force_table(result, units) + springback_table(result, units);
  if (!tables.empty()) html += fmt::format("<div class=\"tables\">\n{}</div>\n", tables);
  return html;
}

} // namespace cnem::report
