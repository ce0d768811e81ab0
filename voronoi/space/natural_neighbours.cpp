#include "voronoi/space/natural_neighbours.hpp"

#include "core/machine/parallel.hpp"
#include "voronoi/space/walk.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace cnem::voronoi {
namespace {

/// Six times the volume of a tetrahedron over the product of three edges below which it counts as flat.
constexpr double flat = 1e-13;
/// Of the distance to the farthest neighbour, below which x counts as lying on a node.
constexpr double on_node = 1e-14;

/// Squared lengths and products of what x, the origin, is joined to a face with.
struct Corner {
  Vec3 a, b, c;            ///< of the face
  Vec3 ab, bc, ca;         ///< a × b, b × c, c × a
  double aa, bb, cc;       ///< squares
  double a_b, b_c, c_a;    ///< a·b, …
  double volume;           ///< six times that of the tetrahedron
  Vec3 centre;             ///< of its circumsphere
  double k_ab, k_bc, k_ca; ///< height of the centre over the faces with x, by twice their area

  Corner(const auto& p, const auto& q, const auto& r)
      : a(p.x, p.y, p.z), b(q.x, q.y, q.z), c(r.x, r.y, r.z), ab(a.cross(b)), bc(b.cross(c)), ca(c.cross(a)),
        aa(p.squared), bb(q.squared), cc(r.squared), a_b(a.dot(b)), b_c(b.dot(c)), c_a(c.dot(a)),
        volume(a.dot(bc)), centre((aa * bc + bb * ca + cc * ab) * (0.5 / volume)),
        k_ab(centre.dot(ab) / ab.squaredNorm()), k_bc(centre.dot(bc) / bc.squaredNorm()),
        k_ca(centre.dot(ca) / ca.squaredNorm()) {}
};

} // namespace

FunctionMesh::FunctionMesh(const Cloud<3>& cloud, const Tetrahedra& mesh, const Circumspheres& spheres,
                           Functions functions) {
  const std::size_t count = mesh.node.size();
  record.resize(count);
  const bool sibson = functions == Functions::sibson;
  if (sibson) share.resize(count);
  for_each_block(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Vec3& centre = spheres.centre[t];
      record[t] = {{centre.x(), centre.y(), centre.z()}, spheres.limit[t], mesh.node[t], mesh.neighbour[t]};
      if (!sibson) continue;
      const auto x = corners_of(cloud, mesh, as<SimplexIndex>(t));
      const auto normal = face_normals(x);
      auto& own = share[t] = {};
      for (std::size_t k = 0; k < 4; ++k) {
        const auto& [p, q, r] = face_of_tetrahedron[k];
        const double squared = normal[k].squaredNorm();
        if (!(squared > 0.0)) continue;
        // height of the centre over the face by twice its area
        const double height = (x[p] - centre).dot(normal[k]) / (24.0 * squared);
        const Vec3 pq = x[q] - x[p], qr = x[r] - x[q], rp = x[p] - x[r];
        const double at_p = -pq.dot(rp), at_q = -qr.dot(pq), at_r = -rp.dot(qr);
        const double of_pq = pq.squaredNorm() * at_r, of_qr = qr.squaredNorm() * at_p,
                     of_rp = rp.squaredNorm() * at_q;
        own[p] += height * (of_pq + of_rp);
        own[q] += height * (of_qr + of_pq);
        own[r] += height * (of_rp + of_qr);
      }
    }
  });
}

NaturalNeighbours3::NaturalNeighbours3(const Cloud<3>& cloud, const Tetrahedra& mesh,
                                       const FunctionMesh& functions)
    : cloud_(cloud), mesh_(mesh), functions_(functions) {}

bool NaturalNeighbours3::in_sphere(SimplexIndex tetrahedron, const Vec3& x) const {
  const FunctionMesh::Record& record = functions_.record[tetrahedron];
  const double dx = x.x() - record.centre[0], dy = x.y() - record.centre[1], dz = x.z() - record.centre[2];
  return dx * dx + dy * dy + dz * dz < record.limit;
}

void NaturalNeighbours3::take(SimplexIndex tetrahedron) {
  in_cavity_.at(tetrahedron, 1) = 1;
  cavity_.push_back(tetrahedron);
}

std::int32_t NaturalNeighbours3::place(NodeIndex node, const Vec3& x) {
  const auto fresh = static_cast<std::int32_t>(neighbour_.size());
  const std::int32_t at = place_of_.at(node, fresh);
  if (at == fresh) {
    const Vec3 d = cloud_.position[node] - x;
    neighbour_.push_back({node, d.x(), d.y(), d.z(), d.squaredNorm()});
  }
  return at;
}

/// Goes on from the tetrahedra of the cavity that are new.
void NaturalNeighbours3::grow(const Vec3& x) {
  for (; grown_ < cavity_.size(); ++grown_) {
    const FunctionMesh::Record& record = functions_.record[cavity_[grown_]];
    std::array<std::int32_t, 4> corner;
    for (std::size_t k = 0; k < 4; ++k) corner[k] = place(record.node[k], x);
    corner_.push_back(corner);
    for (std::size_t k = 0; k < 4; ++k) {
      const SimplexIndex beyond = record.neighbour[k];
      if (exists(beyond)) {
        std::int32_t& known = in_cavity_.at(beyond, -1);
        if (known < 0) {
          known = in_sphere(beyond, x) ? 1 : 0;
          if (known == 1) cavity_.push_back(beyond);
        }
        if (known == 1) continue;
      }
      const auto& [p, q, r] = face_of_tetrahedron[k];
      face_.push_back({{corner[p], corner[q], corner[r]}, beyond});
    }
  }
}

/// Whether x, which is on the plane of a wall, is on the wall itself: gives the linear functions there.
bool NaturalNeighbours3::on_wall(const Face& face) {
  const auto at = [&](std::size_t k) {
    const Neighbour& n = neighbour_[index_of(face.corner[k])];
    return Vec3(n.x, n.y, n.z);
  };
  const Vec3 a = at(0), b = at(1), c = at(2), normal = (b - a).cross(c - a);
  const double twice = normal.squaredNorm();
  const std::array<double, 3> weight{normal.dot(b.cross(c)) / twice, normal.dot(c.cross(a)) / twice,
                                     normal.dot(a.cross(b)) / twice};
  if (!(*std::min_element(weight.begin(), weight.end()) > -1e-12)) return false;
  node_.clear();
  value_.clear();
  for (std::size_t k = 0; k < 3; ++k) {
    node_.push_back(neighbour_[index_of(face.corner[k])].node);
    value_.push_back(std::max(weight[k], 0.0));
  }
  return true;
}

/// Finds cavity, neighbours and faces. found: x is on a node or a wall, and the functions are there. lost: x
/// does not see all of the cavity.
NaturalNeighbours3::Outcome NaturalNeighbours3::collect(const Vec3& x, SimplexIndex start) {
  in_cavity_.clear();
  place_of_.clear();
  cavity_.clear();
  corner_.clear();
  neighbour_.clear();
  face_.clear();
  grown_ = 0;
  take(start);
  grow(x);

  const auto order = [](const Neighbour& a, const Neighbour& b) { return a.squared < b.squared; };
  const auto [nearest, farthest] = std::minmax_element(neighbour_.begin(), neighbour_.end(), order);
  if (nearest->squared <= on_node * on_node * farthest->squared) {
    node_.assign(1, nearest->node);
    value_.assign(1, 1.0);
    return Outcome::found;
  }
  bool joined = false, hidden = false;
  for (std::size_t f = 0; f < face_.size(); ++f) {
    const auto [volume, bound] = volume_with(face_[f]);
    if (volume > bound) continue;
    if (exists(face_[f].beyond)) {
      if (in_cavity_.at(face_[f].beyond, 0) == 1) continue; // taken for another face
      if (volume < -bound) {
        hidden = true;
        continue;
      }
      take(face_[f].beyond); // x is on the circle of the face: what is beyond it is as good as in the cavity
      grow(x);
      joined = true;
    } else {
      if (volume >= -bound && on_wall(face_[f])) return Outcome::found;
      hidden = true; // another wall in the same plane may be the one that x is on
    }
  }
  if (hidden) return leave_hidden(x, start);
  if (joined)
    std::erase_if(
        face_, [&](const Face& face) { return exists(face.beyond) && in_cavity_.at(face.beyond, 0) == 1; });
  return Outcome::surrounded;
}

/// Six times the volume of x with a face, and what of it is rounding.
std::pair<double, double> NaturalNeighbours3::volume_with(const Face& face) const {
  const Neighbour &a = neighbour_[index_of(face.corner[0])], &b = neighbour_[index_of(face.corner[1])],
                  &c = neighbour_[index_of(face.corner[2])];
  return {a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x),
          flat * std::sqrt(a.squared * b.squared * c.squared)};
}

/// Takes tetrahedra out of the cavity whose faces x sees from behind, until it sees all from within: walls
/// may hide them, or tetrahedra are not Delaunay. That with x in it stays.
NaturalNeighbours3::Outcome NaturalNeighbours3::leave_hidden(const Vec3& x, SimplexIndex start) {
  const SpaceWalkEnd at = walk(cloud_, mesh_, start, x);
  if (exists(at.facet)) return Outcome::lost;
  if (in_cavity_.at(at.tetrahedron, 0) != 1) {
    take(at.tetrahedron);
    grow(x);
  }
  for (bool changed = true; changed;) {
    changed = false;
    face_.clear();
    for (std::size_t k = 0; k < cavity_.size(); ++k) {
      const SimplexIndex t = cavity_[k];
      if (in_cavity_.at(t, 0) != 1) continue;
      for (std::size_t f = 0; f < 4; ++f) {
        const SimplexIndex beyond = functions_.record[t].neighbour[f];
        if (exists(beyond) && in_cavity_.at(beyond, 0) == 1) continue;
        const auto& [p, q, r] = face_of_tetrahedron[f];
        const Face face{{corner_[k][p], corner_[k][q], corner_[k][r]}, beyond};
        const auto [volume, bound] = volume_with(face);
        if (volume > bound) {
          face_.push_back(face);
          continue;
        }
        if (t == at.tetrahedron) return Outcome::lost;
        in_cavity_.at(t, 0) = 0;
        changed = true;
        break;
      }
    }
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < cavity_.size(); ++k)
    if (in_cavity_.at(cavity_[k], 0) == 1) {
      cavity_[kept] = cavity_[k];
      corner_[kept++] = corner_[k];
    }
  cavity_.resize(kept);
  corner_.resize(kept);
  return Outcome::surrounded;
}

/// Areas of the facets of x over the distances to its neighbours.
void NaturalNeighbours3::weigh_laplace() {
  weight_.assign(neighbour_.size(), 0.0);
  for (const Face& face : face_) {
    const auto [a, b, c] = face.corner;
    const Corner t(neighbour_[index_of(a)], neighbour_[index_of(b)], neighbour_[index_of(c)]);
    weight_[index_of(a)] += t.k_ab * (t.bb - t.a_b) + t.k_ca * (t.cc - t.c_a);
    weight_[index_of(b)] += t.k_bc * (t.cc - t.b_c) + t.k_ab * (t.aa - t.a_b);
    weight_[index_of(c)] += t.k_ca * (t.aa - t.c_a) + t.k_bc * (t.bb - t.b_c);
  }
}

/// Stolen volumes, times 24.
void NaturalNeighbours3::weigh_sibson() {
  weight_.assign(neighbour_.size(), 0.0);
  for (std::size_t k = 0; k < cavity_.size(); ++k)
    for (std::size_t c = 0; c < 4; ++c)
      weight_[index_of(corner_[k][c])] += 24.0 * functions_.share[cavity_[k]][c];
  for (const Face& face : face_) {
    const auto [a, b, c] = face.corner;
    const Corner t(neighbour_[index_of(a)], neighbour_[index_of(b)], neighbour_[index_of(c)]);
    const double bb_ab = t.bb - t.a_b, aa_ab = t.aa - t.a_b, cc_bc = t.cc - t.b_c, bb_bc = t.bb - t.b_c,
                 aa_ca = t.aa - t.c_a, cc_ca = t.cc - t.c_a;
    const double ab = aa_ab + bb_ab, bc = bb_bc + cc_bc, ca = cc_ca + aa_ca; // squared edges of the face
    const Vec3 normal = t.ab + t.bc + t.ca;
    const double k = (t.volume - t.centre.dot(normal)) / normal.squaredNorm();
    const double of_ab = k * ab * (cc_bc - t.c_a + t.a_b), of_bc = k * bc * (aa_ab - t.c_a + t.b_c),
                 of_ca = k * ca * (bb_bc - t.a_b + t.c_a);
    const double shared_ab = t.k_ab * ab * t.a_b, shared_bc = t.k_bc * bc * t.b_c,
                 shared_ca = t.k_ca * ca * t.c_a;
    weight_[index_of(a)] -= t.aa * (t.k_ab * bb_ab + t.k_ca * cc_ca) + shared_ab + shared_ca + of_ab + of_ca;
    weight_[index_of(b)] -= t.bb * (t.k_bc * cc_bc + t.k_ab * aa_ab) + shared_bc + shared_ab + of_bc + of_ab;
    weight_[index_of(c)] -= t.cc * (t.k_ca * aa_ca + t.k_bc * bb_bc) + shared_ca + shared_bc + of_ca + of_bc;
  }
}

/// Σ w_i (x_i − x) over the sum of the weights and the distance of the farthest neighbour.
double NaturalNeighbours3::missed_place(double& sum, Vec3& missed) const {
  double reach = 0.0;
  sum = 0.0;
  missed.setZero();
  for (std::size_t i = 0; i < neighbour_.size(); ++i) {
    const Neighbour& n = neighbour_[i];
    sum += weight_[i];
    reach = std::max(reach, n.squared);
    missed += weight_[i] * Vec3(n.x, n.y, n.z);
  }
  return missed.norm() / (sum * std::sqrt(reach));
}

/// φ from the weights; false where they are no functions.
bool NaturalNeighbours3::finish() {
  constexpr double negative = 1e-9, rounding = 5e-15, largest = 1e-13, most = 1e-6;
  double sum, error;
  Vec3 missed;
  error = missed_place(sum, missed);
  const double least = *std::min_element(weight_.begin(), weight_.end());
  if (!(sum > 0.0) || !(least >= -negative * sum) || !(error < most)) return false;
  if (least < 0.0) {
    for (double& w : weight_) w = std::max(w, 0.0);
    error = missed_place(sum, missed);
  }
  if (error > rounding) {
    // Circumcentres of slivers lose digits, and Σφ x = x with them; a factor linear in x restores it.
    Mat<3> second = Mat<3>::Zero();
    for (std::size_t i = 0; i < neighbour_.size(); ++i) {
      const Vec3 d(neighbour_[i].x, neighbour_[i].y, neighbour_[i].z);
      second += weight_[i] * d * d.transpose();
    }
    const Vec3 slope = second.inverse() * missed;
    for (std::size_t i = 0; i < neighbour_.size(); ++i) {
      const double change = slope.dot(Vec3(neighbour_[i].x, neighbour_[i].y, neighbour_[i].z));
      if (!(std::abs(change) < 0.5)) return false;
      weight_[i] *= 1.0 - change;
    }
    if (!(missed_place(sum, missed) < largest)) return false;
  }
  node_.clear();
  value_.clear();
  const double inverse = 1.0 / sum;
  for (std::size_t i = 0; i < neighbour_.size(); ++i) {
    if (weight_[i] == 0.0) continue; // of tetrahedra that x does not see
    node_.push_back(neighbour_[i].node);
    value_.push_back(inverse * weight_[i]);
  }
  return true;
}

/// Linear functions of the tetrahedron with x: of those that the ways from some lead to, and the neighbours
/// of flat ones, the one that x is the deepest in.
void NaturalNeighbours3::linear(const Vec3& x, std::span<const SimplexIndex> near) {
  constexpr double well_shaped = 1e-6;
  double deepest = -std::numeric_limits<double>::infinity(), best_quality = deepest;
  const auto try_in = [&](SimplexIndex t) {
    const auto p = corners_of(cloud_, mesh_, t);
    Mat<3> edges;
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      edges.col(static_cast<Eigen::Index>(k)) = p[k + 1] - p[0];
      longest = std::max(longest, (p[k + 1] - p[0]).squaredNorm());
    }
    const Eigen::PartialPivLU<Mat<3>> solver(edges);
    const double quality = solver.determinant() / std::pow(longest, 1.5);
    Vec3 weight = solver.solve(x - p[0]);
    weight += solver.solve(x - p[0] - edges * weight); // what rounding left in flat ones
    const std::array<double, 4> value{1.0 - weight.sum(), weight[0], weight[1], weight[2]};
    const double depth = *std::min_element(value.begin(), value.end());
    if (best_quality >= well_shaped ? quality >= well_shaped && depth > deepest : quality > best_quality) {
      deepest = depth;
      best_quality = quality;
      node_.assign(mesh_.node[t].begin(), mesh_.node[t].end());
      value_.assign(value.begin(), value.end());
    }
    return quality;
  };
  for (const SimplexIndex from : near) {
    const SpaceWalkEnd at = walk(cloud_, mesh_, from, x);
    if (try_in(at.tetrahedron) < well_shaped)
      for (const SimplexIndex other : mesh_.neighbour[at.tetrahedron])
        if (exists(other)) try_in(other);
    if (!exists(at.facet)) return;
  }
}

void NaturalNeighbours3::evaluate_from(Functions functions, const Vec3& x, SimplexIndex start,
                                       std::span<const SimplexIndex> near) {
  const Outcome outcome = collect(x, start);
  if (outcome == Outcome::found) return;
  if (outcome == Outcome::surrounded) {
    if (functions == Functions::sibson) {
      weigh_sibson();
      if (finish()) return;
      ++fallbacks_.to_laplace;
    }
    weigh_laplace();
    if (finish()) return;
  }
  ++fallbacks_.to_linear;
  linear(x, near);
}

void NaturalNeighbours3::evaluate(Functions functions, const Vec3& x, std::span<const SimplexIndex> near) {
  assert(!near.empty());
  if (functions == Functions::linear) return linear(x, near);
  for (const SimplexIndex t : near)
    if (in_sphere(t, x)) return evaluate_from(functions, x, t, near);
  for (const SimplexIndex from : near) {
    const SpaceWalkEnd at = walk(cloud_, mesh_, from, x);
    if (!exists(at.facet)) return evaluate_from(functions, x, at.tetrahedron, near);
  }
  ++fallbacks_.to_linear;
  linear(x, near);
}

void NaturalNeighbours3::evaluate(Functions functions, const Vec3& x, SimplexIndex hint) {
  const SpaceWalkEnd at = walk(cloud_, mesh_, hint, x);
  const std::array near{at.tetrahedron};
  if (functions == Functions::linear || exists(at.facet)) return linear(x, near);
  evaluate_from(functions, x, at.tetrahedron, near);
}

} // namespace cnem::voronoi
