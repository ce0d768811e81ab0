#include "methods/sph.hpp"

#include "cnem/smoothing.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "core/operators/operator_checks.hpp"
#include "voronoi/linear_simplices.hpp"
#include "voronoi/plane/cells.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <numbers>

namespace cnem::methods {
namespace {

/// Distance to the natural neighbours of each node, m, weighted with the facets between: diagonals of
/// squares, whose choice is arbitrary, have none.
Field distances(const Cloud<2>& cloud, const CellComplex<2>& cells) {
  Field length(cloud.position.size(), 0.0), distance(length);
  for (const InnerFace<2>& face : cells.interior) {
    const double l = face.normal().norm();
    const double d = (cloud.position[face.cell[1]] - cloud.position[face.cell[0]]).norm();
    for (const NodeIndex i : face.cell) {
      length[index_of(i)] += l;
      distance[index_of(i)] += l * d;
    }
  }
  for (std::size_t i = 0; i < length.size(); ++i) distance[i] /= length[i];
  return distance;
}

/// Finds the nodes around a node that no wall hides. Scratch of one thread.
class Neighbourhood {
public:
  Neighbourhood(const Cloud<2>& cloud, const StabilisationLinks<2>& links) : cloud_(cloud), links_(links) {}

  /// Nodes nearer than `support`, the node itself among them, in increasing order. Every node within a circle
  /// is reached by Delaunay edges within it (each has a neighbour nearer to the centre), unless a wall is
  /// between.
  const std::vector<NodeIndex>& around(NodeIndex centre, double support) {
    constexpr double detour =
        1.5; // paths along edges of clouds are up to 1.42 (squares) of the straight line
    reached_ = {{centre, 0.0}};
    open_ = {0};
    for (std::size_t next = 0; next < open_.size(); ++next) {
      const Reached from = reached_[open_[next]];
      for (auto e = index_of(links_.begin[index_of(from.node)]);
           e < index_of(links_.begin[index_of(from.node) + 1]); ++e)
        relax(centre, support, detour * support, from, links_.neighbour[e]);
    }
    found_.clear();
    for (const Reached& node : reached_)
      if (node.path <= detour * straight(centre, node.node)) found_.push_back(node.node);
    std::sort(found_.begin(), found_.end());
    return found_;
  }

private:
  struct Reached {
    NodeIndex node;
    double path; ///< m, shortest along edges
  };

  double straight(NodeIndex i, NodeIndex j) const { return (cloud_.position[j] - cloud_.position[i]).norm(); }

  void relax(NodeIndex centre, double support, double longest, const Reached& from, NodeIndex node) {
    if (straight(centre, node) >= support) return;
    const double path = from.path + straight(from.node, node);
    if (path > longest) return;
    auto known = std::find_if(reached_.begin(), reached_.end(),
                              [node](const Reached& other) { return other.node == node; });
    if (known == reached_.end())
      known = reached_.insert(known, {node, path});
    else if (path < known->path)
      known->path = path;
    else
      return;
    open_.push_back(index_of(known - reached_.begin()));
  }

  const Cloud<2>& cloud_;
  const StabilisationLinks<2>& links_;
  std::vector<Reached> reached_;
  std::vector<std::size_t> open_; ///< of reached_, whose neighbours are to be looked at
  std::vector<NodeIndex> found_;
};

/// Rows of consecutive nodes.
struct RowBlock {
  std::vector<NodeIndex> node;
  std::vector<std::int32_t> size;
  Fields<2> gradient;
};

class CorrectedKernel {
public:
  CorrectedKernel(const Cloud<2>& cloud, const Field& volume, Kernel kernel)
      : cloud_(cloud), volume_(volume), kernel_(kernel) {}

  /// Appends the row of a node; false when its neighbours are too few or too much in one line.
  bool append(NodeIndex i, const std::vector<NodeIndex>& around, double support, RowBlock& rows) const {
    constexpr double narrowest = 1e-3; // of moments, beyond which rounding would show in linear fields
    Mat2 moment = Mat2::Zero();
    for (const NodeIndex j : around)
      if (j != i) moment += weight(i, j, support) * to(i, j) * to(i, j).transpose();
    const double half = 0.5 * moment.trace();
    if (!(moment.determinant() > narrowest * half * half)) return false;
    const Mat2 correction = moment.inverse();
    const std::size_t first = rows.node.size();
    std::size_t own = first;
    Vec2 sum = Vec2::Zero();
    for (const NodeIndex j : around) {
      if (j == i) own = rows.node.size();
      const Vec2 b = j == i ? Vec2(0, 0) : Vec2(weight(i, j, support) * correction * to(i, j));
      rows.node.push_back(j);
      for (std::size_t k = 0; k < 2; ++k) rows.gradient[k].push_back(b[static_cast<Eigen::Index>(k)]);
      sum += b;
    }
    for (std::size_t k = 0; k < 2; ++k) rows.gradient[k][own] = -sum[static_cast<Eigen::Index>(k)];
    rows.size.push_back(as<std::int32_t>(rows.node.size() - first));
    return true;
  }

private:
  Vec2 to(NodeIndex i, NodeIndex j) const { return cloud_.position[j] - cloud_.position[i]; }
  double weight(NodeIndex i, NodeIndex j, double support) const {
    const double r = to(i, j).norm();
    return -volume_[index_of(j)] * kernel_slope(kernel_, r, support) / r;
  }

  const Cloud<2>& cloud_;
  const Field& volume_;
  Kernel kernel_;
};

DiscreteOperators<2> corrected_gradients(const Cloud<2>& cloud, const Field& volume, const Field& support,
                                         const StabilisationLinks<2>& links, Kernel kernel) {
  const CorrectedKernel rows_of(cloud, volume, kernel);
  std::vector<RowBlock> rows(blocks(cloud.position.size()));
  for_each_block(cloud.position.size(), [&](std::size_t begin, std::size_t end) {
    constexpr int attempts = 8;
    constexpr double growth = 1.25;
    Neighbourhood neighbourhood(cloud, links);
    for (std::size_t k = begin; k < end; ++k) {
      const auto i = as<NodeIndex>(k);
      double reach = support[k];
      int attempt = 0;
      while (!rows_of.append(i, neighbourhood.around(i, reach), reach, rows[begin / block_size])) {
        reach *= growth;
        if (++attempt == attempts)
          throw GeometryError(
              fmt::format("the neighbours of the node at ({:g}, {:g}) m lie in one line, expected a "
                          "cloud with several rows of nodes",
                          cloud.position[k].x(), cloud.position[k].y()));
      }
    }
  });

  DiscreteOperators<2> op;
  op.points = op.nodes = cloud.nodes();
  op.nodal = true;
  op.volume = volume;
  op.row_begin = {0};
  for (const RowBlock& block : rows) {
    for (const std::int32_t size : block.size) op.row_begin.push_back(op.row_begin.back() + size);
    op.node.insert(op.node.end(), block.node.begin(), block.node.end());
    for (std::size_t k = 0; k < 2; ++k)
      op.gradient[k].insert(op.gradient[k].end(), block.gradient[k].begin(), block.gradient[k].end());
  }
  op.build_transpose();
  assert(rows_are_complete(op) && reproduces_linear_fields(op, cloud.position));
  return op;
}

} // namespace

double kernel_slope(Kernel kernel, double r, double support) {
  const double h = 0.5 * support, s = r / h, unit = 1.0 / (std::numbers::pi * h * h * h);
  if (s >= 2.0) return 0.0;
  const double rest = 2.0 - s;
  if (kernel == Kernel::wendland_c2) return -8.75 / 8.0 * unit * s * rest * rest * rest;
  return 10.0 / 7.0 * unit * (s < 1.0 ? s * (2.25 * s - 3.0) : -0.75 * rest * rest);
}

Sph::Sph(Kernel kernel, double smoothing) : kernel_(kernel), smoothing_(smoothing) {
  if (!(smoothing >= 1.5 && smoothing <= 5.0))
    throw InputError(fmt::format("a kernel support of {:g} spacings: expected 1.5 to 5", smoothing));
}

std::string Sph::name() const {
  return kernel_ == Kernel::cubic_spline ? "sph_cubic_spline" : "sph_wendland_c2";
}

Approximation<2> Sph::rebuild(const Cloud<2>& cloud) {
  const auto triangulation = voronoi::triangulate(cloud);
  const auto circles = voronoi::circumcircles(cloud, triangulation);
  const auto cells = voronoi::constrained_cells(cloud, triangulation, circles);
  Field support = distances(cloud, cells);
  for (double& s : support) s *= smoothing_;

  Approximation<2> result;
  result.links = scni::stabilisation_links<2>(cloud, cells, faces_of_cells<2>(cells));
  result.mechanics = corrected_gradients(cloud, cells.volume, support, result.links, kernel_);
  result.conduction = voronoi::linear_simplices<2>(cloud, triangulation.node);
  result.node_volume = cells.volume;
  result.cells = voronoi::cell_geometry(cloud, triangulation, circles, cells);
  return result;
}

} // namespace cnem::methods
