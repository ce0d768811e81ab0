#pragma once
// The fields that refinement can follow: a new one is a line in indicated_fields.cpp.
#include "core/fields/state.hpp"

#include <span>
#include <string_view>

namespace cnem::adapt {

/// A field at stress points that an indicator is made of.
struct IndicatedField {
  /// What there has to be in a case.
  enum class Needs { nothing, heat, damage };

  const char* name; ///< as in `adapt.indicator.field`
  Needs needs;
  double (*at)(const PointState<2>& point, std::size_t p); ///< its value at a point, in SI units
};

std::span<const IndicatedField> indicated_fields();

/// The field of that name; null when there is none.
const IndicatedField* indicated_field(std::string_view name);

} // namespace cnem::adapt
