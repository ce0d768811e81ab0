#include "machining/cutting_law.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cnem::machining {

LawRange common(const LawRange& a, const LawRange& b) {
  const auto both = [](const Range& one, const Range& other) {
    return Range{.low = std::max(one.low, other.low), .high = std::min(one.high, other.high)};
  };
  return {both(a.thickness, b.thickness), both(a.speed, b.speed), both(a.rake, b.rake)};
}

LawPoint CuttingLaw::at(const Cut& cut) const {
  return std::visit([&](const auto& law) { return law.at(cut); }, law_);
}

bool CuttingLaw::linear() const { return std::holds_alternative<LinearLaw>(law_); }

LawRange CuttingLaw::known() const {
  LawRange range;
  if (const auto* table = std::get_if<TableLaw>(&law_))
    for (const auto& [list, part] : {std::pair{&table->thickness, &range.thickness},
                                     {&table->speed, &range.speed},
                                     {&table->rakes, &range.rake}})
      if (list->size > 0) *part = {.low = list->value[0], .high = list->value[list->size - 1]};
  if (const auto* oblique = std::get_if<ObliqueLaw>(&law_))
    range.rake = {.low = oblique->rake, .high = oblique->rake};
  return range;
}

void CuttingLaw::take_rake(double rake) {
  if (auto* table = std::get_if<TableLaw>(&law_)) *table = table->of_rake(rake);
}

void CuttingLaw::incline(double helix) {
  if (auto* oblique = std::get_if<ObliqueLaw>(&law_); oblique && !std::isfinite(oblique->inclination))
    oblique->inclination = helix;
}

} // namespace cnem::machining
