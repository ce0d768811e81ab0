#pragma once
// Values that the program itself writes into a document, before the schema sees it.
#include "input/schema/document.hpp"

#include <string>

namespace cnem::input {

/// A text, and a table without members, that were written there.
Value text_value(std::string text, const Location& where);
Value table_value(const Location& where);

/// Adds a member, written where the table was.
void put(Value& table, std::string key, Value value);

} // namespace cnem::input
