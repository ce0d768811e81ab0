// What is made of the schema: JSON Schema and the case reference.
#include "input/schema/schema.hpp"
#include "tests/unit/input/case_text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace cnem::input {
namespace {

TEST(Schema, KeysAreUniqueAndHaveParents) {
  std::set<std::string> seen;
  for (const Key& key : schema()) {
    EXPECT_TRUE(seen.insert(key.path).second) << key.path;
    if (key.parent().empty() || key.parent().ends_with("[]")) continue;
    EXPECT_TRUE(seen.contains(key.parent())) << key.path << " stands before its table";
  }
  EXPECT_GT(seen.size(), 100U);
}

TEST(Schema, ConditionsReferToChoicesThatComeFirst) {
  for (const Key& key : schema()) {
    if (key.when.sibling.empty()) continue;
    const Key* sibling = find_key(key.parent() + "." + key.when.sibling);
    ASSERT_TRUE(sibling) << key.path;
    EXPECT_LT(sibling, &key) << key.path;
    for (const std::string& value : key.when.values)
      EXPECT_NE(std::find(sibling->choices.begin(), sibling->choices.end(), value), sibling->choices.end())
          << key.path << ' ' << value;
  }
}

TEST(Schema, ExamplesOfWholeNumbersAreSome) {
  for (const Key& key : schema())
    if (key.type == Type::integer) {
      EXPECT_EQ(key.example_text().find_first_not_of("0123456789"), std::string::npos)
          << key.path << ' ' << key.example_text();
    }
}

/// The schema of the values of a key, found by walking down the JSON as an editor does.
nlohmann::json at_key(const nlohmann::json& root, const std::string& path) {
  nlohmann::json at = root;
  std::istringstream steps(path);
  for (std::string step; std::getline(steps, step, '.');) {
    if (step == "*" && at.contains("anyOf")) at = at.at("anyOf").at(0); // several tables, or one alone
    const bool list = step.ends_with("[]");
    if (list) step.resize(step.size() - 2);
    if (at.contains("anyOf")) at = at.at("anyOf").at(0); // tables by name, or one of them without
    at = step == "*" ? at.at("additionalProperties") : at.at("properties").at(step);
    if (step == "*" && at.contains("anyOf")) at = at.at("anyOf").at(0); // a material: whole, or with a base
    if (list) at = at.at("items");
  }
  return at;
}

TEST(Schema, JsonHoldsEveryKey) {
  const nlohmann::json json = nlohmann::json::parse(json_schema());
  for (const Key& key : schema()) EXPECT_TRUE(at_key(json, key.path).is_object()) << key.path;
  EXPECT_EQ(json.at("else").at("else").at("required"), nlohmann::json::array({"domain"}))
      << "[cutting] may bring the others";
  EXPECT_EQ(json.at("then").at("required"), (nlohmann::json{"cutter", "milling"}));
  EXPECT_FALSE(json.contains("required"));
  EXPECT_EQ(json.at("additionalProperties"), false);
  EXPECT_EQ(at_key(json, "materials.*.heat.conductivity").at("x-si-unit"), "W/(m K)");
  EXPECT_EQ(at_key(json, "materials.*.elastic.poisson").at("anyOf").at(0).at("exclusiveMaximum"), 0.5);
  EXPECT_EQ(at_key(json, "materials.*.plastic.law").at("enum").at(0), "johnson-cook");
  const nlohmann::json methods = at_key(json, "method.name").at("enum");
  EXPECT_NE(std::find(methods.begin(), methods.end(), "fe-tetrahedra"), methods.end())
      << "what space alone has";
  EXPECT_EQ(at_key(json, "cloud.pattern").at("default"), "hexagonal");
  EXPECT_EQ(at_key(json, "domain.outer.path[].to").at("x-si-unit"), "m");
  EXPECT_EQ(at_key(json, "method.gauss_points").at("anyOf").at(0).at("maximum"), 3);
  const nlohmann::json materials = json.at("properties").at("materials").at("additionalProperties");
  EXPECT_EQ(materials.at("anyOf").at(0).at("required"), (nlohmann::json{"density", "elastic"}));
  EXPECT_EQ(materials.at("anyOf").at(1).at("required"), nlohmann::json::array({"base"}));
  EXPECT_FALSE(materials.at("anyOf").at(1).at("properties").at("elastic").contains("required"));
  const nlohmann::json& domain = json.at("properties").at("domain");
  EXPECT_EQ(domain.at("required"), nlohmann::json::array({"material"}));
}

TEST(Schema, ReferenceMentionsEveryKey) {
  const std::string text = case_reference();
  for (const Key& key : schema()) {
    if (key.path.starts_with("domain.holes.*.") || key.path.starts_with("tools.*."))
      continue; // outlines: once
    const bool has_section = key.type == Type::table || key.type == Type::named_tables;
    if (!has_section) {
      EXPECT_NE(text.find(fmt::format("`{}`", key.name())), std::string::npos) << key.path;
    }
  }
  for (const std::string& field : field_names(3))
    EXPECT_NE(text.find(fmt::format("| `{}` |", field)), std::string::npos);
}

TEST(Schema, CommittedReferenceIsUpToDate) {
  std::ifstream stream(CNEM_SOURCE_DIR "/docs/case_reference.md");
  const std::string committed((std::istreambuf_iterator<char>(stream)), {});
  EXPECT_TRUE(committed == case_reference())
      << "regenerate it: build/cnem schema --markdown > docs/case_reference.md";
}

TEST(Schema, ExampleOfTheReferenceIsAValidCase) {
  const std::string text = case_reference();
  const auto begin = text.find("```toml\n") + 8, end = text.find("```", begin);
  EXPECT_EQ(refusal_of(text.substr(begin, end - begin)), "accepted");
}

TEST(Schema, EveryDefaultAndExampleIsAccepted) {
  for (const Key& key : schema()) {
    if (key.type == Type::table || key.type == Type::named_tables || key.type == Type::table_list) continue;
    EXPECT_FALSE(key.expectation().empty());
    EXPECT_FALSE(key.presence == Presence::fallback && key.fallback.empty()) << key.path;
    for (const std::string& text : {key.fallback, key.example}) {
      if (text.empty()) continue;
      // In a case that holds nothing else, other keys are missing, but this one has nothing wrong with it.
      std::string path = key.path;
      for (const std::string_view part : {".*", "[]"})
        for (auto at = path.find(part); at != std::string::npos; at = path.find(part))
          path.replace(at, part.size(), part == ".*" ? ".N" : "");
      if (key.path.find("[]") != std::string::npos) continue;
      std::vector<std::string> overrides{fmt::format("{}={}", path, text)};
      if (key.family == Family::milling) overrides.emplace_back("analysis.type=\"stability\"");
      if (key.family == Family::structures || key.family == Family::machining)
        overrides.emplace_back("analysis.type=\"modes\"");
      if (key.scope == Scope::space) overrides.emplace_back("analysis.kinematics=\"three-dimensional\"");
      const std::string message = refusal_of("", overrides);
      EXPECT_EQ(message.find(fmt::format("--set {0}={1}: key '{0}': found", path, text)), std::string::npos)
          << message;
    }
  }
}

} // namespace
} // namespace cnem::input
