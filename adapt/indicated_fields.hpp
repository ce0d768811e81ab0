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
  double (*in_plane)(const PointState<2>& point, std::size_t p);
  double (*in_space)(const PointState<3>& point, std::size_t p);

  template<class Function>
  constexpr IndicatedField(const char* its_name, Needs what, const Function& at)
      : name(its_name), needs(what), in_plane(at), in_space(at) {}

  /// Its values at all points, in SI units.
  template<int dim> Field values(const PointState<dim>& point) const {
    Field value(point.size());
    for (std::size_t p = 0; p < value.size(); ++p)
      if constexpr (dim == 2)
        value[p] = in_plane(point, p);
      else
        value[p] = in_space(point, p);
    return value;
  }
};

std::span<const IndicatedField> indicated_fields();

/// The field of that name; null when there is none.
const IndicatedField* indicated_field(std::string_view name);

} // namespace cnem::adapt
