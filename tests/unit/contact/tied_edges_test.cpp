// Edges on a seam, where sides that are tied end: each side has its own, and both bear.
#include "space_masses.hpp"
#include "tests/index_literals.hpp"

#include <gtest/gtest.h>
#include <initializer_list>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;
using namespace cnem::testing::literals;

namespace {

/// A roof with its ridge along x, in halves that are tied along the plane through the ridge, and a second
/// one, upside down with its ridge along y, that comes down on it and slides along x.
struct Roofs : SpaceMasses {
  static constexpr double apart = 5.0; ///< m, of the planes where the seam is periodic
  std::vector<std::int32_t> group;

  int add_all(std::initializer_list<Vec3> places, double m, const Vec3& velocity, bool tied) {
    const int first = nodes();
    for (const Vec3& place : places) {
      add(place, m, velocity);
      const bool on_seam = tied && std::abs(std::remainder(place.y(), apart)) < 0.01;
      group.push_back(on_seam ? (place.x() > 0.0 ? 1 : 0) + (place.z() < -0.5 ? 2 : 0) : -1);
    }
    return first;
  }
  /// Of the side at y < 0 (−1) or y > 0 (1), moved by y.
  void half(int side, double y) {
    const double out = y + side;
    const int first = add_all({{-1, y, 0}, {1, y, 0}, {-1, y, -1}, {1, y, -1}, {-1, out, -1}, {1, out, -1}},
                              1.0, Vec3::Zero(), true);
    const auto facet_of = [&](int a, int b, int c, int piece) {
      if (side > 0) std::swap(b, c);
      facet(first + a, first + b, first + c);
      facets.back().piece = as<PieceIndex>(piece);
    };
    facet_of(0, 4, 5, 0), facet_of(0, 5, 1, 0);
    facet_of(2, 5, 4, 0), facet_of(2, 3, 5, 0);
    facet_of(0, 2, 4, 0), facet_of(1, 5, 3, 0);
    const int plane = side > 0 ? 1 : 2;
    facet_of(0, 1, 3, plane), facet_of(0, 3, 2, plane);
  }
  void upper() {
    const int first =
        add_all({{0, -1, 0.01}, {0, 1, 0.01}, {-0.2, -1, 1}, {-0.2, 1, 1}, {0.2, -1, 1}, {0.2, 1, 1}}, 2.0,
                {0.5, 0, -1.0}, false);
    const auto facet_of = [&](int a, int b, int c) { facet(first + a, first + b, first + c); };
    facet_of(0, 2, 3), facet_of(0, 3, 1), facet_of(0, 1, 5), facet_of(0, 5, 4);
    facet_of(2, 4, 5), facet_of(2, 5, 3), facet_of(0, 4, 2), facet_of(1, 3, 5);
  }
  /// `shift`: of the seam in periods, −1 of its upper side, 1 of its lower; 0: an interface.
  void start(bool tied, int shift) {
    contact = std::make_shared<RigidContact<3>>(std::vector<Tool<3>>{}, Space::plane,
                                                BodyContactLaw{true, TrescaLimited{100.0, 0.5}});
    if (shift != 0) contact->repeat({{Vec3(0, apart, 0)}, {1_piece, 2_piece}});
    IndexedVector<NodeIndex, std::int32_t> groups;
    for (const std::int32_t g : group) groups.push_back(g);
    contact->set_boundary(facets, mass.size(), {}, tied ? groups : decltype(groups){});
    flow_stress.assign(contact->boundary_nodes().size(), 10.0);
  }
};

} // namespace

TEST(TiedEdges, on_a_seam_bear_what_both_bear) {
  for (const int shift : {0, 1, -1})
    for (const bool upper_first : {false, true}) {
      const auto crossed = [&](bool tied, int seam) {
        Roofs roofs;
        if (upper_first) roofs.upper();
        roofs.half(1, seam < 0 ? -Roofs::apart : 0.0);
        roofs.half(-1, seam > 0 ? Roofs::apart : 0.0);
        if (!upper_first) roofs.upper();
        roofs.start(tied, seam);
        for (int n = 0; n < 11; ++n) roofs.step(1e-3);
        return roofs;
      };
      const Roofs tied = crossed(true, shift),
                  apart = crossed(false, 1); // where the halves do not meet each other
      const Vec3 all = tied.momentum();
      EXPECT_LT((all - Vec3(6.0, 0, -12.0)).norm(), 1e-12);
      const int upper = upper_first ? 0 : 12, one = upper_first ? 6 : 0, other = one + 6;
      const auto lost = [&](const Roofs& roofs) { // by the upper one's ridge
        return Vec3(2.0 * (Vec3(1.0, 0, -2.0) - roofs.velocity(upper) - roofs.velocity(upper + 1)));
      };
      EXPECT_GT(-lost(tied).z(), 0.5);
      EXPECT_NEAR(lost(tied).x(), lost(apart).x(), 1e-4 * lost(apart).x())
          << shift << upper_first << ": halves that are not tied move apart meanwhile";
      EXPECT_GT(lost(tied).x(), 1e-3);
      EXPECT_LT(lost(tied).x(), -lost(tied).z()) << "it slips";
      for (int i = 0; i < 4; ++i)
        EXPECT_EQ(tied.velocity(one + i), tied.velocity(other + i)) << shift << upper_first << i;
      // of equal masses each side has half
      const auto& impulse = tied.contact->nodal_impulse();
      for (int i = 0; i < 2; ++i)
        EXPECT_LT(
            (impulse[as<BoundaryNodeIndex>(one + i)] - impulse[as<BoundaryNodeIndex>(other + i)]).norm(),
            1e-12)
            << shift << upper_first << i;
    }
}
