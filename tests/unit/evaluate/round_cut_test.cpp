// Sections round a punch: a hand-made slug and skeleton whose zones are known at every angle.
#include "evaluate/round_cut.hpp"

#include "contact/placed_shape.hpp"
#include "core/index.hpp"
#include "evaluate/blanking_parts.hpp"
#include "input/tool_surface.hpp"
#include "tests/degree.hpp"
#include "tests/index_literals.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::evaluate {

using namespace testing::literals;
namespace {

constexpr double drop = -1.3, turn = 2.0 * std::numbers::pi;

/// A round blank, 1 thick, cut by a punch of radius 2 in a die of radius 2.1; the slug has fallen by 1.3. The
/// height of the smooth zone of the slug is 0.28 + 0.1 cos φ, that of the skeleton 0.3.
struct RoundBlank {
  RoundSheet sheet;
  RoundTools tools;
  CutAxis axis;

  using Profile = std::vector<Vec2>; ///< r, z
  /// Turns profiles about z; sides (numbers of their first points) of fracture.
  void add(const std::function<Profile(double)>& now, const Profile& before, std::size_t broken) {
    constexpr std::size_t steps = 180;
    const std::size_t first = sheet.before.points.size(), n = before.size();
    for (std::size_t k = 0; k < steps; ++k) {
      const double angle = turn * static_cast<double>(k) / steps;
      const auto point = [&](const Vec2& x) {
        return Vec3(x.x() * std::cos(angle), x.x() * std::sin(angle), x.y());
      };
      for (const Vec2& x : now(angle)) sheet.now.points.push_back(point(x));
      for (const Vec2& x : before) sheet.before.points.push_back(point(x));
      sheet.volume.resize(sheet.before.points.size(), 1e-6);
      for (std::size_t i = 0; i < n; ++i) {
        const auto at = [&](std::size_t step, std::size_t j) { // one point on the axis
          return as<std::int32_t>(first + (before[j % n].x() > 0.0 ? step % steps * n : 0) + j % n);
        };
        for (const auto& t : {std::array{at(k, i), at(k + 1, i), at(k + 1, i + 1)},
                              std::array{at(k, i), at(k + 1, i + 1), at(k, i + 1)}})
          if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
            sheet.now.triangles.push_back(t);
            sheet.before.triangles.push_back(t);
            sheet.piece.push_back(i == broken ? 1_piece : 0_piece);
          }
      }
    }
  }
  void add_nodes(double from, double to, double z, double z_before) {
    for (double angle = 0.0; angle < turn; angle += 0.05)
      for (double r = from; r < to; r += 0.1) {
        const Vec3 place(r * std::cos(angle), r * std::sin(angle), 0.0);
        sheet.now.points.emplace_back(place + Vec3(0, 0, z));
        sheet.before.points.emplace_back(place + Vec3(0, 0, z_before));
        sheet.volume.push_back(1e-3);
      }
  }
  static TriangleSurface tool(const std::vector<Vec2>& corners) {
    input::ToolSolid solid;
    solid.shape = input::ToolSolid::Shape::revolved;
    for (std::size_t k = 0; k < corners.size(); ++k)
      solid.outline.pieces.push_back({corners[k], corners[(k + 1) % corners.size()], {0, 0}, 0.0, false, ""});
    return input::tool_surface(solid, {{-1, -1, -1}, {1, 1, 1}});
  }

  RoundBlank() {
    sheet.fracture_piece = 1_piece;
    add(
        [](double angle) {
          return Profile{{0.0, drop},         {1.8, drop},
                         {2.1, drop + 0.12},  {2.1, drop + 0.4 + 0.1 * std::cos(angle)},
                         {2.05, drop + 1.05}, {1.98, drop + 1.0},
                         {0.0, drop + 1.0}};
        },
        {{0, 0}, {1.8, 0}, {2.06, 0}, {2.06, 0.4}, {2.06, 1}, {1.98, 1}, {0, 1}}, 3);
    add(
        [](double) {
          return Profile{{6.0, 0.0}, {6.0, 1.0},    {2.4, 1.0}, {2.0, 0.8},
                         {2.0, 0.5}, {2.08, -0.03}, {2.12, 0.0}};
        },
        {{6, 0}, {6, 1}, {2.4, 1}, {2.06, 1}, {2.06, 0.5}, {2.06, 0}, {2.12, 0}}, 4);
    add_nodes(0.1, 1.9, drop + 0.5, 0.5);
    add_nodes(2.3, 5.9, 0.5, 0.5);
    sheet.on_plane.assign(sheet.now.triangles.size(), 0);
    tools.punch = tool({{0, -0.3}, {2, -0.3}, {2, 4}, {0, 4}});
    tools.dies = {tool({{2.1, 0}, {2.1, -4}, {7, -4}, {7, 0}})};
  }
  void move(const Mat<3>& rotation, const Vec3& shift) {
    const auto moved = [&](Vec3& x) { x = rotation * x + shift; };
    for (auto* list : {&sheet.now.points, &sheet.before.points, &tools.punch.points, &tools.dies[0].points})
      for (Vec3& x : *list) moved(x);
    moved(axis.centre);
    axis.direction = rotation * axis.direction;
  }
  /// About y.
  void tilt_slug(double angle) {
    const Mat<3> tilt = contact::rotation_about({0, 1, 0}, angle);
    for (Vec3& x : sheet.now.points)
      if (x.z() < -0.2) x = Vec3(0, 0, drop) + tilt * (x - Vec3(0, 0, drop));
  }
  BlankingResult evaluated(int sections) const {
    BlankingResult result;
    const std::vector<CutArc> arcs = find_arcs(axis, tools, sheet);
    for (const CutArc& arc : arcs) result.cut_length += arc.length;
    if (!arcs.empty()) measure(result, section_angles(arcs, sections));
    return result;
  }
  void measure(BlankingResult& result, const std::vector<double>& angles) const {
    result.parallel = 10.0 * degree;
    measure_round(result, axis, angles, tools, sheet, std::nullopt);
  }
  /// Takes away what of the die is nowhere within some sectors.
  void keep_die(const std::function<bool(double)>& within) {
    TriangleSurface& die = tools.dies[0];
    std::erase_if(die.triangles, [&](const auto& t) {
      return std::ranges::all_of(t, [&](auto i) {
        const Vec3& x = die.points[index_of(i)];
        return !within(std::atan2(x.y(), x.x()) / degree);
      });
    });
  }
};

TEST(RoundCut, zones_are_followed_round_the_punch) {
  const BlankingResult result = RoundBlank().evaluated(6);
  EXPECT_NEAR(result.cut_length, turn * 2.0, 1e-3);
  ASSERT_EQ(result.faces.size(), 12U);
  for (const ShearedFace& face : result.faces) {
    SCOPED_TRACE(::testing::Message()
                 << face.body << " at " << face.angle / degree << " degrees " << face.note);
    const bool slug = face.body == "slug";
    const double rollover = slug ? 0.12 : 0.2, burnish = slug ? 0.28 + 0.1 * std::cos(face.angle) : 0.3;
    EXPECT_TRUE(face.parted);
    EXPECT_TRUE(face.measured);
    EXPECT_NEAR(face.thickness, 1.0, 1e-9);
    EXPECT_NEAR(face.rollover, rollover, 0.006);
    EXPECT_NEAR(face.burnish, burnish, 0.006);
    EXPECT_NEAR(face.fracture, 1.0 - rollover - burnish, 0.006);
    EXPECT_NEAR(face.burr, slug ? 0.05 : 0.03, 1e-3);
  }
}

TEST(RoundCut, mean_and_spread_do_not_depend_on_the_place) {
  RoundBlank blank;
  blank.move(contact::rotation_about({1, 2, -0.5}, 1.1), {3, -2, 10});
  const auto metrics = metrics_of(blank.evaluated(8));
  const auto value = [&](const std::string& name) {
    for (const auto& [known, number] : metrics)
      if (known == name) return number;
    return std::nan("");
  };
  EXPECT_EQ(value("blanking.slug.parted"), 1.0);
  EXPECT_NEAR(value("blanking.slug.burnish[m]"), 0.28, 0.004);
  EXPECT_NEAR(value("blanking.slug.burnish_share"), 0.28, 0.004);
  EXPECT_NEAR(value("blanking.slug.burnish_spread[m]"), 0.1 / std::sqrt(2.0), 0.003);
  EXPECT_NEAR(value("blanking.skeleton.burnish[m]"), 0.3, 0.004);
  EXPECT_LT(value("blanking.skeleton.burnish_spread[m]"), 0.003);
}

// Sheet and die under half of the punch: sections lie where there is something to cut.
TEST(RoundCut, where_nothing_is_cut_there_are_no_sections) {
  RoundBlank blank;
  blank.keep_die([](double angle) { return angle > 1e-6 && angle < 180.0 - 1e-6; });
  const auto arcs = find_arcs(blank.axis, blank.tools, blank.sheet);
  ASSERT_EQ(arcs.size(), 1U);
  EXPECT_NEAR(arcs[0].from, 0.0, 1e-9);
  EXPECT_NEAR(arcs[0].to, std::numbers::pi, 1e-9);
  EXPECT_NEAR(arcs[0].length, turn, 1e-3);
  EXPECT_NEAR(section_angles(arcs, 2)[1], 0.75 * std::numbers::pi, 1e-9);

  BlankingResult result;
  result.punch = "punch";
  result.dies = {"die"};
  blank.measure(result, {0.25 * turn, 0.75 * turn});
  EXPECT_EQ(result.faces.size(), 2U);
  EXPECT_EQ(result.note, "punch passes no edge of die where there was sheet, at 1 of 2 angles");
  blank.tools.dies.clear();
  EXPECT_TRUE(find_arcs(blank.axis, blank.tools, blank.sheet).empty());
}

TEST(RoundCut, a_run_through_0_degrees_begins_below) {
  RoundBlank blank;
  blank.keep_die([](double angle) { return std::abs(angle) < 90.0 - 1e-6; });
  const auto arcs = find_arcs(blank.axis, blank.tools, blank.sheet);
  ASSERT_EQ(arcs.size(), 1U);
  EXPECT_NEAR(arcs[0].from, -90.0 * degree, 1e-9);
  EXPECT_NEAR(arcs[0].to, 90.0 * degree, 1e-9);
  EXPECT_NEAR(section_angles(arcs, 3)[1], 0.0, 1e-9);
}

// Forces and work are of all of it.
TEST(RoundCut, runs_of_angles_add_up) {
  RoundBlank blank;
  blank.keep_die([](double angle) { // 60 degrees and 120
    return (angle > 1e-6 && angle < 60.0 - 1e-6) || (angle < -30.0 - 1e-6 && angle > -150.0 + 1e-6);
  });
  const BlankingResult result = blank.evaluated(3);
  EXPECT_NEAR(result.cut_length, turn, 1e-3);
  ASSERT_EQ(result.faces.size(), 6U);
  EXPECT_NEAR(result.faces[0].angle, 30.0 * degree, 1e-9);
  EXPECT_NEAR(result.faces[2].angle, 240.0 * degree, 1e-9);
  EXPECT_NEAR(result.faces[4].angle, 300.0 * degree, 1e-9);
}

// An ejector under the slug is listed with the dies: it stands inside the punch and cuts nothing.
TEST(RoundCut, what_stands_inside_the_punch_cuts_nothing) {
  RoundBlank blank;
  const BlankingResult alone = blank.evaluated(3);
  blank.tools.dies.push_back(RoundBlank::tool({{1.2, -1.4}, {1.2, -4}, {1.9, -4}, {1.9, -1.4}}));
  const BlankingResult result = blank.evaluated(3);
  ASSERT_EQ(result.faces.size(), alone.faces.size());
  for (std::size_t k = 0; k < alone.faces.size(); ++k) {
    EXPECT_EQ(result.faces[k].cut, "");
    EXPECT_EQ(result.faces[k].burnish, alone.faces[k].burnish);
  }
}

// Edges that end at a node are cut in one place; a pyramid whose tip alone touches the plane is no part of
// the slug there, though a plane of symmetry holds it.
TEST(RoundCut, planes_may_go_through_nodes) {
  RoundBlank blank;
  const auto tip = as<std::int32_t>(blank.sheet.now.points.size());
  for (const Vec3& x : {Vec3(1, 0, -0.8), Vec3(0.9, 0.1, -0.8), Vec3(1.1, 0.1, -0.8), Vec3(1, 0.1, -0.7)}) {
    blank.sheet.now.points.push_back(x);
    blank.sheet.before.points.push_back(x);
    blank.sheet.volume.push_back(1e-6);
  }
  for (const std::array<std::int32_t, 3>& t : {std::array{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}) {
    blank.sheet.now.triangles.push_back({tip + t[0], tip + t[1], tip + t[2]});
    blank.sheet.piece.push_back(0_piece);
    blank.sheet.on_plane.push_back(1);
  }
  blank.sheet.before.triangles = blank.sheet.now.triangles;
  BlankingResult result;
  std::vector<double> angles;
  for (int k = 0; k < 12; ++k) angles.push_back(k / 12.0 * turn);
  blank.measure(result, angles);
  ASSERT_EQ(result.faces.size(), 24U);
  for (const ShearedFace& face : result.faces) {
    EXPECT_TRUE(face.measured) << face.angle / degree << face.note;
    EXPECT_NEAR(face.burnish, face.body == "slug" ? 0.28 + 0.1 * std::cos(face.angle) : 0.3, 0.006)
        << face.angle / degree;
  }
  blank.tilt_slug(0.05);
  BlankingResult tilted;
  blank.measure(tilted, {0.0});
  EXPECT_NEAR(std::abs(tilted.faces.at(0).tilt), 0.05, 0.005);
}

TEST(RoundCut, along_x_angles_count_from_y) {
  RoundBlank blank;
  EXPECT_EQ(blank.axis.counts_from(), 'x');
  Mat<3> z_to_minus_x; // the punch comes from -x; x becomes y
  z_to_minus_x << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  blank.move(z_to_minus_x, {1, 2, 3});
  EXPECT_EQ(blank.axis.counts_from(), 'y');
  const BlankingResult result = blank.evaluated(6);
  ASSERT_EQ(result.faces.size(), 12U);
  for (const ShearedFace& face : result.faces)
    EXPECT_NEAR(face.burnish, face.body == "slug" ? 0.28 + 0.1 * std::cos(face.angle) : 0.3, 0.006);
}

// The die has come up with the slug: what is cut lies between the edges, wherever they are along the axis.
TEST(RoundCut, a_die_that_has_moved_is_where_it_is) {
  RoundBlank blank;
  for (Vec3& x : blank.tools.dies[0].points) x += Vec3(0, 0, 0.4);
  EXPECT_EQ(blank.evaluated(2).faces.size(), 4U);
  for (Vec3& x : blank.tools.dies[0].points) x += Vec3(0.06, 0, 0);
  const auto right = gap_at(blank.axis, 0.0, blank.tools, blank.sheet),
             left = gap_at(blank.axis, 0.5 * turn, blank.tools, blank.sheet);
  ASSERT_TRUE(right && left);
  EXPECT_NEAR(right->edges.die - right->edges.punch, 0.16, 1e-3);
  EXPECT_NEAR(left->edges.die - left->edges.punch, 0.04, 1e-3);
}

// Walls of holes and metal that broke without opening are told apart in the face, as in the plane.
TEST(RoundCut, pieces_and_broken_nodes_are_those_of_the_plane) {
  RoundBlank blank;
  for (std::size_t t = 0; t < blank.sheet.piece.size(); ++t) // half of the slug's smooth zone and more
    if (blank.sheet.piece[t] == 0_piece) {
      const auto corner = blank.sheet.now.corners(t);
      const bool smooth = std::ranges::all_of(corner, [](const Vec3& x) {
        return x.z() < drop + 0.6 && std::abs(x.head<2>().norm() - 2.1) < 1e-9;
      });
      if (smooth) blank.sheet.piece[t] = 2_piece;
    }
  blank.sheet.other_pieces = {2_piece};
  const BlankingResult holed = blank.evaluated(2);
  ASSERT_EQ(holed.faces.size(), 4U);
  EXPECT_NEAR(holed.faces[0].hole, 0.28, 0.01);
  EXPECT_EQ(holed.faces[1].hole, 0.0);

  blank.sheet.other_pieces.clear();
  blank.sheet.broken.assign(blank.sheet.now.points.size(), 0);
  for (std::size_t i = 0; i < blank.sheet.broken.size(); ++i) {
    const Vec3& x = blank.sheet.now.points[i];
    blank.sheet.broken[i] = x.z() < drop + 0.6 && std::abs(x.head<2>().norm() - 2.1) < 1e-9;
  }
  const BlankingResult broken = blank.evaluated(2);
  EXPECT_NEAR(broken.faces[0].broken, 0.28, 0.01);
  EXPECT_EQ(broken.faces[1].broken, 0.0);
}

TEST(RoundCut, holes_are_known_of_bodies_that_are_drawn_out) {
  IndexedVector<PieceIndex, std::string> names;
  for (const char* name : {"rim", "bore", "z-", "z+", "fracture"}) names.push_back(name);
  input::Domain domain;
  domain.outer.pieces.push_back({{0, 0}, {1, 0}, {0, 0}, 0.0, false, "rim"});
  domain.sweep.emplace().ends = {"z-", "z+"};
  EXPECT_EQ(other_pieces(domain, names), std::vector{1_piece});
  domain.sweep.reset();
  domain.block.emplace(); // a tube: what is inside cannot be told from the outline
  EXPECT_TRUE(other_pieces(domain, names).empty());
}

// A tilted slug is measured in its own frame, unless a plane of symmetry holds it.
TEST(RoundCut, bodies_that_a_plane_holds_are_not_turned) {
  RoundBlank blank;
  blank.tilt_slug(0.05);
  const double before = blank.evaluated(2).faces[0].tilt;
  BlankingResult turned, held;
  blank.measure(turned, {0.001});
  EXPECT_NEAR(std::abs(turned.faces.at(0).tilt), 0.05, 0.005);
  blank.sheet.on_plane.assign(blank.sheet.now.triangles.size(), 1);
  blank.measure(held, {0.001});
  EXPECT_EQ(held.faces.at(0).tilt, 0.0);
  EXPECT_LT(std::abs(before), 0.01) << "across the tilt";
}

} // namespace
} // namespace cnem::evaluate
