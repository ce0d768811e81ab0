#pragma once
// For who makes hardening laws and looks at their constants.
#include "core/law_variant.hpp"
#include "plasticity/hardening.hpp"
#include "plasticity/laws/list.hpp"

namespace cnem::plasticity {

struct AnyHardening {
  VariantOf<HardeningLaws> law;
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
template<class Law> const Law* Hardening::maybe() const { return std::get_if<Law>(&law_->law); }

} // namespace cnem::plasticity
