#pragma once
// The fixture of the contract suite: one method, run on every domain.
#include "methods.hpp"
#include "tests/clouds.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {

inline std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

inline Vec2 gradient(const DiscreteOperators<2>& op, std::size_t entry) {
  return {op.gradient[0][entry], op.gradient[1][entry]};
}

/// N_pJ of an entry: the identity when nodal.
inline double value(const DiscreteOperators<2>& op, std::size_t point, std::size_t entry) {
  if (op.nodal) return index(op.node[entry]) == point ? 1.0 : 0.0;
  return op.value[entry];
}

/// Calls body(point, entry, node) for all entries of all rows.
template<class Body> void for_each_entry(const DiscreteOperators<2>& op, Body&& body) {
  for (std::size_t p = 0; p < index(op.points); ++p)
    for (auto e = index(op.row_begin[p]); e < index(op.row_begin[p + 1]); ++e) body(p, e, index(op.node[e]));
}

/// What conduction operators keep, whatever the method (core/discretisation.hpp).
inline constexpr Promises conduction_promises{Promise::non_negative_values, Promise::tiling_cells,
                                              Promise::balanced_constant_stress};

class Contract : public ::testing::TestWithParam<Method> {
protected:
  static bool promised(Promise promise) { return GetParam().make()->promises().keep(promise); }

  /// Rebuilds on every domain and calls check(domain, approximation).
  template<class Check> void on_every_domain(Check&& check) const {
    for (const NamedCloud& domain : domains()) {
      SCOPED_TRACE(domain.name);
      check(domain, GetParam().make()->rebuild(domain.cloud));
    }
  }

  /// Calls check(domain, operators) for the operators of mechanics and of conduction on every domain.
  template<class Check> void on_all_operators(Check&& check) const {
    on_every_domain([&](const NamedCloud& domain, const Approximation<2>& approximation) {
      {
        SCOPED_TRACE("mechanics");
        check(domain, approximation.mechanics);
      }
      SCOPED_TRACE("conduction");
      check(domain, approximation.conduction);
    });
  }

  /// The same for those of both that keep a promise.
  template<class Check> void on_operators_that_keep(Promise promise, Check&& check) const {
    on_every_domain([&](const NamedCloud& domain, const Approximation<2>& approximation) {
      if (promised(promise)) {
        SCOPED_TRACE("mechanics");
        check(domain, approximation.mechanics);
      }
      if (conduction_promises.keep(promise)) {
        SCOPED_TRACE("conduction");
        check(domain, approximation.conduction);
      }
    });
  }
};

} // namespace cnem::testing
