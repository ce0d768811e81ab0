// Passes on a body that continues a period away: both sides keep the same nodes at the same distance while
// their surfaces are split, collapsed and flipped.
#include "adapt/space/periods.hpp"
#include "adapt/space/resample.hpp"
#include "core/geometry/mates.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/space/crossings.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace cnem::adapt {
namespace {

using testing::piece_of;

/// A cube of unit density with these axes periodic.
struct Periodic {
  Cloud<3> cloud;
  SpaceRules rules;
  Field mass, jacobian, size;
  PassReport total;

  explicit Periodic(const std::vector<std::string>& axes, int cells = 6) {
    // lattice nodes stand on both sides alike, diagonals do not
    voronoi::RecoveredBoundary recovered = testing::recovered({.cells = cells});
    cloud = recovered.cloud;
    for (const std::string& axis : axes)
      rules.periods.push_back({piece_of(cloud, axis + "-"), piece_of(cloud, axis + "+")});
    const SpaceStructure structure = structure_of(cloud, std::move(recovered.tetrahedra));
    mass = structure.cell;
    jacobian.assign(mass.size(), 1.0);
    size.assign(mass.size(), 1.0 / cells);
  }

  Resampling<3> resampled(PassReport& report) const {
    NodeProperties properties;
    properties.mass = mass;
    properties.jacobian = jacobian;
    properties.density.assign(mass.size(), 1.0);
    properties.size = size;
    properties.held.assign(mass.size(), 0);
    return resample(cloud, std::move(properties), rules, report);
  }

  /// One pass; what must hold after each.
  void pass() {
    PassReport report;
    const double before = enclosed_measure(cloud);
    const Resampling<3> change = resampled(report);
    for (const Period& period : rules.periods) {
      const auto pairs = shifted_nodes(change.cloud, period);
      const Vec3 shift = change.cloud.position[pairs[0][1]] - change.cloud.position[pairs[0][0]];
      for (const auto& [a, b] : pairs) {
        EXPECT_LT((change.cloud.position[b] - change.cloud.position[a] - shift).norm(), 1e-13);
        if (report.recut == 0) { // else a corner may have come to one side and be old on the other
          EXPECT_EQ(exists(change.old_of[a]), exists(change.old_of[b]));
        }
        if (exists(change.old_of[a])) {
          EXPECT_EQ(change.cloud.position[a], cloud.position[change.old_of[a]]);
        }
      }
    }
    EXPECT_TRUE(voronoi::crossings(change.cloud).empty());
    carry_mean(change.parcels, mass, jacobian);
    carry_sum(change.parcels, mass);
    carry_label(change.labels, size);
    cloud = change.cloud;
    EXPECT_NEAR(enclosed_measure(cloud), before, 2e-3 * before);
    double sum = 0.0;
    for (const double m : mass) sum += m;
    EXPECT_NEAR(sum, 1.0, 1e-12);
    total += report;
  }
};

/// Stretched across the period, with a wave that repeats: facets on it become long in one direction and short
/// in the other, and the planes bulge.
TEST(Periods, sides_stay_copies_while_a_body_flows) {
  Periodic body({"x"});
  const std::size_t nodes = body.cloud.position.size();
  for (int n = 0; n < 8; ++n) {
    const double stretch = 1.1;
    for (Vec3& x : body.cloud.position)
      x = Vec3(x.x() + 0.02 * std::sin(3.0 * x.z()) + 0.01 * std::sin(2.0 * std::numbers::pi * x.x()),
               x.y() / stretch, x.z() * stretch);
    body.pass();
  }
  EXPECT_GT(body.total.inserted_boundary, 40);
  EXPECT_GT(body.total.removed_boundary, 20);
  EXPECT_GT(body.total.recut, 10); // where the planes bulge
  EXPECT_GT(body.total.flipped, 40);
  EXPECT_GT(body.cloud.position.size(), nodes / 2);
}

/// Edges along z are groups of four.
TEST(Periods, two_directions_meet_in_edges) {
  Periodic body({"x", "y"});
  for (int n = 0; n < 6; ++n) {
    for (Vec3& x : body.cloud.position)
      x = Vec3(x.x() + 0.03 * std::sin(2.0 * x.z()), x.y() + 0.02 * x.z() * x.z(), x.z() * 1.12);
    body.pass();
  }
  EXPECT_GT(body.total.inserted_boundary, 20);
}

/// At the border of a side a node with next to no matter goes along it, and its image with it; where three
/// pieces meet and within a side it stays.
TEST(Periods, nodes_without_matter_go_from_borders) {
  Periodic body({"x"});
  constexpr double h = 1.0 / 6;
  const PeriodImages images(body.cloud, body.rules.periods);
  SurfaceRules rules;
  rules.still.assign(body.rules.periods[0].begin(), body.rules.periods[0].end());
  const auto goes = [&](const Vec3& x) {
    const auto& place = body.cloud.position;
    const auto i = as<NodeIndex>(
        std::find_if(place.begin(), place.end(), [&](const Vec3& y) { return (y - x).norm() < 1e-9; }) -
        place.begin());
    const NodeIndex image = images.image(i, body.rules.periods[0][0]);
    Field size = body.size, matter(size.size(), 0.1 * h * h * h);
    matter[index_of(i)] = 1e-4 * h * h * h;
    WorkingSurface surface(body.cloud, IndexedVector<NodeIndex, char>(place.size(), 0), rules);
    PassReport report;
    const RefinedSurface refined = refine_surface(surface, size, matter, {}, report, images);
    EXPECT_TRUE(exists(image));
    EXPECT_EQ(exists(refined.into[i]), exists(refined.into[image]));
    if (exists(refined.into[i])) {
      EXPECT_EQ(images.image(refined.into[i], body.rules.periods[0][0]), refined.into[image]);
      EXPECT_NEAR(surface.at(refined.into[i]).z(), 1.0, 1e-12);
    }
    return exists(refined.into[i]);
  };
  EXPECT_TRUE(goes(Vec3(0.0, 0.5, 1.0)));
  EXPECT_FALSE(goes(Vec3(0.0, 0.0, 1.0)));
  EXPECT_FALSE(goes(Vec3(0.0, 0.5, 0.5)));
}

/// Where a side has come through the skin no two parts of the metal are at one place.
TEST(Periods, crossings_of_sides_are_counted_apart) {
  for (const bool of_side : {true, false}) {
    Periodic body({"x"});
    const double h = body.size[0];
    for (Vec3& x : body.cloud.position) {
      const bool in_side = x.x() < 1e-9 || x.x() > 1.0 - 1e-9, below = std::abs(x.z() - (1.0 - h)) < 1e-9,
                 beside_middle = std::abs(x.y() - 0.5) < 1.1 * h;
      if (of_side && in_side && below && beside_middle)
        x += h * Vec3(0.6, 0.0, 1.05);
      else if (!of_side && (x - Vec3(0.5, 0.0, 1.0)).norm() < 1e-9)
        x += h * Vec3(1.15, 0.0, -0.1);
    }
    PassReport report;
    const Resampling<3> change = body.resampled(report);
    EXPECT_GT(report.crossings, 0);
    EXPECT_EQ(report.side_crossings, of_side ? report.crossings : 0);
    EXPECT_TRUE(voronoi::crossings(change.cloud).empty());
  }
}

/// Where one side of a period asks for finer cells, the other gets them too.
TEST(Periods, what_is_refined_on_one_side_is_refined_on_the_other) {
  Periodic body({"x"});
  for (const NodeIndex i : body.cloud.position.indices())
    if (const Vec3& x = body.cloud.position[i]; x.x() < 0.1 && x.y() < 0.4 && x.z() < 0.4)
      body.size[index_of(i)] *= 0.5;
  body.pass();
  int fine = 0;
  for (const Vec3& x : body.cloud.position) fine += x.x() > 1.0 - 1e-9 && x.y() < 0.4 && x.z() < 0.4;
  EXPECT_GT(fine, 2 * 9);
}

TEST(Periods, facets_of_the_second_side_become_those_of_the_first) {
  Cloud<3> cloud = testing::recovered({.cells = 4}).cloud;
  const std::array<Period, 1> periods{{{piece_of(cloud, "x-"), piece_of(cloud, "x+")}}};
  const double volume = enclosed_measure(cloud);
  repeat_facets(cloud, periods);
  EXPECT_NEAR(enclosed_measure(cloud), volume, 1e-13);
  const PeriodImages images(cloud, periods);
  WorkingSurface surface(cloud, IndexedVector<NodeIndex, char>(cloud.position.size(), 0),
                         {.still = {periods[0][0], periods[0][1]}});
  const AlikeEdits alike(surface, images);
  int pairs = 0;
  for (WorkingSurface::Edge e = 0; e < surface.edges(); ++e) {
    const bool on_period =
        surface.is_still(surface.piece(e)) || surface.is_still(surface.piece(surface.across(e)));
    EXPECT_EQ(alike.edges(e).size(), on_period ? 2U : 1U);
    pairs += on_period;
  }
  EXPECT_GT(pairs, 100);
}

} // namespace
} // namespace cnem::adapt
