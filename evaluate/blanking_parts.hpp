#pragma once
// What evaluations of cuts in the plane and in space share.
#include "core/fields/vector_at.hpp"
#include "evaluate/blanking_result.hpp"
#include "input/case.hpp"
#include "results/fields.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace cnem::evaluate {

template<int dim> std::vector<Vec<dim>> places(const Fields<dim>& field) {
  std::vector<Vec<dim>> list(field[0].size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = vector_at<dim>(field, i);
  return list;
}

/// Whether a support is a plane of symmetry along the cutting direction.
template<int dim> bool along_the_cut(const Support<dim>& support, const Vec<dim>& direction) {
  return support.kind == Support<dim>::Kind::symmetry && std::abs(support.direction.dot(direction)) < 1e-6;
}

/// Pieces of the boundary that neither the outline of the sheet nor fracture made: holes and cracks. Blocks
/// and files of triangles have an outline alone: what is a hole in them cannot be told.
std::vector<PieceIndex> other_pieces(const input::Domain& domain,
                                     const IndexedVector<PieceIndex, std::string>& names);

/// Nodes whose metal has lost all of its strength but what rubble bears; empty where no material breaks.
template<int dim> std::vector<char> broken_nodes(const results::Snapshot<dim>& shot) {
  if (shot.state.point.softening.empty()) return {};
  constexpr double all = 0.99; // resampling takes means
  const Field softening = results::values_at_nodes(shot, "softening");
  std::vector<char> broken;
  broken.reserve(softening.size());
  for (const double lost : softening) broken.push_back(lost >= all);
  return broken;
}

/// What was measured, beside each face that was computed.
std::vector<MeasuredHeights> measured_beside(const std::vector<ShearedFace>& faces,
                                             const std::vector<input::MeasuredFace>& measured);

} // namespace cnem::evaluate
