// Drawings that no one means: numbers that are none, ranges without end, arcs of rounding noise.
#include "tests/unit/input/drawing_text.hpp"

namespace cnem::input {
namespace {

using RefusedDrawings = Drawings;

const std::string of_gmsh = "drawing = { file = \"part.geo\", unit = \"mm\" }";

TEST_F(RefusedDrawings, of_gmsh_with_ranges_without_end) {
  for (const std::string range : {"1e17:100000000000001000", "1:1e17", "1:1/0"})
    expect_parts(refused("lc = 1;\nCurve Loop(1) = {" + range + "};\n", of_gmsh, "part.geo"),
                 {"part.geo:2: "});
  expect_parts(refused("Curve Loop(1) = {1:600001};\nCurve Loop(2) = {1:600001};\n", of_gmsh, "part.geo"),
               {"part.geo:2: found more than a million numbers in ranges"});
}

TEST_F(RefusedDrawings, of_gmsh_with_what_is_no_number) {
  const std::string points = "Point(1) = {0, 0, 0};\nPoint(2) = {1, 0, 0};\n";
  expect_parts(refused(points + "Line(1) = {0/0, 2};\n", of_gmsh, "part.geo"),
               {"part.geo:3: found a number that comes to ", "nan, expected a finite one"});
  expect_parts(refused("\nPoint(1) = {Sqrt(-1), 0, 0};\n", of_gmsh, "part.geo"), {"part.geo:2: "});
  expect_parts(refused("a = 1/0;\n", of_gmsh, "part.geo"), {"part.geo:1: found a number that comes to inf"});
  expect_parts(refused(points + "Line(1) = {1.5, 2};\n", of_gmsh, "part.geo"),
               {"part.geo:3: found no point 1.5"});
  expect_parts(refused(points + "Point(3) = {1e200, 0, 0};\nLine(1) = {1, 3};\n", of_gmsh, "part.geo"),
               {"part.geo:4: found a curve from (0, 0) to (1e+200, 0), expected coordinates"});
}

TEST_F(RefusedDrawings, of_gmsh_with_a_circle_beside_its_centre) {
  const std::string arc = "Point(1) = {5, 0, 0};\nPoint(2) = {0, 0, 0};\nPoint(3) = {0, 5.2, 0};\n"
                          "Circle(1) = {1, 2, 3};\nLine(2) = {3, 2};\nLine(3) = {2, 1};\n";
  expect_parts(refused(arc, of_gmsh, "part.geo"),
               {"part.geo:4: found a circle whose start is 5 from its centre and whose end 5.2"});
  EXPECT_EQ(refused(replaced(arc, "5.2", "5.0001"), of_gmsh, "part.geo"), "accepted") << "a few digits";
}

TEST_F(RefusedDrawings, bulges_of_rounding_are_straight) {
  const Case c = read(dxf(polyline("0", {{0, 0, 1e-16}, {10, 0, -2e-10}, {10, 5, 0}, {0, 5, 0}})), whole);
  for (const CurvePiece& piece : c.domain.outer.pieces) EXPECT_FALSE(piece.is_arc());
  expect_parts(refused(dxf(polyline("0", {{0, 0, 0}, {10, 0, 1e200}, {10, 5, 0}, {0, 5, 0}}))),
               {"part.dxf:48: found a bulge of 1e+200 at a corner"});
}

TEST_F(RefusedDrawings, of_a_single_point) {
  expect_parts(refused(dxf(line("low", {3, 0}, {3, 0}))),
               {"part.dxf:34: found curves without length, all at (3, 0) mm"});
}

TEST_F(RefusedDrawings, with_fillets_where_no_corner_is) {
  const auto asked = [](const std::string& fillets) {
    return "drawing = { file = \"part.dxf\", fillets = [" + fillets + "] }";
  };
  const std::string bored = dxf(square + circle("bore", {5, 2.5}, 1));
  expect_parts(refused(bored, asked("{ at = \"6 2.5 mm\", radius = \"1 mm\" }")),
               {"part.dxf: found a whole circle at (6, 2.5) mm, where a fillet is asked for"});
  expect_parts(
      refused(bored,
              asked("{ at = \"10 5 mm\", radius = \"1 mm\" }, { at = \"9.9 5 mm\", radius = \"2 mm\" }")),
      {"part.dxf: found two fillets of the corner at (10, 5) mm, expected one"});
}

TEST_F(RefusedDrawings, names_of_many_holes_are_no_longer_than_names_may_be) {
  const std::string layer(120, 'b');
  const Case c = read(dxf(square + circle(layer, {2, 2}, 1) + circle(layer, {6, 2}, 1)), whole);
  ASSERT_EQ(c.domain.holes.size(), 2U);
  EXPECT_EQ(c.domain.holes[1].name, std::string(98, 'b') + "_2");
}

TEST_F(RefusedDrawings, layers_that_are_never_plotted_are_left_out) {
  const std::string hidden =
      replaced(dxf(square + circle("frozen", {50, 50}, 1)), "  70\n1\n", "  70\n0\n  290\n0\n");
  EXPECT_EQ(refused(hidden), "accepted");
}

TEST_F(RefusedDrawings, lines_of_a_mesh_are_counted_over_what_is_skipped) {
  const std::string mesh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\nnone\n$EndComments\n$Nodes\nx\n";
  expect_parts(refused(mesh, "drawing = { file = \"part.msh\", unit = \"mm\" }", "part.msh"),
               {"part.msh:8: found 'x' in the section $Nodes"});
}

} // namespace
} // namespace cnem::input
