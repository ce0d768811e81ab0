// Outlines from drawings: the same case as the one written by hand, and what is said of wrong drawings.
#include "tests/unit/input/drawing_text.hpp"

namespace cnem::input {
namespace {

TEST_F(Drawings, make_the_same_case_as_a_path_by_hand) {
  const std::string tools =
      polyline("punch", {{2, 5, 0}, {7, 5, 0.41421356237309503}, {8, 6, 0}, {2, 6, 0}}) +
      line("die", {9, 0}, {4, 0}) + line("die", {9, -3}, {9, 0}) + arc("die", {4, -1}, 1, 90, 180) +
      line("die", {3, -1}, {3, -3}) + line("die", {9, -3}, {3, -3});
  const std::string sheet = "drawing = { file = \"part.dxf\", layers = [\"low\", \"right\", \"high\", "
                            "\"left\", \"bore\"] }";
  const Case drawn = read(dxf(square + circle("bore", {5, 2.5}, 1) + tools), sheet, "part.dxf",
                          "[tools.punch]\ndrawing.file = \"part.dxf\"\n"
                          "[tools.die]\ndrawing = { file = \"part.dxf\", shift = \"0.5 0 mm\" }\n");
  const Case by_hand = read_case_text(
      text(
          R"(outer = { start = "0 0 mm", path = [{ to = "10 0 mm", name = "low" }, { to = "10 5 mm", name = "right" },
  { to = "0 5 mm", name = "high" }, { to = "0 0 mm", name = "left" }] }
holes.bore.circle = { centre = "5 2.5 mm", radius = "1 mm", name = "bore" })") +
          R"([tools.punch]
start = "2 5 mm"
path = [{ to = "7 5 mm", name = "punch" }, { to = "8 6 mm", centre = "7 6 mm", clockwise = false, name = "punch" },
  { to = "2 6 mm", name = "punch" }, { to = "2 5 mm", name = "punch" }]
[tools.die]
start = "9.5 0 mm"
path = [{ to = "4.5 0 mm", name = "die" }, { to = "3.5 -1 mm", centre = "4.5 -1 mm", clockwise = false, name = "die" },
  { to = "3.5 -3 mm", name = "die" }, { to = "9.5 -3 mm", name = "die" }, { to = "9.5 0 mm", name = "die" }]
)",
      "hand.toml");
  EXPECT_EQ(body(drawn), body(by_hand)) << "bits, not nearly";
  EXPECT_EQ(body(read_case_text(drawn.resolved, "elsewhere.toml")), body(drawn)) << "stands without the file";
}

TEST_F(Drawings, are_placed_by_the_case) {
  const Case c = read(dxf(square, "1"),
                      "drawing = { file = \"part.dxf\", scale = 2, mirror = \"x\", rotate = \"90 deg\", "
                      "shift = \"1 2 mm\", names = [{ at = \"254 60 mm\", name = \"end\" }] }");
  // (10, 0) in: doubled, mirrored, turned: (0, -20) in; shifted by (1, 2) mm.
  std::vector<std::string> names;
  Vec2 low = Vec2::Constant(1.0), high = -low;
  for (const CurvePiece& piece : c.domain.outer.pieces) {
    names.push_back(piece.name);
    low = low.cwiseMin(piece.from);
    high = high.cwiseMax(piece.from);
  }
  EXPECT_LT((low - Vec2(0.001 - 0.254, 0.002 - 0.508)).norm(), 1e-12) << low.transpose();
  EXPECT_LT((high - Vec2(0.001, 0.002)).norm(), 1e-12) << high.transpose();
  EXPECT_NE(std::find(names.begin(), names.end(), "end"), names.end()) << "was right";
  EXPECT_EQ(std::find(names.begin(), names.end(), "right"), names.end());
  EXPECT_DOUBLE_EQ(
      read(dxf(square, "1"), "drawing = { file = \"part.dxf\", unit = \"mm\" }").domain.outer.length(), 0.03)
      << "the unit of the case goes first";
}

TEST_F(Drawings, follow_variables_and_round_corners) {
  const Case c = read(dxf(square),
                      "outer.drawing = { file = \"part.dxf\", shift = \"gap, 0 mm\", fillets = [{ at = "
                      "\"10 5 mm\", radius = \"2 * gap\" }] }",
                      "part.dxf", "[let]\ngap = \"0.5 mm\"\n");
  double radius = 0.0;
  for (const CurvePiece& piece : c.domain.outer.pieces) radius = std::max(radius, piece.radius);
  EXPECT_DOUBLE_EQ(radius, 1e-3);
}

TEST_F(Drawings, of_older_polylines_and_from_behind) {
  const auto vertex = [](double x, double y, const std::string& bulge) {
    return lines_of({{0, "VERTEX"}, {8, "0"}}) + point(x, y) + lines_of({{42, bulge}});
  };
  const std::string old = lines_of({{0, "POLYLINE"}, {8, "0"}, {66, "1"}, {70, "1"}}) + vertex(0, 0, "0") +
                          vertex(10, 0, "0") + vertex(10, 5, "0.5") + vertex(0, 5, "0") +
                          lines_of({{0, "SEQEND"}});
  const double area = read(dxf(old), whole).domain.outer.area();
  EXPECT_GT(area, 50e-6) << "the bulge is to the left of the way: outwards";
  const std::string behind =
      lines_of({{0, "LWPOLYLINE"}, {8, "0"}, {70, "1"}, {210, "0"}, {220, "0"}, {230, "-1"}}) + point(0, 0) +
      point(-10, 0) + point(-10, 5) + lines_of({{42, "-0.5"}}) + point(0, 5);
  // Seen from behind x and the sense of turns are reversed.
  EXPECT_NEAR(read(dxf(behind), whole).domain.outer.area(), area, 1e-15);
}

TEST_F(Drawings, join_what_nearly_meets_at_corners_of_lines) {
  const std::string rounded = line("a", {0, 0}, {9, 0}) + arc("a", {9.0000001, 1}, 1, 270, 360) +
                              line("a", {10, 1}, {10, 5}) + line("a", {10, 5}, {0, 5}) +
                              line("a", {0, 5}, {0, 0});
  const Curve outer = read(dxf(rounded), whole).domain.outer;
  for (std::size_t k = 0; k < outer.pieces.size(); ++k)
    EXPECT_EQ(outer.pieces[k].to, outer.pieces[(k + 1) % outer.pieces.size()].from);
  EXPECT_EQ(outer.pieces[0].to, Vec2(9e-3, 0));
}

TEST_F(Drawings, have_holes_named_after_layers) {
  const Case c = read(dxf(circle("bores", {2, 2}, 1) + square + circle("bores", {6, 2}, 1) +
                          circle("frozen", {50, 50}, 1) + lines_of({{0, "TEXT"}, {8, "low"}, {1, "part"}})),
                      whole);
  ASSERT_EQ(c.domain.holes.size(), 2U) << "frozen layers and words are no part of it";
  EXPECT_EQ(c.domain.holes[0].name, "bores_1");
  EXPECT_EQ(c.domain.holes[1].name, "bores_2");
  EXPECT_EQ(c.domain.holes[0].outline.pieces[0].name, "bores");
}

TEST_F(Drawings, that_are_open_say_where) {
  expect_parts(refused(dxf(line("low", {0, 0}, {10, 0}) + line("right", {10, 0.02}, {10, 5}) +
                           line("high", {10, 5}, {0, 5}) + line("left", {0, 5}, {0, 0}))),
               {"case.toml:6:1: key 'domain.drawing': ",
                "part.dxf: the outline is open between (10, 0) mm (layer "
                "\"low\", line 34) and (10, 0.02) mm (layer \"right\", line 46), "
                "0.02 mm apart"});
  EXPECT_EQ(refused(dxf(line("low", {0, 0}, {10, 0}) + line("right", {10, 0.02}, {10, 5}) +
                        line("high", {10, 5}, {0, 5}) + line("left", {0, 5}, {0, 0})),
                    "drawing = { file = \"part.dxf\", tolerance = \"0.05 mm\" }"),
            "accepted");
}

TEST_F(Drawings, that_are_wrong_say_where) {
  expect_parts(refused(dxf(square + line("rib", {0, 0}, {10, 5}))),
               {"curves that branch: 3 meet at (0, 0) mm (layer \"low\"", "layer \"rib\""});
  expect_parts(refused(dxf(square + line("low", {10, 0}, {0, 0}))),
               {"drawn twice from (10, 0) mm to (0, 0) mm (layer \"low\", line 34 and line 82)"});
  expect_parts(refused(dxf(square + line("low", {3, 0}, {3, 0}))),
               {"no longer than the tolerance at (3, 0) mm"});
  expect_parts(refused(dxf(polyline("bow", {{0, 0, 0}, {10, 5, 0}, {10, 0, 0}, {0, 5, 0}}))),
               {"crosses or touches itself at (5, 2.5) mm"});
  expect_parts(refused(dxf(square + circle("bore", {10, 2}, 1))), {"meet at (10, "});
  expect_parts(refused(dxf(square + circle("bore", {15, 2}, 1))),
               {"found 2 closed outlines", "(16, 2) mm on layer \"bore\""});
  expect_parts(refused(dxf(square + circle("a", {5, 2}, 1) + circle("b", {5, 2}, 0.5))),
               {"at (5.5, 2) mm lies in a hole"});
  expect_parts(
      refused(dxf(square), "drawing = { file = \"part.dxf\", layers = [\"hihg\"] }"),
      {"found no layer \"hihg\", expected one of the layers empty, frozen, low, right, high, left (did you "
       "mean 'high'?)"});
  expect_parts(refused(dxf(square), "drawing = { file = \"part.dxf\", layers = [\"empty\"] }"),
               {"the layer \"empty\" has no curves"});
  expect_parts(refused(dxf(square, "0")),
               {"found no unit of its lengths, expected it from the case: unit = \"mm\""});
  expect_parts(refused(dxf(square), "drawing = { file = \"part.dxf\", unit = \"kg\" }"),
               {"expected a unit of length"});
  expect_parts(refused(dxf(square), "drawing = { file = \"prat.dxf\" }"),
               {"found no file", "did you mean 'part.dxf'?"});
  expect_parts(refused(dxf(square), whole + "\nouter.circle = { centre = \"0 0 mm\", radius = \"1 mm\" }"),
               {"key 'domain.outer': found beside domain.drawing, expected one of them"});
  expect_parts(
      refused(dxf(square), "drawing = { file = \"part.dxf\", names = [{ at = \"90 5 mm\", name = \"x\" }] }"),
      {"found no curve near (90, 5) mm"});
}

TEST_F(Drawings, with_what_is_not_read_say_so) {
  expect_parts(refused(dxf(square + lines_of({{0, "SPLINE"}, {8, "low"}}))),
               {"part.dxf:82: the layer \"low\" has a curve of the kind SPLINE, which is not read"});
  expect_parts(refused(dxf(square + lines_of({{0, "INSERT"}, {8, "low"}, {2, "bolt"}}))),
               {"the block \"bolt\" (INSERT), which is not read, expected it exploded"});
  EXPECT_EQ(refused(dxf(square + lines_of({{0, "SPLINE"}, {8, "other"}})),
                    "drawing = { file = \"part.dxf\", layers = [\"low\", \"right\", \"high\", \"left\"] }"),
            "accepted");
  expect_parts(refused("AutoCAD Binary DXF\r\n\x1a"), {"part.dxf:1: found a binary DXF"});
  const std::string good = dxf(square);
  expect_parts(refused(good.substr(0, good.size() - 20)),
               {"the file ends in the section ENTITIES", "cut short"});
  expect_parts(refused(replaced(good, "\n10\n", "\n1O\n")), {"found '1O', expected a finite number"});
  expect_parts(refused("solid\n"), {"part.dxf:1: found 'solid', expected a group code"});
}

const std::string plate_geo = R"(// a plate with a bore
w = 10; h = w/2; r = Sqrt(1); lc = 0.5;
Point(1) = {0, 0, 0, lc}; Point(2) = {w, 0, 0}; Point(3) = {w, h, 0}; Point(4) = {0, h, 0};
Point(5) = {5, 2.5, 0}; Point(6) = {5 + r, 2.5, 0}; Point(7) = {5 - r, 2.5, 0}; Point(8) = {5, 3.5, 0}; Point(9) = {5, 1.5, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Circle(5) = {6, 5, 8}; Circle(6) = {8, 5, 7}; Circle(7) = {7, 5, 9}; Circle(8) = {9, 5, 6};
Curve Loop(1) = {1:4}; Curve Loop(2) = {5, 6, 7, 8};
Plane Surface(1) = {1, 2};
Physical Curve("low") = {1}; Physical Curve("rest", 7) = {2, 3, 4}; Physical Line("bore") = {5:8};
Physical Surface("plate") = {1}; Mesh.MshFileVersion = 2.2;
)";

TEST_F(Drawings, of_gmsh) {
  const std::string domain = "drawing = { file = \"part.geo\", unit = \"mm\" }";
  const Case c = read(plate_geo, domain, "part.geo");
  EXPECT_NEAR(c.domain.outer.area(), 50e-6, 1e-18);
  EXPECT_EQ(c.domain.outer.pieces[0].name, "low");
  ASSERT_EQ(c.domain.holes.size(), 1U);
  EXPECT_EQ(c.domain.holes[0].name, "bore");
  EXPECT_NEAR(std::abs(c.domain.holes[0].outline.area()), 3.14159265358979e-6, 1e-18) << "arcs stay arcs";

  expect_parts(refused(plate_geo, "drawing = { file = \"part.geo\" }", "part.geo"), {"found no unit"});
  expect_parts(refused(plate_geo + "Spline(9) = {1, 2, 3};\n", domain, "part.geo"),
               {"part.geo:11: found the command 'Spline', expected one of those that are read"});
  expect_parts(refused(plate_geo + "Line(9) = {1, 77};\n", domain, "part.geo"),
               {"part.geo:11: found no point 77"});
  expect_parts(refused("widht = 2;\nPoint(1) = {width, 0, 0};\n", domain, "part.geo"),
               {"part.geo:2: found no variable 'width'", "did you mean 'widht'?"});
  expect_parts(refused("Point(1) = {0, 0, 0}", domain, "part.geo"),
               {"found the end of the file, expected ';'"});
}

TEST_F(Drawings, of_meshes) {
  const std::string domain = "drawing = { file = \"part.msh\", unit = \"mm\" }";
  const std::string two = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "low side"
1 2 "rest"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 5 0 0
3 10 0 0
4 10 5 0
5 0 5 0
$EndNodes
$Elements
5
1 1 2 1 1 1 2
2 1 2 1 1 2 3
3 1 2 2 2 3 4
4 1 2 2 3 4 5
5 1 2 2 4 5 1
$EndElements
)";
  const std::string four = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "low side"
1 2 "rest"
$EndPhysicalNames
$Entities
1 2 0 0
1 0 0 0 0
1 0 0 0 10 0 0 1 1 2 1 -2
2 0 0 0 10 5 0 1 2 0
$EndEntities
$Nodes
1 5 1 5
1 1 0 5
1
2
3
4
5
0 0 0
5 0 0
10 0 0
10 5 0
0 5 0
$EndNodes
$Elements
2 5 1 5
1 1 1 2
1 1 2
2 2 3
1 2 1 3
3 3 4
4 4 5
5 5 1
$EndElements
)";
  const Curve outer = read(two, domain, "part.msh").domain.outer;
  ASSERT_EQ(outer.pieces.size(), 4U) << "two sides in line are one";
  EXPECT_EQ(outer.pieces[0].name, "low_side");
  EXPECT_EQ(body(read(two, domain, "part.msh")), body(read(four, domain, "part.msh")));

  const auto elements = two.find("$Elements");
  const std::string triangles = two.substr(0, elements) +
                                "$Elements\n3\n1 2 2 0 1 1 2 5\n2 2 2 0 1 2 4 5\n3 2 2 0 1 2 3 "
                                "4\n$EndElements\n";
  EXPECT_NEAR(read(triangles, domain, "part.msh").domain.outer.area(), 50e-6, 1e-18)
      << "sides of one triangle";
  expect_parts(refused(two.substr(0, elements + 40), domain, "part.msh"),
               {"the file ends in the section $Elements, expected $EndElements"});
  expect_parts(refused(replaced(two, "2.2 0 8", "2.2 1 8"), domain, "part.msh"),
               {"part.msh:2: found a binary mesh"});
  expect_parts(refused(replaced(two, "5 1 2 2 4 5 1", "5 8 2 2 4 5 1"), domain, "part.msh"),
               {"an element of type 8"});
}

TEST_F(Drawings, are_seen_from_the_file_that_names_them) {
  std::filesystem::create_directories(folder_ / "press");
  std::ofstream(folder_ / "press/part.dxf") << dxf(square);
  std::ofstream(folder_ / "press/sheet.toml") << "domain.drawing = { file = \"part.dxf\" }\n";
  std::string without = "include = \"press/sheet.toml\"\n" + text("");
  std::ofstream(folder_ / "case.toml") << without;
  EXPECT_EQ(read_case((folder_ / "case.toml").string()).domain.outer.pieces[0].name, "low");
}

} // namespace
} // namespace cnem::input
