// Keys that follow from constants declared in the libraries.
#include "input/constants.hpp"

#include <gtest/gtest.h>
#include <stdexcept>

namespace cnem::input {
namespace {

struct Simple {
  double a = 0.0, b = 2.5, c = infinite, d = 1.0;

  static constexpr const char* name = "simple";
  static constexpr const char* formula = "a + b";
  static constexpr const char* source = "Hooke 1678";
  static constexpr Parameter<Simple> parameters[] = {
      {&Simple::a, {.name = "a", .unit = "Pa", .range = positive, .required = true, .example = "3 MPa"}},
      {&Simple::b, {.name = "b", .meaning = "What it is.", .source = "Newton 1687"}},
      {&Simple::c, {.name = "c", .unit = "K"}},
      {&Simple::d, {.name = "d", .unit = "1/s", .range = fraction}}};
};

struct Other {
  double a = 0.0;

  static constexpr const char* name = "other";
  static constexpr const char* formula = "a";
  static constexpr const char* source = "";
  static constexpr Parameter<Other> parameters[] = {{&Other::a, Simple::parameters[0].info}};
};

struct Contradiction {
  double a = 0.0;

  static constexpr const char* name = "contradiction";
  static constexpr const char* formula = "a";
  static constexpr const char* source = "";
  static constexpr Parameter<Contradiction> parameters[] = {
      {&Contradiction::a, {.name = "a", .unit = "K", .required = true}}};
};

TEST(Constants, make_their_keys) {
  Keys k;
  const std::vector<LawText> laws = law_texts(Laws<Simple, Other>{});
  add_law_choice(k, "here", laws).required();
  add_law_constants(k, "here", laws);
  ASSERT_EQ(k.all.size(), 5U);
  EXPECT_EQ(k.all[0].path, "here.law");
  EXPECT_EQ(k.all[0].choices, (std::vector<std::string>{"simple", "other"}));
  EXPECT_EQ(k.all[0].doc, "`simple`: a + b (Hooke 1678); `other`: a.");
  const Key &a = k.all[1], &b = k.all[2], &c = k.all[3], &d = k.all[4];
  EXPECT_EQ(a.path, "here.a");
  EXPECT_EQ(a.dimension, dimension::pressure);
  EXPECT_EQ(a.presence, Presence::required);
  EXPECT_EQ(a.example, "\"3 MPa\"");
  EXPECT_EQ(a.when.values, (std::vector<std::string>{"simple", "other"})) << "one key for both";
  EXPECT_FALSE(a.range.contains(0.0));
  EXPECT_EQ(b.doc, "What it is (Newton 1687).");
  EXPECT_EQ(b.fallback, "2.5");
  EXPECT_EQ(b.when.values, std::vector<std::string>{"simple"});
  EXPECT_EQ(c.presence, Presence::optional) << "infinite: none";
  EXPECT_EQ(d.fallback, "\"1 /s\"");
}

TEST(Constants, of_one_name_must_agree) {
  Keys k;
  EXPECT_THROW(add_law_constants(k, "here", law_texts(Laws<Simple, Contradiction>{})), std::logic_error);
}

} // namespace
} // namespace cnem::input
