#pragma once
// Bundles of straight fibres in the workpiece, for the case reader.
#include "input/case.hpp"
#include "input/schema/settings.hpp"

namespace cnem::input {

/// Makes of each bundle of `domain.fibres` two interfaces per fibre, NAME1_left and NAME1_right as seen along
/// the fibres, and of each fibre a region NAME1. Fibres are numbered from left to right and end at the
/// boundary that is nearest along them. Expects outline and holes.
void read_fibres(const Setting& root, Domain& domain, Diagnostics& diagnostics);

} // namespace cnem::input
