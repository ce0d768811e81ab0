// Taylor bars on coarse clouds against independent finite-element solutions (cases/verification/taylor_*).
#include "app/run.hpp"
#include "input/case_reader.hpp"
#include "results/history_writer.hpp"
#include "results/status.hpp"
#include "tests/solver_of.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <tuple>
#include <vector>

namespace cnem::testing {
namespace {

struct Shape {
  double length, radius;         ///< m
  double plastic_strain, centre; ///< largest and on the axis at the wall
  double temperature;            ///< K, there
  double residual;               ///< of the energy over the initial one
};

/// Runs a case of cases/verification.
Shape run(const std::string& name, const std::string& spacing, const std::string& method = "cnem") {
  const input::Case input =
      input::read_case(std::string(CNEM_SOURCE_DIR) + "/cases/verification/" + name + "/case.toml",
                       {"cloud.spacing=\"" + spacing + "\"", "method.name=" + method});
  ExplicitSolver<2> solver = testing::solver_of(input);
  while (solver.state().time < input.time.end) {
    const double dt = solver.stable_step().dt;
    for (int n = 0; n < 10; ++n) solver.advance(dt);
  }
  const State<2>& state = solver.state();
  Shape shape{};
  for (std::size_t i = 0; i < state.node.size(); ++i) {
    const double X = solver.state().node.initial_position[0][i],
                 Y = solver.state().node.initial_position[1][i];
    shape.length = std::max(shape.length, state.node.position[1][i]);
    if (Y == 0.0) shape.radius = std::max(shape.radius, state.node.position[0][i]);
    shape.plastic_strain = std::max(shape.plastic_strain, state.point.plastic_strain[i]);
    if (X == 0.0 && Y == 0.0) {
      shape.centre = state.point.plastic_strain[i];
      shape.temperature = state.node.temperature[i];
    }
    if (X == 0.0) { EXPECT_EQ(state.node.position[0][i], 0.0); }
  }
  shape.residual = std::abs(solver.ledger().residual()) / solver.ledger().initial();
  return shape;
}

void expect_within(double found, double reference, double share, const char* what) {
  EXPECT_NEAR(found, reference, share * reference) << what;
}

TEST(TaylorBar, copper_with_linear_hardening) {
  const Shape shape = run("taylor_copper", "0.64 mm");
  expect_within(shape.length, 21.438e-3, 0.01, "length");
  expect_within(shape.radius, 7.225e-3, 0.02, "radius");
  expect_within(shape.plastic_strain, 3.351, 0.15, "plastic strain");
  EXPECT_LT(shape.residual, 1e-3);
}

TEST(TaylorBar, goes_on_with_the_old_reference_where_nodes_have_passed_each_other) {
  const TemporaryFolder temporary("taylor_renewal");
  const std::filesystem::path& folder = temporary.path();
  const input::Case input =
      input::read_case(CNEM_SOURCE_DIR "/cases/verification/taylor_copper/case.toml",
                       {"cloud.spacing=0.64 mm", "output.pictures=[]", "output.fields_every=80 us"});
  EXPECT_EQ(app::run(input, {.output = folder, .force = true, .version = "test"}), Exit::done);
  const results::RunStatus status = results::read_status(folder);
  ASSERT_EQ(status.warnings.size(), 1U);
  EXPECT_NE(status.warnings[0].find("the reference could not be renewed"), std::string::npos);
  EXPECT_LT(status.energy_residual, 1e-3);
}

TEST(TaylorBar, stainless_steel_with_heat) {
  const Shape shape = run("taylor_304l", "0.64 mm");
  expect_within(shape.length, 27.786e-3, 0.01, "length");
  expect_within(shape.radius, 4.2065e-3, 0.02, "radius");
  expect_within(shape.centre, 0.630, 0.15, "plastic strain");
  expect_within(shape.temperature - 296.0, 505.7 - 296.0, 0.15, "rise of temperature");
}

TEST(TaylorBar, plane_strain_slab) {
  const Shape shape = run("taylor_slab_copper", "0.32 mm");
  expect_within(shape.length, 28.830e-3, 0.01, "length");
  expect_within(shape.radius, 6.372e-3, 0.02, "half width");
  expect_within(shape.plastic_strain, 1.82, 0.15, "plastic strain");

  const Shape particles = run("taylor_slab_copper", "0.32 mm", "sph");
  expect_within(particles.length, shape.length, 0.005, "length of particles");
  expect_within(particles.radius, shape.radius, 0.025, "half width of particles");
  expect_within(particles.centre, shape.centre, 0.15,
                "plastic strain of particles"); // elsewhere: docs/methods.md
  EXPECT_LT(particles.residual, 1e-3);

  // Triangles everywhere: integrated at nodes they do not lock.
  const Shape triangles = run("taylor_slab_copper", "0.32 mm", "hybrid");
  expect_within(triangles.length, shape.length, 0.001, "length of nodal triangles");
  expect_within(triangles.radius, shape.radius, 0.01, "half width of nodal triangles");
  expect_within(triangles.centre, shape.centre, 0.05, "plastic strain of nodal triangles");
  EXPECT_LT(triangles.residual, 1e-3);
}

/// Length and half width or radius of a run with triangles as a user makes it, m.
std::array<double, 2> of_triangles(const std::string& name, const std::string& spacing,
                                   const std::string& lagrangian) {
  const TemporaryFolder temporary("taylor_triangles");
  const input::Case input =
      input::read_case(CNEM_SOURCE_DIR "/cases/verification/" + name + "/case.toml",
                       {"method.name=fe-triangles", "method.lagrangian=" + lagrangian,
                        "cloud.spacing=" + spacing, "output.pictures=[]", "output.fields_every=80 us"});
  EXPECT_EQ(app::run(input, {.output = temporary.path(), .force = true, .version = "test"}), Exit::done);
  const results::RunStatus status = results::read_status(temporary.path());
  EXPECT_EQ(status.warnings, std::vector<std::string>{}) << "masses stay with the matter of the nodes";
  EXPECT_LT(status.energy_residual, 1e-3);
  const results::HistoryTable history = results::read_history(temporary.path() / "history.csv");
  const auto last = [&](const std::string& column) {
    return history.column.at(index_of(history.find(column))).back();
  };
  return {32.4e-3 + last("probe.free_end.displacement_y"), 3.2e-3 + last("probe.foot.displacement_x")};
}

// Linear triangles lock; metal that finds other ones on each new reference flows more freely.
TEST(TaylorBar, of_triangles_is_wider_on_new_references) {
  for (const auto& [name, spacing, length, width] :
       {std::tuple("taylor_slab_copper", "0.32 mm", 28.830e-3, 6.372e-3),
        {"taylor_copper", "0.64 mm", 21.438e-3, 7.225e-3}}) {
    const auto total = of_triangles(name, spacing, "total"),
               renewed = of_triangles(name, spacing, "periodic");
    expect_within(total[0], length, 0.01, "length");
    expect_within(renewed[0], length, 0.01, "length on new references");
    expect_within(renewed[1], width, 0.1, "width on new references");
    EXPECT_GT(renewed[1], total[1] + 0.1 * (width - total[1])) << name;
  }
}

// 21.44 mm of the same bar (Q4, 20 × 120, and the literature), in linear tetrahedra, which lock.
TEST(TaylorBar, in_space_is_as_long_as_the_reference_says) {
  const TemporaryFolder temporary("taylor_space");
  const input::Case input =
      input::read_case(CNEM_SOURCE_DIR "/cases/three_dimensions/taylor_tetrahedra/case.toml",
                       {"cloud.spacing=0.8 mm", "output.history_every=80 us", "output.fields_every=80 us"});
  ASSERT_EQ(app::run(input, {.output = temporary.path(), .force = true, .version = "test"}), Exit::done);
  const results::HistoryTable history = results::read_history(temporary.path() / "history.csv");
  const int column = history.find("probe.free_end.displacement_z");
  ASSERT_GE(column, 0);
  const double length = 32.4e-3 + history.column.at(static_cast<std::size_t>(column)).back();
  EXPECT_NEAR(length, 21.44e-3, 0.03 * 21.44e-3);
  EXPECT_LT(results::read_status(temporary.path()).energy_residual, 1e-3);

  // What ParaView opens: tetrahedra with their fields, in three dimensions.
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((temporary.path() / "fields" / "cells_00001.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  ASSERT_EQ(grid->GetNumberOfCells(), 6 * 4 * 4 * 40);
  EXPECT_EQ(grid->GetCellType(0), VTK_TETRA);
  EXPECT_NEAR(grid->GetBounds()[5], length, 0.02 * length);
  ASSERT_NE(grid->GetCellData()->GetArray("equivalent plastic strain"), nullptr);
  EXPECT_GT(grid->GetCellData()->GetArray("equivalent plastic strain")->GetRange()[1], 0.5);
}

/// Length, mean radius of the foot, and how far its rim is from round, m, of a bar along z.
struct RoundBar {
  double length = 0.0, radius = 0.0, out_of_round = 0.0;

  explicit RoundBar(const State<3>& state) {
    const auto& now = state.node.position;
    const auto& first = state.node.initial_position;
    const double edge = *std::max_element(first[0].begin(), first[0].end());
    double least = 1.0, most = 0.0, nodes = 0.0;
    for (std::size_t i = 0; i < state.node.size(); ++i) {
      length = std::max(length, now[2][i]);
      if (first[2][i] > 0.0 || std::hypot(first[0][i], first[1][i]) < (1.0 - 1e-9) * edge) continue;
      const double r = std::hypot(now[0][i], now[1][i]);
      least = std::min(least, r);
      most = std::max(most, r);
      radius += r;
      nodes += 1.0;
    }
    radius /= nodes;
    out_of_round = most - least;
  }
};

// The axisymmetric reference of TaylorBar.copper_with_linear_hardening.
TEST(TaylorBar, in_space_spreads_as_the_axisymmetric_one) {
  const input::Case input = input::read_case(CNEM_SOURCE_DIR "/cases/three_dimensions/taylor/case.toml",
                                             {"cloud.spacing=0.54 mm", "method.lagrangian=total"});
  ExplicitSolver<3> solver = testing::solver_of<3>(input);
  while (solver.state().time < input.time.end) {
    const double dt = solver.stable_step().dt;
    for (int n = 0; n < 10; ++n) solver.advance(dt);
  }
  const RoundBar bar(solver.state());
  EXPECT_NEAR(bar.length, 21.438e-3, 0.06e-3);
  EXPECT_NEAR(bar.radius, 7.225e-3, 0.08e-3);
  EXPECT_LT(bar.out_of_round, 0.02 * bar.radius);
  EXPECT_LT(std::abs(solver.ledger().residual()), 1e-3 * solver.ledger().initial());
}

TEST(TaylorBar, in_space_is_the_same_on_new_references) {
  const TemporaryFolder temporary("taylor_references");
  const input::Case input =
      input::read_case(CNEM_SOURCE_DIR "/cases/three_dimensions/taylor/case.toml",
                       {"cloud.spacing=0.8 mm", "output.history_every=80 us", "output.fields_every=80 us"});
  ASSERT_EQ(app::run(input, {.output = temporary.path(), .force = true, .version = "test"}), Exit::done);
  const results::RunStatus status = results::read_status(temporary.path());
  EXPECT_LT(status.energy_residual, 1e-3);
  const results::HistoryTable history = results::read_history(temporary.path() / "history.csv");
  const auto last = [&](const std::string& column) {
    return history.column.at(index_of(history.find(column))).back();
  };
  EXPECT_NEAR(32.4e-3 + last("probe.free_end.displacement_z"), 21.438e-3, 0.06e-3);
  EXPECT_NEAR(3.2e-3 + last("probe.foot.displacement_x"), 7.225e-3, 0.08e-3);
}

/// Largest less least radius of the rim over their mean, –, of the nodes of a bar, those on its chords too.
double out_of_round(const std::filesystem::path& nodes) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(nodes.c_str());
  reader->Update();
  vtkDataArray* way = reader->GetOutput()->GetPointData()->GetArray("displacement [m]");
  constexpr double first_radius = 3.2e-3, chords = 0.975, foot = 1e-9;
  std::vector<double> rim;
  for (vtkIdType i = 0; i < reader->GetOutput()->GetNumberOfPoints(); ++i) {
    std::array<double, 3> x{}, u{};
    reader->GetOutput()->GetPoint(i, x.data());
    way->GetTuple(i, u.data());
    if (x[2] - u[2] < foot && std::hypot(x[0] - u[0], x[1] - u[1]) > chords * first_radius)
      rim.push_back(std::hypot(x[0], x[1]));
  }
  EXPECT_GT(rim.size(), 12U);
  const auto [least, most] = std::minmax_element(rim.begin(), rim.end());
  return (*most - *least) * static_cast<double>(rim.size()) / std::accumulate(rim.begin(), rim.end(), 0.0);
}

TEST(TaylorBar, in_space_is_the_same_where_its_cloud_follows_the_deformation) {
  for (const char* cells : {"median", "voronoi"}) {
    SCOPED_TRACE(cells);
    const TemporaryFolder temporary("taylor_resampled");
    std::vector<std::string> overrides{"cloud.spacing=0.54 mm",
                                       "adapt.resample=true",
                                       std::string("method.cells=") + cells,
                                       "output.history_every=80 us",
                                       "output.fields_every=80 us",
                                       "output.picture_fields=[\"plastic_strain\"]",
                                       "output.ranges.plastic_strain=\"0 3\"",
                                       "output.sections.cut={ at = \"0 0.1 0 mm\", normal = \"0 -1 0\" }"};
    if (cells == std::string("voronoi")) overrides.emplace_back("method.functions=laplace");
    const input::Case input =
        input::read_case(CNEM_SOURCE_DIR "/cases/three_dimensions/taylor/case.toml", overrides);
    ASSERT_EQ(app::run(input, {.output = temporary.path(), .force = true, .version = "test"}), Exit::done);
    for (const char* picture : {"plastic_strain_000.png", "plastic_strain_cut_000.png"})
      EXPECT_GT(std::filesystem::file_size(temporary.path() / "pictures" / picture), 5000U);
    const results::RunStatus status = results::read_status(temporary.path());
    EXPECT_LT(status.energy_residual, 1e-3);
    const auto metric = [&](std::string_view name) {
      for (const auto& [key, value] : status.metrics)
        if (key == name) return value;
      ADD_FAILURE() << "no metric " << name;
      return 0.0;
    };
    EXPECT_GT(metric("adapt.passes"), 5.0);
    EXPECT_GT(metric("adapt.inserted") + metric("adapt.inserted_boundary"), 10.0);
    EXPECT_LT(metric("adapt.mass_error"), 1e-12);
    EXPECT_LT(metric("adapt.momentum_error"), 1e-12);
    EXPECT_LT(metric("adapt.heat_error"), 1e-12);
    EXPECT_EQ(metric("adapt.crossings"), 0.0);
    const results::HistoryTable history = results::read_history(temporary.path() / "history.csv");
    const auto last = [&](const std::string& column) {
      return history.column.at(index_of(history.find(column))).back();
    };
    EXPECT_NEAR(32.4e-3 + last("probe.free_end.displacement_z"), 21.438e-3, 0.06e-3);
    EXPECT_NEAR(3.2e-3 + last("probe.foot.displacement_x"), 7.225e-3, 0.08e-3);
    // 2% are kept from 0.42 mm on
    EXPECT_LT(out_of_round(temporary.path() / "fields" / "nodes_00001.vtu"), 0.025);
  }
}

} // namespace
} // namespace cnem::testing
