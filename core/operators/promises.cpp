#include "core/operators/promises.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

namespace cnem {

std::string_view name_of(Promise promise) {
  switch (promise) {
  case Promise::carried_history:
    return "history that is carried to new points";
  case Promise::one_point_per_node:
    return "one stress point per node";
  case Promise::identity_values:
    return "values that are the identity";
  case Promise::interpolating_values:
    return "interpolating values";
  case Promise::non_negative_values:
    return "non-negative values";
  case Promise::tiling_cells:
    return "cells that tile the domain";
  case Promise::balanced_constant_stress:
    return "constant stress without inner force";
  case Promise::hoop_rows:
    return "hoop rows of bodies of revolution";
  }
  return {};
}

void require(const Promises& promises, Promise needed, std::string_view method, std::string_view by_whom) {
  if (promises.keep(needed)) return;
  throw InputError(fmt::format("{} found method '{}', which does not promise '{}', expected one that does",
                               by_whom, method, name_of(needed)));
}

} // namespace cnem
