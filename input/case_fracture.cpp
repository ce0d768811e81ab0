// The evaluation of crack tips.
#include "input/case_parts.hpp"

#include <fmt/format.h>

namespace cnem::input {

void read_fracture(const Setting& root, Case& result, Diagnostics& diagnostics) {
  const Setting& table = *root.find("fracture");
  Fracture& fracture = result.fracture;
  fracture.enrichment = table.get<bool>("enrichment");
  fracture.enrichment_radius = table.maybe<double>("enrichment_radius");
  fracture.integral_inner = table.maybe<double>("integral.inner");
  fracture.integral_outer = table.maybe<double>("integral.outer");
  const Setting* inner = table.find("integral.inner");
  if (inner && fracture.integral_outer && !(*fracture.integral_inner < *fracture.integral_outer))
    diagnostics.add(Mistake::range, inner->where, inner->path,
                    fmt::format("found {:g} m, expected less than integral.outer = {:g} m",
                                *fracture.integral_inner, *fracture.integral_outer));
}

} // namespace cnem::input
