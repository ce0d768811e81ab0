// The marks that follow from an indicator of a front at x = 0.2, in the plane and in space.
#include "adapt/marking.hpp"
#include "adapt/plane/indicator.hpp"
#include "adapt/space/indicator.hpp"
#include "clouds/tetrahedral_block.hpp"
#include "tests/clouds.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace cnem::adapt {
namespace {

double front_at(double x) { return std::tanh((x - 0.2) / 0.05); }

struct PlaneFront {
  static constexpr int dim = 2;
  static constexpr double spacing = 0.08, far = 0.6, budget = 180;
  Cloud<2> cloud;
  Structure structure;

  PlaneFront() {
    testing::add_loop(cloud, {{0, 0}, {1, 0}, {1, 0.4}, {0.4, 0.4}, {0.4, 1}, {0, 1}}, spacing);
    testing::fill(cloud, testing::Lattice::hexagonal, spacing, 0.25, 0.5 * spacing, 3);
    structure = build_structure(cloud);
  }
  Indicator of(const Field& value) const { return indicator(cloud, structure, value); }
};

struct SpaceFront {
  static constexpr int dim = 3;
  static constexpr double spacing = 0.2, far = 0.7, budget = 350;
  Cloud<3> cloud;
  SpaceStructure structure;

  SpaceFront() {
    const clouds::TetrahedralBlock block = clouds::tetrahedral_block({1, 1, 1}, {5, 5, 5}, [](const Vec3& x) {
      return Vec3(x.x() + 0.05 * x.y() * x.z(), x.y() + 0.03 * x.x() * x.x(), x.z() * (1.0 + 0.1 * x.x()));
    });
    cloud = block.cloud;
    structure = structure_of(cloud, voronoi::connected(cloud, block.tetrahedra), scni::CellKind::median);
  }
  Indicator of(const Field& value) const {
    return indicator(cloud, structure, scni::CellKind::median, value);
  }
};

template<class Front> struct Marked : Front {
  static constexpr double h = Front::spacing;
  MarkingRules rules{.tolerance = 0.1, .coarsen = 0.05, .h_min = 0.25 * h, .h_max = 2.0 * h};
  Field value, size;

  Marked() {
    for (const auto& x : this->cloud.position) value.push_back(front_at(x.x()));
    size.assign(value.size(), h);
  }
  Marking mark_now() { return mark<Front::dim>(this->cloud, this->structure, this->of(value), rules, size); }
};

template<class Front> class Marks : public ::testing::Test {};
using Fronts = ::testing::Types<PlaneFront, SpaceFront>;
TYPED_TEST_SUITE(Marks, Fronts);

TYPED_TEST(Marks, refine_at_the_front_and_coarsen_where_nothing_happens) {
  Marked<TypeParam> m;
  const Marking marking = m.mark_now();
  EXPECT_GT(marking.refined, 5);
  EXPECT_GT(marking.coarsened, 5);
  for (std::size_t i = 0; i < m.size.size(); ++i) {
    const double x = m.cloud.position[i].x();
    if (std::abs(x - 0.2) < 0.02) {
      EXPECT_EQ(m.size[i], 0.5 * m.h) << x;
    } else if (x > TypeParam::far) {
      EXPECT_EQ(m.size[i], 2.0 * m.h) << x;
    }
  }
}

TYPED_TEST(Marks, wait_until_the_cloud_has_followed) {
  Marked<TypeParam> m;
  m.mark_now();
  const Field once = m.size;
  m.mark_now();
  EXPECT_EQ(m.size, once);
}

TYPED_TEST(Marks, keep_to_the_range_and_the_budget) {
  Marked<TypeParam> m;
  m.rules.h_min = 0.75 * m.h;
  m.rules.h_max = 1.25 * m.h;
  m.mark_now();
  for (const double h : m.size) {
    EXPECT_GE(h, 0.75 * m.h);
    EXPECT_LE(h, 1.25 * m.h);
  }
  Marked<TypeParam> poor;
  poor.rules.max_nodes = static_cast<std::int64_t>(TypeParam::budget);
  poor.rules.coarsen = 0.0;
  const Marking marking = poor.mark_now();
  EXPECT_GT(marking.tolerance, poor.rules.tolerance);
  limit_growth<TypeParam::dim>(poor.cloud, poor.structure, poor.rules.growth, poor.size);
  EXPECT_LE(nodes_wanted(poor.structure, poor.size), TypeParam::budget);
}

TYPED_TEST(Marks, grow_no_faster_than_asked) {
  Marked<TypeParam> m;
  m.size[10] = 0.1 * m.h;
  limit_growth<TypeParam::dim>(m.cloud, m.structure, 0.3, m.size);
  for (const NodeIndex i : m.cloud.position.indices())
    for (const NodeIndex k : m.structure.neighbours(i))
      EXPECT_LE(m.size[index_of(k)],
                m.size[index_of(i)] + 0.3 * (m.cloud.position[k] - m.cloud.position[i]).norm() + 1e-12);
  EXPECT_EQ(m.size[10], 0.1 * m.h);
}

} // namespace
} // namespace cnem::adapt
