// .vtu files as VTK and the program read them.
#include "core/error.hpp"
#include "results/file_queue.hpp"
#include "results/output_folder.hpp"
#include "results/vtk_reader.hpp"
#include "results/vtk_writer.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/report/three_cells.hpp"

#include <filesystem>
#include <gtest/gtest.h>
#include <memory>
#include <random>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace cnem::report {
namespace {

namespace fs = std::filesystem;

class VtuFiles : public ::testing::Test {
protected:
  void write() {
    for (const Vec2& at : cells.vertex) {
      temperature.push_back(300.0 + static_cast<double>(temperature.size()) / 7.0);
      position[0].push_back(at.x() + 1.0);
      position[1].push_back(at.y());
    }
    results::FileQueue queue;
    results::FieldWriter writer(folder);
    for (const double time : {0.0, 1e-6})
      writer.write<2>(queue, std::make_shared<results::FieldFrame<2>>(results::FieldFrame<2>{
                                 .time = time,
                                 .cells = &cells,
                                 .position = {position[0], position[1]},
                                 .cell_scalars = {{"pressure [Pa]", pressure}},
                                 .cell_vectors = {},
                                 .node_scalars = {{"temperature [K]", temperature}},
                                 .node_vectors = {{"velocity [m/s]", {position[0], position[1], {}}}}}));
    queue.wait();
  }
  vtkSmartPointer<vtkUnstructuredGrid> read(const std::string& file) const {
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName((folder / file).c_str());
    reader->Update();
    return reader->GetOutput();
  }
  const cnem::testing::TemporaryFolder temporary{"output"};
  const fs::path& folder = temporary.path();
  CellGeometry<2> cells = three_cells();
  std::array<std::vector<double>, 2> position;
  std::vector<double> pressure{1.0 / 3.0, -2e8, 5e-300}, temperature;
};

TEST_F(VtuFiles, vtk_reads_cells_and_fields_to_the_bit) {
  write();
  const auto grid = read("fields/cells_00001.vtu");
  ASSERT_EQ(grid->GetNumberOfCells(), 3);
  ASSERT_EQ(grid->GetNumberOfPoints(), 9);
  EXPECT_EQ(grid->GetCellType(2), VTK_POLYGON);
  EXPECT_EQ(grid->GetCell(2)->GetNumberOfPoints(), 5);
  EXPECT_EQ(grid->GetCell(2)->GetPointId(4), 6);
  EXPECT_EQ(grid->GetPoint(4)[0], 41.0);
  for (vtkIdType c = 0; c < 3; ++c)
    EXPECT_EQ(grid->GetCellData()->GetArray("pressure [Pa]")->GetTuple1(c),
              pressure[static_cast<std::size_t>(c)]);
  EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 1e-6);
}

TEST_F(VtuFiles, what_was_written_is_read_back_to_the_bit) {
  write();
  const std::vector<results::FieldFiles> series = results::read_field_series(folder);
  ASSERT_EQ(series.size(), 2U);
  EXPECT_EQ(series[1].time, 1e-6);
  EXPECT_EQ(series[1].nodes, "fields/nodes_00001.vtu");
  const results::CellFields read =
      results::read_cell_fields(folder / series[1].cells, {{"pressure [Pa]"}}, Vec2(1.0, 0.0));
  EXPECT_EQ(read.cells.begin, cells.begin);
  EXPECT_EQ(read.cells.index, cells.index);
  EXPECT_EQ(read.values.front(), Field(pressure.begin(), pressure.end()));
  EXPECT_TRUE(read.displacement[0].empty());
  const std::vector<Vec2> vertices =
      results::moved_vertices<2>(read.cells, {read.position[0], read.position[1]});
  for (std::size_t v = 0; v < vertices.size(); ++v) EXPECT_EQ(vertices[v], cells.vertex[v]) << v;
}

TEST_F(VtuFiles, displacements_of_vertices_are_read_back) {
  Fields<2> moved;
  for (const Vec2& at : cells.vertex) {
    position[0].push_back(at.x());
    position[1].push_back(at.y());
    moved[0].push_back(at.x() + 0.5);
    moved[1].push_back(2.0 * at.y());
  }
  results::FileQueue queue;
  results::FieldFrame<2> frame{.time = 1.0,
                               .cells = &cells,
                               .position = {moved[0], moved[1]},
                               .initial = {position[0], position[1]},
                               .cell_scalars = {},
                               .cell_vectors = {},
                               .node_scalars = {},
                               .node_vectors = {}};
  results::FieldWriter(folder).write<2>(queue, std::make_shared<results::FieldFrame<2>>(frame));
  queue.wait();
  const auto read = results::read_cell_fields(folder / "fields/cells_00000.vtu", {}, Vec2(0, 0));
  for (std::size_t v = 0; v < cells.vertex.size(); ++v) {
    EXPECT_EQ(read.displacement[0][v], 0.5);
    EXPECT_EQ(read.displacement[1][v], position[1][v]);
  }
}

TEST_F(VtuFiles, a_series_or_a_file_that_is_none_is_refused) {
  write();
  const auto message = [](auto&& read) -> std::string {
    try {
      read();
    } catch (const IoError& error) { return error.what(); }
    return "accepted";
  };
  const fs::path file = folder / "fields/cells_00000.vtu";
  EXPECT_NE(message([&] {
              results::read_cell_fields(file, {{"pressure"}}, Vec2(0, 0));
            }).find("no field 'pressure'"),
            std::string::npos);
  const std::string whole = results::read_file(file);
  results::write_atomically(file, whole.substr(0, whole.size() / 3));
  EXPECT_NE(message([&] { results::read_cell_fields(file, {}, Vec2(0, 0)); }).find("damaged or cut short"),
            std::string::npos);
  EXPECT_NE(message([&] { results::has_cell_field(file, {"pressure [Pa]"}); }).find("damaged or cut short"),
            std::string::npos);
  results::write_atomically(file, "nothing");
  EXPECT_NE(message([&] { results::read_cell_fields(file, {}, Vec2(0, 0)); }).find("cannot read"),
            std::string::npos);
  results::write_atomically(folder / "fields.pvd", "<VTKFile/>");
  EXPECT_NE(message([&] { results::read_field_series(folder); }).find("is not a collection"),
            std::string::npos);
}

TEST_F(VtuFiles, vtk_reads_nodes_and_vectors_to_the_bit) {
  write();
  const auto grid = read("fields/nodes_00000.vtu");
  ASSERT_EQ(grid->GetNumberOfPoints(), 9);
  EXPECT_EQ(grid->GetCellType(0), VTK_VERTEX);
  for (vtkIdType i = 0; i < 9; ++i) {
    EXPECT_EQ(grid->GetPointData()->GetArray("temperature [K]")->GetTuple1(i),
              temperature[static_cast<std::size_t>(i)]);
    EXPECT_EQ(grid->GetPointData()->GetArray("velocity [m/s]")->GetTuple3(i)[1],
              position[1][static_cast<std::size_t>(i)]);
  }
}

TEST_F(VtuFiles, arrays_of_many_blocks_come_back_to_the_bit) {
  const std::size_t count = 20000; // a node array takes two blocks and a bit, a position seven
  std::mt19937 random(1);
  cells.begin = {0};
  std::vector<double> noise;
  for (std::size_t i = 0; i < count; ++i) {
    position[0].push_back(static_cast<double>(random()) / 3.0);
    position[1].push_back(0.0);
    noise.push_back(1.0 / static_cast<double>(1 + random()));
  }
  results::FileQueue queue;
  results::FieldWriter(folder).write<2>(
      queue, std::make_shared<results::FieldFrame<2>>(results::FieldFrame<2>{
                 .time = 0.0,
                 .cells = &cells,
                 .position = {position[0], position[1]},
                 .cell_scalars = {},
                 .cell_vectors = {},
                 .node_scalars = {{"noise", noise}, {"again", noise}},
                 .node_vectors = {}}));
  queue.wait();
  const auto grid = read("fields/nodes_00000.vtu");
  ASSERT_EQ(grid->GetNumberOfPoints(), static_cast<vtkIdType>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = static_cast<vtkIdType>(i);
    ASSERT_EQ(grid->GetPoint(at)[0], position[0][i]);
    ASSERT_EQ(grid->GetPointData()->GetArray("noise")->GetTuple1(at), noise[i]);
    ASSERT_EQ(grid->GetPointData()->GetArray("again")->GetTuple1(at), noise[i]);
  }
}

TEST_F(VtuFiles, a_series_goes_on_without_the_frames_that_are_later) {
  write();
  EXPECT_EQ(results::FieldWriter::resume(folder, 1e-6).frames(), 2);
  EXPECT_EQ(results::FieldWriter::resume(folder, 0.5e-6).frames(), 1);
  EXPECT_FALSE(fs::exists(folder / "fields" / "cells_00001.vtu"));
  EXPECT_TRUE(fs::exists(folder / "fields" / "cells_00000.vtu"));
  results::write_atomically(folder / "fields.pvd", "<Collection> <DataSet timestep=\"0\" </Collection>\n");
  EXPECT_THROW(results::FieldWriter::resume(folder, 1.0), IoError);
}

TEST_F(VtuFiles, a_field_of_the_wrong_length_is_refused) {
  pressure.pop_back();
  EXPECT_THROW(write(), InputError);
}

} // namespace
} // namespace cnem::report
