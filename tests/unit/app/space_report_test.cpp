// What a run in space leaves to be read: a cut round the punch, pictures with tools on one scale, cells in
// files.
#include "core/index.hpp"
#include "evaluate/blanking_result.hpp"
#include "report/picture_album.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "results/status.hpp"
#include "results/vtk_reader.hpp"
#include "tests/stl_text.hpp"
#include "tests/unit/app/command_line_fixture.hpp"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem {
namespace {

constexpr const char* round_blank = R"toml(
title = "a quarter of a round blank"
[analysis]
kinematics = "three-dimensional"
thermal = false
[time]
end = "4 us"
quasi_static = false
[domain]
material = "steel"
block = { shape = "cylinder", part = "quarter", radius = "4 mm", length = "1 mm" }
[cloud]
spacing = "0.5 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
plastic = { law = "perfect", yield = "400 MPa" }
[boundary.symmetry]
pieces = ["x-", "y-"]
symmetry = true
[tools.punch]
shape = "revolved"
start = "0 1 mm"
path = [{ to = "2 1 mm" }, { to = "2 3 mm" }, { to = "0 3 mm" }]
velocity = "0 0 -40 m/s"
friction = { law = "none" }
[tools.die]
shape = "revolved"
start = "6 0 mm"
path = [{ to = "2.2 0 mm" }, { to = "2.2 -2 mm" }, { to = "6 -2 mm" }]
friction = { law = "none" }
[report.blanking]
sections = 3
[output]
history_every = "0 s"
fields_every = "0 s"
pictures = "2 4 us"
picture_fields = ["plastic_strain", "pressure"]
surface = true
polyhedra = true
sections.symmetry = { at = "0 0.01 0 mm", normal = "0 -1 0" }
)toml";

using Path = std::filesystem::path;
using SpaceReport = app::CommandLine;

double metric(const results::RunStatus& status, const std::string& name) {
  for (const auto& [known, value] : status.metrics)
    if (known == name) return value;
  ADD_FAILURE() << "no " << name;
  return NAN;
}

void expect_cut(const Path& folder) {
  const results::RunStatus status = results::read_status(folder);
  EXPECT_NEAR(metric(status, "blanking.stroke"), 0.16e-3, 1e-8);
  EXPECT_GT(metric(status, "blanking.largest_force.punch"), 0.0);
  const results::HistoryTable history = results::read_history(folder / results::files::history);
  const double work = history.column[index_of(history.find("energy.tool_work"))].back();
  EXPECT_NEAR(metric(status, "blanking.work.punch"), work, 1e-9 * work);
  EXPECT_EQ(metric(status, "blanking.slug.parted"), 0.0);
  const auto result = evaluate::read_blanking(folder);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->direction_z, -1.0);
  EXPECT_NEAR(result->cut_length, 0.5 * std::numbers::pi * 2e-3, 1e-6);
  ASSERT_EQ(result->faces.size(), 6U); // slug and skeleton in three sections
  EXPECT_NEAR(result->faces[2].angle, 0.25 * std::numbers::pi, 1e-9);
  for (const evaluate::ShearedFace& face : result->faces) {
    EXPECT_NEAR(face.thickness, 1e-3, 1e-9);
    EXPECT_FALSE(face.profile.empty()) << face.note;
  }
  const std::string page = results::read_file(folder / results::files::report);
  for (const char* part :
       {"Face of the slug at 15.0°", "Face of the skeleton at 15.0°", "N/mm of cut length"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
}

void expect_pictures(const Path& folder) {
  const report::PictureAlbum album(folder);
  ASSERT_EQ(album.entries().size(), 8U); // two times, two fields, the surface and a section
  for (const report::AlbumEntry& one : album.entries()) {
    ASSERT_EQ(one.tools.size(), 2U);
    EXPECT_NEAR(one.tools[0].z(), -40.0 * one.time, 1e-9);
    EXPECT_EQ(one.sides.size(), 2U);
    for (const report::AlbumEntry& other : album.entries()) {
      if (one.series == other.series) {
        EXPECT_EQ(one.drawn.range.low, other.drawn.range.low);
        EXPECT_EQ(one.drawn.range.high, other.drawn.range.high);
      }
      EXPECT_TRUE(one.caption != other.caption || one.drawn.view == other.drawn.view) << one.caption;
    }
  }
  EXPECT_LT(album.entries().front().own.range.high, album.entries().front().drawn.range.high)
      << "less had flowed then";
}

// A cut that is followed round the punch, pictures with tools on one scale, surface and cells beside the
// nodes.
TEST_F(SpaceReport, of_a_quarter_of_a_round_blank) {
  std::ofstream(temporary.path() / "case.toml") << round_blank;
  ASSERT_EQ(call({"run", (temporary.path() / "case.toml").string(), "--output", results(), "--threads", "1"}),
            0)
      << message;
  const Path written = results();
  ASSERT_NO_FATAL_FAILURE(expect_cut(written));
  ASSERT_NO_FATAL_FAILURE(expect_pictures(written));
  for (const cnem::results::FieldFiles& frame : cnem::results::read_field_series(written)) {
    ASSERT_EQ(frame.parts.size(), 2U);
    EXPECT_EQ(frame.parts[0].name, "surface");
    EXPECT_EQ(frame.parts[1].name, "polyhedra");
    for (const cnem::results::PartFile& part : frame.parts)
      EXPECT_TRUE(std::filesystem::exists(written / part.file));
  }
}

// Sections go round the place that the case says, and the stroke is that of the punch against the die.
TEST_F(SpaceReport, sections_go_through_their_centre) {
  std::ofstream(temporary.path() / "case.toml") << round_blank;
  ASSERT_EQ(call({"run", (temporary.path() / "case.toml").string(), "--output", results(), "--threads", "1",
                  "--set", "time.end=1 us", "--set", "output.pictures=[]", "--set",
                  "tools.die.velocity=0 0 10 m/s", "--set", "report.blanking.centre=0.5 0.5 0 mm"}),
            0)
      << message;
  EXPECT_NEAR(metric(results::read_status(results()), "blanking.stroke"), 50e-6, 1e-9);
  const auto result = evaluate::read_blanking(results());
  ASSERT_TRUE(result);
  // From there the quarter of the punch is seen between -18.4 and 108.4 degrees.
  EXPECT_NEAR(result->cut_length, 0.5 * std::numbers::pi * 2e-3, 0.1e-3);
  ASSERT_EQ(result->faces.size(), 6U);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(result->faces[2 * k].angle, (2.7 + 42.3 * static_cast<double>(k)) / 180.0 * std::numbers::pi,
                0.03);
}

constexpr const char* first_steps = R"toml(
[analysis]
kinematics = "three-dimensional"
thermal = false
[time]
end = "0.04 us"
step.fixed = "0.02 us"
[domain]
material = "steel"
block = { from = "0 0 0 mm", to = "4 4 2 mm" }
[cloud]
spacing = "0.5 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
[boundary.walls]
pieces = ["x-", "x+", "y-", "y+", "z-"]
velocity = "0 0 0 m/s"
[tools.punch]
shape = "box"
box = { from = "1.4 1.4 2 mm", to = "2.6 2.6 3 mm" }
velocity = "0 0 -100 m/s"
[tools.rod] # in front of the sheet
shape = "box"
box = { from = "1 0.4 2.1 mm", to = "2 0.8 2.4 mm" }
velocity = "2e4 0 0 m/s"
[output]
fields_every = "0 s"
pictures = "0.02 0.04 us"
picture_fields = ["displacement_z"]
sections.middle = { at = "0 0 1.1 mm", normal = "0 0 1" }
)toml";

// Drawn again from its files a picture has the bits of one that had that range from the start; the outside
// is held, so that all times show the same part of space.
TEST_F(SpaceReport, pictures_drawn_again_are_those_of_the_run) {
  const std::string path = (temporary.path() / "case.toml").string();
  std::ofstream(path) << first_steps;
  const auto drawn = [&](const std::string& name, const std::string& change) {
    const Path results = temporary.path() / name;
    EXPECT_EQ(call({"run", path, "--output", results.string(), "--threads", "1", "--set", change}), 0)
        << message;
    return report::PictureAlbum(results);
  };
  const auto again = drawn("again", "output.drawing.common=true"),
             own = drawn("own", "output.drawing.common=false");
  ASSERT_EQ(again.entries().size(), 4U); // two times, the surface and a section
  ASSERT_EQ(own.entries().size(), 4U);
  const auto& range = again.entries().front().drawn.range;
  const auto given =
      drawn("given", fmt::format("output.ranges.displacement_z={:.17g} {:.17g} m", range.low, range.high));
  ASSERT_EQ(given.entries().size(), 4U);
  const auto bytes = [](const report::PictureAlbum& album, std::size_t k) {
    return results::read_file(album.path(album.entries()[k]));
  };
  for (std::size_t k = 0; k < 4; ++k) {
    const report::AlbumEntry &one = again.entries()[k], &alone = own.entries()[k];
    EXPECT_TRUE(given.entries()[k].own == given.entries()[k].drawn)
        << "nothing to draw again of " << one.file;
    EXPECT_EQ(bytes(again, k), bytes(given, k)) << one.file;
    EXPECT_TRUE(alone.own.view == alone.drawn.view);
    const bool last = one.time > 0.03e-6; // with the largest displacement
    if (one.caption.empty()) { EXPECT_EQ(bytes(own, k) == bytes(again, k), last) << one.file; }
  }
}

constexpr const char* stl_punch = R"toml(
[analysis]
kinematics = "three-dimensional"
thermal = false
[time]
end = "1 us"
max_steps = 2
[domain]
material = "steel"
block = { from = "0 0 0 mm", to = "4 2 2 mm" }
[cloud]
spacing = "1 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
[tools.punch]
shape = "stl"
stl.file = "punch.stl"
velocity = "0 0 -10 m/s"
[output]
pictures = []
)toml";

TEST_F(SpaceReport, a_restart_with_another_stl_file_is_refused) {
  std::ofstream(temporary.path() / "case.toml") << stl_punch;
  const Path file = temporary.path() / "punch.stl";
  std::ofstream(file) << testing::stl_box({1, 0, 2}, {3, 2, 4});
  ASSERT_EQ(call({"run", (temporary.path() / "case.toml").string(), "--output", results()}), 0) << message;
  std::filesystem::remove(Path(results()) / results::files::status); // as after a kill
  EXPECT_EQ(call({"restart", results()}), 0) << message;
  std::filesystem::remove(Path(results()) / results::files::status);
  std::ofstream(file) << testing::stl_box({1, 0, 2}, {3, 2, 5});
  EXPECT_EQ(call({"restart", results()}), 2) << message;
  EXPECT_NE(message.find("it has changed since this case was resolved"), std::string::npos) << message;
}

} // namespace
} // namespace cnem
