#pragma once
// What a discretisation may promise of its mechanics operators beyond what all must keep (gradients of
// constants vanish, those of positions are the identity, values sum to 1, forces are the transpose). The
// contract suite tests what is promised, whoever needs more than the common part asks for it by name.
#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace cnem {

enum class Promise : std::uint8_t {
  carried_history,    ///< what points have undergone goes over to those of a new reference on the same
                      ///< nodes (Discretisation::point_parcels)
  one_point_per_node, ///< row i is the stress point of node i and moves with it; holds carried_history in it
  identity_values,    ///< N is the identity; holds one_point_per_node and interpolating_values in it
  interpolating_values, ///< φ_J(x_K) = δ_JK: a nodal value is the value of the field there; otherwise values
                        ///< only reproduce linear fields
  non_negative_values,      ///< N_pJ >= 0
  tiling_cells,             ///< cells of the points are disjoint and fill the domain: Σ V_p = |Ω|
  balanced_constant_stress, ///< constant stress loads the boundary nodes alone, with the tractions of their
                            ///< facets
  hoop_rows,                ///< rows of bodies of revolution (core/operators/operators.hpp)
};

inline constexpr std::array all_promises{Promise::carried_history,          Promise::one_point_per_node,
                                         Promise::identity_values,          Promise::interpolating_values,
                                         Promise::non_negative_values,      Promise::tiling_cells,
                                         Promise::balanced_constant_stress, Promise::hoop_rows};

/// A set of promises.
class Promises {
public:
  constexpr Promises(std::initializer_list<Promise> list) {
    for (const Promise promise : list) kept_ |= bit(promise);
    if (keep(Promise::identity_values))
      kept_ |= bit(Promise::one_point_per_node) | bit(Promise::interpolating_values);
    if (keep(Promise::one_point_per_node)) kept_ |= bit(Promise::carried_history);
  }
  constexpr bool keep(Promise promise) const { return (kept_ & bit(promise)) != 0; }

private:
  static constexpr unsigned bit(Promise promise) { return 1U << static_cast<unsigned>(promise); }
  unsigned kept_ = 0;
};

/// The promise in words, for messages and documents: "one stress point per node".
std::string_view name_of(Promise promise);

/// Throws InputError with the promise's name when it is not among what `method` promises.
void require(const Promises& promises, Promise needed, std::string_view method, std::string_view by_whom);

} // namespace cnem
