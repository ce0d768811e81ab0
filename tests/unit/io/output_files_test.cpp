// What runs write: files of the queue, palettes of pictures, .vtu files as VTK reads them.
#include "core/error.hpp"
#include "io/cell_raster.hpp"
#include "io/file_queue.hpp"
#include "io/png.hpp"
#include "io/vtk_writer.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <unistd.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace cnem::io {
namespace {

namespace fs = std::filesystem;

class OutputFiles : public ::testing::Test {
protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("cnem_output_" + std::to_string(::getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
  fs::path folder;
};

TEST_F(OutputFiles, queued_files_are_whole_and_the_last_of_a_name_stays) {
  FileQueue queue;
  for (int k = 0; k < 50; ++k) {
    queue.put(folder / ("file_" + std::to_string(k)), std::string(1000, 'x') + std::to_string(k));
    queue.put(folder / "list", std::to_string(k));
  }
  queue.wait();
  for (int k = 0; k < 50; ++k)
    EXPECT_EQ(read_file(folder / ("file_" + std::to_string(k))), std::string(1000, 'x') + std::to_string(k));
  EXPECT_EQ(read_file(folder / "list"), "49");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 51); // nothing temporary is left
}

TEST_F(OutputFiles, a_file_that_cannot_be_written_is_told_and_nothing_follows_it) {
  FileQueue queue;
  queue.put(folder / "missing" / "file", "content");
  EXPECT_THROW(queue.wait(), IoError);
  EXPECT_THROW(queue.put(folder / "list", "names what is not there"), IoError);
  EXPECT_THROW(queue.wait(), IoError);
  EXPECT_FALSE(fs::exists(folder / "list"));
}

TEST_F(OutputFiles, what_is_queued_is_written_before_the_queue_goes) {
  { FileQueue().put(folder / "file", "content"); }
  EXPECT_EQ(read_file(folder / "file"), "content");
}

TEST(Palette, few_colours_are_exact) {
  const std::vector<std::uint32_t> pixels{0xFFFFFF, 0x000000, 0x123456, 0xFFFFFF, 0xFF0000, 0xFFFFFF};
  const IndexedPixels reduced = reduce_colours({pixels.data(), 3, 2, 3});
  ASSERT_EQ(reduced.palette.size(), 4U);
  for (std::size_t k = 0; k < pixels.size(); ++k)
    EXPECT_EQ(reduced.palette[reduced.index[k]], pixels[k]) << k;
}

TEST(Palette, a_ramp_of_colours_is_near_and_white_stays_white) {
  std::vector<std::uint32_t> pixels(60000, 0xFFFFFF);
  for (std::uint32_t k = 0; k < 30000; ++k) {
    const std::uint32_t level = k * 256 / 30000;
    pixels[k] = level << 16 | (255 - level) << 8 | level / 2;
  }
  const IndexedPixels reduced = reduce_colours({pixels.data(), 300, 200, 300});
  EXPECT_LE(reduced.palette.size(), 256U);
  int worst = 0;
  for (std::size_t k = 0; k < pixels.size(); ++k)
    for (const int shift : {0, 8, 16})
      worst = std::max(worst, std::abs(static_cast<int>(reduced.palette[reduced.index[k]] >> shift & 0xFF) -
                                       static_cast<int>(pixels[k] >> shift & 0xFF)));
  EXPECT_LE(worst, 4);
  EXPECT_EQ(reduced.palette[reduced.index.back()], 0xFFFFFFU);
}

/// A square of two cells, x from 0 to 2 and from 2 to 4, and one that is not convex, above them.
CellGeometry<2> three_cells(std::vector<Vec2>& vertex) {
  vertex = {{0, 0}, {20, 0}, {20, 20}, {0, 20}, {40, 0}, {40, 20}, {0, 40}, {20, 30}, {40, 40}};
  CellGeometry<2> cells;
  cells.begin = {0, 4, 8, 13};
  cells.index = {0, 1, 2, 3, 1, 4, 5, 2, 3, 5, 8, 7, 6};
  return cells;
}

TEST(CellRaster, cells_meet_without_seams_and_notches_stay_free) {
  std::vector<Vec2> vertex;
  const CellGeometry<2> cells = three_cells(vertex);
  const std::vector<double> value{0.0, 1.0, std::nan("")};
  std::vector<std::uint32_t> pixels(50 * 50, 0xABCDEF);
  paint_cells({pixels.data(), 50, 50, 50}, cells, vertex,
              {.value = value, .map = ColourMap::strain, .range = {0.0, 1.0}, .rim = 1.0});
  const auto at = [&](int x, int y) { return pixels[static_cast<std::size_t>(50 * y + x)]; };
  EXPECT_NE(at(5, 5), at(30, 5));
  for (int x = 1; x < 19; ++x) EXPECT_EQ(at(x, 10), at(5, 5)) << x;
  for (int x = 20; x < 40; ++x) EXPECT_EQ(at(x, 10), at(30, 5)) << x;
  EXPECT_EQ(at(20, 25), 0xFF00FFU); // not a number
  EXPECT_EQ(at(20, 38), 0xABCDEFU); // the notch
  EXPECT_EQ(at(45, 45), 0xABCDEFU);
  EXPECT_LT(at(40, 10) & 0xFF, 0x40U); // the rim is dark
}

TEST(CellRaster, lines_between_cells_are_darker_than_the_cells) {
  std::vector<Vec2> vertex;
  const CellGeometry<2> cells = three_cells(vertex);
  const std::vector<double> value(3, 1.0);
  std::vector<std::uint32_t> plain(50 * 50), lined(50 * 50);
  CellPaint paint{.value = value, .map = ColourMap::strain, .range = {0.0, 1.0}, .rim = 1.0};
  paint_cells({plain.data(), 50, 50, 50}, cells, vertex, paint);
  paint.edge = 1.0;
  paint.strength = 0.4;
  paint_cells({lined.data(), 50, 50, 50}, cells, vertex, paint);
  const auto green = [](std::uint32_t pixel) { return pixel >> 8 & 0xFF; };
  EXPECT_EQ(plain[50 * 10 + 10], lined[50 * 10 + 10]);
  EXPECT_LT(green(lined[50 * 10 + 20]), green(plain[50 * 10 + 20]) - 20);
}

class VtuFiles : public OutputFiles {
protected:
  void write() {
    std::vector<Vec2> vertex;
    cells = three_cells(vertex);
    cells.vertex = vertex;
    cells.vertex_begin = {0};
    for (std::int32_t v = 0; v < 9; ++v) {
      cells.vertex_begin.push_back(v + 1);
      cells.vertex_node.push_back(v);
      cells.vertex_weight.push_back(1.0);
      position[0].push_back(vertex[static_cast<std::size_t>(v)].x() + 1.0);
      position[1].push_back(vertex[static_cast<std::size_t>(v)].y());
      temperature.push_back(300.0 + v / 7.0);
    }
    FileQueue queue;
    FieldWriter writer(folder);
    for (const double time : {0.0, 1e-6})
      writer.write(queue, {.time = time,
                           .cells = &cells,
                           .position = {position[0], position[1]},
                           .cell_scalars = {{"pressure [Pa]", pressure}},
                           .cell_vectors = {},
                           .node_scalars = {{"temperature [K]", temperature}},
                           .node_vectors = {{"velocity [m/s]", {position[0], position[1], {}}}}});
    queue.wait();
  }
  vtkSmartPointer<vtkUnstructuredGrid> read(const std::string& file) const {
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName((folder / file).c_str());
    reader->Update();
    return reader->GetOutput();
  }
  CellGeometry<2> cells;
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
  FileQueue queue;
  FieldWriter(folder).write(queue, {.time = 0.0,
                                    .cells = &cells,
                                    .position = {position[0], position[1]},
                                    .cell_scalars = {},
                                    .cell_vectors = {},
                                    .node_scalars = {{"noise", noise}, {"again", noise}},
                                    .node_vectors = {}});
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
  EXPECT_EQ(FieldWriter::resume(folder, 1e-6).frames(), 2);
  EXPECT_EQ(FieldWriter::resume(folder, 0.5e-6).frames(), 1);
  EXPECT_FALSE(fs::exists(folder / "fields" / "cells_00001.vtu"));
  EXPECT_TRUE(fs::exists(folder / "fields" / "cells_00000.vtu"));
  write_atomically(folder / "fields.pvd", "<Collection> <DataSet timestep=\"0\" </Collection>\n");
  EXPECT_THROW(FieldWriter::resume(folder, 1.0), IoError);
}

TEST_F(VtuFiles, a_field_of_the_wrong_length_is_refused) {
  pressure.pop_back();
  EXPECT_THROW(write(), InputError);
}

} // namespace
} // namespace cnem::io
