#pragma once
// The cutting laws: a file each beside this one. A law is a struct of constants (core/parameter.hpp) with
//   at(cut)      forces per length of edge, and their slope over the chip thickness, for thickness > 0
//   complete()   optional: throws InputError where constants do not fit together
#include "machining/laws/kienzle.hpp"
#include "machining/laws/linear.hpp"
#include "machining/laws/oblique.hpp"
#include "machining/laws/table.hpp"

namespace cnem::machining {

using CuttingLaws = Laws<LinearLaw, KienzleLaw, ObliqueLaw, TableLaw>;

} // namespace cnem::machining
