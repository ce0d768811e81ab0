// What runs write: files of the queue, pictures and their palettes.
#include "core/error.hpp"
#include "report/cell_raster.hpp"
#include "report/palette_png.hpp"
#include "report/picture.hpp"
#include "results/file_queue.hpp"
#include "results/output_folder.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/report/three_cells.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <future>
#include <gtest/gtest.h>
#include <memory>
#include <png.h>
#include <thread>

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

TEST(Palette, any_pixel_has_the_nearest_colour_and_the_first_of_equals) {
  const std::vector<std::uint32_t> palette = drawing_palette(ColourMap::heat, 0.4);
  const auto grey = [](std::uint32_t c) { return c == (c & 0xFF) * 0x10101U; };
  const auto distance = [&](std::uint32_t a, std::uint32_t b) {
    int sum = grey(a) == grey(b) ? 0 : 1000000; // greys and colours keep apart
    for (const int shift : {0, 8, 16}) {
      const int d = static_cast<int>(a >> shift & 0xFF) - static_cast<int>(b >> shift & 0xFF);
      sum += d * d;
    }
    return sum;
  };
  std::uint32_t pixel = 1;
  for (int k = 0; k < 20000; ++k) {
    pixel = (pixel * 1664525U + 1013904223U) & 0xFFFFFFU;
    if (k % 16 == 0) pixel = (pixel & 0xFF) * 0x10101U;
    const auto first =
        std::min_element(palette.begin(), palette.end(), [&](std::uint32_t a, std::uint32_t b) {
          return distance(a, pixel) < distance(b, pixel);
        });
    EXPECT_EQ(nearest_colours({&pixel, 1, 1, 1}, palette)[0], first - palette.begin()) << pixel;
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

TEST_F(DrawnCells, tools_that_conduct_have_the_colours_of_the_scale) {
  CellGeometry<2> tool;
  tool.vertex = {{20, 31}, {36, 39.5}, {4, 39.5}};
  tool.vertex_begin = {0, 1, 2, 3};
  for (std::int32_t v = 0; v < 3; ++v) {
    tool.vertex_node.push_back(as<NodeIndex>(v));
    tool.vertex_weight.push_back(1.0);
    tool.index.push_back(v);
  }
  tool.begin = {0, 3};
  const results::CellFields warm{.cells = tool, .position = {}, .displacement = {}, .values = {{1.0}}};
  picture.warm_tools = &warm;
  draw();
  EXPECT_EQ(at(20, 37), at(30, 5)) << "a tool in the notch, as warm as a cell";
  EXPECT_NE(at(5, 5), at(20, 37));
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

TEST_F(DrawnCells, pictures_of_several_fields_share_what_cells_cover) {
  const std::vector<double> other{1.0, 0.5, 0.0};
  std::array<std::string, 2> alone, together;
  CellRasters rasters;
  for (std::string& png : alone) {
    png = draw_png(picture);
    picture.value = other;
  }
  picture.value = value;
  picture.rasters = &rasters;
  for (std::string& png : together) {
    png = draw_png(picture);
    picture.value = other;
  }
  EXPECT_NE(alone[0], alone[1]);
  EXPECT_EQ(together, alone);
  const auto raster = rasters.of(layout, picture, cells.vertex, 0.0);
  EXPECT_EQ(rasters.of(layout, picture, cells.vertex, 0.0), raster);
  EXPECT_NE(rasters.of(layout, picture, cells.vertex, 1.0), raster);
  PictureLayout shifted = layout;
  shifted.origin.x() += 1.0;
  EXPECT_NE(rasters.of(shifted, picture, cells.vertex, 0.0), raster);
}

TEST_F(DrawnCells, cells_that_are_not_finite_are_left_out) {
  position[0][0] = std::nan("");
  picture.position = {position[0], position[1]};
  layout = layout_picture(picture);
  draw();
  EXPECT_GT(green(at(5, 5)), 0xE0U);
  EXPECT_LT(green(at(30, 5)), 0xFFU);
}

} // namespace
} // namespace cnem::report
