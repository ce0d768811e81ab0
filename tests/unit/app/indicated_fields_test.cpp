// Fields that refinement follows: their values, and that a case can name each of them.
#include "adapt/indicated_fields.hpp"
#include "input/schema/schema.hpp"

#include <gtest/gtest.h>

namespace cnem::app {
namespace {

using adapt::IndicatedField;

TEST(IndicatedFields, give_what_their_names_say) {
  PointState<2> point;
  point.damaged.switch_on(true);
  for (FieldTable* table : {&point.table, &point.damaged}) table->rest(2);
  point.plastic_strain[1] = 0.25;
  point.plastic_rate[1] = 1e4;
  point.equivalent_stress[1] = 5e8;
  point.plastic_work[1] = 3e8;
  point.temperature[1] = 700.0;
  point.damage[1] = 0.5;
  EXPECT_EQ(adapt::indicated_field("plastic_strain")->in_plane(point, 1), 0.25);
  EXPECT_EQ(adapt::indicated_field("plastic_power")->in_plane(point, 1), 5e12);
  EXPECT_EQ(adapt::indicated_field("plastic_work")->in_plane(point, 1), 3e8);
  EXPECT_EQ(adapt::indicated_field("temperature")->in_plane(point, 1), 700.0);
  EXPECT_EQ(adapt::indicated_field("damage")->in_plane(point, 1), 0.5);
  for (const IndicatedField& field : adapt::indicated_fields()) EXPECT_EQ(field.in_plane(point, 0), 0.0);
  EXPECT_EQ(adapt::indicated_field("none"), nullptr);
}

TEST(IndicatedFields, are_the_same_in_space) {
  PointState<3> point;
  point.table.rest(2);
  point.plastic_rate[1] = 1e4;
  point.equivalent_stress[1] = 5e8;
  EXPECT_EQ(adapt::indicated_field("plastic_power")->values(point), (Field{0.0, 5e12}));
}

TEST(IndicatedFields, are_the_choices_of_the_case) {
  const auto& known = input::find_key("adapt.indicator.field")->choices;
  ASSERT_EQ(known.size(), adapt::indicated_fields().size() + 1);
  EXPECT_EQ(known.front(), "none");
  for (std::size_t k = 0; k + 1 < known.size(); ++k)
    EXPECT_EQ(known[k + 1], adapt::indicated_fields()[k].name);
}

} // namespace
} // namespace cnem::app
