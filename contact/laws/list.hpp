#pragma once
// The laws of friction: a file each beside this one. A law is a struct of constants (core/parameter.hpp) with
//   bound(rubbing)        what friction bears at most at a contact
//   needs_flow_stress()   where it asks for rubbing.flow_stress
//   needs_speed()         where it asks for rubbing.speed
//   complete()            optional: throws InputError where constants do not fit together
#include "contact/laws/coulomb.hpp"
#include "contact/laws/coulomb_decay.hpp"
#include "contact/laws/frictionless.hpp"
#include "contact/laws/table.hpp"
#include "contact/laws/tresca_limited.hpp"
#include "contact/laws/tresca_smooth.hpp"

namespace cnem::contact {

using FrictionLaws = Laws<Frictionless, Coulomb, TrescaLimited, CoulombDecay, TrescaSmooth, Table>;

} // namespace cnem::contact
