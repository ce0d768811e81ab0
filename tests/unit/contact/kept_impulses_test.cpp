// What is kept of a step for the sweeps of the next.
#include "contact/kept_impulses.hpp"
#include "core/index.hpp"
#include "tests/index_literals.hpp"

#include <gtest/gtest.h>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::testing::literals;

namespace {

Contact<3> contact_at(FacetIndex facet, BoundaryNodeIndex node, double pressing, bool swept = true) {
  Contact<3> contact;
  contact.facet = facet;
  contact.node = {node, 7_boundary, 8_boundary, 9_boundary};
  contact.weight = {1.0, -0.5, -0.5, 0.0};
  contact.normal = {0, 0, 1};
  contact.pressing = pressing;
  contact.sliding = {0.1 * pressing, 0, 0};
  contact.swept = swept;
  return contact;
}

} // namespace

TEST(KeptImpulses, are_of_what_is_swept_and_presses) {
  KeptImpulses<3> kept;
  kept.keep({contact_at(as<FacetIndex>(4), 2_boundary, 6.0), contact_at(as<FacetIndex>(3), 1_boundary, 0.0),
             contact_at(as<FacetIndex>(5), 3_boundary, 1.0, false)},
            0.5, 1e-9);
  const Contact<3>* const found = kept.find(contact_at(as<FacetIndex>(4), 2_boundary, 0.0));
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->pressing, 12.0); // N
  EXPECT_EQ(found->sliding.x(), 0.1 * 6.0 / 0.5);
  EXPECT_EQ(kept.find(contact_at(as<FacetIndex>(3), 1_boundary, 0.0)), nullptr);
  EXPECT_EQ(kept.find(contact_at(as<FacetIndex>(5), 3_boundary, 0.0)), nullptr);
  Contact<3> image = contact_at(as<FacetIndex>(4), 2_boundary, 0.0);
  image.shift = {1, 0, 0};
  EXPECT_EQ(kept.find(image), nullptr);
  EXPECT_TRUE(kept.covers(contact_at(as<FacetIndex>(9), 2_boundary, 0.0)));
  EXPECT_FALSE(kept.covers(contact_at(as<FacetIndex>(9), 1_boundary, 0.0)));
  EXPECT_FALSE(kept.covers(contact_at(as<FacetIndex>(9), 9_boundary, 0.0))) << "it had no weight";
  EXPECT_EQ(kept.left(), 1e-9);
  kept.keep({}, 0.5, 1e-9);
  EXPECT_TRUE(kept.empty());
  EXPECT_EQ(kept.left(), 0.0);
}
