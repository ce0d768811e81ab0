// Sections round a punch: a hand-made slug and skeleton whose zones are known at every angle.
#include "evaluate/round_cut.hpp"

#include "contact/placed_shape.hpp"
#include "core/index.hpp"
#include "input/tool_surface.hpp"
#include "tests/index_literals.hpp"
#include "tests/unit/evaluate/degree.hpp"

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
    const std::size_t first = sheet.before.size(), n = before.size();
    for (std::size_t k = 0; k < steps; ++k) {
      const double angle = turn * static_cast<double>(k) / steps;
      const auto point = [&](const Vec2& x) {
        return Vec3(x.x() * std::cos(angle), x.x() * std::sin(angle), x.y());
      };
      for (const Vec2& x : now(angle)) sheet.now.points.push_back(point(x));
      for (const Vec2& x : before) sheet.before.push_back(point(x));
      sheet.volume.resize(sheet.before.size(), 1e-6);
      for (std::size_t i = 0; i < n; ++i) {
        const auto at = [&](std::size_t step, std::size_t j) { // one point on the axis
          return as<std::int32_t>(first + (before[j % n].x() > 0.0 ? step % steps * n : 0) + j % n);
        };
        for (const auto& t : {std::array{at(k, i), at(k + 1, i), at(k + 1, i + 1)},
                              std::array{at(k, i), at(k + 1, i + 1), at(k, i + 1)}})
          if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
            sheet.now.triangles.push_back(t);
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
        sheet.before.emplace_back(place + Vec3(0, 0, z_before));
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
    for (auto* list : {&sheet.now.points, &sheet.before, &tools.punch.points, &tools.dies[0].points})
      for (Vec3& x : *list) moved(x);
    moved(axis.centre);
    axis.direction = rotation * axis.direction;
  }
  BlankingResult evaluated(int sections) const {
    BlankingResult result;
    const auto arc = find_arc(axis, tools, sheet);
    if (!arc) return result;
    result.cut_length = arc->length;
    for (const double angle : arc->angles(sections))
      for (const ShearedFace& face :
           measure_section(axis, *gap_at(axis, angle, tools, sheet), sheet, 10.0 * degree, std::nullopt))
        result.faces.push_back(face);
    return result;
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
  for (TriangleSurface* die : {&blank.tools.dies[0]}) {
    auto& triangles = die->triangles;
    const auto behind = [&](const auto& t) {
      return std::all_of(t.begin(), t.end(), [&](auto i) { return die->points[index_of(i)].y() < 1e-9; });
    };
    triangles.erase(std::remove_if(triangles.begin(), triangles.end(), behind), triangles.end());
  }
  const auto arc = find_arc(blank.axis, blank.tools, blank.sheet);
  ASSERT_TRUE(arc);
  EXPECT_NEAR(arc->from, 0.0, 1e-9);
  EXPECT_NEAR(arc->to, std::numbers::pi, 1e-9);
  EXPECT_NEAR(arc->length, turn, 1e-3);
  EXPECT_NEAR(arc->angles(2)[1], 0.75 * std::numbers::pi, 1e-9);
  blank.tools.dies.clear();
  EXPECT_FALSE(find_arc(blank.axis, blank.tools, blank.sheet));
}

} // namespace
} // namespace cnem::evaluate
