#pragma once
// The constrained natural element method in space.
#include "cnem/space_quadrature.hpp"
#include "core/operators/discretisation.hpp"
#include "voronoi/linear_simplices.hpp"

#include <vector>

namespace cnem::scni {

enum class CellKind { voronoi, median };

struct SpaceOptions {
  CellKind cells = CellKind::voronoi;
  /// On Voronoi cells; on median cells they are linear.
  voronoi::Functions functions = voronoi::Functions::laplace;
  int gauss_points = 1; ///< 1 a facet, or 3: one a triangle of it
  /// Right-handed ones that tile the domain of every cloud; empty: each cloud is triangulated.
  std::vector<voronoi::Simplex<3>> tetrahedra{};
};

/// Rows are nodes with their cells, N is the identity, and b_iJ = (1/V_i) ∮ φ_J n dΓ. On constrained Voronoi
/// cells (voronoi/space/voronoi_cells.hpp) every facet is integrated once and serves its two cells with
/// either sign; φ are natural-neighbour functions, on the boundary linear on each facet and integrated
/// exactly. On median cells φ are those of the tetrahedra (cnem/median.hpp). Linear fields are exact with
/// either, and constant stress loads the boundary alone. Links are the edges of the tetrahedra, which heat
/// conducts with.
class CnemInSpace final : public Discretisation<3> {
public:
  static constexpr Promises promised{Promise::identity_values, Promise::non_negative_values,
                                     Promise::tiling_cells, Promise::balanced_constant_stress};

  /// Throws InputError unless there are 1 or 3 points.
  explicit CnemInSpace(SpaceOptions options = {});

  /// Throws GeometryError as voronoi::triangulate (with tetrahedra of its own as voronoi::connected) and
  /// voronoi::linear_tetrahedra do. O(N log N).
  Approximation<3> rebuild(const Cloud<3>& cloud) override;
  Approximation<3> rebuild_rows(const Cloud<3>& cloud) override;
  std::string name() const override;
  Promises promises() const override { return promised; }

  /// Points of the last rebuild at which other functions had to be taken.
  const voronoi::Fallbacks& fallbacks() const { return fallbacks_; }

private:
  /// Fills in the links too.
  UnjoinedRows<3> rows_on_voronoi_cells(const Cloud<3>& cloud, const voronoi::Tetrahedra& mesh,
                                        StabilisationLinks<3>& links);

  SpaceOptions options_;
  voronoi::Fallbacks fallbacks_;
};

} // namespace cnem::scni
