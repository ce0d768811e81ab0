#pragma once
// A block that a punch goes into on a cloud that adapts, run to its end with nothing lost.
#include "app/problem/registry.hpp"
#include "app/run.hpp"
#include "input/case_reader.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "results/status.hpp"
#include "tests/shared_cases.hpp"
#include "tests/temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace cnem::testing {

using Texts = std::vector<std::string>;

inline const std::string adapting = R"toml(
[method]
rereference = { every = 40, strain = 0.1 }
[adapt]
resample = true
[output]
history_every = "0.1 us"
fields_every = "10 us"
)toml";
inline const std::string steel_body = steel_304l + adapting;

// A punch goes into the left of a block.
inline const std::string block_case = steel_block + adapting + "[time]\nend = \"10 us\"\n";
inline const std::string punched =
    block_case + left_punch + "friction = { law = \"tresca-limited\", coefficient = 0.2 }\n";

inline const Texts by_strain{"adapt.indicator.field=plastic_strain", "adapt.indicator.h_min=0.1 mm"};

struct Node {
  Vec2 at;
  double plastic_strain, level, age;
  double nearest; ///< m, distance to the nearest other node
};

/// A run to its end, with nothing lost.
struct Adapted {
  results::RunStatus status;
  results::HistoryTable history;
  std::vector<Node> nodes; ///< at the end

  double metric(const std::string& name) const {
    for (const auto& [key, value] : status.metrics)
      if (key == name) return value;
    throw std::out_of_range(name);
  }
  double counted(const std::string& what) const { return metric("adapt." + what); }
  /// Nodes that a window which moves has let in, less those that it let out.
  double through_window() const {
    double sum = 0.0;
    for (const auto& [key, value] : status.metrics) {
      if (key == "window.fed") sum += value;
      if (key == "window.taken_off") sum -= value;
    }
    return sum;
  }
  const std::vector<double>& column(const std::string& name) const {
    return history.column.at(static_cast<std::size_t>(history.find(name)));
  }
  double energy(const std::string& term) const { return column("energy." + term + "[J/m]").back(); }
  double work() const { return energy("tool_work") + energy("drive_work"); }
  double finest() const {
    return std::min_element(nodes.begin(), nodes.end(),
                            [](const Node& a, const Node& b) { return a.nearest < b.nearest; })
        ->nearest;
  }
  template<class Test> double count(Test&& test) const {
    return static_cast<double>(std::count_if(nodes.begin(), nodes.end(), std::forward<Test>(test)));
  }
};

inline std::vector<Node> last_nodes(const std::filesystem::path& folder) {
  std::filesystem::path last;
  for (const auto& entry : std::filesystem::directory_iterator(folder / results::files::fields_folder))
    if (entry.path().filename().string().starts_with("nodes")) last = std::max(last, entry.path());
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(last.c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  const auto value = [&](const char* field, vtkIdType i) {
    return grid->GetPointData()->GetArray(field)->GetTuple1(i);
  };
  std::vector<Node> nodes;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    nodes.push_back({{grid->GetPoint(i)[0], grid->GetPoint(i)[1]},
                     value("equivalent plastic strain", i),
                     value("level of refinement", i),
                     value("age of the node [s]", i),
                     std::numeric_limits<double>::infinity()});
  for (Node& a : nodes)
    for (const Node& b : nodes)
      if (&a != &b) a.nearest = std::min(a.nearest, (a.at - b.at).norm());
  return nodes;
}

/// outside: how many inner nodes may slip through the boundary, between two passes of a whole run.
inline Adapted run(const std::string& text, Texts overrides = {}, double residual = 5e-4, int outside = 0) {
  overrides.emplace_back("output.pictures=[]");
  const input::Case input = input::read_case_text(text, "case.toml", overrides);
  const TemporaryFolder folder("adaptation");
  EXPECT_EQ(app::run(input, {.output = folder.path(), .force = true, .threads = 1, .version = "test"}),
            Exit::done);
  Adapted result{results::read_status(folder.path()),
                 results::read_history(folder.path() / results::files::history), last_nodes(folder.path())};
  EXPECT_LT(std::abs(result.metric("mass_drift")), 1e-12);
  EXPECT_LT(result.status.energy_residual, residual);
  EXPECT_GT(result.metric("mass_balance.low"), 0.75);
  EXPECT_LT(result.metric("mass_balance.high"), 1.3);
  EXPECT_LE(result.counted("outside"), outside);
  EXPECT_EQ(static_cast<double>(result.nodes.size()), result.column("nodes").back());
  const int start = app::build<2>(input).problem.cloud.nodes();
  for (const char* what : {"mass_error", "momentum_error", "heat_error"})
    EXPECT_LT(result.counted(what), 1e-12) << what;
  EXPECT_LT(result.counted("energy_error"), 1e-10);
  if (result.counted("folded") + result.counted("cuts") == 0.0) {
    EXPECT_EQ(result.column("nodes").back() - start,
              result.counted("inserted") + result.counted("inserted_boundary") - result.counted("removed") -
                  result.counted("removed_boundary") - result.counted("outside") + result.through_window());
  }
  return result;
}

inline Texts with(Texts all, const Texts& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

} // namespace cnem::testing
