// Edges from rake faces of triangles, against cutters whose shape is known in closed form.
#include "machining/cutting_edge.hpp"

#include "core/error.hpp"
#include "machining/engaged_edges.hpp"
#include "machining/layer_grading.hpp"
#include "machining/milling_process.hpp"
#include "machining/stability.hpp"
#include "machining/zero_order.hpp"
#include "tests/unit/machining/benchmarks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::machining {
namespace {

constexpr double arc_degree = std::numbers::pi / 180.0;

/// m, of the profile of a cutter at a height.
double profile_radius(const Cutter& cutter, double z) {
  if (z >= cutter.corner) return cutter.radius();
  return cutter.radius() - cutter.corner +
         std::sqrt(std::max(0.0, cutter.corner * cutter.corner - std::pow(cutter.corner - z, 2)));
}

/// Heights up to `top`: a arc_degree of the corner apart, then equal.
std::vector<double> rows_of(const Cutter& cutter, double top, int rows) {
  std::vector<double> z;
  if (cutter.corner > 0.0)
    for (int k = 0; k < 90 && cutter.corner * (1.0 - std::cos(k * arc_degree)) < top; ++k)
      z.push_back(cutter.corner * (1.0 - std::cos(k * arc_degree)));
  else
    z.push_back(0.0);
  const double from = std::min(cutter.corner, top);
  if (from < top)
    for (int k = cutter.corner > 0.0 ? 0 : 1; k <= rows; ++k) z.push_back(from + (top - from) * k / rows);
  else
    z.push_back(top);
  return z;
}

/// The rake face of tooth 0, 1 mm deep, leaning back by an angle across the edge of a straight side.
TriangleSurface rake_face(const Cutter& cutter, double top, double rake = 0.0, int rows = 24) {
  TriangleSurface face;
  for (const double z : rows_of(cutter, top, rows)) {
    const double r = profile_radius(cutter, z), phi = -cutter.lag(z);
    const Vec3 edge = r * outward(phi) + z * Vec3::UnitZ();
    const double deep = std::min(r, 1e-3);
    Vec3 inner = edge - deep * outward(phi);
    if (rake != 0.0) {
      const Vec3 motion(std::cos(phi), -std::sin(phi), 0.0);
      const Vec3 across = std::cos(cutter.helix) * motion + std::sin(cutter.helix) * Vec3::UnitZ();
      inner = edge - deep * (std::cos(rake) * outward(phi) + std::sin(rake) * across);
    }
    face.points.push_back(edge);
    face.points.push_back(inner);
  }
  const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    face.triangles.push_back({a, b, c});
  };
  for (std::int32_t k = 0; k + 3 < static_cast<std::int32_t>(face.points.size()); k += 2) {
    add(k, k + 2, k + 1);
    add(k + 1, k + 2, k + 3);
  }
  FacetSoup soup; // joins points on the axis at the tip
  for (std::size_t t = 0; t < face.triangles.size(); ++t) soup.triangles.push_back({face.corners(t), 0});
  return joined(soup);
}

Cutter formed(double corner) {
  Cutter cutter;
  cutter.diameter = 10e-3;
  cutter.pitch = {2.0, 2.2, full_turn - 4.2};
  cutter.helix = 30.0 * arc_degree;
  cutter.corner = corner;
  return cutter;
}

/// The same cutter by its rake face alone.
Cutter traced(const Cutter& cutter, double top) {
  Cutter other = cutter;
  other.helix = other.corner = 0.0;
  other.edge = std::make_shared<const CuttingEdge>(rake_face(cutter, top));
  return other;
}

// Layers of a rake face that is that of a ball: as those of the ball, of arcs in place of straight parts.
TEST(CuttingEdge, HasTheLayersOfItsCutter) {
  MillingCut ball = milling_cut(3, 1e9, 0.0, Engagement::Side::up, 0.5);
  ball.cutter.corner = ball.cutter.radius();
  ball.cutter.helix = 0.4;
  ball.engagement.radial_depth = 4e-3; // in the cut above 0.343 mm
  MillingCut edge = ball;
  edge.cutter.edge = std::make_shared<const CuttingEdge>(rake_face(ball.cutter, 4e-3));
  const LayerGrading exact(ball, 3e-3, 360), of_edge(edge, 3e-3, 360);
  EXPECT_NEAR(of_edge.layers(), exact.layers(), 0.05 * exact.layers());
  const std::vector<double> a = exact.ends(30), b = of_edge.ends(30);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(b[k], a[k], 0.01 * 3e-3) << k;
  EXPECT_NEAR(of_edge.thickest(30), exact.thickest(30), 0.1 * exact.thickest(30));
  EXPECT_LT(exact.thickest(30), 0.4e-3);
}

} // namespace

TEST(CuttingEdge, HasRadiusLengthLeadAndLagOfItsCutter) {
  for (const double corner : {0.0, 2e-3, 5e-3}) {
    const Cutter cutter = formed(corner), other = traced(cutter, 6e-3);
    EXPECT_NEAR(other.edge->radius(), cutter.radius(), 1e-12);
    for (double low = 0.0; low < 4.4e-3; low += 0.25e-3) {
      const double high = low + 0.25e-3;
      EXPECT_NEAR(other.mean_radius(low, high), cutter.mean_radius(low, high), 1e-3 * cutter.radius()) << low;
      EXPECT_NEAR(other.profile(low, high) / cutter.profile(low, high), 1.0, 2e-3) << corner << ' ' << low;
      EXPECT_NEAR(other.lead(low, high), cutter.lead(low, high), 0.5 * arc_degree) << corner << ' ' << low;
      EXPECT_NEAR(other.mean_lag(low, high), cutter.mean_lag(low, high), 0.01 * arc_degree)
          << corner << ' ' << low;
    }
  }
}

TEST(CuttingEdge, HasALeadAtAHeight) {
  for (const double corner : {0.0, 2e-3, 5e-3}) {
    const Cutter cutter = formed(corner), other = traced(cutter, 6e-3);
    for (const double z : {0.0, 0.7e-3, 1.9e-3, 3e-3, 6e-3, 7e-3})
      EXPECT_NEAR(other.lead(z, z), cutter.lead(z, z), 0.6 * arc_degree) << corner << ' ' << z;
  }
}

TEST(CuttingEdge, AnglesAreThoseOfTheFace) {
  const Cutter cutter = formed(0.0);
  for (const int rows : {24, 96})
    for (const double rake : {-10.0 * arc_degree, 0.0, 15.0 * arc_degree}) {
      const CuttingEdge edge(rake_face(cutter, 6e-3, rake, rows));
      const auto [inclination, found] = edge.angles(0.0, 6e-3);
      EXPECT_NEAR(inclination, cutter.helix, 0.05 * arc_degree);
      // A facet of a helical face leans by half of what the edge turns by along it.
      EXPECT_NEAR(found, rake, 0.51 * std::cos(cutter.helix) * cutter.lag(6e-3 / rows));
    }
}

TEST(CuttingEdge, CutsAsTheCutterThatItIsOf) {
  for (const double corner : {0.0, 2e-3, 5e-3})
    for (const double run_out : {0.0, 15e-6}) {
      MillingCut cut;
      cut.cutter = formed(corner);
      cut.cutter.run_out = run_out;
      cut.law = aluminium();
      cut.engagement = {Engagement::Side::down, 3e-3};
      cut.feed = 1e-4;
      MillingCut other = cut;
      other.cutter = traced(cut.cutter, 6e-3);
      const ProcessSettings settings{
          .spindle = 800.0, .axial_depth = 3e-3, .length = 0.9e-3, .pitch = 1e-4, .layers = 20, .steps = 180};
      MillingProcess known(cut, {}, settings), traced_one(other, {}, settings);
      double most = 0.0, apart = 0.0, removed = 0.0, removed_too = 0.0, power = 0.0, power_too = 0.0;
      while (!known.at_end()) {
        const ProcessStep one = known.advance(), two = traced_one.advance();
        if (known.steps() < 2 * settings.steps) continue; // earlier turns are told by one formula for both
        most = std::max(most, one.force.norm());
        apart = std::max(apart, (one.force - two.force).norm());
        removed += one.removed;
        removed_too += two.removed;
        power += one.power;
        power_too += two.power;
      }
      EXPECT_LT(apart, 0.01 * most) << corner << ' ' << run_out;
      EXPECT_NEAR(removed_too / removed, 1.0, 1e-3) << corner << ' ' << run_out;
      EXPECT_NEAR(power_too / power, 1.0, 1e-3) << corner << ' ' << run_out;
    }
}

TEST(CuttingEdge, EndsWithItsFaceToALayer) {
  MillingCut cut = milling_cut(2, 767e6, 168.8e6, Engagement::Side::down, 0.25);
  const Cutter flat = formed(0.0);
  cut.cutter = traced(flat, 3e-3 - 1e-7); // of a file with single precision
  const auto removed = [&](double axial_depth, int layers) {
    MillingProcess process(cut, {},
                           {.spindle = 800.0,
                            .axial_depth = axial_depth,
                            .length = 0.6e-3,
                            .pitch = 1e-4,
                            .layers = layers,
                            .steps = 90});
    double sum = 0.0;
    while (!process.at_end()) {
      const ProcessStep step = process.advance();
      EXPECT_TRUE(step.force.allFinite() && std::isfinite(step.torque));
      sum += step.removed;
    }
    return sum;
  };
  const double whole = removed(3e-3, 20);
  EXPECT_GT(whole, 0.0);
  cut.cutter = traced(flat, 6e-3);
  EXPECT_NEAR(whole / removed(3e-3, 20), 1.0, 1e-4) << "the layer at the top is cut";
  TriangleSurface face = rake_face(flat, 6e-3);
  for (Vec3& point : face.points) point.z() += 8e-6; // two layers below the edge
  cut.cutter.edge = std::make_shared<const CuttingEdge>(face);
  const double step = full_turn / 90, thickness = 4e-6;
  const EdgeElements edges(cut, slices(10 * thickness, thickness), 0.0, step);
  for (std::size_t k = 0; k < edges.layers(); ++k) EXPECT_EQ(edges.reaches(k), k >= 2) << k;
  const double above = removed(10 * thickness, 10);
  cut.cutter = traced(flat, 6e-3);
  EXPECT_NEAR(above / removed(10 * thickness, 10), 0.8, 1e-3) << "layers below the edge stay";
}

TEST(CuttingEdge, RefusesWhatIsNoRakeFace) {
  const TriangleSurface good = rake_face(formed(0.0), 6e-3);
  const auto refuse = [](const TriangleSurface& face, const char* why) {
    try {
      const CuttingEdge edge(face);
      ADD_FAILURE() << why;
    } catch (const GeometryError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  TriangleSurface face = good;
  face.triangles.erase(face.triangles.begin() + 10);
  face.triangles.erase(face.triangles.begin() + 11);
  face.triangles.erase(face.triangles.begin() + 10);
  refuse(face, "several pieces");
  face = good;
  std::swap(face.triangles[7][0], face.triangles[7][1]);
  refuse(face, "more than one way");
  face = good;
  for (Vec3& x : face.points)
    if (x.z() > 2e-3 && x.z() < 2.3e-3 && x.head<2>().norm() > 4.9e-3) x.z() += 0.6e-3;
  refuse(face, "does not rise");
}

/// Lobes take what a face is like as the time domain does: those of the cutter that it is of. A chord of a
/// facet that ends within the depth leans by up to 0.4 deg along the profile; the ball begins to cut at a
/// radius of 1 mm, within a row of its face.
TEST(CuttingEdge, HasTheLobesOfItsCutter) {
  using enum Engagement::Side;
  for (const auto& rounded : {std::pair{0.0, up}, {2e-3, down}, {5e-3, down}}) {
    const double corner = rounded.first;
    const auto side = rounded.second;
    MillingCut cut = milling_cut(3, 2e9, 8e8, side, 0.4);
    cut.cutter = formed(corner);
    cut.engagement.radial_depth = 4e-3;
    MillingCut by_face = cut;
    by_face.cutter = traced(cut.cutter, 6e-3);
    std::vector<Mode> modes = spindle_modes();
    modes[0].direction = Vec3(0.8, 0.0, 0.6);
    const auto limits = [&](const MillingCut& one) {
      const auto floquet = depth_limit(one, modes, 7000.0 * rpm, 4e-4, 5e-3);
      const auto zero = zero_order_limit(one, modes, 7000.0 * rpm);
      EXPECT_TRUE(floquet && zero) << corner;
      return floquet && zero ? std::array{floquet->depth, zero->depth} : std::array{0.0, 0.0};
    };
    const auto given = limits(cut), of_face = limits(by_face);
    for (const std::size_t k : {0u, 1u}) EXPECT_NEAR(of_face[k] / given[k], 1.0, 2e-3) << corner << ' ' << k;
  }
}

/// A corner that is nearly none: limits are those of a flat end.
TEST(CuttingEdge, LobesOfASmallCornerAreThoseOfAFlatEnd) {
  MillingCut flat = spindle_cut(0.5);
  flat.cutter.helix = 0.4;
  MillingCut bull = flat;
  bull.cutter.corner = 1e-6;
  const auto limit = [&](const MillingCut& cut) {
    return depth_limit(cut, spindle_modes(), 9000.0 * rpm, 2e-4, 5e-3)->depth;
  };
  EXPECT_NEAR(limit(bull) / limit(flat), 1.0, 1e-3);
  const auto zero = zero_order_limit(bull, spindle_modes(), 9000.0 * rpm),
             of_flat = zero_order_limit(flat, spindle_modes(), 9000.0 * rpm);
  EXPECT_NEAR(zero->depth / of_flat->depth, 1.0, 1e-3);
  EXPECT_NEAR(zero->frequency / of_flat->frequency, 1.0, 1e-4);
}

/// Also of edges whose radius falls with the height, which leave the workpiece at the upper end of a slice.
TEST(CuttingEdge, SlicesChangeTheirTurnBySteps) {
  using enum Engagement::Side;
  Cutter dovetail = formed(0.0);
  TriangleSurface face = rake_face(dovetail, 6e-3);
  for (Vec3& point : face.points) point.head<2>() *= 1.0 - 0.5 * point.z() / 6e-3;
  dovetail.edge = std::make_shared<const CuttingEdge>(face);
  dovetail.helix = 0.0;
  for (const auto& [cutter, depth] : {std::pair{formed(5e-3), 5e-3}, {dovetail, 6e-3}})
    for (const auto side : {up, down})
      for (const double radial_depth : {1e-3, 4e-3, 6.5e-3}) {
        MillingCut cut = milling_cut(3, 2e9, 8e8, side, 0.5);
        cut.cutter = cutter;
        cut.engagement.radial_depth = radial_depth;
        const std::vector<EdgeSlice> slices = edge_slices(cut, depth);
        double before = -1.0, most = 0.0;
        for (const EdgeSlice& slice : slices) {
          const double begin = slice.exit[0] - slice.entry[0], end = slice.exit[1] - slice.entry[1];
          EXPECT_LE(std::abs(end - begin), 0.1 + 1e-6) << radial_depth;
          EXPECT_GT(slice.width, 1e-9 * depth) << "no slivers";
          EXPECT_TRUE(before < 0.0 || begin == before);
          before = end;
          most = std::max(most, std::abs(end - begin));
        }
        EXPECT_GT(most, 0.005) << "the turn changes over the height";
        EXPECT_LT(slices.size(), 150u);
      }
}

/// Below half of its radius this ball is in the cut beyond the exit of its side, up to 180°: there, too, one
/// tooth begins to miss it.
TEST(CuttingEdge, FactorsOfABallWithRunOutAreThoseOfAFineSum) {
  MillingCut cut = milling_cut(2, 2e9, 8e8, Engagement::Side::up, 0.75);
  cut.cutter = formed(5e-3);
  cut.cutter.pitch = equal_pitch(2);
  cut.engagement.radial_depth = 1.5 * cut.cutter.radius();
  cut.cutter.run_out = 0.25 * cut.feed;
  KienzleLaw law;
  law.Kt1 = 400e6;
  law.Kr1 = 130e6;
  law.mt = law.mr = 0.05;
  cut.law = law;
  constexpr double depth = 0.6e-3, spindle = 800.0; // radius 2.37 mm
  const DirectionalFactors found = EngagedEdges(cut, depth, spindle).mean_factors();
  DirectionalFactors sum = DirectionalFactors::Zero();
  constexpr int heights = 8, angles = 5000;
  bool misses_late = false;
  for (const EdgeSlice& slice : edge_slices(cut, depth))
    for (std::size_t tooth = 0; tooth < 2; ++tooth)
      for (int i = 0; i < heights; ++i) {
        const double x = (i + 0.5) / heights, entry = (1.0 - x) * slice.entry[0] + x * slice.entry[1],
                     turn = (1.0 - x) * slice.exit[0] + x * slice.exit[1] - entry;
        for (int k = 0; k < angles; ++k) {
          const double phi = entry + turn * (k + 0.5) / angles,
                       h = slice.sine * steady_thickness(cut, tooth, phi);
          if (!(h > 0.0)) {
            misses_late |= phi > cut.engagement.exit(cut.cutter) && phi < 2.9;
            continue;
          }
          const LawPoint point = cut.law.at({.thickness = h, .speed = spindle * slice.radius});
          sum += slice.answer(phi, point.slope) * (turn / (full_turn * heights * angles));
        }
      }
  EXPECT_TRUE(misses_late);
  EXPECT_LT((found - sum).norm() / sum.norm(), 1e-3);
}

} // namespace cnem::machining
