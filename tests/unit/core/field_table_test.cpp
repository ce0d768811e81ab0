// Fields declared once: what follows from the line of a field.
#include "core/fields/state.hpp"
#include "tests/index_literals.hpp"

#include <gtest/gtest.h>
#include <map>

namespace cnem {

using namespace testing::literals;

namespace {

struct Group {
  FieldTable table{"group"};
  ScalarField mass{table, {"mass", "kg", Carry::sum, Checkpoint::holds}};
  ScalarField strain{table, {"strain", "1", Carry::mass_mean, Checkpoint::holds}};
  ScalarField heat{table, {"heat", "K", Carry::capacity_mean, Checkpoint::omits}};
  TensorField<2> velocity{table, {"velocity", "m/s", Carry::inertia_mean, Checkpoint::holds}};
  TensorField<2> place{table, {"place", "m", Carry::label, Checkpoint::holds}};
  TensorField<4> tensor{table, {"tensor", "1", Carry::renewed, Checkpoint::omits, rest_unit_symmetric}};
  LabelField material{table, "material"};

  Group() = default;
  Group(const Group& other) : Group() { *this = other; }
  ~Group() = default;
  Group& operator=(const Group&) = default;
};

/// Keeps what it is given by name.
class Kept : public Archive {
public:
  explicit Kept(bool loading) : loading_(loading) {}
  bool loading() const override { return loading_; }
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::vector<std::int64_t>> labels;

protected:
  std::size_t extent(const std::string& name) override {
    return labels.count(name) != 0 ? labels[name].size() : numbers[name].size();
  }
  void carry(const std::string& name, const char*, std::span<double> values) override {
    if (loading_)
      std::copy(numbers.at(name).begin(), numbers.at(name).end(), values.begin());
    else
      numbers[name].assign(values.begin(), values.end());
  }
  void carry(const std::string& name, std::span<std::int64_t> values) override {
    if (loading_)
      std::copy(labels.at(name).begin(), labels.at(name).end(), values.begin());
    else
      labels[name].assign(values.begin(), values.end());
  }
  void carry(const std::string&, std::string&) override {}

private:
  bool loading_;
};

Group three() {
  Group group;
  group.table.rest(3);
  group.mass = Field{1.0, 3.0, 2.0};
  group.strain = Field{0.1, 0.5, 0.9};
  group.heat = Field{300.0, 400.0, 500.0};
  group.velocity[0] = {1.0, 5.0, 9.0};
  group.place[1] = {0.0, 1.0, 2.0};
  group.material = std::vector<std::int32_t>{4, 5, 6};
  return group;
}

TEST(FieldTable, sizes_fields_at_rest) {
  Group group;
  group.table.rest(2);
  EXPECT_EQ(group.mass, (Field{0.0, 0.0}));
  EXPECT_EQ(group.tensor[2], (Field{1.0, 1.0}));
  EXPECT_EQ(group.tensor[3], (Field{0.0, 0.0}));
  EXPECT_EQ(group.material.size(), 2U);
  group.table.switch_on(false);
  group.table.rest(2);
  EXPECT_TRUE(group.mass.empty());
  EXPECT_TRUE(group.material.empty());
}

TEST(FieldTable, carries_each_field_by_its_rule) {
  Group group = three();
  group.tensor[0] = {7.0, 7.0, 7.0};
  // the first node, and one of half the second and all of the third
  const NodeRows parcels{{0, 1, 3}, {0_node, 1_node, 2_node}, {1.0, 0.5, 1.0}},
      labels{{0, 1, 2}, {0_node, 2_node}, {1.0, 1.0}};
  group.table.carry_over(
      CarryWeights<NodeIndex>{parcels, labels, group.mass, {1.0, 1.0, 4.0}, {1.0, 2.0, 3.0}});
  group.table.rest_renewed(2);
  EXPECT_EQ(group.mass, (Field{1.0, 3.5}));
  EXPECT_NEAR(group.strain[1], (1.5 * 0.5 + 2.0 * 0.9) / 3.5, 1e-15);
  EXPECT_NEAR(group.heat[1], (1.0 * 400.0 + 3.0 * 500.0) / 4.0, 1e-12);
  EXPECT_NEAR(group.velocity[0][1], (0.5 * 5.0 + 4.0 * 9.0) / 4.5, 1e-14);
  EXPECT_EQ(group.place[1], (Field{0.0, 2.0}));
  EXPECT_EQ(group.material, (std::vector<std::int32_t>{4, 6}));
  EXPECT_EQ(group.tensor[0], (Field{1.0, 1.0})) << "made anew";
  EXPECT_EQ(group.strain[0], 0.1) << "bits of a node that nothing happened to";
}

TEST(FieldTable, archives_what_checkpoints_hold_under_its_path) {
  Group group = three();
  Kept out(false);
  group.table.archive(out);
  EXPECT_EQ(out.numbers.size(), 6U) << "mass, strain, two components each of velocity and place";
  EXPECT_EQ(out.numbers.at("group/velocity.0"), (std::vector<double>{1.0, 5.0, 9.0}));
  EXPECT_EQ(out.numbers.count("group/heat"), 0U);
  Group other;
  other.table.rest(3);
  Kept in(true);
  in.numbers = out.numbers;
  in.labels = out.labels;
  other.table.archive(in);
  EXPECT_EQ(other.strain, group.strain);
  EXPECT_EQ(other.material, group.material);
  EXPECT_EQ(other.heat, (Field{0.0, 0.0, 0.0}));
}

TEST(FieldTable, of_a_copy_is_its_own) {
  Group group = three();
  Group copy = group;
  EXPECT_EQ(copy.table.entries().size(), group.table.entries().size());
  copy.table.rest(1);
  EXPECT_EQ(copy.mass.size(), 1U);
  EXPECT_EQ(group.mass, (Field{1.0, 3.0, 2.0}));
  copy = group;
  EXPECT_EQ(copy.place[1], group.place[1]);
  EXPECT_EQ(copy.table.entries().front().component, &copy.mass);
}

/// Names are what checkpoints and users know fields by.
TEST(FieldTable, names_of_the_state_are_unique_and_have_units) {
  const State<3> state;
  std::map<std::string, int> seen;
  for (const FieldTable* table : {&state.node.table, &state.node.scaling})
    for (const FieldTable::Entry& entry : table->entries()) {
      EXPECT_EQ(++seen[std::string("node/") + entry.line.name], 1) << entry.line.name;
      EXPECT_NE(std::string(entry.line.unit), "") << entry.line.name;
    }
  for (const FieldTable* table : {&state.point.table, &state.point.damaged, &state.point.oriented})
    for (const FieldTable::Entry& entry : table->entries()) {
      EXPECT_EQ(++seen[std::string("point/") + entry.line.name], 1) << entry.line.name;
      EXPECT_NE(std::string(entry.line.unit), "") << entry.line.name;
    }
}

} // namespace
} // namespace cnem
