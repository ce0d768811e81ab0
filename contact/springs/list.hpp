#pragma once
// Springs that tools hang on: a file each beside this one. A spring is a struct of constants
// (core/parameter.hpp) with, over the travel s (m) that it has been pressed back by since the start,
//   force(s)    N/m^(3−dim) (N of revolution), at s
//   energy(s)   its integral from 0, J/m^(3−dim)
//   slope(s)    its derivative, for the stable step
#include "contact/springs/gas.hpp"
#include "contact/springs/linear.hpp"
#include "contact/springs/table.hpp"
#include "core/law_variant.hpp"

#include <utility>

namespace cnem::contact {

using Springs = Laws<LinearSpring, GasSpring, SpringTable>;

/// One of them. `charge` is the share of its force that is there, over time: a force that were there at once
/// would hit what it holds.
class Spring {
public:
  Spring() = default;
  /// Throws InputError where constants do not fit together.
  template<class Law>
  requires requires { Law::parameters; }
  Spring(Law law) {
    if constexpr (requires { law.complete(); }) law.complete();
    law_ = std::move(law);
  }

  TimeTable charge{1.0};

  double force(double s) const {
    return std::visit([&](const auto& law) { return law.force(s); }, law_);
  }
  double energy(double s) const {
    return std::visit([&](const auto& law) { return law.energy(s); }, law_);
  }
  double slope(double s) const {
    return std::visit([&](const auto& law) { return law.slope(s); }, law_);
  }

private:
  VariantOf<Springs> law_;
};

} // namespace cnem::contact
