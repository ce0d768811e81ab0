// Elements of a field that others hold.
#include "core/fields/aligned.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <utility>

namespace cnem {
namespace {

TEST(KeptField, elements_are_aligned_and_stay_when_the_field_takes_others) {
  Field field(100, 1.5);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(field.data()) % 64, 0U);
  const KeptField kept(field);
  EXPECT_EQ(kept.data(), field.data());
  EXPECT_TRUE(kept.is_of(field));
  field[3] = 2.5; // what the field does with them shows
  EXPECT_EQ(kept.data()[3], 2.5);
  field = Field(5000, 7.0);
  EXPECT_FALSE(kept.is_of(field));
  EXPECT_EQ(kept.size(), 100U);
  for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_EQ(kept.data()[i], i == 3 ? 2.5 : 1.5);
}

TEST(KeptField, elements_outlive_the_field_and_are_of_it_no_more_once_it_grows) {
  auto field = std::make_unique<Field>(10, 1.0);
  KeptField kept(*field);
  field->reserve(11);
  field->push_back(2.0);
  EXPECT_FALSE(kept.is_of(*field));
  field.reset();
  EXPECT_EQ(kept.data()[9], 1.0);
  const KeptField moved(std::move(kept));
  EXPECT_EQ(moved.data()[0], 1.0);
}

TEST(KeptField, of_no_elements_holds_nothing) {
  const Field none;
  const KeptField kept(none);
  EXPECT_EQ(kept.size(), 0U);
  EXPECT_TRUE(kept.is_of(none));
}

} // namespace
} // namespace cnem
