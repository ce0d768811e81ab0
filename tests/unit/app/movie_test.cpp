// Pictures of several times and films, as a user asks for them.
#include "app/command_line.hpp"

#include "input/case_reader.hpp"
#include "report/picture_album.hpp"
#include "report/picture_recorder.hpp"
#include "results/output_folder.hpp"
#include "results/recorder.hpp"
#include "tests/shared_cases.hpp"
#include "tests/solver_of.hpp"
#include "tests/temporary_folder.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>

namespace cnem::app {
namespace {

const std::string moving = testing::punched_block + R"toml(
[time]
end = "2 us"
[output]
fields_every = "0.5 us"
pictures_every = "1 us"
picture_fields = ["plastic_strain"]
[output.windows.edge]
box = ["0 1 mm", "2 2 mm"]
)toml";

class Movie : public ::testing::Test {
protected:
  int call(std::vector<std::string> words) {
    words.insert(words.begin(), "cnem");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    ::testing::internal::CaptureStderr();
    ::testing::internal::CaptureStdout();
    const int code = command_line(static_cast<int>(argv.size()), argv.data());
    printed = ::testing::internal::GetCapturedStdout();
    message = ::testing::internal::GetCapturedStderr();
    return code;
  }
  void run(const std::string& set = "output.drawing.common=true") {
    std::ofstream(folder / "moving.toml") << moving;
    ASSERT_EQ(
        call({"run", (folder / "moving.toml").string(), "--output", done(), "--threads", "1", "--set", set}),
        0)
        << message;
  }
  std::string done() const { return (folder / "done").string(); }
  std::string film(const std::string& name) const { return (folder / name).string(); }

  const testing::TemporaryFolder temporary{"movie"};
  const std::filesystem::path& folder = temporary.path();
  std::string message, printed;
};

std::set<std::pair<double, double>> ranges_of(const report::PictureAlbum& album) {
  std::set<std::pair<double, double>> ranges;
  for (const report::AlbumEntry& entry : album.entries())
    ranges.emplace(entry.drawn.range.low, entry.drawn.range.high);
  return ranges;
}

/// Width and height of a PNG file.
std::string size_of(const report::PictureAlbum& album, std::size_t entry) {
  return results::read_file(album.path(album.entries()[entry])).substr(16, 8);
}

TEST_F(Movie, pictures_of_all_times_have_one_scale) {
  run();
  const report::PictureAlbum album(done());
  ASSERT_EQ(album.entries().size(), 6U) << "0, 1 and 2 us, the whole and a window";
  EXPECT_EQ(ranges_of(album).size(), 1U);
  EXPECT_GT(album.entries()[0].drawn.range.high, 0.0) << "although nothing has flowed";
  EXPECT_EQ(album.entries()[0].drawn.range.high, album.entries()[5].own.range.high);
  EXPECT_EQ(album.entries()[0].drawn.view, album.entries()[4].drawn.view);
  for (const std::size_t k : {2U, 4U}) EXPECT_EQ(size_of(album, k), size_of(album, 0)) << k;
}

TEST_F(Movie, pictures_have_their_own_scales_where_the_case_says_so) {
  run("output.drawing.common=false");
  const report::PictureAlbum album(done());
  EXPECT_EQ(ranges_of(album).size(), 3U);
  for (const report::AlbumEntry& entry : album.entries()) EXPECT_EQ(entry.drawn.view, entry.own.view);
}

TEST_F(Movie, pictures_have_the_range_and_the_view_of_the_case) {
  std::ofstream(folder / "moving.toml")
      << moving
      << "[output.drawing]\nview = [\"0 0 mm\", \"3 2 mm\"]\n[output.ranges]\nplastic_strain = \"0 0.5\"\n";
  ASSERT_EQ(call({"run", (folder / "moving.toml").string(), "--output", done(), "--threads", "1"}), 0)
      << message;
  const report::PictureAlbum album(done());
  EXPECT_EQ(ranges_of(album), (std::set{std::pair(0.0, 0.5)}));
  EXPECT_EQ(album.entries()[0].drawn.view, (report::PictureWindow{{0, 0}, {3e-3, 2e-3}}));
}

TEST_F(Movie, pictures_from_files_are_those_of_the_run_far_from_the_origin_too) {
  const input::Case input = input::read_case_text(testing::steel_304l + R"toml(
[time]
end = "2 us"
[domain]
material = "steel"
outer.rectangle = { from = "1000.0001 3 mm", to = "1004.0001 5 mm" }
[cloud]
spacing = "0.3 mm"
[boundary.left]
pieces = ["left"]
symmetry = true
[tools.punch]
rectangle = { from = "999 5 mm", to = "1001.1 7 mm" }
velocity = "0 -60 m/s"
[output.drawing]
mirror = true
)toml",
                                                  "far");
  ASSERT_NE(input.origin, Vec3(0, 0, 0));
  ExplicitSolver<2> solver = testing::solver_of(input);
  for (int k = 0; k < 30; ++k) solver.advance(0.5 * solver.stable_step().dt);
  const results::Snapshot<2> shot = results::snapshot(solver);
  results::FileQueue files;
  results::FieldRecorder(folder, input).record(files, shot);
  files.wait();
  const std::vector<std::string> names{"velocity_x", "stress_xy", "plastic_strain"};
  const auto of_run = report::picture_source(input, shot, shot.state.node.position, names);
  const auto of_files =
      report::picture_source(input, folder, results::read_field_series(folder).front(), names);
  EXPECT_EQ(of_files->time, of_run->time);
  EXPECT_EQ(of_files->fields.position, of_run->fields.position);
  EXPECT_EQ(of_files->fields.cells.index, of_run->fields.cells.index);
  EXPECT_EQ(of_files->fields.values, of_run->fields.values);
  ASSERT_EQ(of_files->tools.size(), 2U) << "the punch and its image";
  for (std::size_t t = 0; t < 2; ++t) {
    EXPECT_EQ(of_files->tools[t].displacement, of_run->tools[t].displacement);
    EXPECT_LT(of_files->tools[t].displacement.y(), 0.0);
  }
  for (std::size_t f = 0; f < names.size(); ++f)
    EXPECT_EQ(report::draw_png(report::picture_of(input, *of_files, f)),
              report::draw_png(report::picture_of(input, *of_run, f)));
}

TEST_F(Movie, films_are_made_of_the_fields) {
  run();
  ASSERT_EQ(call({"movie", done(), "--width", "400"}), 0) << message;
  EXPECT_EQ(printed, done() + "/plastic_strain.gif\n");
  const std::string gif = results::read_file(done() + "/plastic_strain.gif");
  EXPECT_EQ(gif.substr(0, 6), "GIF89a");
  EXPECT_EQ(static_cast<unsigned char>(gif[6]) + 256 * static_cast<unsigned char>(gif[7]), 400);
  const std::string again = done() + "/plastic_strain_edge.gif";
  ASSERT_EQ(call({"movie", done(), "--width", "400", "--window", "edge", "--mirror"}), 0) << message;
  EXPECT_NE(results::read_file(again), gif);
  ASSERT_EQ(call({"movie", done(), "--field", "triaxiality", "--from", "0.4 us", "--to", "1600 ns", "--fps",
                  "5", "--output", film("film.webp")}),
            0)
      << message;
  EXPECT_EQ(results::read_file(film("film.webp")).substr(8, 4), "WEBP");
}

TEST_F(Movie, mp4_is_made_by_ffmpeg_where_it_is_installed) {
  run();
  const std::string path = std::getenv("PATH");
  const std::string none = (folder / "none").string(), tools = (folder / "tools").string();
  std::filesystem::create_directories(none);
  std::filesystem::create_directories(tools);
  const std::vector<std::string> words{"movie", done(), "--width", "400", "--output", film("film.mp4")};
  setenv("PATH", none.c_str(), 1);
  EXPECT_EQ(call(words), 2);
  EXPECT_NE(message.find("MP4 needs ffmpeg, which is not installed"), std::string::npos) << message;
  // One that copies its input, the word after -i, to its output, the last word.
  std::ofstream(tools + "/ffmpeg")
      << "#!/bin/sh\nwhile [ $# -gt 1 ]; do [ \"$1\" = -i ] && input=$2; shift; done\n"
         "cat \"$input\" > \"$1\"\n";
  std::filesystem::permissions(tools + "/ffmpeg", std::filesystem::perms::owner_all);
  setenv("PATH", (tools + ":" + path).c_str(), 1);
  EXPECT_EQ(call(words), 0) << message;
  EXPECT_EQ(results::read_file(film("film.mp4")).substr(0, 6), "GIF89a");
  std::ofstream(tools + "/ffmpeg") << "#!/bin/sh\nexit 1\n";
  EXPECT_EQ(call(words), 4);
  EXPECT_NE(message.find("ffmpeg could not make"), std::string::npos) << message;
  setenv("PATH", path.c_str(), 1);
  for (const char* left : {"film.mp4.gif", "film.mp4.part"})
    EXPECT_FALSE(std::filesystem::exists(film(left)));
}

TEST_F(Movie, what_a_run_has_not_is_told) {
  run();
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
      {{done(), "--field", "triaxialty"}, "did you mean 'triaxiality'?"},
      {{done(), "--window", "corner"}, "--window: found 'corner', expected one of edge"},
      {{done(), "--output", film("film.avi")}, "expected a name that ends in .gif, .webp or .mp4"},
      {{done(), "--from", "3 us"}, "has 0 of the times asked for"},
      {{done(), "--to", "3 mm"}, "--to: found '3 mm', which is a length"},
      {{done(), "--fps", "500"}, "--fps"},
      {{done(), "--fps", "nan"}, "--fps: found nan"},
      {{done(), "--from", "2 us", "--to", "1 us"}, "--from 2e-06 s is not before --to 1e-06 s"},
      {{done(), "--field", "damage"}, "--field: the run has no 'damage'"},
      {{folder.string()}, "holds no run with fields"}};
  for (auto [words, expected] : wrong) {
    words.insert(words.begin(), "movie");
    EXPECT_EQ(call(words), 2) << expected;
    EXPECT_NE(message.find(expected), std::string::npos) << message;
  }
}

} // namespace
} // namespace cnem::app
