// The edge defect in space: nothing in affine motion, springs of stiffness ½ α w (μ_i + μ_j) against the
// rest.
#include "core/operators/side_by_side.hpp"
#include "mechanics/terms/edge_defect.hpp"

#include <gtest/gtest.h>

namespace cnem {
namespace {

constexpr double alpha = 0.5, weight = 2.0, mu = 3.0;

/// Four nodes that are all linked with each other.
struct Linked {
  StabilisationLinks<3> links{{0, 3, 6, 9, 12}, {}, Field(12, weight)};
  Fields<3> reference, position, force;
  Fields<9> deformation;
  ColumnStress<3> stress{Field(4 * column_stress<3>, 0.0), {}};
  EdgeDefect<3> edges{alpha};

  Linked(const Mat<3>& f) {
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        if (j != i) links.neighbour.push_back(as<NodeIndex>(j));
    const double x[4][3] = {{0, 0, 0}, {1, 0.1, 0}, {0.2, 1, -0.1}, {0.3, 0.2, 1.1}};
    for (Fields<3>* fields : {&reference, &position, &force}) resize_all(*fields, 4);
    resize_all(deformation, 4);
    for (std::size_t n = 0; n < 4; ++n) {
      const Vec<3> X(x[n][0], x[n][1], x[n][2]), now = f * X;
      for (std::size_t k = 0; k < 3; ++k) {
        reference[k][n] = x[n][k];
        position[k][n] = now[static_cast<int>(k)];
      }
      for (std::size_t c = 0; c < 9; ++c)
        deformation[c][n] = f(static_cast<int>(c / 3), static_cast<int>(c % 3));
    }
  }

  EdgeEnergy energy() {
    edges.reset(Field(4, mu));
    edges.store_records(deformation, side_by_side<3>(reference), 0, 4);
    return edges.apply(links, Field(4, 1.0), side_by_side<3>(position), stress, force, 0, 4);
  }
};

TEST(EdgeDefectInSpace, is_nothing_in_affine_motion) {
  Mat<3> f;
  f << 1.1, 0.2, -0.3, 0.05, 0.9, 0.4, -0.1, 0.15, 1.2;
  Linked body(f);
  EXPECT_NEAR(body.energy().stored, 0.0, 1e-30);
  for (const Field& component : body.force)
    for (const double value : component) EXPECT_NEAR(value, 0.0, 1e-14);
}

TEST(EdgeDefectInSpace, draws_back_a_node_that_the_gradients_do_not_see) {
  Linked body(Mat<3>::Identity());
  const double shift = 1e-3, stiffness = alpha * weight * mu;
  body.position[2][0] += shift;
  const EdgeEnergy energy = body.energy();
  EXPECT_NEAR(energy.stored, 3.0 * 0.5 * stiffness * shift * shift, 1e-18) << "three links";
  EXPECT_EQ(energy.released, 0.0);
  EXPECT_NEAR(body.force[2][0], -3.0 * stiffness * shift, 1e-15);
  for (std::size_t n = 1; n < 4; ++n) EXPECT_NEAR(body.force[2][n], stiffness * shift, 1e-15);
  // −½ Σ_j k r ⊗ X_ij / V_i of the node that moved, P_zk.
  for (std::size_t k = 0; k < 3; ++k) {
    double moment = 0.0;
    for (std::size_t n = 1; n < 4; ++n)
      moment += stiffness * -shift * (body.reference[k][n] - body.reference[k][0]);
    EXPECT_NEAR(body.stress.columns[beside<3> * k + 2], -0.5 * moment, 1e-15) << k;
  }
}

} // namespace
} // namespace cnem
