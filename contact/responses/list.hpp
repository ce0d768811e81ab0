#pragma once
// How a tool answers nodes that are inside it: a file each beside this one. A response is a struct of
// constants (core/parameter.hpp); all but the first have
//   push(intrusion)   the impulse on one node, whatever other nodes do (contact/response_push.hpp)
//   step_share()      optional: the largest stable step over that with exact contact
#include "contact/responses/exact.hpp"
#include "contact/responses/kinematic.hpp"
#include "contact/responses/penalty.hpp"

namespace cnem::contact {

using Responses = Laws<Exact, Penalty, Kinematic>;

} // namespace cnem::contact
