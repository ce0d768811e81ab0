#include "study/page.hpp"

#include "core/index.hpp"
#include "input/schema/units.hpp"
#include "report/html.hpp"
#include "report/report_style.hpp"
#include "results/output_folder.hpp"

#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace cnem::study {

namespace {

/// Whether a text is numbers with their unit ("-11 m/s", "-1 5 mm"), as quantities of a case are written.
bool is_quantity(std::string_view text) {
  bool any = false;
  while (!text.empty()) {
    const std::size_t sign = text.front() == '+' ? 1 : 0;
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data() + sign, text.data() + text.size(), number);
    if (error != std::errc{}) break;
    any = true;
    text.remove_prefix(index_of(end - text.data()));
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  }
  if (!any || text.empty()) return any;
  try {
    input::parse_unit(text);
    return true;
  } catch (const input::UnitError&) { return false; }
}

constexpr const char* table_style = R"css(
.runs { overflow-x: auto; background: var(--card); border: 1px solid var(--line); border-radius: 12px; padding: 10px 18px; }
.runs th, .runs td { padding: 5px 14px 5px 0; white-space: nowrap; text-align: right; }
.runs th:first-child, .runs td:first-child { text-align: left; }
.runs a { color: var(--c0); }
.runs .bad { color: var(--bad); }
)css";

} // namespace

std::string csv_field(const std::string& text) {
  const bool like_formula = text.find_first_of("=+-@\t\r") == 0 && !is_quantity(text);
  const std::string shown = like_formula ? "'" + text : text;
  if (shown.find_first_of(",\"\r\n") == std::string::npos) return shown;
  std::string quoted = "\"";
  for (const char c : shown) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csv_table(const Study& study, const std::vector<RunRecord>& runs,
                      const std::vector<NumberColumn>& columns) {
  std::string csv = "run";
  const auto add = [&](const std::string& text) {
    csv += ',';
    csv += csv_field(text);
  };
  for (const std::string& key : study.keys) add(key);
  csv += ",state,exit";
  for (const NumberColumn& column : columns) add(column.name);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    csv += '\n';
    csv += csv_field(study.runs[k].name);
    for (const std::string& key : study.keys) {
      const input::Value* value = study.runs[k].find(key);
      add(value ? plain_text(*value) : "");
    }
    add(state_name(runs[k].state));
    add(runs[k].state == RunRecord::State::pending ? "" : std::to_string(runs[k].exit));
    for (const NumberColumn& column : columns) {
      const std::optional<double>& value = column.value[k];
      add(value && std::isfinite(*value) ? input::format_number(*value) : "");
    }
  }
  return csv + "\n";
}

std::string column_name(const std::string& path) {
  return path.starts_with("metrics.") ? path.substr(8) : path;
}

std::string cell(const std::string& text, const char* tag) {
  return fmt::format("<{0}>{1}</{0}>", tag, report::html_escape(text));
}

report::Chart history_chart(std::span<const results::HistoryTable> histories,
                            std::span<const std::string> labels, const std::string& column,
                            const std::string& x) {
  report::Chart chart;
  chart.title = x == "time" ? column : fmt::format("{} over {}", column, x);
  chart.x_label = x;
  chart.y_label = column;
  for (std::size_t k = 0; k < histories.size(); ++k) {
    const results::HistoryTable& history = histories[k];
    const int at = history.find(column), along = history.find(x);
    if (at < 0 || along < 0) continue;
    chart.x_unit = results::split_column_name(history.names[index_of(along)]).unit;
    const auto index = index_of(at);
    chart.y_unit = results::split_column_name(history.names[index]).unit;
    report::ChartSeries line;
    line.label = labels[k];
    line.x = history.column[index_of(along)];
    line.y = history.column[index];
    line.colour = static_cast<int>(k);
    chart.series.push_back(std::move(line));
  }
  if (chart.series.empty()) chart.note = "No run has these columns in its history.csv.";
  return chart;
}

std::string chart_section(const std::vector<report::Chart>& charts, const results::ShownUnits& units,
                          const std::string& id, const std::string& title) {
  std::string html;
  for (const report::Chart& chart : charts)
    html += fmt::format(
        "<figure><h3>{}</h3>\n{}{}</figure>\n", report::html_escape(chart.title),
        report::svg_chart(chart, units),
        chart.note.empty() ? "" : "<figcaption>" + report::html_escape(chart.note) + "</figcaption>");
  return html.empty()
             ? ""
             : fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n<div class=\"charts\">\n{}</div>\n</section>\n",
                           id, report::html_escape(title), html);
}

results::ShownUnits shown_units(const Study& study, const std::filesystem::path& folder) {
  for (const StudyRun& run : study.runs)
    if (const auto resolved = folder / run.name / results::files::resolved_case;
        std::filesystem::exists(resolved))
      return results::ShownUnits::of_case(results::read_file(resolved));
  return {};
}

std::string page(const PageHead& head, const std::string& body) {
  std::string html =
      fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
                  "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
                  "<title>{}</title>\n<style>{}{}{}</style>\n</head>\n<body>\n<main>\n",
                  report::html_escape(head.title), report::report_style, table_style, head.style);
  html += fmt::format(
      "<header>\n<p class=\"code\">cnem {}</p>\n<h1>{}</h1>\n<p class=\"verdict {}\">{}</p>\n</header>\n",
      report::html_escape(head.version), report::html_escape(head.title), head.good ? "good" : "bad",
      report::html_escape(head.verdict));
  return html + report::keep_units(body) + "</main>\n</body>\n</html>\n";
}

} // namespace cnem::study
