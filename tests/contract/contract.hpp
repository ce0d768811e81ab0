#pragma once
// The fixture of the contract suite: one method, run on every domain of its dimension. Checks are written
// once, as templates on the dimension.
#include "core/fields/vector_at.hpp"
#include "methods.hpp"
#include "voronoi/linear_simplices.hpp"
#include "voronoi/space/conduction.hpp"
#include "voronoi/space/triangulate.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {

inline constexpr double tolerance = 1e-12;

template<class Number> std::size_t index(Number i) { return index_of(i); }

template<int dim> Vec<dim> gradient(const DiscreteOperators<dim>& op, std::size_t entry) {
  return vector_at<dim>(op.gradient, entry);
}

/// N_pJ of an entry: the identity when nodal.
template<int dim> double value(const DiscreteOperators<dim>& op, std::size_t point, std::size_t entry) {
  if (op.nodal) return index(op.node[entry]) == point ? 1.0 : 0.0;
  return op.value[entry];
}

/// Calls body(point, entry, node) for all entries of all rows.
template<int dim, class Body> void for_each_entry(const DiscreteOperators<dim>& op, Body&& body) {
  for (std::size_t p = 0; p < index(op.points); ++p)
    for (auto e = index(op.row_begin[p]); e < index(op.row_begin[p + 1]); ++e) body(p, e, index(op.node[e]));
}

/// What conduction operators keep, whatever the method (core/operators/discretisation.hpp).
inline constexpr Promises conduction_promises{Promise::non_negative_values, Promise::tiling_cells,
                                              Promise::balanced_constant_stress};

class Contract : public ::testing::TestWithParam<Method> {
protected:
  static bool promised(Promise promise) { return GetParam().entry->promises.keep(promise); }

  /// Calls check(domain) for every domain.
  template<class Check> static void on_every_cloud(Check&& check) {
    const auto all = [&](const auto& domains) {
      for (const auto& domain : domains) {
        if (domain.flat && !promised(Promise::one_point_per_node)) continue;
        SCOPED_TRACE(domain.name);
        check(domain);
      }
    };
    if (GetParam().dim == 2)
      all(all_domains<2>());
    else
      all(all_domains<3>());
  }

  /// The operators of conduction; in space, where methods keep only what of tetrahedra is read, those that
  /// this is the pattern of.
  static const DiscreteOperators<2>& conducting(const Domain<2>&, const DiscreteOperators<2>& kept) {
    return kept;
  }
  static DiscreteOperators<3> conducting(const Domain<3>& domain, const DiscreteOperators<3>& kept) {
    const auto made = [&] {
      if (GetParam().entry->name != "cnem") return voronoi::linear_simplices<3>(domain.cloud, domain.mesh);
      return voronoi::linear_tetrahedra(domain.cloud, GetParam().takes_mesh(domain)
                                                          ? voronoi::connected(domain.cloud, domain.mesh)
                                                          : voronoi::triangulate(domain.cloud));
    };
    DiscreteOperators<3> whole = made(), pattern = whole;
    voronoi::keep_pattern(pattern);
    EXPECT_EQ(kept.row_begin, pattern.row_begin);
    EXPECT_EQ(kept.node, pattern.node);
    EXPECT_EQ(kept.col_begin, pattern.col_begin);
    EXPECT_EQ(kept.volume, pattern.volume);
    EXPECT_EQ(kept.gradient, pattern.gradient);
    return whole;
  }

  /// Rebuilds on every domain and calls check(domain, approximation).
  template<class Check> static void on_every_domain(Check&& check) {
    on_every_cloud(
        [&](const auto& domain) { check(domain, GetParam().make(domain)->rebuild(domain.cloud)); });
  }

  /// Calls check(domain, operators) for the operators of mechanics and of conduction on every domain.
  template<class Check> static void on_all_operators(Check&& check) {
    on_every_domain([&](const auto& domain, const auto& approximation) {
      {
        SCOPED_TRACE("mechanics");
        check(domain, approximation.mechanics);
      }
      SCOPED_TRACE("conduction");
      check(domain, conducting(domain, approximation.conduction));
    });
  }

  /// The same for those of both that keep a promise.
  template<class Check> static void on_operators_that_keep(Promise promise, Check&& check) {
    on_every_domain([&](const auto& domain, const auto& approximation) {
      if (promised(promise)) {
        SCOPED_TRACE("mechanics");
        check(domain, approximation.mechanics);
      }
      if (conduction_promises.keep(promise)) {
        SCOPED_TRACE("conduction");
        check(domain, conducting(domain, approximation.conduction));
      }
    });
  }
};

} // namespace cnem::testing
