#include "machining/cutting_law.hpp"

#include <cmath>

namespace cnem::machining {

LawPoint CuttingLaw::at(const Cut& cut) const {
  return std::visit([&](const auto& law) { return law.at(cut); }, law_);
}

bool CuttingLaw::linear() const { return std::holds_alternative<LinearLaw>(law_); }

std::pair<double, double> CuttingLaw::thicknesses() const {
  if (const auto* table = std::get_if<TableLaw>(&law_))
    return {table->thickness.value[0], table->thickness.value[table->thickness.size - 1]};
  return {0.0, infinite};
}

void CuttingLaw::incline(double helix) {
  if (auto* oblique = std::get_if<ObliqueLaw>(&law_); oblique && !std::isfinite(oblique->inclination))
    oblique->inclination = helix;
}

} // namespace cnem::machining
