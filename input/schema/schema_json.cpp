// JSON Schema of a case, for editors that complete and check TOML.
#include "input/schema/schema.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace cnem::input {
namespace {

using Json = nlohmann::ordered_json;

Json text_type() { return {{"type", "string"}}; }

Json one_of(std::vector<Json> options) { return {{"anyOf", std::move(options)}}; }

Json array_of(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }

/// Two components, or three.
Json components_of(const Json& item, const Key& key) {
  Json list = array_of(item);
  list["minItems"] = key.components == 3 || (key.scope == Scope::space && !key.planar) ? 3 : 2;
  list["maxItems"] = key.planar || key.scope == Scope::plane ? 2 : 3;
  return list;
}

/// A number with a unit; dimensionless ones may be bare.
Json quantity(const Key& key) {
  if (!key.dimension.dimensionless()) return text_type();
  Json number{{"type", "number"}};
  if (key.range.low != anything.low)
    number[key.range.low_open ? "exclusiveMinimum" : "minimum"] = key.range.low;
  if (key.range.high != anything.high)
    number[key.range.high_open ? "exclusiveMaximum" : "maximum"] = key.range.high;
  return one_of({number, text_type()});
}

Json time_tables(const Json& value) {
  const auto closed = [](Json properties, Json required) {
    return Json{{"type", "object"},
                {"properties", std::move(properties)},
                {"required", std::move(required)},
                {"additionalProperties", false}};
  };
  const Json list = one_of({text_type(), array_of(text_type())});
  return one_of(
      {value,
       closed({{"value", value}, {"ramp", text_type()}, {"from", value}, {"smooth", {{"type", "boolean"}}}},
              {"value"}),
       closed({{"times", list}, {"values", one_of({text_type(), array_of(value)})}}, {"times", "values"})});
}

/// With a base in the library a material needs none of its keys.
enum class Needs { as_written, with_base };

Json object_schema(const std::string& pattern, Needs needs);

/// One of the tables of a table of names. Of those that may have a base: whole, or with it.
Json entry_schema(const std::string& pattern) {
  Json whole = object_schema(pattern, Needs::as_written);
  if (!find_key(pattern + ".base")) return whole;
  Json changed = object_schema(pattern, Needs::with_base);
  changed["required"] = Json::array({"base"});
  return one_of({std::move(whole), std::move(changed)});
}

/// In the plane and in space: which of them the file is of, a schema does not know.
std::vector<std::string> all_choices(const Key& key) {
  std::vector<std::string> all = key.choices;
  for (const std::string& choice : key.choices_in_space)
    if (std::find(all.begin(), all.end(), choice) == all.end()) all.push_back(choice);
  return all;
}

Json value_schema(const Key& key, Needs needs) {
  Json scalar = quantity(key);
  Json vector = one_of({text_type(), components_of(scalar, key)});
  switch (key.type) {
  case Type::table:
    return object_schema(key.path, needs);
  case Type::named_tables: {
    Json named{{"type", "object"},
               {"propertyNames", {{"pattern", "^[A-Za-z0-9_-]{1,100}$"}}},
               {"additionalProperties", entry_schema(key.path + ".*")}};
    return key.alone ? one_of({std::move(named), entry_schema(key.path + ".*")}) : named;
  }
  case Type::table_list:
    return array_of(object_schema(key.path + "[]", needs));
  case Type::variables:
    return {{"type", "object"},
            {"propertyNames", {{"pattern", "^[A-Za-z_][A-Za-z0-9_]{0,99}$"}}},
            {"additionalProperties", one_of({{{"type", "number"}}, text_type()})}};
  case Type::quantity:
    return scalar;
  case Type::integer:
    return one_of({{{"type", "integer"},
                    {"minimum", static_cast<std::int64_t>(key.range.low)},
                    {"maximum", static_cast<std::int64_t>(key.range.high)}},
                   text_type()});
  case Type::boolean:
    return {{"type", "boolean"}};
  case Type::text:
    return text_type();
  case Type::choice:
    return {{"enum", all_choices(key)}};
  case Type::texts:
    return one_of({text_type(), array_of(text_type())});
  case Type::choices:
    return one_of({{{"enum", all_choices(key)}}, array_of({{"enum", all_choices(key)}})});
  case Type::vector:
    return vector;
  case Type::vectors:
    return array_of(vector);
  case Type::quantities:
    return one_of({scalar, array_of(scalar)});
  case Type::function:
    return time_tables(scalar);
  case Type::vector_function: {
    Json components{
        {"type", "object"},
        {"properties", {{"x", time_tables(scalar)}, {"y", time_tables(scalar)}, {"z", time_tables(scalar)}}},
        {"minProperties", 1},
        {"additionalProperties", false}};
    return one_of({time_tables(vector), std::move(components)});
  }
  }
  return {};
}

Json parsed_toml(const std::string& text) {
  // Defaults and examples are scalars and arrays, on which TOML and JSON agree; inline tables are left out.
  return Json::parse(text, nullptr, false);
}

Json object_schema(const std::string& pattern, Needs needs) {
  Json properties = Json::object(), required = Json::array();
  for (const Key* key : members_of(pattern)) {
    Json schema = value_schema(*key, needs);
    std::string description = key->doc;
    if (!key->when.sibling.empty()) {
      description += " Goes with " + key->when.sibling + " = ";
      for (const std::string& value : key->when.values)
        description += (value == key->when.values.front() ? "\"" : " or \"") + value + "\"";
      description += '.';
    }
    if (!description.empty()) schema["description"] = description;
    if (!key->dimension.dimensionless()) schema["x-si-unit"] = key->quantity().si_unit;
    if (key->revolution) schema["x-si-unit-axisymmetric"] = describe(*key->revolution).si_unit;
    if (!key->fallback.empty()) schema["default"] = parsed_toml(key->fallback);
    if (!key->example.empty())
      if (Json example = parsed_toml(key->example); !example.is_discarded())
        schema["examples"] = Json::array({std::move(example)});
    const Key* table = find_key(pattern);
    const bool outside = // depends on the analysis
        (key->scope != Scope::everywhere && (!table || key->scope != table->scope)) ||
        (key->family != Family::everywhere && (!table || key->family != table->family));
    if (key->presence == Presence::required && !key->free_in_space && key->when.sibling.empty() &&
        key->elsewhere.empty() && !outside && needs == Needs::as_written)
      required.push_back(key->name());
    properties[key->name()] = std::move(schema);
  }
  Json object{{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!required.empty()) object["required"] = std::move(required);
  return object;
}

} // namespace

namespace {

/// What a case has to have at the top in one family of analyses.
Json required_in(Family family) {
  Json required = Json::array();
  for (const Key* key : members_of(""))
    if (key->presence == Presence::required && key->family == family && key->elsewhere.empty())
      required.push_back(key->name());
  return {{"required", std::move(required)}};
}

} // namespace

std::string json_schema() {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "cnem case"}};
  schema.update(object_schema("", Needs::as_written));
  const auto of_types = [](std::vector<std::string> types) -> Json {
    const Json analysis{{"properties", {{"type", {{"enum", std::move(types)}}}}}, {"required", {"type"}}};
    return {{"properties", {{"analysis", analysis}}}, {"required", {"analysis"}}};
  };
  schema["if"] = of_types({"stability", "milling"});
  schema["then"] = required_in(Family::milling);
  schema["else"] = {{"if", of_types({"modes", "removal"})}, {"else", required_in(Family::bodies)}};
  return schema.dump(2) + "\n";
}

} // namespace cnem::input
