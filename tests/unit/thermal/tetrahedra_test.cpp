// Conduction on tetrahedra: from present positions alone it is that of the operators on the reference, and
// what those hold beside their pattern is not read.
#include "core/operators/side_by_side.hpp"
#include "tests/clouds.hpp"
#include "tests/space_clouds.hpp"
#include "thermal/conduction.hpp"
#include "voronoi/linear_simplices.hpp"
#include "voronoi/space/conduction.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace cnem::testing {
namespace {

constexpr double k = 50.0;
constexpr int count = 3; ///< boxes an edge

/// A cube of boxes of six tetrahedra each, its inner nodes moved.
struct Cube {
  Cloud<3> cloud;
  std::vector<voronoi::Simplex<3>> tetrahedra;

  Cube() {
    Random random(5);
    const auto index = [](const std::array<int, 3>& at) {
      return as<NodeIndex>((at[2] * (count + 1) + at[1]) * (count + 1) + at[0]);
    };
    for (int n = 0; n < (count + 1) * (count + 1) * (count + 1); ++n) {
      const std::array<int, 3> at{n % (count + 1), n / (count + 1) % (count + 1),
                                  n / (count + 1) / (count + 1)};
      Vec3 x;
      for (int d = 0; d < 3; ++d) {
        const int place = at[static_cast<std::size_t>(d)];
        x[d] = place + (place > 0 && place < count ? random.uniform(-0.2, 0.2) : 0.0);
      }
      cloud.position.push_back(x);
    }
    constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (int n = 0; n < count * count * count; ++n)
      for (int o = 0; o < 6; ++o) {
        std::array<int, 3> at{n % count, n / count % count, n / count / count};
        voronoi::Simplex<3> corner{index(at)};
        for (std::size_t step = 0; step < 3; ++step) {
          ++at[static_cast<std::size_t>(orders[o][step])];
          corner[step + 1] = index(at);
        }
        if (o >= 3) std::swap(corner[1], corner[2]);
        tetrahedra.push_back(corner);
      }
  }
};

/// Positions bent out of those of the reference, side by side.
Field bent(const Cloud<3>& cloud) {
  Fields<3> position;
  resize_all(position, cloud.position.size());
  for (std::size_t i = 0; i < cloud.position.size(); ++i) {
    const Vec3& x = cloud.position[i];
    position[0][i] = 1.2 * x.x() + 0.05 * x.y() * x.y();
    position[1][i] = 0.8 * x.y() - 0.04 * x.x() * x.z();
    position[2][i] = x.z() + 0.3 * x.x();
  }
  return side_by_side<3>(position);
}

/// Σ V k J (F⁻¹F⁻ᵀ ∇T)·b with the gradients of the reference.
Field pulled_back_flow(const DiscreteOperators<3>& op, const Field& position, const Field& temperature) {
  Field flow(index_of(op.nodes), 0.0);
  for (std::size_t p = 0; p < index_of(op.points); ++p) {
    Mat<3> f = Mat<3>::Zero();
    Vec3 gradient = Vec3::Zero();
    const auto b = [&](std::size_t e) {
      return Vec3(op.gradient[0][e], op.gradient[1][e], op.gradient[2][e]);
    };
    const auto first = index_of(op.row_begin[p]), last = index_of(op.row_begin[p + 1]);
    for (std::size_t e = first; e < last; ++e) {
      f += Vec3::Map(position.data() + beside<3> * index_of(op.node[e])) * b(e).transpose();
      gradient += temperature[index_of(op.node[e])] * b(e);
    }
    const Vec3 flux = k * f.determinant() * f.inverse() * f.inverse().transpose() * gradient;
    for (std::size_t e = first; e < last; ++e) flow[index_of(op.node[e])] -= op.volume[p] * flux.dot(b(e));
  }
  return flow;
}

/// K, from 200 to 900.
Field random_temperatures(std::size_t nodes, std::uint64_t seed) {
  Random random(seed);
  Field temperature(nodes);
  for (double& value : temperature) value = random.uniform(200, 900);
  return temperature;
}

Field flow_of(const DiscreteOperators<3>& op, const Field& position, const Field& temperature) {
  Conduction<3> conduction;
  conduction.set_operators(op, Field(index_of(op.points), k));
  Field flow(temperature.size(), 0.0);
  conduction.add_flow(position, temperature, flow);
  return flow;
}

TEST(ConductionInSpace, tetrahedra_give_what_the_pulled_back_operator_gives) {
  const Cube cube;
  DiscreteOperators<3> op = voronoi::linear_simplices<3>(cube.cloud, cube.tetrahedra);
  const Field position = bent(cube.cloud);
  const Field temperature = random_temperatures(cube.cloud.position.size(), 3);
  const Field expected = pulled_back_flow(op, position, temperature);

  voronoi::keep_pattern(op);
  EXPECT_TRUE(op.gradient[0].empty() && op.weighted_gradient[0].empty());
  const Field flow = flow_of(op, position, temperature);
  double sum = 0.0;
  for (std::size_t i = 0; i < flow.size(); ++i) {
    EXPECT_NEAR(flow[i], expected[i], 1e-12 * k * 900) << i;
    sum += flow[i];
  }
  EXPECT_NEAR(sum, 0.0, 1e-9) << "what one node gives others receive";
}

/// Flat ones are taken together with a neighbour, in rows behind those of the others.
TEST(ConductionInSpace, rows_of_flat_tetrahedra_conduct_beside_the_others) {
  const auto body = recovered({.shape = SpaceShape::cube, .cells = 5, .jitter = 1e-3});
  DiscreteOperators<3> op = voronoi::linear_tetrahedra(body.cloud, body.tetrahedra);
  const auto entries = [&](std::size_t p) { return op.row_begin[p + 1] - op.row_begin[p]; };
  EXPECT_EQ(entries(0), 4);
  EXPECT_GT(entries(index_of(op.points) - 1), 4);
  EXPECT_EQ(op.row_begin[0], 0);
  for (std::size_t p = 1; p < index_of(op.points); ++p)
    if (entries(p) == 4) { EXPECT_EQ(entries(p - 1), 4) << p; }

  const Field position = bent(body.cloud);
  const Field temperature = random_temperatures(body.cloud.position.size(), 4);
  const Field expected = pulled_back_flow(op, position, temperature);
  voronoi::keep_pattern(op);
  std::size_t others = 0;
  for (std::size_t p = 0; p < index_of(op.points); ++p)
    if (entries(p) > 4) others += index_of(entries(p));
  EXPECT_EQ(op.gradient[0].size(), others) << "of those behind the single ones alone";
  const Field flow = flow_of(op, position, temperature);
  for (std::size_t i = 0; i < flow.size(); ++i) EXPECT_NEAR(flow[i], expected[i], 1e-11 * k * 900) << i;
}

/// The decay rate that no mode exceeds is above the largest of all modes, by no more than usual.
TEST(ConductionInSpace, no_mode_decays_faster_than_the_bound) {
  const Cube cube;
  const DiscreteOperators<3> op = voronoi::linear_simplices<3>(cube.cloud, cube.tetrahedra);
  const Field position = bent(cube.cloud);
  const std::size_t n = cube.cloud.position.size();
  const Field capacity(n, 2.0);
  Conduction<3> conduction;
  conduction.set_operators(op, Field(index_of(op.points), k));
  Eigen::MatrixXd matrix(n, n);
  for (std::size_t j = 0; j < n; ++j) {
    Field unit(n, 0.0), flow(n, 0.0);
    unit[j] = 1.0;
    conduction.add_flow(position, unit, flow);
    for (std::size_t i = 0; i < n; ++i)
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = -flow[i] / capacity[i];
  }
  const double fastest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues().maxCoeff();
  const double bound = conduction.fastest_decay(position, capacity);
  EXPECT_GE(bound, fastest);
  EXPECT_LE(bound, 4.0 * fastest);
}

/// A tetrahedron that has gone flat, or inside out, conducts as one that is nearly flat; also where rows of
/// the cloud are no tetrahedra (voronoi/space/conduction.hpp), and the bound of the decay knows.
TEST(ConductionInSpace, flat_tetrahedra_conduct_from_warm_to_cold) {
  Cloud<3> cloud;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    cloud.position.push_back(x);
  const std::vector<voronoi::Simplex<3>> one{
      {as<NodeIndex>(0), as<NodeIndex>(1), as<NodeIndex>(2), as<NodeIndex>(3)}};
  const DiscreteOperators<3> tetrahedron = voronoi::linear_simplices<3>(cloud, one);
  DiscreteOperators<3> row = tetrahedron; // the same with a fifth entry, of no weight
  row.node.push_back(as<NodeIndex>(0));
  row.row_begin.back() = 5;
  row.value.push_back(0.0);
  for (Field& component : row.gradient) component.push_back(0.0);
  row.build_transpose();
  for (const DiscreteOperators<3>* op : {&tetrahedron, &std::as_const(row)}) {
    SCOPED_TRACE(op->node.size());
    Conduction<3> conduction;
    conduction.set_operators(*op, Field(1, k));
    for (const double height : {1e-9, 0.0, -1e-9, -0.5}) {
      const Field position{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.3, 0.3, height, 0};
      const Field temperature{300, 300, 300, 400};
      Field flow(4, 0.0);
      conduction.add_flow(position, temperature, flow);
      EXPECT_LT(flow[3], 0.0) << height;
      EXPECT_GT(flow[3], -1e4 * k) << height;
      EXPECT_GT(conduction.fastest_decay(position, Field(4, 1.0)), -flow[3] / 100.0) << height;
    }
  }
}

} // namespace
} // namespace cnem::testing
