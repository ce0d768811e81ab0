#pragma once
// From TOML values to typed values in SI.
#include "input/schema/settings.hpp"

#include <stdexcept>

namespace cnem::input {

/// Why a value does not fit its key, and where exactly.
struct ConversionError : std::runtime_error {
  ConversionError(Mistake kind_, Location where_, const std::string& message)
      : std::runtime_error(message), kind(kind_), where(std::move(where_)) {}
  Mistake kind;
  Location where;
};

/// The value of a key that is not a table. Throws ConversionError.
SettingValue convert_value(const Value& value, const Key& key);

} // namespace cnem::input
