#pragma once
// Functions integrated along the faces between cells, each face once for its two cells.
#include "core/geometry/cell_complex.hpp"
#include "core/geometry/revolution.hpp"
#include "core/machine/parallel.hpp"
#include "voronoi/plane/cells.hpp"
#include "voronoi/plane/natural_neighbours.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace cnem::scni {

/// Means φ̄_J = (1/|Γ|) ∫ φ_J dΓ of the functions on each inner face, as sparse rows.
class FaceMeans {
public:
  static constexpr std::size_t block_size = 512;
  struct Block {
    std::vector<std::int32_t> begin; ///< [face of the block + 1]
    std::vector<NodeIndex> node;
    std::vector<double> value;
  };
  explicit FaceMeans(std::vector<Block> blocks)
      : blocks_(std::move(blocks)), unread_(std::make_unique<std::atomic<int>[]>(blocks_.size())) {
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      unread_[b] = 2 * (static_cast<int>(blocks_[b].begin.size()) - 1);
  }

  /// Stencil of an inner face; empty for faces without area.
  std::span<const NodeIndex> nodes(FaceIndex face) const {
    const auto& [block, begin] = row(face);
    return {block.node.data() + begin[0], block.node.data() + begin[1]};
  }
  /// φ̄ on that stencil; sums to 1. Of revolution the mean of r φ (m), which sums to the mean radius.
  std::span<const double> values(FaceIndex face) const {
    const auto& [block, begin] = row(face);
    return {block.value.data() + begin[0], block.value.data() + begin[1]};
  }

  /// These have been read for a cell. Where both cells of all its faces have had it a block is let go of: it
  /// may be called for several cells at a time.
  void release(std::span<const FaceIndex> faces) {
    for (std::size_t k = 0; k < faces.size();) {
      const std::size_t block = index_of(faces[k]) / block_size;
      int read = 0;
      for (; k < faces.size() && index_of(faces[k]) / block_size == block; ++k) ++read;
      const int left = unread_[block].fetch_sub(read, std::memory_order_acq_rel) - read;
      assert(left >= 0);
      if (left == 0) blocks_[block] = {};
    }
  }

private:
  std::pair<const Block&, const std::int32_t*> row(FaceIndex face) const {
    const std::size_t f = index_of(face);
    const Block& block = blocks_[f / block_size];
    return {block, &block.begin[f % block_size]};
  }
  std::vector<Block> blocks_;
  std::unique_ptr<std::atomic<int>[]> unread_; ///< [block] times that its faces are yet to be read
};

/// Adds functions at a point, times `weight`, to the row of a block that begins at `start`: its entries are
/// in the order in which they came first. functions: nodes() and values().
template<class Functions>
void add_point(FaceMeans::Block& block, std::size_t start, const Functions& functions, double weight) {
  const auto node = functions.nodes();
  const auto value = functions.values();
  const std::size_t known = block.node.size();
  for (std::size_t k = 0; k < node.size(); ++k) {
    std::size_t e = start;
    while (e < known && block.node[e] != node[k]) ++e;
    if (e < known) {
      block.value[e] += weight * value[k];
    } else {
      block.node.push_back(node[k]);
      block.value.push_back(weight * value[k]);
    }
  }
}

/// Integrates with `face_rule(points)`. make() gives the functions, one object a thread: evaluate(x, face)
/// at a point of an inner face, then nodes() and values(). Faces whose area is less than
/// 1e-14 of the distance between their nodes (to the power dim − 1) are skipped: they carry rounding only. Of
/// revolution at least 2 points are taken, without which r φ of linear fields would not be exact.
template<int dim, class MakeFunctions>
FaceMeans face_means(const Cloud<dim>& cloud, const CellComplex<dim>& cells, int points, Space space,
                     MakeFunctions&& make) {
  const auto rule = face_rule<dim>(space == Space::revolution ? std::max(points, 2) : points);
  const std::size_t faces = cells.interior.size();
  std::vector<FaceMeans::Block> blocks((faces + FaceMeans::block_size - 1) / FaceMeans::block_size);

  const auto is_skipped = [&](const InnerFace<dim>& face) {
    constexpr double smallest = 1e-14;
    const double distance = (cloud.position[face.cell[1]] - cloud.position[face.cell[0]]).squaredNorm();
    return !(face.normal().squaredNorm() > smallest * smallest * (dim == 2 ? distance : distance * distance));
  };
  const auto integrate = [&](std::size_t b, auto& functions) {
    FaceMeans::Block& block = blocks[b];
    const std::size_t first = b * FaceMeans::block_size;
    const std::size_t last = std::min(first + FaceMeans::block_size, faces);
    block.begin.reserve(last - first + 1);
    block.node.reserve(10 * (last - first));
    block.value.reserve(10 * (last - first));
    block.begin.push_back(0);
    for (std::size_t f = first; f < last; ++f) {
      const InnerFace<dim>& face = cells.interior[f];
      const std::size_t start = block.node.size();
      for (const FacePoint<dim>& point : is_skipped(face) ? std::span<const FacePoint<dim>>() : rule) {
        const Vec<dim> at = point_on<dim>(face.corner, point.place);
        const double weight = space == Space::revolution ? point.weight * at.x() : point.weight;
        functions.evaluate(at, face);
        add_point(block, start, functions, weight);
      }
      block.begin.push_back(static_cast<std::int32_t>(block.node.size()));
    }
  };

  ParallelFailure failure;
#pragma omp parallel
  {
    std::optional<decltype(make())> functions;
#pragma omp for schedule(dynamic)
    for (std::size_t b = 0; b < blocks.size(); ++b)
      failure.guard(static_cast<std::ptrdiff_t>(b), [&] {
        if (!functions) functions.emplace(make());
        integrate(b, *functions);
      });
  }
  failure.rethrow();
  return FaceMeans(std::move(blocks));
}

/// Those of natural neighbours on the faces of Voronoi cells, with 1, 2 or 3 Gauss points. Throws
/// GeometryError where the domain is so thin that rounding puts a point of a face outside of it.
FaceMeans face_means(const Cloud<2>& cloud, const voronoi::Triangulation& triangulation,
                     const voronoi::Circumcircles& circles, const voronoi::Cells& cells,
                     voronoi::Functions functions, int gauss_points, Space space = Space::plane);

/// Moving least squares with supports of `support` spacings (cnem/moving_least_squares.hpp), likewise. Throws
/// InputError for supports out of range, GeometryError as MovingLeastSquares does.
FaceMeans face_means(const Cloud<2>& cloud, const voronoi::Cells& cells, double support, int gauss_points,
                     Space space = Space::plane);

} // namespace cnem::scni
