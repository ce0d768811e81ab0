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

/// From `first` to `last`: straight, or along 10 s³ − 15 s⁴ + 6 s⁵, which starts and ends without a kink or a
/// jump of curvature, in 64 straight pieces.
TimeTable ramp_table(double duration, double first, double last, bool smooth);

/// The value of a key that is not a table. Throws ConversionError.
SettingValue convert_value(const Value& value, const Key& key);

} // namespace cnem::input
