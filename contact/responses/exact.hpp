#pragma once
#include "contact/response_push.hpp"

#include <array>

namespace cnem::contact {

/// Impulses that let nothing in, found for all nodes and corners together (contact/impulse_solver.hpp).
struct Exact {
  static constexpr const char* name = "exact";
  static constexpr const char* formula =
      "impulses that let nothing in, for nodes and corners together, in the step in which it would enter";
  static constexpr const char* source = "Signorini; Coulomb";
  static constexpr std::array<Parameter<Exact>, 0> parameters{};
};

} // namespace cnem::contact
