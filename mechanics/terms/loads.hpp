#pragma once
// Applied forces: tractions and pressures on boundary pieces, body forces.
#include "core/fields/state.hpp"
#include "core/geometry/cloud.hpp"
#include "core/geometry/revolution.hpp"
#include "core/operators/resampling.hpp"
#include "core/time_table.hpp"

#include <string>
#include <vector>

namespace cnem {

/// Traction per unit area of the initial boundary, fixed in direction; Pa.
template<int dim> struct Traction {
  std::string name;
  std::array<TimeTable, dim> value;
  std::vector<Facet<dim>> facets;
};

/// Pressure on the current boundary along its inward normal; Pa.
template<int dim> struct Pressure {
  std::string name;
  TimeTable value;
  std::vector<Facet<dim>> facets;
};

/// The external forces of (53), lumped to nodes with shape functions that are linear on the boundary.
template<int dim> class Loads {
public:
  Loads() = default;
  /// `initial` holds the positions in which tractions are measured.
  Loads(std::vector<Traction<dim>> tractions, std::vector<Pressure<dim>> pressures,
        std::array<TimeTable, dim> acceleration, const std::vector<Vec<dim>>& initial,
        Space space = Space::plane);

  /// Acts on a changed cloud. initial: labels of the nodes (core/operators/resampling.hpp).
  void resample(const Cloud<dim>& cloud, const Fields<dim>& initial);

  bool empty() const { return tractions_.empty() && pressures_.empty() && !body_force_; }

  /// External force at nodes, N/m^(3−dim) (N of revolution), written to force().
  void evaluate(double time, const Fields<dim>& position, const Field& mass);
  const Fields<dim>& force() const { return force_; }

  /// A traction (Pa) that is uniform on a facet.
  struct FacetTraction {
    Facet<dim> facet;
    Vec<dim> traction;
  };
  /// Tractions and pressures on all loaded facets.
  std::vector<FacetTraction> facet_tractions(double time, const Fields<dim>& position) const;

private:
  void share_out(const std::vector<Vec<dim>>& initial);

  std::vector<Traction<dim>> tractions_;
  std::vector<std::vector<std::array<double, dim>>> traction_share_; ///< area of each facet its nodes carry
  std::vector<Pressure<dim>> pressures_;
  std::array<TimeTable, dim> acceleration_;
  bool body_force_ = false;
  Space space_ = Space::plane;
  Fields<dim> force_;
};

extern template class Loads<2>;
extern template class Loads<3>;

} // namespace cnem
