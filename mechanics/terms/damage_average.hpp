#pragma once
// Growth of damage averaged over a length of the material, so that where and when it breaks does not depend
// on the cells (Pijaudier-Cabot and Bažant 1987: what controls softening is nonlocal, the rest is local).
#include "core/fields/state.hpp"
#include "core/operators/operators.hpp"
#include "plasticity/material.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace cnem {

/// dD_p ← Σ_q w_pq V_q dD_q/Σ_q w_pq V_q over the points q of the same material that do not soften and are
/// nearer than R, that of the material, w = (1 − r²/R²)², r on the reference.
template<int dim> class DamageAverage {
public:
  explicit DamageAverage(const std::vector<plasticity::Material>& materials);

  bool active() const { return active_; } ///< whether any material has a length
  /// Lists who is near whom on a new reference; reference [component][node], m.
  void list(const DiscreteOperators<dim>& operators, const Fields<dim>& reference,
            const PointState<dim>& point);
  /// Keeps D of the beginning of a step.
  void begin(const PointState<dim>& point) { before_ = point.damage; }
  /// What D has grown by since then is averaged; initiation strains follow.
  void share(PointState<dim>& point);

private:
  static constexpr int group_size = 32; ///< points that follow each other, and mostly lie near each other

  static constexpr std::size_t rows = 4; ///< summed side by side, as each sum waits for its last addition

  /// Σ w V dD of some points that follow each other, at most as many as rows.
  std::array<double, rows> sums(std::size_t first, std::size_t last) const;
  bool grows_near(std::size_t p) const; ///< or in the same group as what is near

  bool active_;
  std::vector<double> radius_;           ///< [material] m; 0: its damage is local
  std::vector<std::size_t> begin_;       ///< [point + 1]
  std::vector<std::int32_t> other_;      ///< points
  Field weight_;                         ///< w V
  std::vector<std::size_t> group_begin_; ///< [point + 1]
  std::vector<std::int32_t> group_;      ///< of points, that have any of those near
  Field before_, growth_;                ///< [point] D and dD; scratch of a step
  std::vector<char> group_grows_;        ///< [group] whether any of its dD is not 0
  std::vector<char> counts_;             ///< [point] whether it does not soften
  Field total_;                          ///< [point] Σ w V over those near it that count
};

extern template class DamageAverage<2>;
extern template class DamageAverage<3>;

} // namespace cnem
