#include "adapt/indicated_fields.hpp"

#include <algorithm>
#include <array>

namespace cnem::adapt {

namespace {

using Needs = IndicatedField::Needs;

constexpr std::array list{
    IndicatedField{"plastic_strain", Needs::nothing,
                   [](const auto& point, std::size_t p) { return point.plastic_strain[p]; }},
    IndicatedField{
        "plastic_power", Needs::nothing,
        [](const auto& point, std::size_t p) { return point.equivalent_stress[p] * point.plastic_rate[p]; }},
    IndicatedField{"plastic_work", Needs::nothing,
                   [](const auto& point, std::size_t p) { return point.plastic_work[p]; }},
    IndicatedField{"temperature", Needs::heat,
                   [](const auto& point, std::size_t p) { return point.temperature[p]; }},
    IndicatedField{"damage", Needs::damage, [](const auto& point, std::size_t p) { return point.damage[p]; }},
};

} // namespace

std::span<const IndicatedField> indicated_fields() { return list; }

const IndicatedField* indicated_field(std::string_view name) {
  const auto* found =
      std::find_if(list.begin(), list.end(), [&](const IndicatedField& field) { return field.name == name; });
  return found == list.end() ? nullptr : found;
}

} // namespace cnem::adapt
