// Periodic planes in space, in one to three directions: a strain that the periods allow stays uniform, and
// mass, momentum and energy are kept; pairs stay pairs.
#include "app/problem/bodies.hpp"
#include "app/problem/registry.hpp"
#include "app/space_adaptation.hpp"
#include "core/error.hpp"
#include "core/fields/vector_at.hpp"
#include "input/case_reader.hpp"
#include "tests/clouds.hpp"
#include "tests/steel.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

namespace cnem::testing {
namespace {

constexpr const char* x_period = "[periodic.x]\npieces = [\"x-\", \"x+\"]\n";
constexpr const char* y_period = "[periodic.y]\npieces = [\"y-\", \"y+\"]\n";
constexpr const char* z_period = "[periodic.z]\npieces = [\"z-\", \"z+\"]\n";

input::Case periodic_block(const std::string& more, const std::string& grid = "false") {
  return input::read_case_text(fmt::format(R"toml(
[analysis]
kinematics = "three-dimensional"
[time]
end = "1 us"
[domain]
material = "steel"
block = {{ from = "0 0 0 mm", to = "1 0.8 0.6 mm", grid = {} }}
[cloud]
spacing = "0.2 mm"
{})toml",
                                           grid, more) +
                                   steel_304l,
                               "case.toml");
}

ExplicitSolver<3> start(const input::Case& input, const std::function<Vec3(const Vec3&)>& velocity) {
  app::Setup<3> setup = app::build<3>(input);
  for (const NodeIndex i : setup.problem.cloud.position.indices()) {
    const Vec3 v = velocity(setup.problem.cloud.position[i]);
    for (int k = 0; k < 3; ++k) setup.velocity[index_of(k)][index_of(i)] = v[k];
  }
  return {std::move(setup.problem), std::move(setup.velocity), std::move(setup.temperature)};
}

std::map<std::size_t, int> sizes_of_groups(const Ties<3>& ties) {
  std::map<std::size_t, int> count;
  ties.each_group([&](std::span<const NodeIndex> group) { ++count[group.size()]; });
  return count;
}

TEST(SpacePeriods, edges_and_corners_of_a_box_are_groups_of_four_and_eight) {
  for (const std::string& grid : {std::string("false"), std::string("true")}) {
    const app::Setup<3> setup =
        app::build<3>(periodic_block(std::string(x_period) + y_period + z_period, grid));
    const auto count = sizes_of_groups(setup.problem.ties);
    EXPECT_EQ(count.at(8), 1);
    EXPECT_EQ(count.at(4), 4 + 3 + 2); // inner nodes of edges of 5, 4 and 3 spacings
    if (grid == "true") {
      EXPECT_EQ(count.at(2), 12 + 8 + 6); // inner nodes of faces
    }
  }
}

/// A profile of straight sides that are named in their order ("a", "b", …), with periods between some.
input::Case periodic_profile(const std::vector<std::string>& corners, const std::string& periods) {
  std::string path;
  for (std::size_t k = 0; k < corners.size(); ++k)
    path += fmt::format("{{ to = \"{} mm\", name = \"{}\" }}, ", corners[(k + 1) % corners.size()],
                        char('a' + k));
  return input::read_case_text(fmt::format(R"toml(
[analysis]
kinematics = "three-dimensional"
[time]
end = "1 us"
[domain]
material = "steel"
outer.start = "{} mm"
outer.path = [{}]
extrude = {{ to = "0.2 mm" }}
[cloud]
spacing = "0.2 mm"
[periodic]
{}
)toml",
                                           corners.front(), path, periods) +
                                   steel_304l,
                               "case.toml");
}

contact::Repetition<3> repetition_of(const input::Case& input) {
  return app::repetition(input, app::build<3>(input).problem.cloud);
}

TEST(SpacePeriods, a_side_in_two_pieces_repeats_once_and_six_sides_twice) {
  const contact::Repetition<3> cut =
      repetition_of(periodic_profile({"0 0", "1 0", "1 0.4", "1 0.8", "0 0.8", "0 0.4"},
                                     "low.pieces = [\"f\", \"b\"]\nhigh.pieces = [\"e\", \"c\"]\n"
                                     "z.pieces = [\"z-\", \"z+\"]"));
  ASSERT_EQ(cut.period.size(), 2U);
  EXPECT_LT((cut.period[0] - Vec3(1e-3, 0, 0)).norm(), 1e-12);
  EXPECT_LT((cut.period[1] - Vec3(0, 0, 2e-4)).norm(), 1e-12);
  EXPECT_EQ(cut.sides.size(), 6U);
  const contact::Repetition<3> hexagon = repetition_of(periodic_profile(
      {"1 0", "0.5 0.866025", "-0.5 0.866025", "-1 0", "-0.5 -0.866025", "0.5 -0.866025"},
      "one.pieces = [\"d\", \"a\"]\ntwo.pieces = [\"e\", \"b\"]\nthree.pieces = [\"f\", \"c\"]"));
  ASSERT_EQ(hexagon.period.size(), 2U);
  EXPECT_LT((hexagon.period[0] - Vec3(1.5e-3, 0.866025e-3, 0)).norm(), 1e-12);
  EXPECT_EQ(hexagon.sides.size(), 6U);
}

TEST(SpacePeriods, periods_that_cannot_be_together_are_told) {
  const input::Case input =
      periodic_profile({"0 0", "0.8 0", "0.8 0.4", "1.2 0.4", "1.2 0.8", "0 0.8", "0 0.4"},
                       "low.pieces = [\"g\", \"b\"]\nupper.pieces = [\"f\", \"d\"]");
  try {
    app::build<3>(input);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'periodic.upper.pieces': found sides 0.0012, 0, 0 m apart"),
              std::string::npos)
        << error.what();
  }
}

/// Both sides have the same nodes though what lies beside them is laid out otherwise.
TEST(SpacePeriods, generated_sides_are_copies) {
  const app::Setup<3> setup = app::build<3>(
      periodic_block(std::string(x_period) + y_period +
                     "[cloud.refine.edge]\nbox = [\"0 0 0 mm\", \"1 0.8 0.1 mm\"]\nspacing = \"0.1 mm\"\n"));
  const Cloud<3>& cloud = setup.problem.cloud;
  int pairs = 0;
  setup.problem.ties.each_group([&](std::span<const NodeIndex> group) {
    const Vec3& x = cloud.position[group[0]];
    for (const NodeIndex i : group.subspan(1)) {
      const Vec3 shift = cloud.position[i] - x;
      EXPECT_NEAR(shift.x() * (1e-3 - std::abs(shift.x())), 0.0, 1e-20);
      EXPECT_NEAR(shift.y() * (0.8e-3 - std::abs(shift.y())), 0.0, 1e-20);
      EXPECT_NEAR(shift.z(), 0.0, 1e-17);
    }
    ++pairs;
  });
  EXPECT_GT(pairs, 60);
}

/// Velocities (0.5 mm/us)·z along x and y between planes that move so: no node feels a force but those held.
TEST(SpacePeriods, a_sheared_block_is_sheared_evenly) {
  const std::string held = R"toml(
[boundary.low]
pieces = ["z-"]
velocity = "0 0 0 m/s"
[boundary.high]
pieces = ["z+"]
velocity = "60 30 0 m/s"
)toml";
  for (const std::string& period :
       {std::string(x_period) + y_period + "[time.step]\nlocal = true\n", std::string(x_period) + y_period})
    for (const std::string& grid : {std::string("false"), std::string("true")}) {
      ExplicitSolver<3> solver = start(periodic_block(period + held, grid), [](const Vec3& x) -> Vec3 {
        return {1e5 * x.z(), 5e4 * x.z(), 0.0};
      });
      for (int n = 0; n < 40; ++n) solver.advance(solver.stable_step().dt);
      const auto& node = solver.state().node;
      const auto& point = solver.state().point;
      EXPECT_GT(point.plastic_strain[0], 0.01);
      for (std::size_t i = 0; i < node.size(); ++i) {
        const double z = node.position[2][i];
        EXPECT_NEAR(node.velocity[0][i], 1e5 * z, 1e-10 * 60.0) << i;
        EXPECT_NEAR(node.velocity[1][i], 5e4 * z, 1e-10 * 60.0) << i;
        EXPECT_NEAR(node.velocity[2][i], 0.0, 1e-10 * 60.0) << i;
        EXPECT_NEAR(point.plastic_strain[i], point.plastic_strain[0], 1e-10) << i;
        EXPECT_NEAR(node.temperature[i], node.temperature[0], 1e-9) << i;
      }
    }
}

/// One equation for all images: what a random start has of momentum and energy stays, and images share
/// velocities and temperatures.
TEST(SpacePeriods, momentum_and_energy_of_a_shaken_block_are_kept) {
  for (const std::string& periods : {std::string(x_period), std::string(x_period) + y_period,
                                     std::string(x_period) + y_period + z_period}) {
    Random random(3);
    ExplicitSolver<3> solver = start(periodic_block(periods), [&](const Vec3&) -> Vec3 {
      return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0, 2)};
    });
    const auto& node = solver.state().node;
    const auto momentum = [&] {
      Vec3 sum = Vec3::Zero();
      for (std::size_t i = 0; i < node.size(); ++i)
        for (int k = 0; k < 3; ++k) sum[k] += node.mass[i] * node.velocity[index_of(k)][i];
      return sum;
    };
    const Vec3 before = momentum();
    double mass = 0.0;
    for (const double m : node.mass) mass += m;
    EXPECT_NEAR(mass, 7850.0 * 0.48e-9, 1e-12 * mass);
    for (int n = 0; n < 60; ++n) solver.advance(solver.stable_step().dt);
    EXPECT_LT((momentum() - before).norm(), 1e-12 * mass);
    solver.conditions().ties.each_group([&](std::span<const NodeIndex> group) {
      for (const NodeIndex i : group) {
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_EQ(node.velocity[k][index_of(i)], node.velocity[k][index_of(group[0])]);
        EXPECT_EQ(node.temperature[index_of(i)], node.temperature[index_of(group[0])]);
      }
    });
    EXPECT_LT(std::abs(solver.ledger().residual()), 1e-3 * solver.ledger().initial());
  }
}

/// A node on a symmetry plane and a periodic one slides along the line of both.
TEST(SpacePeriods, nodes_on_a_symmetry_plane_too_stay_on_it) {
  ExplicitSolver<3> solver =
      start(periodic_block(std::string(x_period) + "[boundary.base]\npieces = [\"z-\"]\nsymmetry = true\n"),
            [](const Vec3& x) -> Vec3 {
              return {3.0, 5.0 * std::sin(8e3 * x.x()), -20.0 * x.z() / 6e-4};
            });
  for (int n = 0; n < 60; ++n) solver.advance(solver.stable_step().dt);
  const auto& node = solver.state().node;
  int both = 0;
  solver.conditions().ties.each_group([&](std::span<const NodeIndex> group) {
    for (const NodeIndex i : group) {
      if (std::abs(solver.conditions().cloud.position[i].z()) > 1e-12) continue;
      ++both;
      EXPECT_EQ(node.velocity[2][index_of(i)], 0.0);
      EXPECT_GT(node.velocity[0][index_of(i)], 1.0);
    }
  });
  EXPECT_EQ(both, 10);
}

/// A slice of a profile with a slot along z whose lips close while the upper one goes along z by half the
/// width of the slice: that half meets the image of the lower lip.
class Lips {
public:
  explicit Lips(bool touch)
      : solver_(
            start(input::read_case_text(R"toml(
[analysis]
kinematics = "three-dimensional"
[time]
end = "1 us"
[domain]
material = "steel"
outer.start = "0 0 mm"
outer.path = [
  { to = "1.2 0 mm" }, { to = "1.2 0.4 mm" }, { to = "0.4 0.4 mm", name = "lower" }, { to = "0.4 0.5 mm" },
  { to = "1.2 0.5 mm", name = "upper" }, { to = "1.2 0.9 mm" }, { to = "0 0.9 mm" }, { to = "0 0 mm" },
]
extrude = { to = "0.4 mm" }
[cloud]
spacing = "0.1 mm"
[periodic.z]
pieces = ["z-", "z+"]
)toml" +
                                            std::string(touch ? "[contact]\ndeformable = true\nfriction = { "
                                                                "law = \"coulomb\", coefficient = 0.2 }\n"
                                                              : "") +
                                            steel_304l,
                                        "case.toml"),
                  [](const Vec3& x) -> Vec3 {
                    return x.y() > 0.45e-3 ? Vec3(5.0, -150.0, 300.0) : Vec3(0.0, 0.0, 0.0);
                  })) {}

  /// m/s.
  Vec3 mean_velocity() const {
    const auto& node = solver_.state().node;
    Vec3 sum = Vec3::Zero();
    double mass = 0.0;
    for (std::size_t i = 0; i < node.size(); ++i) {
      mass += node.mass[i];
      for (int k = 0; k < 3; ++k) sum[k] += node.mass[i] * node.velocity[index_of(k)][i];
    }
    return sum / mass;
  }

  /// m, by how much the upper lip lies in the lower one, or in an image of it.
  double deepest() const {
    double depth = 0.0;
    for (const NodeIndex i : nodes("upper"))
      for (const Facet<3>& facet : solver_.conditions().cloud.facets) {
        if (name(facet) != "lower") continue;
        for (const double period : {-0.4e-3, 0.0, 0.4e-3, 0.8e-3}) {
          const Vec3 x = place(i) - Vec3(0.0, 0.0, period), a = place(facet.node[0]),
                     e = place(facet.node[1]) - a, f = place(facet.node[2]) - a, r = x - a;
          const double area = e.x() * f.z() - e.z() * f.x(), s = (r.x() * f.z() - r.z() * f.x()) / area,
                       t = (e.x() * r.z() - e.z() * r.x()) / area;
          if (s < 0.0 || t < 0.0 || s + t > 1.0) continue;
          depth = std::max(depth, (a + s * e + t * f - x).y());
        }
      }
    return depth;
  }

  /// m, by how much the upper lip has gone beyond the lower one.
  double beyond() const {
    double most = 0.0;
    for (const NodeIndex i : nodes("upper")) most = std::max(most, place(i).z() - 0.4e-3);
    return most;
  }

  void run() {
    while (solver_.state().time < 0.8e-6) {
      solver_.advance(solver_.stable_step().dt);
      deepest_ever_ = std::max(deepest_ever_, deepest());
    }
  }
  /// m, after any step.
  double deepest_ever() const { return deepest_ever_; }
  const ExplicitSolver<3>& solver() const { return solver_; }

private:
  std::string name(const Facet<3>& facet) const {
    return solver_.conditions().cloud.piece_names[facet.piece];
  }
  Vec3 place(NodeIndex i) const { return vector_at<3>(solver_.state().node.position, index_of(i)); }
  std::vector<NodeIndex> nodes(const std::string& piece) const {
    std::vector<NodeIndex> all;
    for (const Facet<3>& facet : solver_.conditions().cloud.facets)
      if (name(facet) == piece) all.insert(all.end(), facet.node.begin(), facet.node.end());
    return all;
  }

  ExplicitSolver<3> solver_;
  double deepest_ever_ = 0.0;
};

TEST(SpacePeriods, lips_that_close_meet_images_of_each_other) {
  Lips lips(true), free(false);
  const Vec3 before = lips.mean_velocity();
  lips.run();
  free.run();
  EXPECT_GT(lips.beyond(), 0.1e-3) << "a quarter of the slice";
  EXPECT_LT(lips.deepest_ever(), 1e-13);
  EXPECT_GT(free.deepest(), 5e-6) << "they would have passed through each other";
  EXPECT_LT((lips.mean_velocity() - before).norm(), 1e-12 * 300.0);
  EXPECT_LT(std::abs(lips.solver().ledger().residual()), 1e-3 * lips.solver().ledger().initial());
}

// Without heat there may be no capacity to weigh the temperatures of images by.
TEST(SpacePeriods, temperatures_stay_through_a_pass_of_metal_that_has_no_heat) {
  const input::Case input = input::read_case_text(R"toml(
[analysis]
kinematics = "three-dimensional"
thermal = false
[time]
end = "1 us"
[domain]
material = "metal"
block = { from = "0 0 0 mm", to = "1 0.8 0.6 mm" }
[cloud]
spacing = "0.2 mm"
[materials.metal]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
[adapt]
resample = true
[initial]
temperature = "350 K"
)toml" + std::string(x_period),
                                                  "case.toml");
  ExplicitSolver<3> solver = start(input, [](const Vec3& x) -> Vec3 { return {1e5 * x.z(), 0.0, 0.0}; });
  app::SpaceAdaptation adaptation(input, solver);
  for (int n = 0; n < 5; ++n) solver.advance(solver.stable_step().dt);
  adaptation.renew(solver, [](const Resampling<3>&) {});
  for (const double temperature : solver.state().node.temperature) EXPECT_NEAR(temperature, 350.0, 1e-10);
}

} // namespace
} // namespace cnem::testing
