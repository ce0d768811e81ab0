#include "clouds/generate_boundary.hpp"
#include "clouds/space/patches.hpp"
#include "core/error.hpp"
#include "core/geometry/place_text.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace cnem::clouds {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

Vec3 turned(const Vec2& x, double angle) { return {x.x() * std::cos(angle), x.x() * std::sin(angle), x.y()}; }

/// The profile with its pieces cut so that none touches the axis with both ends, unless it lies on it, and
/// with places on the axis exactly there.
Curve cut_at_poles(Curve curve, double tolerance) {
  Curve result;
  for (CurvePiece& piece : curve.pieces) {
    for (Vec2* end : {&piece.from, &piece.to})
      if (std::abs(end->x()) <= tolerance) end->x() = 0.0;
    const double least = piece.is_arc() ? std::min({piece.point(0.25).x(), piece.point(0.5).x(),
                                                    piece.point(0.75).x(), piece.from.x(), piece.to.x()})
                                        : std::min(piece.from.x(), piece.to.x());
    if (least < -tolerance)
      throw GeometryError(
          fmt::format("the profile crosses the axis: '{}' from {} to {} reaches the radius {:.6g} m; "
                      "expected radii of at least 0",
                      piece.name, place_text(piece.from), place_text(piece.to), least));
    if (piece.is_arc() && piece.from.x() == 0.0 && piece.to.x() == 0.0) {
      CurvePiece half = piece;
      half.to = piece.point(0.5);
      result.pieces.push_back(half);
      half = piece;
      half.from = result.pieces.back().to;
      result.pieces.push_back(half);
    } else {
      result.pieces.push_back(piece);
    }
  }
  return result;
}

bool on_axis(const CurvePiece& piece) {
  return !piece.is_arc() && piece.from.x() == 0.0 && piece.to.x() == 0.0;
}

/// A function of the fraction of a piece that grows or falls, by values at equal steps.
class Monotone {
public:
  explicit Monotone(std::vector<double> values)
      : value_(std::move(values)), falls_(value_.back() < value_.front()) {}

  double operator()(double s) const {
    const double at = std::clamp(s, 0.0, 1.0) * steps();
    const auto k = std::min(static_cast<std::size_t>(at), value_.size() - 2);
    return value_[k] + (at - static_cast<double>(k)) * (value_[k + 1] - value_[k]);
  }
  /// The fraction at which it has a value.
  double inverse(double value) const {
    const auto after = falls_ ? std::ranges::upper_bound(value_, value, std::ranges::greater{})
                              : std::ranges::upper_bound(value_, value);
    const auto k = std::clamp<std::ptrdiff_t>(after - value_.begin(), 1, std::ssize(value_) - 1);
    const double before = value_[index_of(k - 1)], past = value_[index_of(k)];
    return std::clamp((static_cast<double>(k - 1) + (value - before) / (past - before)) / steps(), 0.0, 1.0);
  }

private:
  double steps() const { return static_cast<double>(value_.size() - 1); }

  std::vector<double> value_;
  bool falls_;
};

constexpr int steps = 2000; // along a piece

double radius_at(const CurvePiece& piece, double s) { return std::max(piece.point(s).x(), 0.0); }

/// The smaller radius of curvature of the surface that a piece sweeps; of a cone not below that at the radius
/// `core`: its tip is one node.
double curvature_radius(const CurvePiece& piece, double s, double core) {
  const double normal = std::abs(piece.tangent(s).y()), round = radius_at(piece, s);
  if (!piece.is_arc()) return normal > 1e-9 ? std::max(round, core) / normal : straight;
  const double by_circle = normal > 1e-9 ? round / normal : straight;
  return round > 1e-6 * piece.radius ? std::min(piece.radius, by_circle) : piece.radius;
}

/// ∫ ds/r from the start of a piece that does not touch the axis.
Monotone isothermal(const CurvePiece& piece) {
  std::vector<double> sum{0.0};
  for (int k = 0; k < steps; ++k)
    sum.push_back(sum.back() + piece.length() / steps / radius_at(piece, (k + 0.5) / steps));
  return Monotone(std::move(sum));
}

/// Distance from the pole in the plane of the patch around it: proportional to exp ∫ ds/r, the radius where
/// that is the largest; within `core` (m) of the pole in proportion to the length, which leaves tips finite.
Monotone stereographic(const CurvePiece& piece, double core) {
  const bool outwards = piece.to.x() > piece.from.x();
  std::vector<double> distance{std::max(piece.from.x(), piece.to.x())};
  const double step = piece.length() / steps;
  double inner = 0.0;               // where the core begins
  for (int k = steps; k > 0; --k) { // in to the pole
    const double s = (k - 0.5) / steps, radius = radius_at(piece, outwards ? s : 1.0 - s);
    if (radius < core && inner == 0.0) inner = distance.back() / k;
    distance.push_back(inner > 0.0 ? inner * (k - 1) : distance.back() * std::exp(-step / radius));
  }
  if (outwards) std::ranges::reverse(distance);
  return Monotone(std::move(distance));
}

struct Edge {
  Polyline vertex;        ///< ends among them
  std::vector<double> at; ///< [vertex] fraction
};

/// What the pieces of one curve of the profile sweep.
class Sweep {
public:
  Sweep(SurfaceBuilder& surface, const Curve& curve, double angle)
      : surface_(surface), curve_(curve), angle_(angle), full_(angle == full_turn) {
    const std::size_t count = curve.pieces.size();
    for (std::size_t end = 0; end < 2; ++end)
      for (const CurvePiece& piece : curve.pieces) {
        const bool shared = end == 1 && (full_ || piece.from.x() == 0.0);
        corner_[end].push_back(shared ? corner_[0][corner_[end].size()]
                                      : surface.add(turned(piece.from, end == 0 ? 0.0 : angle)));
      }
    for (std::size_t p = 0; p < count; ++p) add_circle(p);
    for (std::size_t end = 0; end < 2; ++end)
      for (std::size_t p = 0; p < count; ++p) add_meridian(end, p);
  }

  void add_sides() {
    for (std::size_t p = 0; p < curve_.pieces.size(); ++p) {
      const CurvePiece& piece = curve_.pieces[p];
      if (on_axis(piece)) continue;
      if (is_flat(piece) || piece.from.x() == 0.0 || piece.to.x() == 0.0)
        add_polar(p);
      else
        add_strip(p);
    }
  }

  /// The profile at an end, in its own plane.
  PatchLoop end_loop(std::size_t end) const {
    PatchLoop loop;
    for (std::size_t p = 0; p < curve_.pieces.size(); ++p) {
      const Edge& edge = meridian_[end][p];
      for (std::size_t k = 0; k + 1 < edge.vertex.size(); ++k)
        loop.add(edge.vertex[k], curve_.pieces[p].point(edge.at[k]));
    }
    return loop;
  }

private:
  void add_circle(std::size_t p) {
    const Vec2 x = curve_.pieces[p].from;
    Edge edge{{corner_[0][p]}, {0.0}};
    if (x.x() > 0.0) {
      const auto place = [&](double s) { return turned(x, s * angle_); };
      edge.at = surface_.divide(place, x.x() * angle_, x.x(), angle_);
      for (std::size_t k = 1; k + 1 < edge.at.size(); ++k)
        edge.vertex.push_back(surface_.add(place(edge.at[k])));
      edge.vertex.push_back(corner_[1][p]);
    }
    circle_.push_back(std::move(edge));
  }

  /// Where the whole turn leaves no ends, lines of nodes are wanted on faces that are cut open only.
  void add_meridian(std::size_t end, std::size_t p) {
    const CurvePiece& piece = curve_.pieces[p];
    if (full_ && end == 1) return meridian_[1].push_back(meridian_[0][p]);
    if (end == 1 && on_axis(piece)) return meridian_[1].push_back(meridian_[0][p]);
    const std::size_t next = (p + 1) % curve_.pieces.size();
    Edge edge{{corner_[end][p]}, {0.0, 1.0}};
    if (!full_ || needs_seam(piece)) {
      const auto place = [&](double s) { return turned(piece.point(s), end == 0 ? 0.0 : angle_); };
      edge.at =
          surface_.divide(place, piece.length(), piece.is_arc() ? piece.radius : straight, piece.sweep());
      for (std::size_t k = 1; k + 1 < edge.at.size(); ++k)
        edge.vertex.push_back(surface_.add(place(edge.at[k])));
    }
    edge.vertex.push_back(corner_[end][next]);
    meridian_[end].push_back(std::move(edge));
  }

  static bool is_flat(const CurvePiece& piece) {
    return !piece.is_arc() && std::abs(piece.from.y() - piece.to.y()) <= 1e-12 * piece.length();
  }

  /// Faces around a rounded pole and plane rings need no cut: a pole is no node there.
  static bool needs_seam(const CurvePiece& piece) {
    if (on_axis(piece)) return false;
    if (is_flat(piece)) return false;
    const bool first = piece.from.x() == 0.0, last = piece.to.x() == 0.0;
    if (!first && !last) return true;
    return std::abs(piece.tangent(first ? 0.0 : 1.0).y()) > 1e-6; // a cone's tip is a node
  }

  void add(PatchLoop& loop, const Edge& edge, bool back, const std::function<Vec2(double)>& place) const {
    const std::size_t n = edge.vertex.size();
    for (std::size_t k = 0; k + 1 < n; ++k) {
      const std::size_t i = back ? n - 1 - k : k;
      loop.add(edge.vertex[i], place(edge.at[i]));
    }
  }

  /// Growth of a spacing that is given along a piece, at its values there.
  static double steepest(const std::vector<double>& at, const std::vector<double>& value) {
    double growth = 0.0;
    for (std::size_t k = 1; k < at.size(); ++k)
      growth = std::max(growth, std::abs(value[k] - value[k - 1]) / std::abs(at[k] - at[k - 1]));
    return growth;
  }

  /// The map of a patch to its plane, by the fraction of the piece.
  struct Plane {
    std::function<double(double)> across;        ///< place on a meridian, m
    std::function<double(double)> enlarged;      ///< lengths in the plane over those on the surface
    std::function<double(const Vec2&)> fraction; ///< of a place in the plane
    double core;                                 ///< m, radius around a pole
  };

  void set_spacing(Patch& patch, const CurvePiece& piece, const Plane& plane) const {
    const SpaceSpacing& field = surface_.spacing();
    constexpr int samples = 400;
    double coarsest = 0.0, finest = std::numeric_limits<double>::infinity();
    std::vector<double> at, value;
    for (int k = 0; k <= samples; ++k) {
      const double s = static_cast<double>(k) / samples, limit = curvature_radius(piece, s, plane.core);
      at.push_back(plane.across(s));
      value.push_back(plane.enlarged(s) * curved_spacing(field.spacing, limit));
      coarsest = std::max(coarsest, value.back());
      finest = std::min(finest, plane.enlarged(s) * curved_spacing(field.finest(), limit));
    }
    patch.spacing = SpacingField{coarsest, {}};
    const double growth = field.growth() + steepest(at, value);
    if (growth < 1e-6) return;
    patch.spacing.mapped = {[&field, &piece, plane, place = patch.on_surface](const Vec2& x) {
                              const double s = plane.fraction(x);
                              return plane.enlarged(s) *
                                     curved_spacing(field.at(place(x)),
                                                    curvature_radius(piece, s, plane.core));
                            },
                            finest, std::min(growth, 0.9)};
  }

  /// (θ, ∫ ds/r) times the largest radius.
  void add_strip(std::size_t p) {
    const CurvePiece& piece = curve_.pieces[p];
    const Monotone integral = isothermal(piece);
    double size = 0.0;
    for (int k = 0; k <= 64; ++k) size = std::max(size, radius_at(piece, k / 64.0));
    const double width = size * angle_;
    const auto height = [&](double s) { return size * integral(s); };
    Patch patch;
    patch.piece = surface_.piece(piece.name);
    PatchLoop loop;
    add(loop, circle_[p], false, [&](double s) { return Vec2(s * width, 0.0); });
    add(loop, meridian_[1][p], false, [&](double s) { return Vec2(width, height(s)); });
    add(loop, circle_[(p + 1) % circle_.size()], true,
        [&](double s) { return Vec2(s * width, height(1.0)); });
    add(loop, meridian_[0][p], true, [&](double s) { return Vec2(0.0, height(s)); });
    patch.loops.push_back(std::move(loop));
    const auto fraction = [&integral, size](const Vec2& x) { return integral.inverse(x.y() / size); };
    patch.on_surface = [&piece, fraction, size](const Vec2& x) {
      return turned(piece.point(fraction(x)), x.x() / size);
    };
    set_spacing(patch, piece,
                {height, [&piece, size](double s) { return size / radius_at(piece, s); }, fraction, 0.0});
    surface_.add_patch(patch);
  }

  /// Polar coordinates around a pole, or of a plane face, whose plane it is.
  void add_polar(std::size_t p) {
    const CurvePiece& piece = curve_.pieces[p];
    const bool outwards = piece.to.x() > piece.from.x(), flat = is_flat(piece);
    const double rim = std::max(piece.to.x(), piece.from.x());
    const double core = surface_.spacing().at(turned(outwards ? piece.from : piece.to, 0.0));
    const Monotone distance = flat ? Monotone({piece.from.x(), piece.to.x()}) : stereographic(piece, core);
    Patch patch;
    patch.piece = surface_.piece(piece.name);
    patch.turned = outwards;
    patch.on_surface = [&](const Vec2& x) {
      return turned(piece.point(distance.inverse(x.norm())), std::atan2(x.y(), x.x()));
    };
    const std::size_t next = (p + 1) % circle_.size();
    const Edge &outer = circle_[outwards ? next : p], &inner = circle_[outwards ? p : next];
    const auto circle = [&](double radius) {
      return [this, radius](double s) {
        const double angle = full_ && s == 1.0 ? 0.0 : s * angle_;
        return Vec2(radius * std::cos(angle), radius * std::sin(angle));
      };
    };
    const auto ray = [&](double angle) {
      return [&distance, angle](double s) {
        return Vec2(distance(s) * std::cos(angle), distance(s) * std::sin(angle));
      };
    };
    const double hole = std::min(piece.from.x(), piece.to.x());
    PatchLoop loop;
    add(loop, outer, false, circle(rim));
    patch.loops.resize(1);
    if (full_ && !needs_seam(piece)) {
      if (hole > 0.0) add(patch.loops.emplace_back(), inner, true, circle(hole));
    } else {
      add(loop, meridian_[1][p], outwards, ray(full_ ? 0.0 : angle_));
      if (hole > 0.0) add(loop, inner, true, circle(hole));
      add(loop, meridian_[0][p], !outwards, ray(0.0));
    }
    patch.loops.front() = std::move(loop);
    const auto enlarged = [&](double s) {
      if (flat) return 1.0;
      double radius = radius_at(piece, s);
      if (radius < core) { // one factor holds there
        constexpr double beyond = 1.0 / steps;
        double at = s;
        while (radius < core && at >= 0.0 && at <= 1.0) {
          at += outwards ? beyond : -beyond;
          radius = radius_at(piece, at);
        }
        s = at;
      }
      return distance(s) / radius;
    };
    set_spacing(patch, piece,
                {distance, enlarged, [&](const Vec2& x) { return distance.inverse(x.norm()); }, core});
    surface_.add_patch(patch);
  }

  SurfaceBuilder& surface_;
  const Curve& curve_;
  double angle_;
  bool full_;
  std::array<Polyline, 2> corner_;            ///< [end][piece] where it starts
  std::vector<Edge> circle_;                  ///< [piece] swept by its start
  std::array<std::vector<Edge>, 2> meridian_; ///< [end][piece]
};

/// A whole turn leaves a body only where the profile leaves the axis along it.
void check_poles(const Curve& curve) {
  for (std::size_t p = 0; p < curve.pieces.size(); ++p) {
    const CurvePiece& piece = curve.pieces[(p + 1) % curve.pieces.size()];
    if (piece.from.x() == 0.0 && !on_axis(curve.pieces[p]) && !on_axis(piece))
      throw GeometryError(
          fmt::format("the profile touches the axis at the single point {}; expected an edge on "
                      "the axis, or none",
                      place_text(piece.from)));
  }
}

} // namespace

Cloud<3> revolved_surface(const Revolution& shape, const SpaceSpacing& field) {
  if (!(shape.angle > 0.0 && shape.angle <= full_turn * (1.0 + 1e-12)))
    throw GeometryError(
        fmt::format("a profile turned by {:g} rad makes no body; expected an angle in (0, 2π]", shape.angle));
  if (!shape.profile.cracks.empty())
    throw GeometryError("a profile with cracks is not revolved; expected none");
  DomainShape profile = checked_and_oriented(shape.profile);
  check_holes(profile);
  const double tolerance = 1e-9 * domain_size(profile);
  profile.outer = cut_at_poles(profile.outer, tolerance);
  for (Curve& hole : profile.holes) hole = cut_at_poles(hole, tolerance);
  SpaceSpacing spacing = field; // as it is seen from the origin
  for (SpaceRefinement& refinement : spacing.refinements)
    for (Vec3& x : refinement.points) x -= shape.origin;
  const bool full = shape.angle > full_turn * (1.0 - 1e-12);
  SurfaceBuilder surface(spacing);
  std::array<Patch, 2> ends;
  for (std::size_t end = 0; end < 2 && !full; ++end) {
    const auto place = [angle = end == 0 ? 0.0 : shape.angle](const Vec2& x) { return turned(x, angle); };
    ends[end] = {
        {}, {spacing.spacing, {}}, place, end == 1, surface.piece(end == 0 ? shape.low : shape.high)};
    if (!spacing.uniform())
      ends[end].spacing.mapped = {[&spacing, place](const Vec2& x) { return spacing.at(place(x)); },
                                  spacing.finest(), spacing.growth()};
  }
  for (std::size_t c = 0; c <= profile.holes.size(); ++c) {
    const Curve& curve = c == 0 ? profile.outer : profile.holes[c - 1];
    check_poles(curve);
    Sweep sweep(surface, curve, full ? full_turn : shape.angle);
    sweep.add_sides();
    for (std::size_t end = 0; end < 2 && !full; ++end) ends[end].loops.push_back(sweep.end_loop(end));
  }
  for (std::size_t end = 0; end < 2 && !full; ++end) surface.add_patch(ends[end]);
  Cloud<3> cloud = surface.take();
  for (Vec3& x : cloud.position) x += shape.origin;
  return cloud;
}

} // namespace cnem::clouds
