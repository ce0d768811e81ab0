#include "voronoi/plane/natural_neighbours.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace cnem::voronoi {

namespace {

/// Sine below which x counts as lying on an edge.
constexpr double on_edge = 1e-14;

/// Whether values are not negative (but for the rounding of barycentric coordinates) and sum to 1.
[[maybe_unused]] bool part_unity(std::span<const double> values) {
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return std::abs(sum - 1.0) < 1e-12 && *std::min_element(values.begin(), values.end()) > -1e-8;
}

} // namespace

NaturalNeighbours::NaturalNeighbours(const Cloud<2>& cloud, const Triangulation& mesh,
                                     const Circumcircles& circles)
    : cloud_(cloud), mesh_(mesh), circles_(circles), frame_(64), ring_(64) {
  node_.reserve(ring_.size());
  value_.reserve(ring_.size());
  gradient_.reserve(ring_.size());
}

bool NaturalNeighbours::in_circle(SimplexIndex triangle, const Vec2& x) const {
  return (circles_.centre[triangle] - x).squaredNorm() < circles_.limit[triangle];
}

/// What an edge a → b of the cavity means that x is not clearly to the left of.
NaturalNeighbours::Outcome NaturalNeighbours::degenerate_edge(const Neighbour& a, const Neighbour& b,
                                                              bool wall, bool located) const {
  const double aa = a.x * a.x + a.y * a.y, bb = b.x * b.x + b.y * b.y;
  if (std::min(aa, bb) <= on_edge * on_edge * std::max(aa, bb)) return Outcome::on_node;
  const double sine = (a.x * b.y - a.y * b.x) / (aa + bb);
  if (sine < -(located ? 1e-7 : on_edge)) return Outcome::lost;
  if (!wall) return Outcome::inside; // x lies on an edge inside the cavity
  return a.x * b.x + a.y * b.y <= 0.0 ? Outcome::on_wall : Outcome::lost;
}

/// Walks once round the cavity, the triangles whose circles contain x, depth first and counter-clockwise. The
/// path runs through circumcentres only: old ones while it pivots about a neighbour, new ones as it passes an
/// edge of the cavity. Between two of these it is the inner boundary of what x steals from the neighbour, so
/// that the shoelace formula can be summed on the way. When the outcome is on_node or on_wall, ring_[0] (and
/// ring_[1]) are the nodes concerned and frame_[0] a triangle that has them.
NaturalNeighbours::Outcome NaturalNeighbours::collect(const Vec2& x, SimplexIndex start, bool located) {
  const IndexedSpan<SimplexIndex, const std::array<NodeIndex, 3>> corner = mesh_.node;
  const IndexedSpan<SimplexIndex, const std::array<SimplexIndex, 3>> neighbour = mesh_.neighbour;
  const IndexedSpan<SimplexIndex, const Vec2> centre = circles_.centre;
  const IndexedSpan<NodeIndex, const Vec2> position = cloud_.position;
  const auto place = [&](std::size_t at, NodeIndex node) {
    if (at == ring_.size()) ring_.resize(2 * at);
    const Vec2& p = position[node];
    ring_[at].node = node;
    ring_[at].x = p.x() - x.x();
    ring_[at].y = p.y() - x.y();
  };
  std::size_t count = 0;
  place(0, corner[start][1]);
  std::size_t depth = 0, visited = 1;
  frame_[0] = {start, 0, 3};
  Vec2 c = centre[start] - x;
  double path = 0.0;
  while (true) {
    Frame& frame = frame_[depth];
    if (frame.left == 0) {
      if (depth == 0) break;
      --depth;
      const Vec2 up = centre[frame_[depth].triangle] - x;
      path += cross(c, up);
      c = up;
      continue;
    }
    const SimplexIndex t = frame.triangle;
    const std::int32_t k = frame.edge;
    frame.edge = next_corner(k);
    --frame.left;
    const SimplexIndex across = neighbour[t][index_of(k)];
    const auto descend = [&] {
      const auto& back = neighbour[across];
      const std::int32_t entry = back[0] == t ? 0 : back[1] == t ? 1 : 2;
      if (++depth == frame_.size()) frame_.resize(2 * depth);
      frame_[depth] = {across, next_corner(entry), 2};
      const Vec2 down = centre[across] - x;
      path += cross(c, down);
      c = down;
      ++visited;
    };
    if (exists(across) && in_circle(across, x)) {
      descend();
      if (visited > corner.size()) return Outcome::lost;
      continue;
    }

    const std::size_t here = count++;
    place(count, corner[t][index_of(next_corner(next_corner(k)))]);
    Neighbour& a = ring_[here];
    const Neighbour& b = ring_[count];
    const double aa = a.x * a.x + a.y * a.y, bb = b.x * b.x + b.y * b.y, ab = a.x * b.x + a.y * b.y;
    const double area = a.x * b.y - a.y * b.x;
    if (area <= on_edge * (aa + bb)) {
      const Outcome outcome = degenerate_edge(a, b, !exists(across), located);
      if (outcome == Outcome::inside) {
        --count;
        descend();
        if (visited > corner.size()) return Outcome::lost;
        continue;
      }
      ring_[0] = outcome == Outcome::on_node && bb < aa ? b : a;
      ring_[1] = b;
      frame_[0].triangle = t;
      return outcome;
    }
    const double inverse = 1.0 / area;
    a.area = area;
    a.cx = 0.5 * inverse * (aa * b.y - bb * a.y);
    a.cy = 0.5 * inverse * (bb * a.x - aa * b.x);
    a.cot_next = (bb - ab) * inverse;
    a.cot_here = (aa - ab) * inverse;
    const double leg = c.x() * a.cy - c.y() * a.cx;
    a.stolen = -(path + leg);
    path = -leg;
  }
  ring_[0].stolen -= path;
  count_ = count;
  return Outcome::inside;
}

/// φ from the ring of neighbours.
void NaturalNeighbours::weigh(Functions functions) {
  node_.resize(count_);
  value_.resize(count_);
  double sum = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  const Neighbour* before = &ring_[count_ - 1];
  for (std::size_t i = 0; i < count_; ++i) {
    const Neighbour& n = ring_[i];
    const double raw = functions == Functions::sibson ? n.stolen + (before->cx * n.cy - before->cy * n.cx)
                                                      : n.cot_next + before->cot_here;
    const double weight = std::max(raw, 0.0);
    node_[i] = n.node;
    value_[i] = weight;
    sum += weight;
    x += weight * n.x;
    y += weight * n.y;
    xx += weight * n.x * n.x;
    xy += weight * n.x * n.y;
    yy += weight * n.y * n.y;
    before = &n;
  }
  const double inverse = 1.0 / sum;
  for (double& value : value_) value *= inverse;
  // Circumcentres of slivers lose digits, and Σφ x = x with them; a factor linear in x that restores it is as
  // close to one as the sum was right.
  const double missed = x * x + y * y;
  if (missed <= 1e-28 * sum * (xx + yy)) return;
  const double determinant = xx * yy - xy * xy;
  const double slope_x = (yy * x - xy * y) / determinant, slope_y = (xx * y - xy * x) / determinant;
  const auto change = [&](const Neighbour& n) { return slope_x * n.x + slope_y * n.y; };
  // Rounding asks for large changes too, of neighbours whose weight is next to nothing: it is left.
  double reach = 0.0;
  for (std::size_t i = 0; i < count_; ++i) reach = std::max(reach, std::hypot(ring_[i].x, ring_[i].y));
  const double largest = std::sqrt(missed) > 1e-10 * sum * reach ? 0.5 : 1e-3;
  for (std::size_t i = 0; i < count_; ++i)
    if (!(std::abs(change(ring_[i])) < largest)) return;
  const double left = 1.0 - inverse * (slope_x * x + slope_y * y); // of the sum, 1 but for slivers
  for (std::size_t i = 0; i < count_; ++i) value_[i] *= (1.0 - change(ring_[i])) / left;
}

/// ∇φ from the ring, after weigh(). The bisector of x and a neighbour moves with ½ (midpoint − x)/distance,
/// so twice the stolen area has the gradient s·2(midpoint − x) with the Laplace weight s.
void NaturalNeighbours::weigh_gradients(Functions functions) {
  gradient_.assign(count_, Vec2::Zero());
  double sum = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t j = i + 1 == count_ ? 0 : i + 1;
    const Neighbour &a = ring_[i], &b = ring_[j];
    if (functions == Functions::laplace) {
      const Vec2 edge(b.x - a.x, b.y - a.y);
      const Vec2 area_gradient = left_normal(edge);
      gradient_[i] += (-edge - a.cot_next * area_gradient) / a.area;
      gradient_[j] += (edge - a.cot_here * area_gradient) / a.area;
      sum += a.cot_next + a.cot_here;
    } else {
      const double weight = 0.5 * (b.cot_next + a.cot_here);
      gradient_[j] = weight * Vec2(a.cx + b.cx, a.cy + b.cy);
      sum += b.stolen + (a.cx * b.cy - a.cy * b.cx);
    }
  }
  Vec2 total = Vec2::Zero();
  for (const Vec2& g : gradient_) total += g;
  for (std::size_t i = 0; i < count_; ++i) gradient_[i] = (gradient_[i] - value_[i] * total) / sum;
}

void NaturalNeighbours::linear_on(const Location& at) {
  node_.assign(mesh_.node[at.triangle].begin(), mesh_.node[at.triangle].end());
  value_.assign(at.weight.begin(), at.weight.end());
}

void NaturalNeighbours::linear_gradients_on(SimplexIndex triangle) {
  const auto& nodes = mesh_.node[triangle];
  std::array<double, 3> value{};
  for (std::size_t i = 0; i < node_.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (nodes[k] == node_[i]) value[k] = value_[i];
  linear_on({triangle, value, true});
  std::array<Vec2, 3> x;
  for (std::size_t k = 0; k < 3; ++k) x[k] = cloud_.position[nodes[k]];
  const double twice_area = cross(x[1] - x[0], x[2] - x[0]);
  gradient_.resize(3);
  for (std::size_t k = 0; k < 3; ++k)
    gradient_[k] = left_normal(x[(k + 2) % 3] - x[(k + 1) % 3]) / twice_area;
}

/// Turns the ring into nodes and values; false when it does not surround x.
bool NaturalNeighbours::finish(Outcome outcome, Functions functions) {
  switch (outcome) {
  case Outcome::inside:
    weigh(functions);
    return true;
  case Outcome::on_node:
    node_.assign(1, ring_[0].node);
    value_.assign(1, 1.0);
    return true;
  case Outcome::on_wall: {
    const Vec2 a(ring_[0].x, ring_[0].y), edge(ring_[1].x - ring_[0].x, ring_[1].y - ring_[0].y);
    const double lambda = std::clamp(-a.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    node_ = {ring_[0].node, ring_[1].node};
    value_ = {1.0 - lambda, lambda};
    return true;
  }
  case Outcome::lost:
    break;
  }
  return false;
}

void NaturalNeighbours::evaluate(Functions functions, const Vec2& x, SimplexIndex hint) {
  const Location at = locate(cloud_, mesh_, x, hint);
  if (!at.inside)
    throw GeometryError(fmt::format("the point ({:.9g}, {:.9g}) m lies outside the domain", x.x(), x.y()));
  // Only rounding in triangles of hardly any area gets x lost once it is located.
  if (functions == Functions::linear || !finish(collect(x, at.triangle, true), functions)) linear_on(at);
  assert(part_unity(value_));
}

void NaturalNeighbours::evaluate_on_facet(Functions functions, const Vec2& x,
                                          const std::array<SimplexIndex, 2>& triangle) {
  for (const SimplexIndex t : triangle)
    if (functions != Functions::linear && exists(t) && in_circle(t, x) &&
        finish(collect(x, t, false), functions)) {
      assert(part_unity(value_));
      return;
    }
  evaluate(functions, x, std::max(triangle[0], triangle[1]));
}

void NaturalNeighbours::evaluate_with_gradients(Functions functions, const Vec2& x, SimplexIndex hint) {
  const Location at = locate(cloud_, mesh_, x, hint);
  if (!at.inside)
    throw GeometryError(fmt::format("the point ({:.9g}, {:.9g}) m lies outside the domain", x.x(), x.y()));
  if (functions == Functions::linear) {
    linear_on(at);
    return linear_gradients_on(at.triangle);
  }
  const Outcome outcome = collect(x, at.triangle, true);
  const bool found = finish(outcome, functions);
  if (!found) linear_on(at);
  if (outcome == Outcome::inside)
    weigh_gradients(functions);
  else
    linear_gradients_on(found ? frame_[0].triangle : at.triangle);
}

} // namespace cnem::voronoi
