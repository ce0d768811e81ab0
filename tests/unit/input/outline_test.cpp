// Outlines of domains, holes, cracks and tools, right and wrong.
#include "input/curve_checks.hpp"
#include "tests/unit/input/case_text.hpp"

#include <cmath>
#include <numbers>

namespace cnem::input {
namespace {

constexpr double pi = std::numbers::pi;

/// The curve of a tool written in a case whose workpiece is away from it, in places that are counted from (0,
/// 0).
Curve curve(const std::string& outline) {
  return read_small("[tools.t]\n" + outline, {"domain.outer.rectangle={from=\"-99 -99 m\", to=\"-9 -9 m\"}"})
      .tools.at(0)
      .outline;
}
std::string problem(const std::string& outline) { return refusal("[tools.t]\n" + outline); }

void expect_joined(const Curve& c) {
  for (std::size_t i = 0; i < c.pieces.size(); ++i) {
    const CurvePiece& piece = c.pieces[i];
    EXPECT_EQ(piece.to, c.pieces[(i + 1) % c.pieces.size()].from);
    if (!piece.is_arc()) continue;
    EXPECT_NEAR((piece.from - piece.centre).norm(), piece.radius, 1e-12);
    EXPECT_NEAR((piece.to - piece.centre).norm(), piece.radius, 1e-12);
    EXPECT_LE(std::abs(piece.sweep()), pi * (1.0 + 1e-9));
  }
}

TEST(Outline, PathsCloseAndRunCounterClockwise) {
  const Curve open =
      curve("start = \"0 0 m\"\npath = [{ to = \"0 1 m\" }, { to = \"1 1 m\" }, { to = \"1 0 m\" }]\n");
  const Curve closed = curve("start = \"0 0 m\"\npath = [{ to = \"1 0 m\" }, { to = \"1 1 m\" }, { to = \"0 "
                             "1 m\" }, { to = \"0 0 m\" }]\n");
  EXPECT_EQ(open.pieces.size(), 4U);
  EXPECT_EQ(closed.pieces.size(), 4U);
  EXPECT_DOUBLE_EQ(open.area(), 1.0);
  EXPECT_DOUBLE_EQ(closed.area(), 1.0);
  expect_joined(open);
}

TEST(Outline, NamesFollowTheirPiecesWhenReversed) {
  const Curve c =
      curve("start = \"0 0 m\"\nclose = \"d\"\npath = [{ to = \"0 1 m\", name = \"a\" }, { to = \"1 1 m\", "
            "name = \"b\" }, { to = \"1 0 m\" }]\n");
  for (const CurvePiece& piece : c.pieces) {
    const Vec2 middle = piece.point(0.5);
    const std::string expected = middle.x() == 0.0   ? "a"
                                 : middle.y() == 1.0 ? "b"
                                 : middle.x() == 1.0 ? "t"
                                                     : "d";
    EXPECT_EQ(piece.name, expected);
  }
}

TEST(Outline, ArcsByCentreAndByRadius) {
  // A half disc, either way of writing it.
  const Curve by_centre = curve("start = \"1 0 m\"\npath = [{ to = \"-1 0 m\", centre = \"0 0 m\", name = "
                                "\"round\" }]\nclose = \"flat\"\n");
  const Curve by_radius = curve("start = \"1 0 m\"\npath = [{ to = \"-1 0 m\", radius = \"1 m\" }]\n");
  EXPECT_NEAR(by_centre.area(), 0.5 * pi, 1e-12);
  EXPECT_NEAR(by_radius.area(), 0.5 * pi, 1e-12);
  EXPECT_EQ(by_centre.pieces[0].name, "round");
  // A bite out of a square, clockwise; and the same corner bulging.
  const std::string square =
      "start = \"0 0 m\"\npath = [{ to = \"1 0 m\" }, { to = \"2 1 m\", radius = \"1 m\", clockwise "
      "= BITE }, { to = \"2 2 m\" }, { to = \"0 2 m\" }]\n";
  const double polygon = 3.5, segment = 0.25 * pi - 0.5;
  EXPECT_NEAR(curve(replaced(square, "BITE", "true")).area(), polygon - segment, 1e-12);
  EXPECT_NEAR(curve(replaced(square, "BITE", "false")).area(), polygon + segment, 1e-12);
  // Three quarters of a circle by its centre: split into two arcs.
  const Curve pacman =
      curve("start = \"1 0 m\"\npath = [{ to = \"0 -1 m\", centre = \"0 0 m\" }, { to = \"0 0 m\" }]\n");
  EXPECT_NEAR(pacman.area(), 0.75 * pi, 1e-12);
  EXPECT_EQ(pacman.pieces.size(), 4U);
  expect_joined(pacman);
  // A whole circle.
  const Curve disc =
      curve("start = \"1 0 m\"\npath = [{ to = \"1 0 m\", centre = \"0 0 m\", clockwise = true }]\n");
  EXPECT_NEAR(disc.area(), pi, 1e-12);
  expect_joined(disc);
}

TEST(Outline, FilletsAreTangentArcs) {
  const Curve c =
      curve("start = \"0 0 m\"\npath = [{ to = \"4 0 m\", fillet = \"1 m\" }, { to = \"4 4 m\" }, { to = \"2 "
            "2 m\", "
            "fillet = \"0.5 m\", name = \"notch\", fillet_name = \"root\" }, { to = \"0 4 m\" }]\n");
  expect_joined(c);
  int arcs = 0;
  for (std::size_t i = 0; i < c.pieces.size(); ++i) {
    const CurvePiece &piece = c.pieces[i], &next = c.pieces[(i + 1) % c.pieces.size()];
    if (piece.is_arc()) {
      ++arcs;
      EXPECT_EQ(piece.clockwise, piece.name == "root");
    }
    if (piece.is_arc() || next.is_arc()) {
      EXPECT_NEAR(piece.tangent(1.0).dot(next.tangent(0.0)), 1.0, 1e-12);
    }
  }
  EXPECT_EQ(arcs, 2);
  // The convex corner loses r²(1 − π/4), the reentrant one of 90° gains it.
  EXPECT_NEAR(c.area(), 12.0 - (1.0 - 0.25) * (1.0 - 0.25 * pi), 1e-12);
}

TEST(Outline, FilletsMayTakeWholeSides) {
  const Curve stadium = curve("rectangle = { from = \"0 0 m\", to = \"4 2 m\", fillet = \"1 m\" }\n");
  EXPECT_NEAR(stadium.area(), 4.0 + pi, 1e-12);
  EXPECT_EQ(stadium.pieces.size(), 6U);
  expect_joined(stadium);
  const Curve disc = curve("rectangle = { from = \"0 0 m\", to = \"2 2 m\", fillet = \"1 m\" }\n");
  EXPECT_NEAR(disc.area(), pi, 1e-12);
  EXPECT_EQ(disc.pieces.size(), 4U);
  expect_joined(disc);
}

TEST(Outline, RotationTurnsCounterClockwiseAboutItsCentre) {
  const Curve c = curve("rectangle = { from = \"1 0 m\", to = \"2 1 m\" }\nrotate = { angle = \"90 deg\", "
                        "centre = \"1 0 m\" }\n");
  EXPECT_NEAR((c.pieces[0].to - Vec2(1, 1)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(c.area(), 1.0, 1e-15);
}

TEST(Outline, CircleIsTwoArcs) {
  const Curve c = curve("circle = { centre = \"1 2 m\", radius = \"3 m\", name = \"rim\" }\n");
  EXPECT_EQ(c.pieces.size(), 2U);
  EXPECT_EQ(c.pieces[1].name, "rim");
  EXPECT_NEAR(c.area(), 9.0 * pi, 1e-12);
  expect_joined(c);
}

TEST(Outline, ImpossibleOutlinesAreExplained) {
  const std::string at = "case.toml:14:8: key 'tools.t'";
  expect_parts(problem("velocity = \"0 0 m/s\"\n"),
               {at, "expected either start and path, or rectangle, or circle"});
  expect_parts(problem("circle = { centre = \"0 0 m\", radius = \"1 m\" }\nstart = \"0 0 m\"\n"),
               {"expected either"});
  expect_parts(problem("path = [{ to = \"1 0 m\" }]\n"), {"key 'tools.t.start': missing"});
  expect_parts(problem("start = \"0 0 m\"\npath = []\n"), {"case.toml:16:1: key 'tools.t.path': is empty"});
  expect_parts(problem("circle = { centre = \"0 0 m\", radius = \"1 m\" }\nclose = \"x\"\n"),
               {"only a path has"});
  const auto path = [](const std::string& pieces) {
    return problem("start = \"0 0 m\"\npath = [" + pieces + "]\n");
  };
  expect_parts(path("{ to = \"0 0 m\" }, { to = \"1 0 m\" }"),
               {"key 'tools.t.path[0].to': the piece has no length"});
  expect_parts(path("{ to = \"1 0 m\", name = \"all\" }, { to = \"1 1 m\" }"),
               {"found a piece named \"all\""});
  expect_parts(path("{ to = \"1 0 m\" }"), {"encloses no area"});
  expect_parts(path("{ to = \"2 0 m\" }, { to = \"2 2 m\" }, { to = \"1 -1 m\" }"),
               {"key 'tools.t.path': the outline crosses or touches itself at"});
  expect_parts(path("{ to = \"2 0 m\" }, { to = \"1 0 m\" }, { to = \"1 1 m\" }"),
               {"crosses or touches itself"});
  expect_parts(path("{ to = \"2 0 m\" }, { to = \"1 0 m\", centre = \"0 0 m\" }"),
               {"path[1].centre'", "lie at 2 m and 1 m from its centre"});
  expect_parts(path("{ to = \"2 0 m\", radius = \"0.5 m\" }"),
               {"path[0].radius'", "no arc of radius 0.5 m", "2 m apart"});
  expect_parts(path("{ to = \"2 0 m\", radius = \"2 m\", centre = \"1 0 m\" }"),
               {"either a centre or a radius"});
  expect_parts(path("{ to = \"2 0 m\", clockwise = true }"), {"only an arc has a sense"});
  expect_parts(path("{ to = \"1 0 m\" }, { to = \"1 1 m\", fillet_name = \"x\" }"),
               {"there is no fillet to name"});
  expect_parts(path("{ to = \"1 0 m\", fillet = \"0.5 m\" }, { to = \"1 1 m\", fillet = \"0.51 m\" }, { to = "
                    "\"0 1 m\" }"),
               {"path[0].fillet'", "a radius of 0.5 m does not fit at (1, 0) m", "1.01 m of a piece of 1 m"});
  expect_parts(path("{ to = \"1 0 m\", fillet = \"0.5 m\" }, { to = \"2 0 m\" }, { to = \"2 1 m\" }"),
               {"there is no corner to round at (1, 0) m"});
  expect_parts(path("{ to = \"1 0 m\", fillet = \"0.5 m\" }, { to = \"0 1 m\", centre = \"0 0 m\" }"),
               {"a fillet joins two straight pieces"});
  expect_parts(problem("rectangle = { from = \"0 0 m\", to = \"1 0 m\" }\n"),
               {"key 'tools.t.rectangle.to'", "no area"});
}

TEST(Outline, HolesAndCracksMustFit) {
  const auto hole = [](const std::string& a) { return refusal("[domain.holes.a]\n" + a); };
  const auto circle = [](const std::string& at, const std::string& r) {
    return "circle = { centre = \"" + at + " mm\", radius = \"" + r + " mm\" }\n";
  };
  EXPECT_EQ(hole(circle("5 2.5", "1")), "accepted");
  expect_parts(hole(circle("5 2.5", "2.5")),
               {"case.toml:14:", "key 'domain.holes.a': the hole meets domain.outer at"});
  expect_parts(hole(circle("5 2.5", "3")), {"the hole meets domain.outer"});
  expect_parts(hole(circle("15 2.5", "1")), {"lies outside domain.outer"});
  expect_parts(hole(circle("5 2.5", "1") + "[domain.holes.b]\n" + circle("6.5 2.5", "1")),
               {"key 'domain.holes.b': the hole meets domain.holes.a"});
  expect_parts(hole(circle("5 2.5", "2") + "[domain.holes.b]\n" + circle("5 2.5", "1")),
               {"lies in the other"});

  const auto crack = [](const std::string& points) {
    return refusal("[domain.cracks.c]\npoints = [" + points + "]\n");
  };
  EXPECT_EQ(crack("\"2 2 mm\", \"4 2 mm\""), "accepted");
  EXPECT_EQ(crack("\"0 2 mm\", \"4 2 mm\""), "accepted"); // open at the left side
  EXPECT_EQ(crack("\"0 2 mm\", \"10 2 mm\""), "accepted");
  expect_parts(crack("\"2 2 mm\""), {"case.toml:15:11: key 'domain.cracks.c.points': found 1 points"});
  expect_parts(crack("\"2 2 mm\", \"2 2 mm\""), {"two consecutive points coincide"});
  expect_parts(crack("\"2 2 mm\", \"12 2 mm\""), {"the point (0.012, 0.002) m is outside domain.outer"});
  expect_parts(crack("\"2 2 mm\", \"4 0 mm\", \"6 2 mm\""), {"the crack meets domain.outer at (0.004, 0) m"});
  expect_parts(crack("\"2 2 mm\", \"6 2 mm\", \"6 3 mm\", \"4 1 mm\""),
               {"the crack crosses or touches itself"});
  expect_parts(
      refusal(
          "[domain.cracks.c]\npoints = [\"2 2 mm\", \"4 2 mm\"]\n[domain.cracks.d]\npoints = [\"3 1 mm\", "
          "\"3 3 mm\"]\n"),
      {"key 'domain.cracks.d.points': the crack meets domain.cracks.c at (0.003, 0.002) m"});
  expect_parts(refusal("[domain.holes.a]\n" + circle("5 2.5", "1") +
                       "[domain.cracks.c]\npoints = [\"5 2.5 mm\", "
                       "\"8 2.5 mm\"]\n"),
               {"in the hole domain.holes.a"});
}

TEST(Outline, SymmetryNeedsStraightPieces) {
  const std::string hole = "[domain.holes.a]\ncircle = { centre = \"5 2 mm\", radius = \"1 mm\" }\n";
  expect_parts(refusal(hole + "[boundary.s]\npieces = \"a\"\nsymmetry = true\n"),
               {"case.toml:18:1: key 'boundary.s.symmetry': found piece 'a', which is not straight"});
  const std::string crack = "[domain.cracks.c]\npoints = [\"2 2 mm\", \"4 2 mm\"]\n";
  expect_parts(refusal(crack + "[boundary.s]\npieces = \"c\"\nsymmetry = true\n"),
               {"found piece 'c+'", "'c-'"});
  EXPECT_EQ(read_small(crack + "[boundary.s]\npieces = \"c\"\npressure = \"1 MPa\"\n").boundary[0].pieces,
            (std::vector<std::string>{"c+", "c-"}));
}

TEST(CurveChecks, InsideAndDistanceOnAShapeOfArcs) {
  // A disc with a round bite: |x| < 2, |x − (2, 0)| > 1.
  const double y = std::sqrt(4.0 - 1.75 * 1.75);
  Curve c{{{{1.75, y}, {-2, 0}, {0, 0}, 2.0, false, ""},
           {{-2, 0}, {1.75, -y}, {0, 0}, 2.0, false, ""},
           {{1.75, -y}, {1.75, y}, {2, 0}, 1.0, true, ""}}};
  for (double px = -2.45; px < 2.5; px += 0.1)
    for (double py = -2.45; py < 2.5; py += 0.1) {
      const Vec2 x(px, py);
      const bool expected = x.norm() < 2.0 && (x - Vec2(2, 0)).norm() > 1.0;
      EXPECT_EQ(inside(c, x), expected) << px << ' ' << py;
      EXPECT_EQ(inside(c.reversed(), x), expected) << px << ' ' << py;
    }
  EXPECT_NEAR(distance(c, {0.5, 0.0}), 0.5, 1e-15);
  EXPECT_NEAR(distance(c, {-3.0, 0.0}), 1.0, 1e-15);
  EXPECT_FALSE(self_crossing(c));
  EXPECT_FALSE(common_point(c, Curve{{{{-1, 0}, {0, 0}, {0, 0}, 0.0, false, ""}}}));
  EXPECT_TRUE(common_point(c, Curve{{{{0, 0}, {1, 0}, {0, 0}, 0.0, false, ""}}}));
}

} // namespace
} // namespace cnem::input
