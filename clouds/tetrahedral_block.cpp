#include "clouds/tetrahedral_block.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::clouds {

TetrahedralBlock tetrahedral_block(const Vec<3>& size, const std::array<int, 3>& count,
                                   const std::function<Vec<3>(const Vec<3>&)>& place) {
  if (*std::min_element(count.begin(), count.end()) < 1 || !(size.minCoeff() > 0.0))
    throw GeometryError(fmt::format("a block of {} x {} x {} boxes and {:g} x {:g} x {:g} m is none",
                                    count[0], count[1], count[2], size.x(), size.y(), size.z()));
  TetrahedralBlock block;
  const auto index = [&](int i, int j, int k) {
    return as<NodeIndex>((k * (count[1] + 1) + j) * (count[0] + 1) + i);
  };
  for (int k = 0; k <= count[2]; ++k)
    for (int j = 0; j <= count[1]; ++j)
      for (int i = 0; i <= count[0]; ++i)
        block.cloud.position.push_back(
            place({size.x() * i / count[0], size.y() * j / count[1], size.z() * k / count[2]}));
  block.cloud.piece_names = {"x-", "x+", "y-", "y+", "z-", "z+"};

  // From corner 000 to 111 of a box along the axes in each order; odd orders are left-handed.
  constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i)
        for (int o = 0; o < 6; ++o) {
          std::array<int, 3> at{i, j, k};
          std::array<NodeIndex, 4> corner{index(i, j, k)};
          for (int step = 0; step < 3; ++step) {
            ++at[index_of(orders[o][step])];
            corner[index_of(step + 1)] = index(at[0], at[1], at[2]);
          }
          if (o >= 3) std::swap(corner[1], corner[2]);
          const auto x = [&](int c) { return block.cloud.position[corner[index_of(c)]]; };
          if (!((x(1) - x(0)).cross(x(2) - x(0)).dot(x(3) - x(0)) > 0.0))
            throw GeometryError(
                fmt::format("a tetrahedron of the block at ({:g}, {:g}, {:g}) m has no volume", x(0).x(),
                            x(0).y(), x(0).z()));
          block.tetrahedra.push_back(corner);
        }

  // A side is cut along the diagonal from its lowest to its highest corner, as the tetrahedra cut it.
  const auto add_side = [&](int axis, bool high) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    for (int second = 0; second < count[index_of(b)]; ++second)
      for (int first = 0; first < count[index_of(a)]; ++first) {
        const auto node = [&](int du, int dv) {
          std::array<int, 3> at{};
          at[index_of(axis)] = high ? count[index_of(axis)] : 0;
          at[index_of(a)] = first + du;
          at[index_of(b)] = second + dv;
          return index(at[0], at[1], at[2]);
        };
        const auto piece = as<PieceIndex>(2 * axis + (high ? 1 : 0));
        for (const bool upper : {false, true}) {
          std::array<NodeIndex, 3> corner{node(0, 0), upper ? node(1, 1) : node(1, 0),
                                          upper ? node(0, 1) : node(1, 1)};
          if (!high) std::swap(corner[1], corner[2]);
          block.cloud.facets.push_back({corner, piece});
        }
      }
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true}) add_side(axis, high);
  return block;
}

Vec2 disc_of_square(const Vec2& x) {
  return {x.x() * std::sqrt(1.0 - 0.5 * x.y() * x.y()), x.y() * std::sqrt(1.0 - 0.5 * x.x() * x.x())};
}

} // namespace cnem::clouds
