// What bulk viscosity takes for the length of a cell: as much as damps its own waves by ξ, also of flat
// cells.
#include "mechanics/terms/bulk_viscosity.hpp"
#include "tests/unit/mechanics/linear.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <utility>

namespace cnem::testing {
namespace {

struct ViscousBody {
  Cloud<2> cloud;
  Approximation<2> approximation;
  plasticity::Material material = steel();
  Field share, length; ///< [point] s, and √V in m

  explicit ViscousBody(Cloud<2> nodes) : cloud(std::move(nodes)), approximation(scni::Cnem().rebuild(cloud)) {
    const DiscreteOperators<2>& op = approximation.mechanics;
    Field mass = op.node_volume();
    for (double& m : mass) m *= material.density;
    set_length_shares(op, Field(op.volume.size(), material.density), mass, {}, share);
    for (const double volume : op.volume) length.push_back(std::sqrt(volume));
  }

  /// Share of critical damping of the highest mode over the ξ of all points, with lengths of s √V or of √V.
  double damping_of_highest_mode(bool by_share) {
    const double stiff = material.wave_modulus(false), speed = std::sqrt(stiff / material.density);
    Field viscous(length);
    for (std::size_t p = 0; p < viscous.size(); ++p)
      viscous[p] *= stiff / speed * (by_share ? share[p] : 1.0);
    const Linear elastic = linearise(approximation, cloud, material, 0.0),
                 damped = linearise(approximation, cloud, viscous, 0.0, material.density, 0.0);
    const Eigen::VectorXd s = elastic.mass.cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(s.asDiagonal() * elastic.stiffness *
                                                               s.asDiagonal());
    const Eigen::VectorXd mode = s.asDiagonal() * modes.eigenvectors().rightCols<1>();
    return mode.dot(damped.stiffness * mode) / (2.0 * std::sqrt(modes.eigenvalues().maxCoeff()));
  }
};

TEST(BulkViscosity, takes_all_of_the_length_of_cells_as_long_as_wide) {
  for (const Lattice lattice : {Lattice::square, Lattice::hexagonal}) {
    ViscousBody body(rectangle(1.0, 1.0, 0.1, lattice, 0.2));
    for (const double share : body.share) EXPECT_EQ(share, 1.0);
    const double damping = body.damping_of_highest_mode(true);
    EXPECT_GT(damping, 0.3);
    EXPECT_LT(damping, 1.1);
  }
}

TEST(BulkViscosity, damps_flat_cells_no_more) {
  ViscousBody body(rectangle(2e-3, 4e-6, 0.1e-3, Lattice::square)); // cells of 100 by 2 um
  // Thickness over root of the volume, were b that of one node on each side; it is that of three.
  const double least = *std::min_element(body.share.begin(), body.share.end());
  EXPECT_GT(least, 4e-6 / std::sqrt(100e-6 * 2e-6));
  EXPECT_LT(least, 1.5 * 4e-6 / std::sqrt(100e-6 * 2e-6));
  EXPECT_GT(body.damping_of_highest_mode(false), 3.0);
  const double damping = body.damping_of_highest_mode(true);
  EXPECT_GT(damping, 0.3);
  EXPECT_LT(damping, 1.4);
}

TEST(BulkViscosity, takes_nearly_all_of_the_length_of_linear_triangles) {
  const Cloud<2> cloud = rectangle(1.0, 1.0, 0.1);
  const Approximation<2> plane = make(Method::triangles, Space::plane)->rebuild(cloud);
  Field mass = plane.mechanics.node_volume(), share;
  for (double& m : mass) m *= steel().density;
  set_length_shares(plane.mechanics, Field(plane.mechanics.volume.size(), steel().density), mass, {}, share);
  EXPECT_GT(*std::min_element(share.begin(), share.end()), 0.95);
}

// Far from the axis a ring is as a strip: masses and volumes of revolution have 2 pi r alike.
TEST(BulkViscosity, takes_of_a_ring_what_it_takes_of_its_section) {
  Cloud<2> cloud = rectangle(2e-3, 4e-6, 0.1e-3, Lattice::square);
  const ViscousBody strip(cloud);
  for (Vec2& x : cloud.position) x.x() += 1.0;
  const Approximation<2> ring = make(Method::cnem, Space::revolution)->rebuild(cloud);
  Field mass = ring.mechanics.node_volume(), share;
  for (double& m : mass) m *= steel().density;
  set_length_shares(ring.mechanics, Field(ring.mechanics.volume.size(), steel().density), mass, {}, share);
  for (std::size_t p = 0; p < share.size(); ++p) EXPECT_NEAR(share[p], strip.share[p], 0.02 * share[p]) << p;
}

// Inertia four times as large swings half as fast, and its cells are taken for twice as long.
TEST(BulkViscosity, knows_mass_scaling_and_ties) {
  const Cloud<2> cloud = rectangle(2e-3, 4e-6, 0.1e-3, Lattice::square);
  const ViscousBody strip(cloud);
  const DiscreteOperators<2>& op = strip.approximation.mechanics;
  const Field density(op.volume.size(), strip.material.density);
  Field mass = op.node_volume(), heavy, tied;
  for (double& m : mass) m *= 4.0 * strip.material.density;
  set_length_shares(op, density, mass, {}, heavy);
  for (std::size_t p = 0; p < heavy.size(); ++p)
    EXPECT_NEAR(heavy[p], std::min(1.0, 2.0 * strip.share[p]), 1e-12);

  std::vector<std::array<NodeIndex, 2>> pairs; // both ends, as over a period
  for (const NodeIndex a : cloud.position.indices())
    for (const NodeIndex b : cloud.position.indices())
      if (cloud.position[a].x() < 1e-9 && cloud.position[b].x() > 2e-3 - 1e-9 &&
          std::abs(cloud.position[a].y() - cloud.position[b].y()) < 1e-9)
        pairs.push_back({a, b});
  ASSERT_EQ(pairs.size(), 2U);
  for (double& m : mass) m /= 4.0;
  set_length_shares(op, density, mass, Ties<2>(pairs, cloud.position), tied);
  for (const auto& [a, b] : pairs) // has the inertia of two, of which it is one half
    EXPECT_GT(tied[index_of(a)], 1.01 * strip.share[index_of(a)]);
}

} // namespace
} // namespace cnem::testing
