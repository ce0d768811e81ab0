#include "input/schema/written_values.hpp"

#include <utility>

namespace cnem::input {

Value text_value(std::string text, const Location& where) {
  Value value;
  value.kind = Value::Kind::text;
  value.text = std::move(text);
  value.where = where;
  return value;
}

Value table_value(const Location& where) {
  Value value;
  value.kind = Value::Kind::table;
  value.where = where;
  return value;
}

void put(Value& table, std::string key, Value value) {
  table.members.push_back({std::move(key), table.where, std::move(value)});
}

} // namespace cnem::input
