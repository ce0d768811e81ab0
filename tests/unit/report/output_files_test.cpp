// What runs write: files of the queue, palettes of pictures, .vtu files as VTK reads them.
#include "core/error.hpp"
#include "report/palette_png.hpp"
#include "report/picture.hpp"
#include "results/file_queue.hpp"
#include "results/output_folder.hpp"
#include "results/vtk_reader.hpp"
#include "results/vtk_writer.hpp"
#include "tests/temporary_folder.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <future>
#include <gtest/gtest.h>
#include <memory>
#include <png.h>
#include <random>
#include <thread>
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

class OutputFiles : public ::testing::Test {
protected:
  const cnem::testing::TemporaryFolder temporary{"output"};
  const fs::path& folder = temporary.path();
};

TEST_F(OutputFiles, queued_files_are_whole_and_the_last_of_a_name_stays) {
  results::FileQueue queue;
  for (int k = 0; k < 50; ++k) {
    queue.put(folder / ("file_" + std::to_string(k)), std::string(1000, 'x') + std::to_string(k));
    queue.put(folder / "list", std::to_string(k));
  }
  queue.wait();
  for (int k = 0; k < 50; ++k)
    EXPECT_EQ(results::read_file(folder / ("file_" + std::to_string(k))),
              std::string(1000, 'x') + std::to_string(k));
  EXPECT_EQ(results::read_file(folder / "list"), "49");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 51); // nothing temporary is left
}

TEST_F(OutputFiles, a_file_that_cannot_be_written_is_told_and_nothing_follows_it) {
  results::FileQueue queue;
  queue.put(folder / "missing" / "file", "content");
  EXPECT_THROW(queue.wait(), IoError);
  EXPECT_THROW(queue.put(folder / "list", "names what is not there"), IoError);
  EXPECT_THROW(queue.wait(), IoError);
  EXPECT_FALSE(fs::exists(folder / "list"));
}

TEST_F(OutputFiles, what_is_queued_is_written_before_the_queue_goes) {
  { results::FileQueue().put(folder / "file", "content"); }
  EXPECT_EQ(results::read_file(folder / "file"), "content");
}

TEST_F(OutputFiles, files_are_made_elsewhere_and_reach_the_disk_in_order) {
  results::FileQueue queue;
  std::atomic<int> made = 0;
  for (int k = 0; k < 20; ++k)
    queue.put(
        folder / ("file_" + std::to_string(k)),
        [&made, k] {
          ++made;
          return std::string(1000, static_cast<char>('a' + k));
        },
        1000);
  queue.wait();
  EXPECT_EQ(made, 20);
  for (int k = 0; k < 20; ++k)
    EXPECT_EQ(results::read_file(folder / ("file_" + std::to_string(k))),
              std::string(1000, static_cast<char>('a' + k)));
}

TEST_F(OutputFiles, a_list_waits_for_the_file_that_it_names) {
  std::promise<void> go;
  {
    results::FileQueue queue;
    queue.put(
        folder / "file",
        [&] {
          go.get_future().wait();
          return std::string("content");
        },
        0);
    queue.put(folder / "list", "file");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_FALSE(fs::exists(folder / "list"));
    go.set_value();
  }
  EXPECT_EQ(results::read_file(folder / "file"), "content");
  EXPECT_EQ(results::read_file(folder / "list"), "file");
}

TEST_F(OutputFiles, a_file_that_cannot_be_made_is_told_and_nothing_follows_it) {
  results::FileQueue queue;
  queue.put(
      folder / "file", []() -> std::string { throw InputError("no such field"); }, 0);
  EXPECT_THROW(queue.wait(), InputError);
  EXPECT_THROW(queue.put(folder / "list", "names what is not there"), InputError);
  EXPECT_FALSE(fs::exists(folder / "file"));
  EXPECT_FALSE(fs::exists(folder / "list"));
}

TEST_F(OutputFiles, a_file_for_which_memory_does_not_suffice_is_not_begun) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "its allocator ends the process instead of throwing";
#endif
  results::FileQueue queue;
  bool begun = false;
  queue.put(
      folder / "large", [&] { return begun = true, std::string("content"); }, std::size_t{1} << 58);
  EXPECT_THROW(queue.wait(), std::bad_alloc);
  EXPECT_FALSE(begun);
  EXPECT_FALSE(fs::exists(folder / "large"));
}

TEST(Palette, every_colour_of_the_drawing_is_its_own_nearest) {
  for (const ColourMap map : {ColourMap::strain, ColourMap::heat, ColourMap::diverging}) {
    const std::vector<std::uint32_t> palette = drawing_palette(map, 0.4);
    ASSERT_EQ(palette.size(), 256U);
    const auto index = nearest_colours({palette.data(), 16, 16, 16}, palette);
    for (std::size_t k = 0; k < palette.size(); ++k) EXPECT_EQ(palette[index[k]], palette[k]) << k;
    for (const std::uint32_t colour : {0xFFFFFFU, 0x000000U, 0xFF00FFU})
      EXPECT_NE(std::find(palette.begin(), palette.end(), colour), palette.end()) << colour;
  }
}

TEST(Palette, the_colour_map_is_met_within_what_can_be_seen) {
  for (const ColourMap map : {ColourMap::strain, ColourMap::heat, ColourMap::diverging}) {
    const std::vector<std::uint32_t> palette = drawing_palette(map, 0.4);
    for (int k = 0; k <= 1000; ++k) {
      const Colour colour = map_colour(map, k / 1000.0);
      const auto byte = [](double c) { return static_cast<std::uint32_t>(std::lround(255.0 * c)); };
      const std::uint32_t pixel = byte(colour.red) << 16 | byte(colour.green) << 8 | byte(colour.blue);
      const std::uint32_t near = palette[nearest_colours({&pixel, 1, 1, 1}, palette)[0]];
      const Colour drawn{(near >> 16 & 0xFF) / 255.0, (near >> 8 & 0xFF) / 255.0, (near & 0xFF) / 255.0};
      EXPECT_LT(colour_distance(colour, drawn), 0.01) << k; // half of a just noticeable difference
    }
  }
}

/// A square of two cells, x from 0 to 20 and from 20 to 40, and one that is not convex, above them.
CellGeometry<2> three_cells() {
  CellGeometry<2> cells;
  cells.vertex = {{0, 0}, {20, 0}, {20, 20}, {0, 20}, {40, 0}, {40, 20}, {0, 40}, {20, 30}, {40, 40}};
  cells.begin = {0, 4, 8, 13};
  cells.index = {0, 1, 2, 3, 1, 4, 5, 2, 3, 5, 8, 7, 6};
  cells.vertex_begin = {0};
  for (std::int32_t v = 0; v < 9; ++v) { // vertices move with nodes at them
    cells.vertex_begin.push_back(v + 1);
    cells.vertex_node.push_back(as<NodeIndex>(v));
    cells.vertex_weight.push_back(1.0);
  }
  return cells;
}

class DrawnCells : public ::testing::Test {
protected:
  DrawnCells() {
    for (const Vec2& at : cells.vertex)
      for (std::size_t k = 0; k < 2; ++k) position[k].push_back(at[static_cast<Eigen::Index>(k)]);
    picture.cells = &cells;
    picture.position = {position[0], position[1]};
    picture.value = value;
    picture.range = ColourRange{0.0, 1.0};
    picture.edges = false;
    picture.width = 600;
    layout = layout_picture(picture);
  }
  /// Colours of the picture as its PNG has them.
  void draw() {
    const std::string png = draw_png(picture);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_TRUE(png_image_begin_read_from_memory(&image, png.data(), png.size())) << image.message;
    EXPECT_TRUE(image.format & PNG_FORMAT_FLAG_COLORMAP); // a byte a pixel
    image.format = PNG_FORMAT_RGB;
    pixels.resize(PNG_IMAGE_SIZE(image));
    ASSERT_TRUE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr)) << image.message;
    ASSERT_EQ(image.width, static_cast<png_uint_32>(layout.width));
    ASSERT_EQ(image.height, static_cast<png_uint_32>(layout.height));
  }
  std::uint32_t at(double x, double y) const {
    const Vec2 p = layout.pixel({x, y});
    const auto first = 3 * (static_cast<std::size_t>(p.y()) * static_cast<std::size_t>(layout.width) +
                            static_cast<std::size_t>(p.x()));
    return static_cast<std::uint32_t>(pixels[first] << 16 | pixels[first + 1] << 8 | pixels[first + 2]);
  }
  /// Least green within a few pixels along x.
  std::uint32_t darkest(double x, double y) const {
    std::uint32_t least = 255;
    for (int k = -2; k <= 2; ++k) least = std::min(least, green(at(x + k / layout.scale, y)));
    return least;
  }
  static std::uint32_t green(std::uint32_t colour) { return colour >> 8 & 0xFFU; }
  CellGeometry<2> cells = three_cells();
  std::array<std::vector<double>, 2> position;
  std::vector<double> value{0.0, 1.0, std::nan("")};
  Picture picture;
  PictureLayout layout;
  std::vector<png_byte> pixels;
};

TEST_F(DrawnCells, cells_meet_without_seams_and_notches_stay_free) {
  draw();
  EXPECT_NE(at(5, 5), at(30, 5));
  for (double x = 1; x < 19.8; x += 0.1) EXPECT_EQ(at(x, 10), at(5, 5)) << x;
  for (double x = 20.2; x < 39; x += 0.1) EXPECT_EQ(at(x, 10), at(30, 5)) << x;
  EXPECT_EQ(at(20, 25), 0xFF00FFU);    // not a number
  EXPECT_GT(green(at(20, 38)), 0xE0U); // the notch
  EXPECT_GT(green(at(-0.5, 20)), 0xE0U);
  EXPECT_LT(darkest(40, 10), 0x70U); // the rim
}

TEST_F(DrawnCells, lines_between_cells_are_darker_than_the_cells) {
  value = {1.0, 1.0, 1.0};
  picture.value = value;
  draw();
  const std::uint32_t plain = at(20, 10), inside = at(10, 10);
  EXPECT_EQ(plain, inside);
  picture.edges = true;
  picture.width = 2000;
  layout = layout_picture(picture);
  draw();
  EXPECT_EQ(at(10, 10), inside);
  EXPECT_LT(darkest(20, 10), green(plain) - 20);
}

TEST_F(DrawnCells, cells_of_one_colour_stay_apart) {
  for (std::size_t v : {1U, 4U, 5U, 2U}) position[0][v] += 2.0; // the first cell keeps its corners 0 and 3
  cells.index = {0, 0, 3, 3, 1, 4, 5, 2, 3, 5, 8, 7, 6};
  value = {1.0, 1.0, 1.0};
  layout = layout_picture(picture);
  draw();
  EXPECT_GT(green(at(10, 10)), 0xE0U);
  EXPECT_NE(at(30, 10), at(10, 10));
  EXPECT_EQ(at(30, 10), at(20, 28));
}

TEST_F(DrawnCells, cells_that_are_not_finite_are_left_out) {
  position[0][0] = std::nan("");
  picture.position = {position[0], position[1]};
  layout = layout_picture(picture);
  draw();
  EXPECT_GT(green(at(5, 5)), 0xE0U);
  EXPECT_LT(green(at(30, 5)), 0xFFU);
}

class VtuFiles : public OutputFiles {
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
      results::read_cell_fields(folder / series[1].cells, {"pressure [Pa]"}, Vec2(1.0, 0.0));
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
  EXPECT_NE(
      message([&] { results::read_cell_fields(file, {"pressure"}, Vec2(0, 0)); }).find("no field 'pressure'"),
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
