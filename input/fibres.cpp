#include "input/fibres.hpp"

#include "input/case_walls.hpp"
#include "input/curve_checks.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace cnem::input {
namespace {

/// Where straight lines both ways from x meet the boundary first: against `along`, then along it.
std::array<Vec2, 2> ends_of_line(const Domain& domain, const Vec2& x, const Vec2& along) {
  const double size = extent(domain.outer);
  std::array<Vec2, 2> ends{x, x};
  for (std::size_t way = 0; way < 2; ++way) {
    const CurvePiece ray{x, x + (way == 0 ? -2.0 : 2.0) * size * along, {0, 0}, 0.0, false, ""};
    double nearest = 2.0 * size;
    for (const auto& [name, curve] : curves_of(domain))
      for (const CurvePiece& piece : curve->pieces)
        for (const Vec2& meets : meeting_points(ray, piece, 1e-12 * size))
          if ((meets - x).norm() < nearest) {
            nearest = (meets - x).norm();
            ends[way] = meets;
          }
  }
  return ends;
}

} // namespace

void read_fibres(const Setting& root, Domain& domain, Diagnostics& diagnostics) {
  for (const Setting& bundle : root.entries("domain.fibres")) {
    const auto number = bundle.get<std::int64_t>("number");
    const double width = bundle.get<double>("width"), pitch = bundle.get<double>("pitch"),
                 angle = bundle.get<double>("angle");
    const Setting& centre = *bundle.find("centre");
    if (number > 1 && !(pitch > width))
      diagnostics.add(Mistake::range, bundle.find("pitch")->where, bundle.path + ".pitch",
                      fmt::format("found {} m, expected more than the width of a fibre, {} m", pitch, width));
    const Vec2 along(std::cos(angle), std::sin(angle)), right = right_normal(along);
    for (std::int64_t k = 0; k < number; ++k) {
      const std::string name = fmt::format("{}{}", bundle.name, k + 1);
      const Vec2 middle = std::get<Vec2>(centre.value) +
                          (static_cast<double>(k) - 0.5 * static_cast<double>(number - 1)) * pitch * right;
      for (const double side : {-0.5, 0.5}) {
        const Vec2 x = middle + side * width * right;
        if (const std::string reason = outside_reason(domain, x); !reason.empty()) {
          diagnostics.add(Mistake::geometry, centre.where, centre.path,
                          fmt::format("a face of fibre {} goes through {}, which is {}, expected fibres that "
                                      "pass beside `centre` within the workpiece",
                                      k + 1, show(x), reason));
          return;
        }
        const auto [from, to] = ends_of_line(domain, x, along);
        Interface& face = domain.interfaces.emplace_back();
        face.name = name + (side < 0.0 ? "_left" : "_right");
        face.path = {from, to};
        face.key = bundle.path;
        if (const Setting* cohesive = bundle.find("cohesive")) read_cohesive(*cohesive, face, diagnostics);
      }
      const auto [from, to] = ends_of_line(domain, middle, along);
      domain.regions.push_back({name, 0.5 * (from + to), bundle.get<std::string>("material"),
                                root.get<double>("initial.temperature"), root.get<Vec2>("initial.velocity")});
    }
  }
}

} // namespace cnem::input
