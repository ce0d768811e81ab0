#pragma once
// Bodies in space with what is known of them.
#include "clouds/space/domain.hpp"

#include <cmath>
#include <map>
#include <numbers>

namespace cnem::clouds::testing {

inline CurvePiece straight(const Vec2& from, const Vec2& to, const std::string& name) {
  return {from, to, {0, 0}, 0.0, false, name};
}

inline CurvePiece round(const Vec2& from, const Vec2& to, const Vec2& centre, const std::string& name,
                        bool clockwise = false) {
  return {from, to, centre, (from - centre).norm(), clockwise, name};
}

inline Curve ring(const Vec2& centre, double radius, const std::string& name) {
  const Vec2 right = centre + Vec2(radius, 0.0);
  return {{round(right, right, centre, name)}};
}

inline Curve corners(const std::vector<Vec2>& corner, const std::vector<std::string>& names) {
  Curve curve;
  for (std::size_t k = 0; k < corner.size(); ++k)
    curve.pieces.push_back(straight(corner[k], corner[(k + 1) % corner.size()], names[k]));
  return curve;
}

struct Body {
  std::string name;
  SpaceDomain domain;
  double volume;                       ///< m³
  std::map<std::string, double> areas; ///< m² of its pieces
  double spacing;                      ///< m, a coarse one
};

inline std::vector<Body> bodies() {
  constexpr double pi = std::numbers::pi;
  const Curve rectangle = corners({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {"y-", "x+", "y+", "x-"});
  const Curve ell = corners({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
                            {"foot", "toe", "sole", "shin", "top", "back"});
  const Curve slice{{straight({0, 0}, {1, 0}, "theta-"), round({1, 0}, {0, 1}, {0, 0}, "side"),
                     straight({0, 1}, {0, 0}, "theta+")}};
  const Curve half{{round({0, -1}, {0, 1}, {0, 0}, "side"), straight({0, 1}, {0, -1}, "axis")}};
  const Curve shell{{round({0, -2}, {0, 2}, {0, 0}, "outside"), straight({0, 2}, {0, 1}, "axis"),
                     round({0, 1}, {0, -1}, {0, 0}, "inside", true), straight({0, -1}, {0, -2}, "axis")}};
  const Curve bar = corners({{0, 0}, {1, 0}, {1, 2}, {0, 2}}, {"bottom", "side", "top", "axis"});
  const Curve tip = corners({{0, 0}, {1, 0}, {0, 2}}, {"bottom", "flank", "axis"});
  const Vec3 here(0, 0, 0), there(3, -1, 2);
  const double slope = std::sqrt(5.0);
  return {
      {"box",
       Extrusion{{rectangle, {}, {}}, 0, 1},
       2.0,
       {{"y-", 2}, {"x+", 1}, {"y+", 2}, {"x-", 1}, {"z-", 2}, {"z+", 2}},
       0.25},
      {"plate with a hole",
       Extrusion{{rectangle, {ring({1, 0.5}, 0.25, "hole")}, {}}, -1, -0.5, "low", "high"},
       0.5 * (2 - pi / 16),
       {{"hole", 0.25 * pi}, {"low", 2 - pi / 16}, {"high", 2 - pi / 16}, {"x+", 0.5}},
       0.12},
      {"L", Extrusion{{ell, {}, {}}, 0, 1}, 3.0, {{"shin", 1}, {"sole", 1}, {"z+", 3}}, 0.25},
      {"cylinder",
       Extrusion{{ring({0, 0}, 1, "side"), {}, {}}, 0, 1},
       pi,
       {{"side", 2 * pi}, {"z+", pi}},
       0.25},
      {"sector",
       Extrusion{{slice, {}, {}}, 0, 1},
       pi / 4,
       {{"theta-", 1}, {"theta+", 1}, {"side", pi / 2}},
       0.2},
      {"ball", Revolution{{half, {}, {}}, there, 2 * pi}, 4 * pi / 3, {{"side", 4 * pi}}, 0.3},
      {"quarter of a ball",
       Revolution{{half, {}, {}}, here, pi / 2},
       pi / 3,
       {{"side", pi}, {"theta-", pi / 2}, {"theta+", pi / 2}},
       0.25},
      {"shell",
       Revolution{{shell, {}, {}}, here, pi / 2},
       7 * pi / 3,
       {{"outside", 4 * pi}, {"inside", pi}, {"theta-", 1.5 * pi}},
       0.4},
      {"torus",
       Revolution{{ring({2, 0}, 0.7, "side"), {}, {}}, here, 2 * pi},
       4 * pi * pi * 0.49,
       {{"side", 8 * pi * pi * 0.7}},
       0.3},
      {"bar",
       Revolution{{bar, {}, {}}, here, 2 * pi},
       2 * pi,
       {{"bottom", pi}, {"top", pi}, {"side", 4 * pi}},
       0.3},
      {"quarter of a bar",
       Revolution{{bar, {}, {}}, here, pi / 2, "y-", "x-"},
       pi / 2,
       {{"side", pi}, {"y-", 2}, {"x-", 2}},
       0.3},
      {"cone",
       Revolution{{tip, {}, {}}, here, 2 * pi},
       2 * pi / 3,
       {{"bottom", pi}, {"flank", slope * pi}},
       0.2},
  };
}

} // namespace cnem::clouds::testing
