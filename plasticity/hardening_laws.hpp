#pragma once
// For who makes hardening laws and looks at their constants.
#include "plasticity/hardening.hpp"
#include "plasticity/laws/list.hpp"

#include <variant>

namespace cnem::plasticity {

template<class List> struct VariantOf;
template<class... Law> struct VariantOf<Laws<Law...>> { using type = std::variant<Law...>; };

struct AnyHardening {
  VariantOf<HardeningLaws>::type law;
};

template<class Law> Law completed(Law law) {
  if constexpr (requires { law.complete(); }) law.complete();
  return law;
}

template<class Law>
requires requires { Law::parameters; }
Hardening::Hardening(const Law& law)
    : law_(std::make_shared<const AnyHardening>(AnyHardening{completed(law)})) {}

template<class Law> const Law& Hardening::as() const { return std::get<Law>(law_->law); }

} // namespace cnem::plasticity
