#include "adapt/space/working_surface.hpp"

#include "adapt/space/boundary_planes.hpp"
#include "core/geometry/facets.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace cnem::adapt {

using voronoi::next_edge;
namespace {

double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180.0); }

double cosine_between(const Vec3& a, const Vec3& b) {
  const double lengths = std::sqrt(a.squaredNorm() * b.squaredNorm());
  return lengths > 0.0 ? a.dot(b) / lengths : -1.0;
}

/// Least height over longest side, –.
double shape_of(const std::array<Vec3, 3>& x) {
  double longest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, (x[(k + 1) % 3] - x[k]).squaredNorm());
  return longest > 0.0 ? 2.0 * area_normal<3>(x).norm() / longest : 0.0;
}

} // namespace

WorkingSurface::WorkingSurface(const Cloud<3>& cloud, const IndexedVector<NodeIndex, char>& held,
                               const SurfaceRules& rules)
    : rules_(rules), least_crease_(cosine(rules.crease)), least_corner_(cosine(rules.corner)),
      least_turn_(cosine(rules.turn)), least_flat_(cosine(rules.flat)), position_(cloud.position),
      held_(held), holds_(cloud.position.size(), 0), apart_(cloud.position.size(), 0),
      still_(cloud.position.size(), 0), leaving_(cloud.position.size(), no_edge),
      facet_(cloud.facets.begin(), cloud.facets.end()), closed_(cloud.facets.size(), 0) {
  assert(held.size() == cloud.position.size());
  const voronoi::SurfaceEdges across = voronoi::surface_edges(cloud);
  across_.reserve(3 * across.size());
  for (const auto& of_facet : across) across_.insert(across_.end(), of_facet.begin(), of_facet.end());
  for (Edge e = 0; e < edges(); ++e)
    if (leaving_[start(e)] == no_edge) leaving_[start(e)] = e;
  for (const Facet<3>& facet : cloud.facets)
    if (is_still(facet.piece))
      for (const NodeIndex i : facet.node) still_[i] = 1;
  if (cloud.twins.empty()) return;
  const auto behind = voronoi::facets_behind(cloud);
  for (const CloudFacetIndex f : behind.indices()) {
    if (!exists(behind[f])) continue;
    closed_[index_of(f)] = 1;
    for (const NodeIndex i : cloud.facets[f].node) held_[i] = 1;
  }
}

WorkingSurface::Corners WorkingSurface::corners(std::size_t facet) const {
  const auto& node = facet_[facet].node;
  return {at(node[0]), at(node[1]), at(node[2])};
}

Vec3 WorkingSurface::normal(Edge e) const { return area_normal<3>(corners(index_of(e / 3))); }

double WorkingSurface::cosine_across(Edge e) const { return cosine_between(normal(e), normal(across(e))); }

int WorkingSurface::valence(NodeIndex i) const {
  int count = 0;
  around(i, [&](Edge) { ++count; });
  return count;
}

WorkingSurface::Edge WorkingSurface::between(NodeIndex from, NodeIndex to) const {
  Edge found = no_edge;
  around(from, [&](Edge e) {
    if (end(e) == to) found = e;
  });
  return found;
}

bool WorkingSurface::crease(Edge e) const {
  return piece(e) != piece(across(e)) || (cosine_across(e) < least_crease_ && !is_still(piece(e)));
}

bool WorkingSurface::corner(NodeIndex i) const {
  std::array<NodeIndex, 2> other{};
  std::size_t count = 0;
  around(i, [&](Edge e) {
    if (!crease(e)) return;
    if (count < 2) other[count] = end(e);
    ++count;
  });
  if (count != 2) return count != 0;
  return cosine_between(at(i) - at(other[0]), at(other[1]) - at(i)) < least_corner_;
}

bool WorkingSurface::on_crease(NodeIndex i) const {
  bool any = false;
  around(i, [&](Edge e) { any |= crease(e); });
  return any;
}

bool WorkingSurface::of_folds(NodeIndex i) const {
  bool all = true;
  around(i, [&](Edge e) { all &= piece(e) == piece(leaving_[i]); });
  return all;
}

int WorkingSurface::pieces_meet(NodeIndex i) const {
  int count = 0;
  around(i, [&](Edge e) { count += piece(e) != piece(across(e)); });
  return count;
}

/// Of a node on a crease each side is a part; what a part that is plane is normal to is no way. A corner has
/// none but the line in which two planes meet.
void WorkingSurface::keep_on_faces(NodeIndex i, Vec3& way) const {
  if (held(i) || still(i)) {
    way = Vec3::Zero();
    return;
  }
  constexpr double plane = 1e-7; // sine of an angle
  struct Side {                  // between two creases
    Vec3 normal;
    bool is_plane, is_plane_beyond;
    int facets;
  };
  std::vector<Side> sides;
  std::vector<Edge> fan;
  around(i, [&](Edge e) { fan.push_back(e); });
  const auto first = std::find_if(fan.begin(), fan.end(), [&](Edge e) { return crease(e); });
  if (first != fan.end()) std::rotate(fan.begin(), first, fan.end());
  // the facet of an edge comes before the edge is crossed
  for (std::size_t k = 0; k < fan.size(); ++k) {
    const Edge e = fan[(k + 1) % fan.size()], opposite = next_edge(e);
    const Vec3 n = normal(e).normalized();
    if (sides.empty() || crease(fan[k])) sides.push_back({n, true, true, 0});
    Side& side = sides.back();
    const auto bent = [&](const Vec3& other) { return side.normal.cross(other).norm() > plane; };
    if (bent(n)) side.is_plane = false;
    if (!crease(opposite) && bent(normal(across(opposite)).normalized())) side.is_plane_beyond = false;
    ++side.facets;
  }
  constexpr int few = 2; // one facet, or the halves of one, are plane by themselves
  std::vector<Vec3> planes;
  for (const Side& side : sides)
    if (side.is_plane && (side.is_plane_beyond || side.facets > few)) planes.push_back(side.normal);
  const auto meets_first = [&](const Vec3& n) { return n.cross(planes.front()).norm() > plane; };
  const bool line = std::any_of(planes.begin(), planes.end(), meets_first);
  way = corner(i) && !line ? Vec3::Zero() : within_planes(planes, way);
}

Vec3 WorkingSurface::way_of_volume(NodeIndex i) const {
  if (!on_surface(i) || held(i) || still(i)) return Vec3::Zero();
  Vec3 gradient = Vec3::Zero();
  double area = 0.0;
  around(i, [&](Edge e) {
    const Vec3 part = (at(end(e)) - at(i)).cross(at(apex(e)) - at(i)) / 6.0;
    gradient += part;
    area += part.norm();
  });
  keep_on_faces(i, gradient);
  constexpr double least = 0.1; // else it is rounding, or a long way for a little volume
  return gradient.norm() > least * area ? gradient : Vec3::Zero();
}

void WorkingSurface::join(Edge a, Edge b) {
  across_[index_of(a)] = b;
  across_[index_of(b)] = a;
}

WorkingSurface::Edge WorkingSurface::add_facet(const Facet<3>& facet) {
  const Edge first = edges();
  facet_.push_back(facet);
  closed_.push_back(0);
  across_.resize(across_.size() + 3, no_edge);
  return first;
}

SurfaceChange WorkingSurface::split(Edge e, const Vec3& x) {
  if (!alive(e)) return {Refusal::absent};
  const Edge back = across(e);
  const std::size_t f = index_of(e / 3), g = index_of(back / 3);
  if (closed_[f] || closed_[g]) return {Refusal::held};
  const NodeIndex a = start(e), b = end(e), c = apex(e), d = apex(back), made = position_.next();
  position_.push_back(x);
  held_.push_back(holds_[a] && holds_[b]);
  holds_.push_back(char{held_[made]});
  apart_.push_back(0);
  still_.push_back(is_still(facet_[f].piece) || is_still(facet_[g].piece));
  const Edge after = across(next_edge(e)), before = across(last_edge(back));
  const Edge one = add_facet({{made, b, c}, facet_[f].piece});
  const Edge other = add_facet({{b, made, d}, facet_[g].piece});
  facet_[f].node[index_of(next_edge(e) % 3)] = made;
  facet_[g].node[index_of(back % 3)] = made;
  join(one, other);
  join(next_edge(e), one + 2);
  join(one + 1, after);
  join(last_edge(back), other + 1);
  join(other + 2, before);
  leaving_.push_back(one);
  leaving_[b] = one + 1;
  return {Refusal::none, 0.0, made};
}

SurfaceChange WorkingSurface::split(Edge e) {
  if (!alive(e)) return {Refusal::absent};
  return split(e, 0.5 * (at(start(e)) + at(end(e))));
}

bool WorkingSurface::may_become(const Corners& before, const Corners& after) const {
  const double shape = shape_of(after);
  if (shape < rules_.shape && shape < shape_of(before)) return false;
  return cosine_between(area_normal<3>(before), area_normal<3>(after)) > least_turn_;
}

bool WorkingSurface::wants_flip(Edge e) const {
  const auto cotangent = [&](Edge edge) { // of the angle across
    const Vec3 a = at(start(edge)) - at(apex(edge)), b = at(end(edge)) - at(apex(edge));
    return a.dot(b) / a.cross(b).norm();
  };
  constexpr double least = -1e-6; // of four cocircular nodes either diagonal will do
  return cotangent(e) + cotangent(across(e)) < least;
}

/// Whether there is nothing but a tetrahedron of flat metal between the facets of an edge, of which a further
/// edge passes above another one: the facets cross as soon as it has turned inside out.
bool WorkingSurface::is_film(Edge e) const {
  if (cosine_across(e) > 0.0) return false;
  const Vec3 a = at(start(e)), b = at(end(e)), c = at(apex(e)), d = at(apex(across(e)));
  if ((b - a).cross(c - a).dot(d - a) > 0.0) return false; // a notch
  const auto cross = [](const Vec3& from, const Vec3& to, const Vec3& start, const Vec3& end) {
    const Vec3 normal = (to - from).cross(end - start), between = start - from;
    const double s = between.cross(end - start).dot(normal), t = between.cross(to - from).dot(normal),
                 whole = normal.squaredNorm();
    return s > 0.0 && s < whole && t > 0.0 && t < whole;
  };
  return cross(a, c, b, d) || cross(a, d, b, c);
}

SurfaceChange WorkingSurface::try_flip(Edge e, double spacing, Flip kind) const {
  if (!alive(e)) return {Refusal::absent};
  const Edge back = across(e);
  const std::size_t f = index_of(e / 3), g = index_of(back / 3);
  if (closed_[f] || closed_[g]) return {Refusal::held};
  const bool film = kind == Flip::of_film;
  if (facet_[f].piece != facet_[g].piece || (film ? !is_film(e) : cosine_across(e) < least_flat_))
    return {Refusal::crease};
  const NodeIndex a = start(e), b = end(e), c = apex(e), d = apex(back);
  if (c == d || between(c, d) != no_edge || valence(a) < 4 || valence(b) < 4) return {Refusal::link};
  const Corners one{at(c), at(a), at(d)}, other{at(d), at(b), at(c)};
  const Vec3 sum = area_normal<3>(corners(f)) + area_normal<3>(corners(g));
  const double shape = std::min(rules_.shape, std::min(shape_of(corners(f)), shape_of(corners(g))));
  for (const Corners& after : {one, other})
    if ((!film && cosine_between(area_normal<3>(after), sum) < least_turn_) || shape_of(after) < shape)
      return {Refusal::normals};
  const double volume = (at(b) - at(a)).cross(at(c) - at(a)).dot(at(d) - at(a)) / 6.0;
  const double cube = spacing * spacing * spacing;
  if (!is_still(piece(e)) && std::abs(volume) > rules_.volume * cube) return {Refusal::volume};
  constexpr double plane = 1e-9;
  if (held(a) && held(b) && held(c) && held(d) && std::abs(volume) > plane * cube) return {Refusal::held};
  return {Refusal::none, volume};
}

SurfaceChange WorkingSurface::flip(Edge e, double spacing, Flip kind) {
  const SurfaceChange change = try_flip(e, spacing, kind);
  if (!change.done()) return change;
  const Edge back = across(e);
  const std::size_t f = index_of(e / 3), g = index_of(back / 3);
  const NodeIndex a = start(e), b = end(e), c = apex(e), d = apex(back);
  const Edge c_to_a = across(last_edge(e)), b_to_c = across(next_edge(e));
  const Edge a_to_d = across(next_edge(back)), d_to_b = across(last_edge(back));
  const Edge first = 3 * (e / 3), second = 3 * (back / 3);
  facet_[f].node = {c, a, d};
  facet_[g].node = {d, b, c};
  join(first, c_to_a);
  join(first + 1, a_to_d);
  join(first + 2, second + 2);
  join(second, d_to_b);
  join(second + 1, b_to_c);
  leaving_[c] = first;
  leaving_[a] = first + 1;
  leaving_[d] = second;
  leaving_[b] = second + 1;
  return change;
}

bool WorkingSurface::swell(NodeIndex i, double volume, double most) {
  const Vec3 way = way_of_volume(i);
  if (way == Vec3::Zero()) return false;
  const Vec3 step = volume / way.squaredNorm() * way, x = at(i) + step;
  if (step.norm() > most) return false;
  bool fits = true;
  around(i, [&](Edge e) {
    const Corners before = corners(index_of(e / 3));
    Corners after = before;
    after[index_of(e % 3)] = x;
    fits = fits && may_become(before, after);
  });
  if (fits) position_[i] = x;
  return fits;
}

IndexedVector<CloudFacetIndex, Facet<3>> WorkingSurface::facets() const {
  IndexedVector<CloudFacetIndex, Facet<3>> list;
  for (const Facet<3>& facet : facet_)
    if (exists(facet.node[0])) list.push_back(facet);
  return list;
}

std::vector<CloudFacetIndex> WorkingSurface::changed_facets(const Cloud<3>& before) const {
  std::vector<CloudFacetIndex> list;
  CloudFacetIndex number{};
  for (std::size_t f = 0; f < facet_.size(); ++f) {
    if (!exists(facet_[f].node[0])) continue;
    const auto stayed = [&](NodeIndex i) { return at(i) == before.position[i]; };
    const auto& node = facet_[f].node;
    const bool same = f < before.facets.size() && before.facets[f].node == node;
    if (!same || !std::all_of(node.begin(), node.end(), stayed)) list.push_back(number);
    number = as<CloudFacetIndex>(index_of(number) + 1);
  }
  return list;
}

} // namespace cnem::adapt
