#include "report/report.hpp"

#include "report/blanking_page.hpp"
#include "report/cutting_page.hpp"
#include "report/experiment_page.hpp"
#include "report/html.hpp"
#include "report/report_style.hpp"
#include "results/si_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cnem::report {
namespace {

std::string section(const std::string& id, const std::string& title, const std::string& body) {
  return body.empty()
             ? ""
             : fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, html_escape(title), body);
}

std::string render_figures(const ReportData& data) {
  std::string html;
  for (const Figure& figure : data.figures)
    html += fmt::format("<div><dt>{}</dt><dd>{}</dd>{}</div>\n", html_escape(figure.name),
                        html_escape(figure.value),
                        figure.note.empty() ? "" : "<dd class=\"of\">" + html_escape(figure.note) + "</dd>");
  return html.empty() ? "" : "<dl class=\"figures\">\n" + html + "</dl>\n";
}

std::string table(const std::vector<std::pair<std::string, std::string>>& rows) {
  std::string html = "<table>\n";
  for (const auto& [name, value] : rows)
    html +=
        fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", html_escape(name), html_escape(value));
  return html + "</table>\n";
}

std::string render_warnings(const ReportData& data) {
  std::string html;
  for (const std::string& warning : data.warnings) html += fmt::format("<li>{}</li>\n", html_escape(warning));
  return html.empty() ? "" : "<ul class=\"warnings\">\n" + html + "</ul>\n";
}

std::string caption_of(const std::string& note) {
  return note.empty() ? "" : fmt::format("<figcaption>{}</figcaption>", html_escape(note));
}

std::string figure(const ReportPicture& picture, const std::string& what) {
  const std::string time = results::si_format(picture.time, "s");
  return fmt::format("<figure data-time=\"{}\">{}{}</figure>\n", html_escape(time),
                     picture_element(picture.png, what + " at " + time), caption_of(picture.note));
}

std::string render_post_mortem(const ReportData& data) {
  if (!data.post_mortem) return "";
  const results::PostMortem& post = *data.post_mortem;
  std::vector<std::pair<std::string, std::string>> rows{{"Field", post.field},
                                                        {"Step", std::to_string(post.step)},
                                                        {"Time", results::si_format(post.time, "s", 6)}};
  if (post.node >= 0) rows.emplace_back("Node", std::to_string(post.node));
  if (std::isfinite(post.x) && std::isfinite(post.y))
    rows.emplace_back("Position", fmt::format("x = {}, y = {}", data.units.format(post.x, "m", 6),
                                              data.units.format(post.y, "m", 6)));
  if (!post.last_good.empty()) rows.emplace_back("Last good state", post.last_good);
  std::string html =
      fmt::format("<div class=\"post-mortem\">\n<p>{}</p>\n{}", html_escape(post.text), table(rows));
  if (!post.causes.empty()) html += "<h3>Likely causes</h3>\n<ul>\n";
  for (const std::string& cause : post.causes) html += fmt::format("<li>{}</li>\n", html_escape(cause));
  if (!post.causes.empty()) html += "</ul>\n";
  if (data.place) html += figure(*data.place, data.place->caption);
  return html + "</div>\n";
}

// What pictures of one kind have in common: "temperature, the band".
std::string kind_of(const ReportPicture& picture) {
  return picture.caption.empty() ? picture.field : picture.field + ", " + picture.caption;
}

// Several times of one kind: a player, which the script fills, and what it plays.
std::string render_series(const std::vector<const ReportPicture*>& series, const std::string& kind) {
  std::string figures;
  for (const ReportPicture* picture : series) figures += figure(*picture, kind);
  if (series.size() < 3) return figures;
  return fmt::format("<figure class=\"player\" hidden><img alt=\"{}\"/><figcaption></figcaption>"
                     "<div class=\"controls\"><button type=\"button\" aria-label=\"play\">▶</button>"
                     "<input type=\"range\" min=\"0\" max=\"{}\" aria-label=\"time\"/><output></output></div>"
                     "</figure>\n<details><summary>All {} pictures</summary>\n{}</details>\n",
                     html_escape(kind), series.size() - 1, series.size(), figures);
}

std::string render_pictures(const ReportData& data) {
  std::vector<std::string> kinds;
  for (const ReportPicture& picture : data.pictures)
    if (std::find(kinds.begin(), kinds.end(), kind_of(picture)) == kinds.end())
      kinds.push_back(kind_of(picture));
  std::string html;
  for (const std::string& kind : kinds) {
    std::vector<const ReportPicture*> chosen;
    for (const ReportPicture& picture : data.pictures)
      if (kind_of(picture) == kind) chosen.push_back(&picture);
    std::stable_sort(chosen.begin(), chosen.end(),
                     [](auto* one, auto* other) { return one->time < other->time; });
    html += fmt::format("<div class=\"series\"><h3>{}</h3>\n{}</div>\n", html_escape(kind),
                        render_series(chosen, kind));
  }
  return html.empty() ? "" : "<div class=\"pictures\">\n" + html + "</div>\n";
}

std::string render_charts(const ReportData& data) {
  std::string html;
  for (const Chart& chart : data.charts)
    html += fmt::format("<figure><h3>{}</h3>\n{}{}</figure>\n", html_escape(chart.title),
                        svg_chart(chart, data.units), caption_of(chart.note));
  return html.empty() ? "" : "<div class=\"charts\">\n" + html + "</div>\n";
}

std::string render_tables(const ReportData& data) {
  std::string html;
  for (const ReportTable& entry : data.tables)
    html += fmt::format("<div><h3>{}</h3>\n{}</div>\n", html_escape(entry.title), table(entry.rows));
  return html.empty() ? "" : "<div class=\"tables\">\n" + html + "</div>\n";
}

} // namespace

std::string render_report(const ReportData& data) {
  std::string html = fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
                                 "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
                                 "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n",
                                 html_escape(data.title), report_style);
  html += fmt::format("<header>\n<p class=\"code\">{}</p>\n<h1>{}</h1>\n<p class=\"verdict {}\">{}</p>\n<p "
                      "class=\"code\">{}</p>\n</header>\n",
                      html_escape(data.subtitle), html_escape(data.title), data.failed ? "bad" : "good",
                      html_escape(data.verdict), html_escape(data.run_line));
  html += render_figures(data);
  html += section("post-mortem", "Where it went wrong", render_post_mortem(data));
  html += section("warnings", data.warnings_title, render_warnings(data));
  html += section("experiment", "Experiment", render_experiments(data.experiments, data.units));
  if (data.blanking) {
    const bool cut = !data.blanking->punch.empty();
    html += section("blanking", cut ? "Blanking" : "Springback",
                    render_blanking(*data.blanking, data.blanking_forces, data.units));
  }
  if (data.cutting) html += section("cutting", "Cutting", render_cutting(*data.cutting, data.units));
  html += section("pictures", "Pictures", render_pictures(data));
  html += section("histories", data.charts_title, render_charts(data));
  html += section("numbers", "Numbers", render_tables(data));
  if (!data.case_text.empty())
    html += section("case", data.case_title,
                    fmt::format("<pre tabindex=\"0\">{}</pre>\n", html_escape(data.case_text)));
  return keep_units(std::move(html)) +
         fmt::format("</main>\n<dialog><img alt=\"enlarged picture\"/></dialog>\n<script>{}</script>\n"
                     "</body>\n</html>\n",
                     report_script);
}

} // namespace cnem::report
