#pragma once
// A case in plain words, for people who decide whether to start it.
#include "input/case.hpp"

#include <string>

namespace cnem::app {

/// What is done to what, for how long, what that takes (app/forecast.hpp); of [cutting] also the numbers that
/// say whether heat, edge, inertia and cells are as they should be. Lines of text. Throws InputError.
std::string explanation(const input::Case& input);

} // namespace cnem::app
