#include "tables.hpp"

#include "app/statics/static_model.hpp"
#include "input/case_reader.hpp"
#include "problems.hpp"
#include "results/output_folder.hpp"

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>
#include <sstream>

namespace cnem::convergence {

namespace {

/// Order from the last two levels, in the mean spacing N^(−1/2).
double order(double coarse, double fine, double nodes_coarse, double nodes_fine) {
  return std::log(coarse / fine) / (0.5 * std::log(nodes_fine / nodes_coarse));
}

/// Fills a table row by row with the time each took.
template<class RowOf> void fill(Table& table, const std::vector<std::string>& names, RowOf&& row_of) {
  for (std::size_t m = 0; m < names.size(); ++m) {
    const auto start = std::chrono::steady_clock::now();
    table.rows.push_back({names[m], row_of(m)});
    table.seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
}

std::vector<std::string> names_of(const std::vector<Method>& list) {
  std::vector<std::string> names;
  for (const Method& method : list) names.push_back(method.name);
  return names;
}

Table table_of(const Problem& problem) {
  Table table{problem.name, problem.title, {}, {}, {}};
  for (std::size_t k = 0; k < problem.spacings.size(); ++k)
    for (const char* what : {"nodes", "L2", "energy"})
      table.columns.push_back(fmt::format("{} (h = {:g})", what, problem.spacings[k]));
  table.columns.insert(table.columns.end(), {"L2 order", "energy order"});
  const std::vector<Method> list = methods();
  fill(table, names_of(list), [&](std::size_t m) {
    std::vector<double> values;
    std::vector<Errors> errors;
    for (const double h : problem.spacings) {
      const Errors e = errors.emplace_back(solve(problem, list[m], h));
      values.insert(values.end(), {double(e.nodes), e.l2, e.energy});
    }
    const Errors &coarse = errors[errors.size() - 2], &fine = errors.back();
    values.push_back(order(coarse.l2, fine.l2, coarse.nodes, fine.nodes));
    values.push_back(order(coarse.energy, fine.energy, coarse.nodes, fine.nodes));
    return values;
  });
  return table;
}

/// Tip displacements; 16.4326 is published for λ = 7500, G = 0.375.
Table cook(const std::string& name, double poisson) {
  const std::vector<int> divisions{4, 8, 16, 32};
  Table table{name,
              fmt::format("Cook's membrane, plane strain, G = 0.375, ν = {:g}: tip displacement", poisson),
              {},
              {},
              {}};
  for (const int n : divisions) table.columns.push_back(fmt::format("{0} × {0}", n));
  const std::vector<Method> list = methods();
  fill(table, names_of(list), [&](std::size_t m) {
    std::vector<double> values;
    for (const int n : divisions) values.push_back(cook_tip(list[m], {0.75 * (1.0 + poisson), poisson}, n));
    return values;
  });
  return table;
}

/// Error of K_I of the paper's plate over σ√(πa), against boundary collocation.
Table crack() {
  const std::vector<std::pair<double, double>> spacings{{0.2, 0.016}, {0.1, 0.008}, {0.05, 0.004}};
  Table table{"crack",
              "Central crack, a/W = 0.1: error of K_I over σ√(πa) at the right tip, plane stress, ν = 0.3",
              {},
              {},
              {}};
  for (const auto& [far, near] : spacings)
    for (const char* what : {"nodes", "error"})
      table.columns.push_back(fmt::format("{} (h = {:g} a at the tip)", what, 10 * near));
  struct Kind {
    std::string name;
    std::vector<std::string> set;
  };
  std::vector<Kind> kinds;
  for (const bool enriched : {true, false}) {
    const std::string with = enriched ? ", enriched" : "";
    const std::string flag = fmt::format("fracture.enrichment={}", enriched);
    for (int points = 1; points <= 3; ++points)
      kinds.push_back({fmt::format("Sibson, {} point{}{}", points, points > 1 ? "s" : "", with),
                       {flag, fmt::format("method.gauss_points={}", points)}});
    kinds.push_back(
        {"Laplace, 2 points" + with, {flag, "method.functions=laplace", "method.gauss_points=2"}});
  }
  kinds.push_back(
      {"Sibson, 2 points, not stabilised", {"fracture.enrichment=false", "method.stabilisation=0"}});
  kinds.push_back({"FE triangles", {"method.name=fe-triangles", "method.lagrangian=total"}});
  std::vector<std::string> names;
  for (const Kind& kind : kinds) names.push_back(kind.name);
  fill(table, names, [&](std::size_t m) {
    std::vector<double> values;
    for (const auto& [far, near] : spacings) {
      std::vector<std::string> set = kinds[m].set;
      set.push_back(fmt::format("cloud.spacing={} mm", far));
      set.push_back(fmt::format("cloud.refine.tips.spacing={} mm", near));
      const input::Case input =
          input::read_case(CNEM_SOURCE_DIR "/cases/paper/crack_straight/case.toml", set);
      const app::StaticModel<2> model(input);
      const auto tips = app::evaluate_tips(model, solve_statics(model.problem()));
      const double unit = 1e6 * std::sqrt(std::numbers::pi * 1e-4);
      values.push_back(model.setup.problem.cloud.nodes());
      values.push_back(tips.at(1).intensity.K_I / unit - 1.01395);
    }
    return values;
  });
  return table;
}

std::string number(double value, int digits) {
  return value == std::floor(value) && std::abs(value) < 1e7 ? fmt::format("{:.0f}", value)
                                                             : fmt::format("{:.{}g}", value, digits);
}

std::string markdown(const Table& table) {
  std::string text = fmt::format("## {}\n\n| method | {} | seconds |\n|---|{}---|\n", table.title,
                                 fmt::join(table.columns, " | "), [&] {
                                   std::string rule;
                                   for (std::size_t k = 0; k < table.columns.size(); ++k) rule += "---|";
                                   return rule;
                                 }());
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    text += fmt::format("| {} |", table.rows[r].method);
    for (const double value : table.rows[r].values) text += fmt::format(" {} |", number(value, 3));
    text += fmt::format(" {:.2f} |\n", table.seconds[r]);
  }
  return text + "\n";
}

} // namespace

std::vector<std::string> table_names() {
  return {"affine_patch", "plate_with_hole", "thick_cylinder", "cantilever",
          "cook_0.3",     "cook_0.4999",     "crack"};
}

Table compute(const std::string& name) {
  for (const Problem& problem : {affine_patch(), plate_with_hole(), thick_cylinder(), cantilever()})
    if (problem.name == name) return table_of(problem);
  if (name.starts_with("cook_")) return cook(name, std::stod(name.substr(5)));
  return crack();
}

Table read_baseline(const std::string& folder, const std::string& name) {
  std::istringstream file(results::read_file(folder + "/" + name + ".csv"));
  Table table;
  table.name = name;
  std::string line;
  std::getline(file, line); // header
  while (std::getline(file, line)) {
    Row row;
    std::istringstream cells(line);
    std::getline(cells, row.method, ';');
    for (std::string cell; std::getline(cells, cell, ';');) row.values.push_back(std::stod(cell));
    table.rows.push_back(std::move(row));
  }
  return table;
}

void write_baselines(const std::string& folder, const std::vector<Table>& tables) {
  std::string page =
      "# Convergence tables\n\n"
      "Written by `cases/verification/convergence/regenerate`; what they say is in README.md. Errors are "
      "relative. L2: "
      "nodal displacements weighted with nodal volumes. Energy: the stress, constant on each cell, "
      "integrated over the cells. Orders are those of the last two levels in N^(-1/2). Seconds are for the "
      "whole row on the machine that wrote this page.\n\n";
  for (const Table& table : tables) {
    std::string text = fmt::format("method;{}\n", fmt::join(table.columns, ";"));
    for (const Row& row : table.rows) {
      text += row.method;
      for (const double value : row.values) text += fmt::format(";{}", number(value, 6));
      text += '\n';
    }
    results::write_atomically(folder + "/" + table.name + ".csv", text);
    page += markdown(table);
  }
  results::write_atomically(folder + "/tables.md", page);
}

} // namespace cnem::convergence
