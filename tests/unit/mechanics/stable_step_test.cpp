// The bound on the highest frequency: it holds, it is near, and it is the same after a restart.
#include "core/fields/memory_archive.hpp"
#include "tests/unit/mechanics/graded.hpp"
#include "tests/unit/mechanics/linear.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

struct StretchedBlock {
  Cloud<2> cloud = graded_rectangle(1.0, 1.0, 0.2, 0.05, {{0.5, 0.0}, {0.5, 1.0}});
  Approximation<2> approximation = scni::Cnem().rebuild(cloud);
  plasticity::Material material = steel();
  Fields<5> deformation;
  Field modulus, mass;

  StretchedBlock() {
    const auto points = static_cast<std::size_t>(op().points);
    resize_all(deformation, points);
    stretch(1.0);
    modulus.assign(points, material.elasticity.lambda() + 2.0 * material.elasticity.mu());
    mass = op().node_volume();
    for (double& m : mass) m *= material.density;
  }
  const DiscreteOperators<2>& op() const { return approximation.mechanics; }
  /// x → s x at constant y.
  void stretch(double s) {
    for (const std::size_t k : {3U, 4U}) std::fill(deformation[k].begin(), deformation[k].end(), 1.0);
    std::fill(deformation[0].begin(), deformation[0].end(), s);
  }
  double of_all(SpectralBound<2>& bound) const {
    return bound.of_all(op(), deformation, modulus, mass).value;
  }
  double of_rows() const {
    double largest = 0.0;
    for (const auto& range : SpectralBound<2>().of_ranges(op(), deformation, modulus, mass, block_size))
      largest = std::max(largest, range.value);
    return largest;
  }
};

TEST(SpectralBound, holds_and_is_nearer_than_rows) {
  StretchedBlock block;
  SpectralBound<2> bound;
  const double near = block.of_all(bound), rows = block.of_rows();
  const double highest =
      squared_frequencies(linearise(block.approximation, block.cloud, block.material, 0.0)).maxCoeff();
  EXPECT_GE(near, highest);
  EXPECT_LE(near, rows / 1.25); // the step is at least 1.12 times as long
  EXPECT_GE(std::sqrt(highest / near), 0.6);
}

TEST(SpectralBound, is_found_again_once_it_has_grown_and_holds_in_between) {
  StretchedBlock block;
  SpectralBound<2> kept;
  double highest = block.of_all(kept);
  for (const double s : {0.99, 0.9, 0.7, 0.5, 1.3}) {
    block.stretch(s);
    SpectralBound<2> fresh;
    const double near = block.of_all(fresh), held = block.of_all(kept);
    EXPECT_GE(held, near * (1.0 - 0.05)) << s;
    highest = std::max(highest, near);
    EXPECT_LE(held, highest * 1.06) << s;
  }
}

TEST(SpectralBound, goes_on_from_the_shares_it_has) {
  StretchedBlock block;
  SpectralBound<2> kept;
  block.of_all(kept);
  block.stretch(0.9);
  SpectralBound<2> fresh;
  EXPECT_LE(block.of_all(kept), block.of_all(fresh) * 1.02);
}

TEST(SpectralBound, of_points_without_stiffness_is_that_of_the_others) {
  StretchedBlock block;
  SpectralBound<2> bound;
  const double all = block.of_all(bound);
  block.modulus[7] = 0.0;
  bound.forget();
  const double most = block.of_all(bound);
  EXPECT_GT(most, 0.5 * all);
  EXPECT_LE(most, all * (1.0 + 1e-12));
  block.modulus[7] = block.modulus[6]; // what x says of it is nothing now
  EXPECT_NEAR(block.of_all(bound), all, 1e-12 * all);
  std::fill(block.modulus.begin(), block.modulus.end(), 0.0);
  bound.forget();
  EXPECT_EQ(block.of_all(bound), 0.0);
  block.modulus[3] = std::nan("");
  EXPECT_TRUE(std::isnan(block.of_all(bound)));
}

/// A sheared strip between periodic sides: at its corners sharp wedges are tied to blunt ones.
struct ShearedStrip {
  static constexpr double shear = 3.0;
  Cloud<2> cloud = rectangle(1e-3, 0.6e-3, 0.1e-3, Lattice::square);
  Ties<2> ties;

  ShearedStrip() {
    std::vector<std::array<NodeIndex, 2>> pairs;
    for (const NodeIndex right : nodes_on(cloud, 1_piece))
      for (const NodeIndex left : nodes_on(cloud, 3_piece))
        if (std::abs(cloud.position[right].y() - cloud.position[left].y()) < 1e-9)
          pairs.push_back({left, right});
    for (Vec2& x : cloud.position) x.x() += shear * x.y();
    ties = Ties<2>(pairs, cloud.position);
  }
};

/// Of tied nodes, u = T û: Tᵀ K T and Tᵀ M T.
Linear tied(const Linear& free, const Ties<2>& ties) {
  const auto nodes = free.mass.size() / 2;
  std::vector<Eigen::Index> column(static_cast<std::size_t>(nodes), -1);
  Eigen::Index count = 0;
  std::vector<Eigen::Index> of_group(ties.nodes().size(), -1);
  for (std::size_t i = 0; i < column.size(); ++i) {
    const std::int32_t g = ties.group()[as<NodeIndex>(i)];
    if (g < 0) {
      column[i] = count++;
    } else {
      Eigen::Index& shared = of_group[static_cast<std::size_t>(g)];
      if (shared < 0) shared = count++;
      column[i] = shared;
    }
  }
  Eigen::MatrixXd join = Eigen::MatrixXd::Zero(2 * nodes, 2 * count);
  for (Eigen::Index i = 0; i < nodes; ++i)
    for (Eigen::Index k = 0; k < 2; ++k) join(2 * i + k, 2 * column[static_cast<std::size_t>(i)] + k) = 1.0;
  return {join.transpose() * free.stiffness * join, join.transpose() * free.mass};
}

TEST(SpectralBound, of_tied_nodes_holds_and_is_nearer_than_that_of_free_ones) {
  const ShearedStrip strip;
  Approximation<2> approximation = scni::Cnem().rebuild(strip.cloud);
  const DiscreteOperators<2>& op = approximation.mechanics;
  const plasticity::Material material = steel();
  const auto points = static_cast<std::size_t>(op.points);
  Fields<5> deformation;
  resize_all(deformation, points);
  for (const std::size_t k : {0U, 3U, 4U}) std::fill(deformation[k].begin(), deformation[k].end(), 1.0);
  const Field modulus(points, material.wave_modulus(false));
  Field mass = op.node_volume();
  for (double& m : mass) m *= material.density;
  const double free = SpectralBound<2>().of_all(op, deformation, modulus, mass).value,
               bound = SpectralBound<2>().of_all(op, deformation, modulus, mass, strip.ties).value;
  double rows = 0.0;
  for (const auto& range :
       SpectralBound<2>().of_ranges(op, deformation, modulus, mass, block_size, strip.ties))
    rows = std::max(rows, range.value);
  const double highest =
      squared_frequencies(tied(linearise(approximation, strip.cloud, material, 0.0), strip.ties)).maxCoeff();

  EXPECT_GE(bound, highest);
  EXPECT_GE(rows, bound);
  EXPECT_LT(bound, 0.8 * free);
  EXPECT_GE(std::sqrt(highest / bound), 0.6);
  constexpr double alpha = 0.05; // of the edge defect
  EXPECT_GE(bound * (1.0 + alpha),
            squared_frequencies(tied(linearise(approximation, strip.cloud, material, alpha), strip.ties))
                .maxCoeff());
}

// Nearly at the bound, with the edge defect, all frequencies shaken.
TEST(SpectralBound, of_tied_nodes_keeps_the_energy) {
  const ShearedStrip strip;
  Problem<2> model = model_of(strip.cloud, Method::cnem, steel());
  model.ties = strip.ties;
  model.safety = 0.95;
  Random random(3);
  ExplicitSolver<2> solver = start(std::move(model), [&](const Vec2&) -> Vec2 {
    return {random.uniform(-1, 1), random.uniform(-1, 1)};
  });
  for (int n = 0; n < 5000; ++n) solver.advance(solver.stable_step().dt);
  EXPECT_LT(std::abs(solver.ledger().residual()), 1e-2 * solver.ledger().initial());
}

TEST(SpectralBound, has_the_same_bits_after_a_restart) {
  StretchedBlock block;
  SpectralBound<2> first, second;
  block.of_all(first);
  MemoryArchive memory;
  first.archive(memory);
  memory.recall();
  second.archive(memory);
  block.stretch(0.995); // not so much that x would be found again
  EXPECT_EQ(block.of_all(first), block.of_all(second));
  SpectralBound<2> fresh;
  EXPECT_NE(block.of_all(first), block.of_all(fresh));
}

} // namespace
} // namespace cnem::testing
