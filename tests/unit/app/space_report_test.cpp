// What a run in space leaves to be read: a cut round the punch, pictures with tools on one scale, cells in
// files.
#include "core/index.hpp"
#include "evaluate/blanking_result.hpp"
#include "report/picture_album.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "results/status.hpp"
#include "results/vtk_reader.hpp"
#include "tests/unit/app/command_line_fixture.hpp"

#include <cmath>
#include <filesystem>
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
  for (const char* part : {"Face of the slug at 15°", "Face of the skeleton at 15°", "N/mm of cut length"})
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
  const Path folder = results();
  ASSERT_NO_FATAL_FAILURE(expect_cut(folder));
  ASSERT_NO_FATAL_FAILURE(expect_pictures(folder));
  for (const cnem::results::FieldFiles& frame : cnem::results::read_field_series(folder)) {
    ASSERT_EQ(frame.tools.size(), 2U);
    EXPECT_EQ(frame.tools[0].tool, "surface");
    EXPECT_EQ(frame.tools[1].tool, "polyhedra");
    for (const cnem::results::ToolFile& part : frame.tools)
      EXPECT_TRUE(std::filesystem::exists(folder / part.file));
  }
}

} // namespace
} // namespace cnem
