// Smoothing along links: what it leaves alone, what it keeps, what it takes away.
#include "mechanics/terms/link_smoother.hpp"
#include "models.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

using Smoother = LinkSmoother<2>;

struct Sheet {
  Cloud<2> cloud = rectangle(2e-3, 1e-3, 1e-4, Lattice::hexagonal, 0.2);
  Approximation<2> approximation = make(Method::cnem)->rebuild(cloud);
  std::size_t n = cloud.position.size();
  Field reference, share = Field(n, 1.0), mass = approximation.mechanics.volume;
  std::vector<std::int32_t> kind = std::vector<std::int32_t>(n, 0);

  Sheet() {
    Fields<2> position;
    resize_all(position, n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < 2; ++k) position[k][i] = cloud.position[i][Eigen::Index(k)];
    reference = side_by_side<2>(position);
  }
  Smoother smoother(double strength) const {
    return {approximation.links, reference, share, kind, mass, strength};
  }
  const Vec2& at(std::int32_t node) const { return cloud.position[std::size_t(node)]; }
  template<class Function> std::vector<Smoother::Values> values(const Smoother& on, const Function& f) const {
    std::vector<Smoother::Values> x;
    for (const std::int32_t node : on.nodes()) {
      x.emplace_back(Smoother::Values::Zero());
      x.back()[0] = f(node);
      x.back()[3] = -2.0 * f(node);
    }
    return x;
  }
};

double noise(std::int32_t i) { return double(std::uint32_t(i) * 2654435761U % 1000) / 500.0 - 1.0; }

TEST(LinkSmoother, keeps_sums_and_first_moments_and_takes_noise_away) {
  const Sheet sheet;
  double last = 1.0;
  for (const double strength : {0.1, 1.0, 10.0}) {
    const Smoother smoother = sheet.smoother(strength);
    ASSERT_EQ(smoother.nodes().size(), sheet.n);
    const auto x = sheet.values(smoother, noise);
    const auto change = smoother.change(x);
    double sum = 0.0, size = 0.0, before = 0.0, after = 0.0;
    Vec2 moment = Vec2::Zero();
    for (std::size_t a = 0; a < x.size(); ++a) {
      const double mass = sheet.mass[std::size_t(smoother.nodes()[a])];
      sum += mass * change[a][0];
      moment += mass * change[a][0] * sheet.at(smoother.nodes()[a]);
      size += mass * std::abs(change[a][0]);
      before += mass * x[a][0] * x[a][0];
      after += mass * (x[a][0] + change[a][0]) * (x[a][0] + change[a][0]);
      EXPECT_DOUBLE_EQ(change[a][3], -2.0 * change[a][0]);
      EXPECT_EQ(change[a][1], 0.0);
    }
    EXPECT_LT(std::abs(sum), 1e-13 * size);
    EXPECT_LT(moment.norm(), 1e-13 * size * 2e-3);
    EXPECT_LT(after, last * before) << strength;
    last = after / before;
  }
  EXPECT_LT(last, 0.1);
}

TEST(LinkSmoother, leaves_linear_values_alone) {
  const Sheet sheet;
  const Smoother smoother = sheet.smoother(10.0);
  const auto change = smoother.change(sheet.values(
      smoother, [&](std::int32_t i) { return 0.3 + 400.0 * sheet.at(i).x() - 900.0 * sheet.at(i).y(); }));
  for (const auto& delta : change) EXPECT_LT(delta.abs().maxCoeff(), 1e-13);
}

TEST(LinkSmoother, links_nodes_that_take_part_and_are_of_one_kind) {
  Sheet sheet;
  for (std::size_t i = 0; i < sheet.n; ++i) {
    const Vec2& x = sheet.cloud.position[i];
    if (x.x() > 1.5e-3) sheet.share[i] = 0.0;
    sheet.kind[i] = x.x() > 0.7e-3 ? 1 : 0;
  }
  const Smoother smoother = sheet.smoother(1.0);
  for (const std::int32_t node : smoother.nodes()) EXPECT_LE(sheet.at(node).x(), 1.5e-3);
  // noise of one kind leaves the other where it is
  const auto change = smoother.change(sheet.values(
      smoother, [&](std::int32_t i) { return sheet.kind[std::size_t(i)] == 1 ? noise(i) : 0.5; }));
  double other = 0.0;
  for (std::size_t a = 0; a < change.size(); ++a)
    if (sheet.kind[std::size_t(smoother.nodes()[a])] == 0)
      EXPECT_LT(std::abs(change[a][0]), 1e-14);
    else
      other = std::max(other, std::abs(change[a][0]));
  EXPECT_GT(other, 0.3);
}

} // namespace
} // namespace cnem::testing
