// Files of triangles: read once, known by their content.
#include "core/error.hpp"
#include "input/case_reader.hpp"
#include "input/space_domain.hpp"
#include "input/tool_surface.hpp"
#include "tests/stl_text.hpp"
#include "tests/temporary_folder.hpp"

#include <fstream>
#include <gtest/gtest.h>

namespace cnem::input {
namespace {

constexpr const char* head = R"([analysis]
kinematics = "three-dimensional"
[time]
end = "10 us"
[cloud]
spacing = "1 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
[method]
lagrangian = "total"
)";
constexpr const char* tool = R"([domain]
material = "steel"
block = { from = "0 0 0 mm", to = "4 2 2 mm" }
[tools.punch]
shape = "stl"
stl = { file = "box.stl", unit = "1 um" }
)";
constexpr const char* workpiece = R"([domain]
material = "steel"
stl = { file = "box.stl" }
)";

class TriangleFile : public ::testing::Test {
protected:
  void SetUp() override { write(2.0); }
  void write(double height) const { std::ofstream(file) << testing::stl_box({0, 0, 0}, {4, 2, height}); }
  Case read(const std::string& body) const {
    return read_case_text(head + body, (temporary.path() / "case.toml").string());
  }
  std::string refusal_of(const std::string& text) const {
    try {
      read_case_text(text, "elsewhere/case.resolved.toml");
    } catch (const InputError& error) { return error.what(); }
    return "";
  }

  const cnem::testing::TemporaryFolder temporary{"triangle_file"};
  const std::filesystem::path file = temporary.path() / "box.stl";
};

// Contact, pictures and evaluation have the solid that the checksum is of, whatever becomes of the file.
TEST_F(TriangleFile, of_a_tool_is_read_once) {
  const Case c = read(tool);
  std::filesystem::remove(file);
  const ToolSolid& solid = *c.tools.at(0).solid;
  EXPECT_EQ(solid.file, file.string());
  EXPECT_EQ(solid.soup.triangles.size(), 12U);
  EXPECT_NEAR(tool_surface(solid, {{0, 0, 0}, {1, 1, 1}}).volume(), 16e-18, 1e-24);
}

// A seam that closes a round surface by sines and cosines meets its other side to rounding only.
TEST_F(TriangleFile, of_a_tool_is_welded_as_that_of_a_workpiece) {
  std::string text = cnem::testing::stl_box({0, 0, 0}, {4, 2, 2});
  const std::string corner = "vertex 4 2 2\n";
  text.replace(text.find(corner), corner.size(), "vertex 4 1.9999999999999998 2\n");
  std::ofstream(file) << text;
  EXPECT_EQ(read(workpiece).domain.faceted_pieces.size(), 6U);
  const TriangleSurface surface = tool_surface(*read(tool).tools.at(0).solid, {{0, 0, 0}, {1, 1, 1}});
  EXPECT_EQ(surface.points.size(), 8U);
  EXPECT_NO_THROW(check_closed(surface));
}

TEST_F(TriangleFile, is_known_by_its_content_in_resolved_cases) {
  for (const auto& [body, key] : {std::pair{tool, "tools.punch.stl"}, {workpiece, "domain.stl"}}) {
    write(2.0);
    const std::string resolved = read(body).resolved;
    EXPECT_NE(resolved.find("content = \""), std::string::npos) << resolved;
    const auto below_head = [](const std::string& text) { return text.substr(text.find('\n')); };
    EXPECT_EQ(below_head(read_case_text(resolved, "elsewhere/case.resolved.toml").resolved),
              below_head(resolved));
    write(2.5);
    const std::string refusal = refusal_of(resolved);
    EXPECT_NE(refusal.find(std::string("key '") + key + ".file': found " + file.string() + " with checksum"),
              std::string::npos)
        << refusal;
    EXPECT_NE(refusal.find(std::string("(without '") + key + ".content' the file"), std::string::npos)
        << refusal;
  }
}

TEST_F(TriangleFile, that_is_none_is_told_with_its_name_and_line) {
  std::ofstream(file) << "solid a\nfacet norm";
  for (const char* body : {tool, workpiece}) {
    try {
      read(body);
      ADD_FAILURE();
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("box.stl: line 2 of the STL file: found"), std::string::npos)
          << error.what();
    }
  }
}

// Places far from the surface and second names of a piece would go unnoticed: a piece lost its name.
TEST_F(TriangleFile, has_names_at_places_on_its_surface_one_for_a_piece) {
  const auto refusal = [&](const std::string& names) -> std::string {
    try {
      read("[domain]\nmaterial = \"steel\"\nstl.file = \"box.stl\"\nstl.names = [" + names + "]\n");
    } catch (const InputError& error) { return error.what(); }
    return "";
  };
  EXPECT_EQ(refusal(R"({ at = "0 1 1 mm", name = "a" }, { at = "4 1 1 mm", name = "a" },)"
                    R"({ at = "0 1 0.5 mm", name = "a" })"),
            "");
  const std::string far = refusal(R"({ at = "9 1 1 mm", name = "left" })");
  EXPECT_NE(
      far.find("case.toml:15:16: key 'domain.stl.names[0].at': found (0.009, 0.001, 0.001) m, expected a "
               "place on the surface: its nearest point, (0.004, 0.001, 0.001) m, is 0.005 m away"),
      std::string::npos)
      << far;
  const std::string twice = refusal(R"({ at = "0 1 1 mm", name = "a" }, { at = "0 1 0.5 mm", name = "b" })");
  EXPECT_NE(twice.find("key 'domain.stl.names[1].name': found \"b\" for the piece that domain.stl.names[0] "
                       "calls \"a\", expected one name for a piece"),
            std::string::npos)
      << twice;
}

} // namespace
} // namespace cnem::input
