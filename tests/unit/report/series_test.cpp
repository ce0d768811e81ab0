// Halves drawn whole, what colours span, pictures on a dark page, films.
#include "core/error.hpp"
#include "input/case_reader.hpp"
#include "mechanics/field_catalogue.hpp"
#include "report/film.hpp"
#include "report/html.hpp"
#include "report/report.hpp"
#include "report/symmetry.hpp"
#include "tests/shared_cases.hpp"
#include "tests/unit/report/three_cells.hpp"

#include <gif_lib.h>
#include <gtest/gtest.h>
#include <png.h>
#include <webp/demux.h>

#include <array>
#include <cmath>
#include <numbers>

namespace cnem::report {
namespace {

Curve polygon(const std::vector<Vec2>& corners) {
  Curve curve;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    curve.pieces.emplace_back().from = corners[k];
    curve.pieces.back().to = corners[(k + 1) % corners.size()];
  }
  return curve;
}

TEST(ColourSpan, leaves_out_what_is_beyond_the_percentile) {
  std::vector<double> values(1000);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = static_cast<double>(k);
  values.back() = 1e6;
  values.push_back(std::nan(""));
  EXPECT_EQ(value_span(ColourMap::strain, values, 100.0), (ColourRange{0.0, 1e6}));
  EXPECT_EQ(value_span(ColourMap::strain, values, 99.0), (ColourRange{0.0, 989.0}));
  values[3] = -995.0;
  EXPECT_EQ(value_span(ColourMap::diverging, values, 99.0), (ColourRange{-990.0, 990.0}));
}

TEST(ColourSpan, of_a_share_at_rest_is_that_of_all) {
  EXPECT_EQ(value_span(ColourMap::strain, std::vector<double>{0, 0, 0, 0.3}, 60.0), (ColourRange{0.0, 0.3}));
}

TEST(Symmetry, cells_end_at_the_line_where_one_side_is_kept) {
  results::CellFields fields;
  fields.cells.vertex = {{-2, 0}, {1, 0}, {1, 1}, {-2, 1}};
  resize_all(fields.position, 4);
  keep_side(fields, {Vec2(0, 0), Vec2(-1, 0)});
  EXPECT_EQ(fields.cells.vertex, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(fields.position[0], (Field{0, 1, 1, 0}));
}

TEST(ColourSpan, of_a_field_at_rest_does_not_widen_that_of_the_series) {
  const std::vector<double> rest{296.0, 296.0}, warm{296.0, 320.0};
  const ColourRange span =
      joined(value_span(ColourMap::heat, rest, 100.0), value_span(ColourMap::heat, warm, 100.0));
  EXPECT_EQ(widened(ColourMap::heat, span), (ColourRange{296.0, 320.0}));
  const ColourRange alone = widened(ColourMap::heat, value_span(ColourMap::heat, rest, 100.0));
  EXPECT_LT(alone.low, alone.high);
  EXPECT_EQ(widened(ColourMap::diverging, {0.0, 0.0}), (ColourRange{-1.0, 1.0}));
}

TEST(Symmetry, lines_are_those_of_the_case) {
  const std::string rest = "[time]\nend = \"1 us\"\n";
  const auto lines = [&](const std::string& text) {
    return symmetry_lines(input::read_case_text(text + rest, "case"));
  };
  const auto block = lines(testing::steel_block); // slides on its base
  ASSERT_EQ(block.size(), 1U);
  EXPECT_EQ(block[0].normal, Vec2(0, -1));
  EXPECT_EQ(block[0].at.y(), 0.0);
  const auto round = lines(testing::steel_block + "[analysis]\nkinematics = \"axisymmetric\"\n");
  ASSERT_EQ(round.size(), 2U) << "the axis as well";
  EXPECT_EQ(round[0].normal, Vec2(-1, 0));
  const auto both = lines(testing::steel_block + "[boundary.lid]\npieces = [\"top\"]\nsymmetry = true\n");
  EXPECT_EQ(both.size(), 1U) << "of parallel lines the first";
}

TEST(Symmetry, images_meet_the_cells_and_turn_components_round) {
  results::CellFields fields;
  fields.cells = three_cells();
  for (const Vec2& x : fields.cells.vertex)
    for (std::size_t k = 0; k < 2; ++k) fields.position[k].push_back(x[as<int>(k)]);
  fields.values = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  const std::size_t vertices = fields.cells.vertex.size(), corners = fields.cells.index.size();
  const SymmetryLine left{Vec2(0, 7), Vec2(-1, 0)};
  const auto sign = [&](const char* name) { return image_sign(field_info<2>(name), left); };
  EXPECT_EQ(sign("velocity_x"), -1.0);
  EXPECT_EQ(sign("velocity_y"), 1.0);
  EXPECT_EQ(sign("stress_xy"), -1.0);
  EXPECT_EQ(sign("stress_xx"), 1.0);
  EXPECT_EQ(sign("principal_stress_2"), 1.0);
  EXPECT_EQ(sign("plastic_strain"), 1.0);
  add_image(fields, left, {sign("plastic_strain"), sign("velocity_x")});
  std::size_t on_line = 0;
  for (std::size_t v = 0; v < vertices; ++v) on_line += fields.cells.vertex[v].x() == 0.0 ? 1 : 0;
  ASSERT_GT(on_line, 0U);
  EXPECT_EQ(fields.cells.vertex.size(), 2 * vertices - on_line) << "those on the line are shared";
  EXPECT_EQ(fields.values[0], (Field{1, 2, 3, 1, 2, 3}));
  EXPECT_EQ(fields.values[1], (Field{4, 5, 6, -4, -5, -6}));
  ASSERT_EQ(fields.cells.index.size(), 2 * corners);
  double area = 0.0, of_image = 0.0; // signed: the image runs the same way round
  for (std::size_t c = 0; c < 6; ++c)
    for (auto b = fields.cells.begin[c], e = fields.cells.begin[c + 1], k = b; k < e; ++k)
      (c < 3 ? area : of_image) +=
          cross(fields.cells.vertex[index_of(fields.cells.index[index_of(k)])],
                fields.cells.vertex[index_of(fields.cells.index[index_of(k + 1 < e ? k + 1 : b)])]);
  EXPECT_NEAR(area, of_image, 1e-12 * area);
}

TEST(Symmetry, curves_keep_their_sense_in_the_image) {
  Curve curve = polygon({{0, 0}, {3, 0}, {3, 2}, {0, 2}});
  curve.pieces[1].centre = {3, 1};
  curve.pieces[1].radius = 1;
  const Curve image = curve.mirrored(Vec2(-1, 5), Vec2(1, 0));
  EXPECT_NEAR(curve.area(), 6.0 + 0.5 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(image.area(), curve.area(), 1e-12);
  double least = 0.0, inside = 0.0;
  const std::vector<Vec2> corners = image.polygon();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    least = std::min(least, corners[k].x());
    inside += 0.5 * cross(corners[k], corners[(k + 1) % corners.size()]);
  }
  EXPECT_NEAR(least, -6.0, 1e-3) << "-1 - (4 + 1)";
  EXPECT_NEAR(inside, image.area(), 1e-2);
}

/// Two cells wide, their image on the left.
class Half : public ::testing::Test {
protected:
  Half() {
    fields.cells = three_cells();
    for (const Vec2& x : fields.cells.vertex)
      for (std::size_t k = 0; k < 2; ++k) fields.position[k].push_back(x[as<int>(k)]);
    fields.values = {{0.2, 0.9, 0.5}};
  }
  PaletteImage drawn() {
    picture.cells = &fields.cells;
    picture.position = {fields.position[0], fields.position[1]};
    picture.value = fields.values[0];
    picture.range = ColourRange{0.0, 1.0};
    picture.edges = false;
    picture.width = width;
    layout = layout_picture(picture);
    return draw(picture);
  }
  std::uint32_t at(const PaletteImage& image, double x, double y) const {
    const Vec2 p = layout.pixel({x, y});
    return image.palette[image.index[static_cast<std::size_t>(p.y()) * static_cast<std::size_t>(image.width) +
                                     static_cast<std::size_t>(p.x())]];
  }
  int width = 600;
  results::CellFields fields;
  Picture picture;
  PictureLayout layout;
};

TEST_F(Half, is_drawn_whole_about_its_line) {
  const SymmetryLine left{Vec2(0, 0), Vec2(-1, 0)};
  add_image(fields, left, {1.0});
  picture.symmetry = {left};
  width = 1400;
  const PaletteImage image = drawn();
  for (const auto& [x, y] : {std::pair(10.0, 5.0), std::pair(30.0, 5.0)})
    EXPECT_EQ(at(image, -x, y), at(image, x, y)) << x;
  EXPECT_NE(at(image, 10, 5), at(image, 30, 5));
  std::size_t dark = 0, light = 0; // the line is dashed
  for (double y = 0.5; y < 29; y += 0.1) {
    const double pixel = 1.0 / layout.scale;
    const std::uint32_t colour = std::min(at(image, -0.5 * pixel, y), at(image, 0.5 * pixel, y));
    dark += colour < 0x404040U ? 1 : 0;
    light += colour > 0xC0C0C0U ? 1 : 0;
  }
  EXPECT_GT(dark, 50U);
  EXPECT_GT(light, 10U);
}

TEST_F(Half, tools_stay_on_their_side_of_the_line) {
  const Curve bar = polygon({{-30, 41}, {30, 41}, {30, 44}, {-30, 44}});
  picture.tools = {{&bar, {0, 0}, "", {{Vec2(0, 0), Vec2(-1, 0)}}}};
  picture.window = PictureWindow{{-40, 0}, {40, 45}};
  const PaletteImage image = drawn();
  EXPECT_NE(at(image, 10, 42.5), at(image, 36, 42.5));
  EXPECT_EQ(at(image, -10, 42.5), at(image, -36, 42.5)) << "cut off at the line";
}

TEST_F(Half, a_stated_percentile_has_a_line_of_its_own) {
  const int height = drawn().height;
  picture.percentile = 99.0;
  EXPECT_GT(drawn().height, height);
}

std::vector<png_byte> decoded(const std::string& png) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_memory(&image, png.data(), png.size())) << image.message;
  image.format = PNG_FORMAT_RGB;
  std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
  EXPECT_TRUE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr)) << image.message;
  return pixels;
}

TEST_F(Half, on_a_dark_page_greys_turn_round_and_cells_stay) {
  const PaletteImage image = drawn();
  const std::string png = palette_png(image);
  const auto patch = dark_patch(png);
  ASSERT_TRUE(patch);
  std::string dark = png;
  dark.replace(patch->offset, patch->bytes.size(), patch->bytes);
  const std::vector<png_byte> before = decoded(png), after = decoded(dark); // with its checksum in order
  const auto pixel = [&](const std::vector<png_byte>& pixels, double x, double y) {
    const Vec2 p = layout.pixel({x, y});
    const auto k = 3 * (static_cast<std::size_t>(p.y()) * static_cast<std::size_t>(image.width) +
                        static_cast<std::size_t>(p.x()));
    return std::array<int, 3>{pixels[k], pixels[k + 1], pixels[k + 2]};
  };
  for (const double x : {10.0, 30.0}) EXPECT_EQ(pixel(before, x, 5), pixel(after, x, 5));
  EXPECT_EQ(before[0], 255);
  EXPECT_EQ((std::array<int, 3>{after[0], after[1], after[2]}), (std::array<int, 3>{27, 32, 39}))
      << "the card";
  EXPECT_FALSE(dark_patch(dark)) << "it has no greys to turn";
  EXPECT_FALSE(dark_patch("no picture"));
  EXPECT_NE(picture_element(png, "a & b").find("alt=\"a &amp; b\" data-dark=\""), std::string::npos);
}

/// Two drawings that differ in a part, and one like the second.
class Film : public Half {
protected:
  Film() {
    frame.push_back(drawn());
    fields.values[0][1] = 0.1;
    frame.push_back(drawn());
    frame.push_back(frame.back());
  }
  std::vector<PaletteImage> frame;
};

TEST_F(Film, gif_gives_every_frame_back_without_loss) {
  const auto encoder = gif_encoder();
  for (const PaletteImage& image : frame) encoder->add(image, 10);
  const std::string film = encoder->finish();
  struct Reader {
    const std::string& bytes;
    std::size_t at = 0;
  } reader{film};
  int error = 0;
  GifFileType* gif = DGifOpen(
      &reader,
      [](GifFileType* file, GifByteType* to, int count) {
        auto& from = *static_cast<Reader*>(file->UserData);
        const std::size_t length = std::min(static_cast<std::size_t>(count), from.bytes.size() - from.at);
        std::copy_n(from.bytes.data() + from.at, length, to);
        from.at += length;
        return static_cast<int>(length);
      },
      &error);
  ASSERT_NE(gif, nullptr) << error;
  ASSERT_EQ(DGifSlurp(gif), GIF_OK);
  ASSERT_EQ(gif->ImageCount, 3);
  std::vector<std::uint8_t> canvas(frame[0].index.size());
  for (int f = 0; f < 3; ++f) {
    const SavedImage& part = gif->SavedImages[f];
    for (int y = 0; y < part.ImageDesc.Height; ++y)
      for (int x = 0; x < part.ImageDesc.Width; ++x)
        canvas[static_cast<std::size_t>((part.ImageDesc.Top + y) * gif->SWidth + part.ImageDesc.Left + x)] =
            part.RasterBits[y * part.ImageDesc.Width + x];
    EXPECT_EQ(canvas, frame[static_cast<std::size_t>(f)].index) << f;
  }
  EXPECT_LT(gif->SavedImages[1].ImageDesc.Width, gif->SWidth) << "no more than what differs";
  EXPECT_EQ(gif->SColorMap->Colors[200].Green, frame[0].palette[200] >> 8 & 0xFF);
  DGifCloseFile(gif, &error);
}

TEST_F(Film, webp_gives_every_frame_back_without_loss) {
  const auto encoder = webp_encoder();
  for (const PaletteImage& image : frame) encoder->add(image, 10);
  const std::string film = encoder->finish();
  const WebPData data{reinterpret_cast<const std::uint8_t*>(film.data()), film.size()};
  WebPAnimDecoder* decoder = WebPAnimDecoderNew(&data, nullptr);
  ASSERT_NE(decoder, nullptr);
  std::uint8_t* pixels = nullptr;
  int time = 0;
  for (std::size_t f = 0; f < 2; ++f) { // equal frames become one that lasts
    ASSERT_TRUE(WebPAnimDecoderGetNext(decoder, &pixels, &time));
    for (std::size_t k = 0; k < frame[f].index.size(); ++k) {
      const std::uint32_t colour = frame[f].palette[frame[f].index[k]];
      ASSERT_EQ(pixels[4 * k] << 16 | pixels[4 * k + 1] << 8 | pixels[4 * k + 2], static_cast<int>(colour));
    }
  }
  EXPECT_EQ(time, 300);
  WebPAnimDecoderDelete(decoder);
}

TEST_F(Half, a_series_of_three_is_played_and_one_of_two_is_not) {
  const std::string png = palette_png(drawn());
  const auto page = [&](int times) {
    ReportData data;
    for (int k = 0; k < times; ++k)
      data.pictures.push_back({png, "pressure", 1e-6 * k, "band", k == 1 ? "the second" : ""});
    return render_report(data);
  };
  EXPECT_NE(page(3).find("<figure class=\"player\""), std::string::npos);
  EXPECT_NE(page(3).find("max=\"2\""), std::string::npos);
  EXPECT_NE(page(3).find("<summary>All 3 pictures</summary>"), std::string::npos);
  EXPECT_EQ(page(2).find("<figure class=\"player\""), std::string::npos);
  EXPECT_NE(page(2).find("<figcaption>the second</figcaption>"), std::string::npos);
}

} // namespace
} // namespace cnem::report
