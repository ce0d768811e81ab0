#include "tests/degenerate/random_clouds.hpp"

#include "voronoi/order.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace cnem::voronoi::test {

namespace {

constexpr double pi = std::numbers::pi;
using Random = std::mt19937;
using Loop = std::vector<Vec2>;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
int integer(Random& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

/// Points along the closed polygon about h apart; its corners are kept. `jitter` moves them along the sides.
Loop resample(const Loop& corners, double h, Random& random, double jitter = 0.0) {
  Loop loop;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 &a = corners[k], &b = corners[(k + 1) % corners.size()];
    const int n = std::max(1, static_cast<int>(std::lround((b - a).norm() / h)));
    loop.push_back(a);
    // From the same end in both directions: the two faces of a crack have bitwise equal positions.
    const bool forward = a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
    for (int i = 1; i < n; ++i) {
      const double s = i + uniform(random, -jitter, jitter);
      loop.push_back(forward ? a + (b - a) * (s / n) : b + (a - b) * ((n - s) / n));
    }
  }
  return loop;
}

Loop circle(const Vec2& centre, double radius, int n, bool clockwise = false) {
  Loop loop;
  for (int k = 0; k < n; ++k) {
    const double angle = (clockwise ? -2.0 : 2.0) * pi * k / n;
    loop.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return loop;
}

void add_loop(Cloud<2>& cloud, const Loop& loop) {
  const auto first = static_cast<std::int32_t>(cloud.nodes());
  const auto n = static_cast<std::int32_t>(loop.size());
  for (const Vec2& x : loop) cloud.position.push_back(x);
  for (std::int32_t k = 0; k < n; ++k)
    cloud.facets.push_back({{as<NodeIndex>(first + k), as<NodeIndex>(first + (k + 1) % n)}, {}});
}

/// Declares all coincident nodes twins: the faces of cracks.
void declare_twins(Cloud<2>& cloud) {
  std::vector<NodeIndex> order;
  for (const NodeIndex i : cloud.position.indices()) order.push_back(i);
  const auto at = [&](NodeIndex i) -> const Vec2& { return cloud.position[i]; };
  std::sort(order.begin(), order.end(), [&](NodeIndex a, NodeIndex b) {
    return at(a).x() != at(b).x() ? at(a).x() < at(b).x() : at(a).y() < at(b).y();
  });
  for (std::size_t k = 1; k < order.size(); ++k)
    if (at(order[k - 1]) == at(order[k])) cloud.twins.push_back({order[k - 1], order[k]});
}

double distance_to(const Vec2& x, const Vec2& a, const Vec2& b) {
  const double s = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (x - a - s * (b - a)).norm();
}

/// Even-odd rule on the loops, and no closer than `gap` to the boundary.
bool well_inside(const Cloud<2>& cloud, const Vec2& x, double gap) {
  bool inside = false;
  for (const auto& facet : cloud.facets) {
    const Vec2& a = cloud.position[static_cast<std::size_t>(facet.node[0])];
    const Vec2& b = cloud.position[static_cast<std::size_t>(facet.node[1])];
    if (distance_to(x, a, b) <= gap) return false;
    if ((a.y() > x.y()) != (b.y() > x.y()) &&
        x.x() < a.x() + (b.x() - a.x()) * (x.y() - a.y()) / (b.y() - a.y()))
      inside = !inside;
  }
  return inside;
}

/// Appends those candidates that lie well inside; the boundary must be complete.
void fill(Cloud<2>& cloud, const std::vector<Vec2>& candidates, double gap) {
  std::vector<Vec2> accepted;
  for (const Vec2& x : candidates)
    if (well_inside(cloud, x, gap)) accepted.push_back(x);
  cloud.position.insert(cloud.position.end(), accepted.begin(), accepted.end());
}

enum class Pattern { grid, hexagonal, jittered, random };

std::vector<Vec2> pattern(Pattern kind, double h, Random& random) {
  std::vector<Vec2> points;
  const double rise = kind == Pattern::hexagonal ? std::sqrt(0.75) : 1.0;
  const int n = static_cast<int>(4.0 / h);
  for (int j = -n; j <= n; ++j)
    for (int i = -n; i <= n; ++i) {
      Vec2 x(i * h, j * h * rise);
      if (kind == Pattern::hexagonal && j % 2 != 0) x.x() += 0.5 * h;
      if (kind == Pattern::jittered) x += h * Vec2(uniform(random, -0.4, 0.4), uniform(random, -0.4, 0.4));
      if (kind == Pattern::random) x = Vec2(uniform(random, -4.0, 4.0), uniform(random, -4.0, 4.0));
      points.push_back(x);
    }
  return points;
}

Pattern any_pattern(Random& random) { return static_cast<Pattern>(integer(random, 0, 3)); }

const Loop square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
const Loop l_shape{{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}};

Loop star(Random& random) {
  Loop corners;
  const int arms = integer(random, 3, 9);
  const double inner = uniform(random, 0.1, 0.5);
  for (int k = 0; k < 2 * arms; ++k)
    corners.push_back((k % 2 ? inner : 1.0) * Vec2(std::cos(pi * k / arms), std::sin(pi * k / arms)));
  return corners;
}

using Family = std::function<void(Cloud<2>&, Random&, double h)>;

const std::vector<std::pair<const char*, Family>>& table() {
  static const std::vector<std::pair<const char*, Family>> families{
      {"jittered square",
       [](Cloud<2>& cloud, Random& random, double h) {
         add_loop(cloud, resample(square, h, random, 0.3));
         fill(cloud, pattern(Pattern::jittered, h, random), 0.2 * h);
       }},
      {"cocircular grid",
       [](Cloud<2>& cloud, Random& random, double h) {
         h = 1.0 / std::round(1.0 / h);
         add_loop(cloud, resample(square, h, random));
         fill(cloud, pattern(Pattern::grid, h, random), 0.5 * h);
       }},
      {"hexagonal",
       [](Cloud<2>& cloud, Random& random, double h) {
         add_loop(cloud, resample(square, h, random));
         fill(cloud, pattern(Pattern::hexagonal, h, random), 0.3 * h);
       }},
      {"L",
       [](Cloud<2>& cloud, Random& random, double h) {
         add_loop(cloud, resample(l_shape, h, random, 0.3));
         fill(cloud, pattern(any_pattern(random), h, random), 0.1 * h);
       }},
      {"star",
       [](Cloud<2>& cloud, Random& random, double h) {
         add_loop(cloud, resample(star(random), h, random));
         fill(cloud, pattern(any_pattern(random), h, random), 0.05 * h);
       }},
      {"annulus", // all boundary nodes on two circles: cocircular in one great cavity when the inside is
                  // empty
       [](Cloud<2>& cloud, Random& random, double h) {
         const double radius = uniform(random, 0.1, 0.8);
         add_loop(cloud, circle({0, 0}, 1.0, integer(random, 6, 60)));
         add_loop(cloud, circle({0.1, 0.0}, radius, integer(random, 6, 30), true));
         if (integer(random, 0, 3) > 0) fill(cloud, pattern(any_pattern(random), h, random), 0.05 * h);
       }},
      {"embedded slit",
       [](Cloud<2>& cloud, Random& random, double h) {
         add_loop(cloud, resample(square, h, random));
         const double y = uniform(random, -0.5, 0.5), end = uniform(random, 0.1, 0.9);
         add_loop(cloud, resample({{-end, y}, {end, -y}}, h, random));
         declare_twins(cloud);
         fill(cloud, pattern(any_pattern(random), h, random), 0.05 * h);
       }},
      {"slit open to the boundary",
       [](Cloud<2>& cloud, Random& random, double h) {
         const Vec2 mouth(-1, uniform(random, -0.7, 0.7)),
             tip(uniform(random, -0.8, 0.9), uniform(random, -0.7, 0.7));
         add_loop(cloud, resample({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, mouth, tip, mouth}, h, random));
         declare_twins(cloud);
         fill(cloud, pattern(any_pattern(random), h, random), 0.05 * h);
       }},
      {"crossing slits", // three faces and more meet at one point
       [](Cloud<2>& cloud, Random& random, double h) {
         add_loop(cloud, resample(square, h, random));
         Loop slits;
         const int arms = integer(random, 3, 5);
         for (int k = 0; k < arms; ++k) {
           const double angle = -2.0 * pi * k / arms;
           slits.push_back({0, 0});
           slits.push_back(uniform(random, 0.3, 0.9) * Vec2(std::cos(angle), std::sin(angle)));
         }
         add_loop(cloud, resample(slits, 1.0, random));
         declare_twins(cloud);
         fill(cloud, pattern(any_pattern(random), h, random), 0.05 * h);
       }},
      {"thin neck",
       [](Cloud<2>& cloud, Random& random, double h) {
         const double w = std::pow(10.0, uniform(random, -4.0, -1.0));
         add_loop(cloud, resample({{-1, -1},
                                   {-0.1, -1},
                                   {-0.1, -w},
                                   {0.1, -w},
                                   {0.1, -1},
                                   {1, -1},
                                   {1, 1},
                                   {0.1, 1},
                                   {0.1, w},
                                   {-0.1, w},
                                   {-0.1, 1},
                                   {-1, 1}},
                                  h, random));
         fill(cloud, pattern(any_pattern(random), h, random), 0.05 * h);
       }},
      {"circumcentres beyond the boundary", // a coarse boundary with many nodes close to it
       [](Cloud<2>& cloud, Random& random, double h) {
         add_loop(cloud, integer(random, 0, 1) ? square : star(random));
         std::vector<Vec2> near;
         for (int k = 0; k < 200; ++k) {
           const std::size_t f =
               static_cast<std::size_t>(integer(random, 0, static_cast<int>(cloud.facets.size()) - 1));
           const Vec2 &a = cloud.position[static_cast<std::size_t>(cloud.facets[f].node[0])],
                      &b = cloud.position[static_cast<std::size_t>(cloud.facets[f].node[1])];
           const double depth = std::pow(10.0, uniform(random, -3.0, -0.5));
           near.push_back(a + uniform(random, 0.05, 0.95) * (b - a) +
                          depth * left_normal(b - a).normalized());
         }
         fill(cloud, near, 1e-3 * h);
       }},
      {"strongly graded",
       [](Cloud<2>& cloud, Random& random, double) {
         add_loop(cloud, resample(square, 0.5, random, 0.3));
         std::vector<Vec2> points;
         const Vec2 focus(uniform(random, -0.9, 0.9), uniform(random, -0.9, 0.9));
         for (int k = 0; k < 300; ++k) {
           const double r = std::pow(10.0, uniform(random, -5.0, 0.3)),
                        angle = uniform(random, 0.0, 2.0 * pi);
           points.push_back(focus + r * Vec2(std::cos(angle), std::sin(angle)));
         }
         fill(cloud, points, 1e-7);
       }},
      {"plate with holes",
       [](Cloud<2>& cloud, Random& random, double h) {
         add_loop(cloud, resample(square, h, random));
         for (int j = 0; j < 2; ++j)
           for (int i = 0; i < 2; ++i)
             add_loop(cloud,
                      circle({i - 0.5, j - 0.5}, uniform(random, 0.05, 0.45), integer(random, 5, 24), true));
         fill(cloud, pattern(any_pattern(random), h, random), 0.02 * h);
       }},
      {"two bodies in touch", // a conforming interface of twins
       [](Cloud<2>& cloud, Random& random, double h) {
         add_loop(cloud, resample({{-1, -1}, {0, -1}, {0, 1}, {-1, 1}}, h, random));
         add_loop(cloud, resample({{0, -1}, {1, -1}, {1, 1}, {0, 1}}, h, random));
         declare_twins(cloud);
         fill(cloud, pattern(any_pattern(random), h, random), 0.1 * h);
       }},
      {"boundary nodes only",
       [](Cloud<2>& cloud, Random& random, double h) {
         add_loop(cloud, resample(integer(random, 0, 1) ? l_shape : star(random), h, random, 0.3));
       }},
      {"stretched and sheared", // what large strain leaves behind between two rebuilds
       [](Cloud<2>& cloud, Random& random, double h) {
         add_loop(cloud, resample(integer(random, 0, 1) ? square : l_shape, h, random, 0.3));
         fill(cloud, pattern(any_pattern(random), h, random), 0.1 * h);
         const double flat = std::pow(10.0, uniform(random, -3.0, 0.0)), shear = uniform(random, -5.0, 5.0);
         for (Vec2& x : cloud.position) x = Vec2(x.x() + shear * x.y(), flat * x.y());
       }},
      {"ragged boundary", // what a cut leaves behind
       [](Cloud<2>& cloud, Random& random, double h) {
         Loop loop = resample(square, h, random, 0.3);
         for (Vec2& x : loop) x += h * Vec2(uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3));
         add_loop(cloud, loop);
         fill(cloud, pattern(any_pattern(random), h, random), 0.02 * h);
       }},
  };
  return families;
}

} // namespace

int families() { return static_cast<int>(table().size()); }

RandomCloud random_cloud(int family, std::uint32_t seed) {
  const auto& [name, make] = table()[static_cast<std::size_t>(family)];
  Random random(1000u * static_cast<std::uint32_t>(family) + seed);
  Cloud<2> cloud;
  cloud.piece_names = {"boundary"};
  make(cloud, random, uniform(random, 0.12, 0.4));
  // Half of the clouds are turned and shifted: nothing is aligned with the axes any more, and collinear
  // boundaries become collinear to rounding only.
  if (seed % 2 == 1) {
    const double angle = uniform(random, 0.0, 2.0 * pi), c = std::cos(angle), s = std::sin(angle);
    const Vec2 shift(uniform(random, -3.0, 3.0), uniform(random, -3.0, 3.0));
    for (Vec2& x : cloud.position) x = Vec2(c * x.x() - s * x.y(), s * x.x() + c * x.y()) + shift;
  }
  RandomCloud result{renumber(cloud, hilbert_order(cloud.position)), 0.0, 0.0,
                     std::string(name).append(" ").append(std::to_string(seed))};
  for (const auto& facet : cloud.facets)
    result.area += 0.5 * cross(cloud.position[static_cast<std::size_t>(facet.node[0])] - cloud.position[0],
                               cloud.position[static_cast<std::size_t>(facet.node[1])] - cloud.position[0]);
  Vec2 low = cloud.position[0], high = low;
  for (const Vec2& x : cloud.position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  result.size = (high - low).norm();
  return result;
}

} // namespace cnem::voronoi::test
