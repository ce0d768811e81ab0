#pragma once
// Clouds in space for tests: bodies of lattice cells, a torus and a shell, whose nodes may be shaken,
// sheared, bent and turned, with random diagonals on their faces: the boundary has to be recovered.
#include "core/geometry/facets.hpp"
#include "tests/clouds.hpp"
#include "voronoi/space/recovery.hpp"

#include <Eigen/Geometry>
#include <functional>
#include <stdexcept>
#include <string>

namespace cnem::testing {

enum class SpaceShape { cube, l, one_hole, two_holes, slit, notch, thin_wall, torus, shell };

inline constexpr std::array space_shapes = {SpaceShape::cube,      SpaceShape::l,     SpaceShape::one_hole,
                                            SpaceShape::two_holes, SpaceShape::slit,  SpaceShape::notch,
                                            SpaceShape::thin_wall, SpaceShape::torus, SpaceShape::shell};

inline const char* name_of(SpaceShape shape) {
  return std::array{"cube", "l", "one_hole", "two_holes", "slit", "notch", "thin_wall", "torus", "shell"}
      [static_cast<std::size_t>(shape)];
}

/// The first piece whose name begins so.
inline PieceIndex piece_of(const Cloud<3>& cloud, const std::string& prefix) {
  for (const PieceIndex p : cloud.piece_names.indices())
    if (cloud.piece_names[p].starts_with(prefix)) return p;
  throw std::logic_error("no piece " + prefix);
}

/// How a body of size 1 is filled and deformed.
struct SpaceCloud {
  SpaceShape shape = SpaceShape::cube;
  int cells = 5;       ///< along an edge of length 1
  double jitter = 0.0; ///< of inner nodes, in spacings; on faces and creases they move along these
  double shear = 0.0;  ///< γ
  int shear_plane = 0; ///< 0 to 5: which coordinate moves along which
  double wave = 0.0;   ///< amplitude of a wave through the body, in lengths
  bool turned = false; ///< by a random rotation: nothing is on a coordinate plane
  std::uint64_t seed = 1;
};

namespace space {

using Cell = std::array<int, 3>;

/// A body of cells of a lattice of unit spacing; cells may be told apart by walls.
struct CellBody {
  Cell size;
  std::function<bool(const Cell&)> filled;
  std::function<bool(const Cell&, std::size_t axis)> wall = [](const Cell&, std::size_t) {
    return false; ///< between a cell and the next along the axis
  };

  bool has(const Cell& c) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (c[k] < 0 || c[k] >= size[k]) return false;
    return filled(c);
  }
  /// Whether the cell's side along an axis, at its lower (0) or upper end (1), is surface.
  bool is_surface(const Cell& c, std::size_t axis, int end) const {
    Cell next = c;
    next[axis] += end == 1 ? 1 : -1;
    return !has(next) || wall(end == 1 ? c : next, axis);
  }
};

inline CellBody cell_body(SpaceShape shape, int n) {
  const int third = std::max(1, n / 3), half = std::max(1, n / 2);
  switch (shape) {
  case SpaceShape::l:
    return {{n, n, half}, [=](const Cell& c) { return c[0] < half || c[1] < half; }};
  case SpaceShape::one_hole: {
    const int low = (n - third) / 2;
    return {{n, n, half}, [=](const Cell& c) {
              return c[0] < low || c[0] >= low + third || c[1] < low || c[1] >= low + third;
            }};
  }
  case SpaceShape::two_holes:
    return {{n + 2, n, half}, [=](const Cell& c) {
              const bool along = c[0] == 1 || c[0] == n;
              return !(along && c[1] >= 1 && c[1] < n - 1);
            }};
  case SpaceShape::slit:
    return {{n, n, half},
            [](const Cell&) { return true; },
            [=](const Cell& c, std::size_t axis) { return axis == 1 && c[1] == half - 1 && c[0] < half; }};
  case SpaceShape::notch:
    return {{n, n, half}, [=](const Cell& c) { return !(c[1] == half && c[0] < half); }};
  case SpaceShape::thin_wall:
    return {{n, n, 1}, [](const Cell&) { return true; }};
  default:
    return {{n, n, n}, [](const Cell&) { return true; }};
  }
}

/// Fills `cloud` with the nodes of the lattice and the sides of cells as facets, pieces by their planes.
/// movable: [node][axis] whether it may be moved along the axis.
inline void add_cells(Cloud<3>& cloud, const CellBody& body, Random& random,
                      IndexedVector<NodeIndex, std::array<bool, 3>>& movable) {
  const auto [nx, ny, nz] = body.size;
  const auto vertex_number = [&, nx = nx, ny = ny](const Cell& v) {
    return index_of(v[0] + (nx + 1) * (v[1] + (ny + 1) * v[2]));
  };
  const auto corner = [](const Cell& v, int c) {
    return Cell{v[0] - 1 + (c & 1), v[1] - 1 + (c >> 1 & 1), v[2] - 1 + (c >> 2)};
  };
  std::vector<std::array<NodeIndex, 8>> node_of(
      vertex_number({0, 0, nz + 1})); // by the cell around the vertex
  std::vector<std::array<bool, 3>> flat(node_of.size(), {true, true, true});
  for (int z = 0; z <= nz; ++z)
    for (int y = 0; y <= ny; ++y)
      for (int x = 0; x <= nx; ++x) {
        const Cell v{x, y, z};
        auto& nodes = node_of[vertex_number(v)];
        nodes.fill(NodeIndex::none);
        std::vector<NodeIndex> here;
        for (int start = 0; start < 8; ++start) {
          if (exists(nodes[index_of(start)]) || !body.has(corner(v, start))) continue;
          const NodeIndex node = cloud.position.next();
          cloud.position.push_back(Vec3(x, y, z));
          for (const NodeIndex other : here) cloud.twins.push_back({other, node});
          here.push_back(node);
          std::vector<int> stack{start};
          while (!stack.empty()) {
            const int c = stack.back();
            stack.pop_back();
            if (exists(nodes[index_of(c)])) continue;
            nodes[index_of(c)] = node;
            for (std::size_t axis = 0; axis < 3; ++axis) {
              const int end = (c >> axis & 1) == 0 ? 1 : 0;
              if (!body.is_surface(corner(v, c), axis, end)) stack.push_back(c ^ (1 << axis));
            }
          }
        }
        for (int c = 0; c < 8; ++c)
          for (std::size_t axis = 0; axis < 3; ++axis)
            if (body.has(corner(v, c)) && body.is_surface(corner(v, c), axis, (c >> axis & 1) == 0 ? 1 : 0))
              flat[vertex_number(v)][axis] = false;
        for (std::size_t n = 0; n < here.size(); ++n) movable.push_back(flat[vertex_number(v)]);
      }

  std::map<std::pair<Cell, std::size_t>, bool> diagonal;
  std::map<std::string, PieceIndex> pieces;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        for (std::size_t axis = 0; axis < 3; ++axis)
          for (int end = 0; end < 2; ++end) {
            const Cell c{x, y, z};
            if (!body.has(c) || !body.is_surface(c, axis, end)) continue;
            Cell low = c;
            low[axis] += end;
            const std::size_t one = (axis + 1) % 3, other = (axis + 2) % 3;
            std::array<NodeIndex, 4> quad;
            for (std::size_t k = 0; k < 4; ++k) {
              Cell v = low;
              v[one] += k == 1 || k == 2;
              v[other] += k >= 2;
              int around = 0; // c as seen from v
              for (std::size_t a = 0; a < 3; ++a) around |= (c[a] - v[a] + 1) << a;
              quad[k] = node_of[vertex_number(v)][index_of(around)];
            }
            const auto [it, fresh] = diagonal.try_emplace({low, axis}, false);
            if (fresh) it->second = random.uniform(0, 1) < 0.5;
            const std::string name =
                std::string(axis_name(axis)) + (end == 1 ? "+" : "-") + std::to_string(low[axis]);
            const auto [piece, first] = pieces.try_emplace(name, as<PieceIndex>(cloud.piece_names.size()));
            if (first) cloud.piece_names.push_back(name);
            std::array<std::size_t, 6> corners = it->second ? std::array<std::size_t, 6>{0, 1, 2, 0, 2, 3}
                                                            : std::array<std::size_t, 6>{0, 1, 3, 1, 2, 3};
            if (end == 0) std::swap(corners[1], corners[2]), std::swap(corners[4], corners[5]);
            for (std::size_t t = 0; t < 6; t += 3)
              cloud.facets.push_back(
                  {{quad[corners[t]], quad[corners[t + 1]], quad[corners[t + 2]]}, piece->second});
          }
}

/// Nodes on a sphere about the origin, as the surface of a lattice cube.
inline void add_sphere(Cloud<3>& cloud, double radius, double spacing, bool inwards, double jitter,
                       Random& random) {
  Cloud<3> cube;
  IndexedVector<NodeIndex, std::array<bool, 3>> movable;
  const int n = std::max(2, static_cast<int>(std::lround(0.5 * std::numbers::pi * radius / spacing)));
  add_cells(cube, {{n, n, n}, [](const Cell&) { return true; }}, random, movable);
  IndexedVector<NodeIndex, NodeIndex> number(cube.position.size(), NodeIndex::none);
  const auto piece = as<PieceIndex>(cloud.piece_names.size());
  cloud.piece_names.push_back(inwards ? "inner" : "outer");
  for (const auto& facet : cube.facets) {
    for (const NodeIndex i : facet.node) {
      if (exists(number[i])) continue;
      number[i] = cloud.position.next();
      Vec3 x;
      for (Eigen::Index k = 0; k < 3; ++k) {
        double at = cube.position[i][k] * 2.0 / n - 1.0;
        if (std::abs(at) < 1.0) at += random.uniform(-jitter, jitter) / n;
        x[k] = std::tan(0.25 * std::numbers::pi * at);
      }
      cloud.position.push_back(x.normalized() * radius);
    }
    std::array node{number[facet.node[0]], number[facet.node[1]], number[facet.node[2]]};
    if (inwards) std::swap(node[1], node[2]);
    cloud.facets.push_back({node, piece});
  }
}

constexpr double tube_radius = 0.2, ring_radius = 0.5, outer_radius = 0.5, inner_radius = 0.2;

inline void add_torus(Cloud<3>& cloud, double spacing, double jitter, Random& random) {
  const int along = std::max(6, static_cast<int>(std::lround(2 * std::numbers::pi * ring_radius / spacing)));
  const int round = std::max(4, static_cast<int>(std::lround(2 * std::numbers::pi * tube_radius / spacing)));
  cloud.piece_names.push_back("torus");
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < round; ++j) {
      const double u = 2 * std::numbers::pi * (i + random.uniform(-jitter, jitter) / 2) / along;
      const double v = 2 * std::numbers::pi * (j + random.uniform(-jitter, jitter) / 2) / round;
      const double r = ring_radius + tube_radius * std::cos(v);
      cloud.position.push_back(Vec3(r * std::cos(u), r * std::sin(u), tube_radius * std::sin(v)));
    }
  const auto node = [&](int i, int j) { return as<NodeIndex>(i % along * round + j % round); };
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < round; ++j) {
      const NodeIndex a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      if (random.uniform(0, 1) < 0.5)
        cloud.facets.push_back({{a, b, c}, {}}), cloud.facets.push_back({{a, c, d}, {}});
      else
        cloud.facets.push_back({{a, b, d}, {}}), cloud.facets.push_back({{b, c, d}, {}});
    }
}

/// Depth below the surface of a round body, m.
inline double depth(SpaceShape shape, const Vec3& x) {
  if (shape == SpaceShape::torus)
    return tube_radius - std::hypot(std::hypot(x.x(), x.y()) - ring_radius, x.z());
  return std::min(outer_radius - x.norm(), x.norm() - inner_radius);
}

inline void fill_round(Cloud<3>& cloud, SpaceShape shape, double spacing, double jitter, Random& random) {
  const int n = static_cast<int>(1.0 / spacing) + 1;
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      for (int k = -n; k <= n; ++k) {
        const Vec3 shaken(random.uniform(-jitter, jitter), random.uniform(-jitter, jitter),
                          random.uniform(-jitter, jitter));
        const Vec3 x = spacing * (Vec3(i, j, k) + shaken);
        if (depth(shape, x) > 0.6 * spacing) cloud.position.push_back(x);
      }
}

/// Moves nodes by their offsets, those of facets that fold less.
inline void shake(Cloud<3>& cloud, const IndexedVector<NodeIndex, std::array<bool, 3>>& movable,
                  double jitter, Random& random) {
  const IndexedVector<NodeIndex, Vec3> rest = cloud.position;
  IndexedVector<NodeIndex, Vec3> offset(rest.size());
  for (const NodeIndex i : rest.indices())
    for (std::size_t k = 0; k < 3; ++k)
      offset[i][static_cast<Eigen::Index>(k)] = movable[i][k] ? random.uniform(-jitter, jitter) : 0.0;
  for (const auto& [a, b] : cloud.twins) offset[b] = offset[a];
  for (int round = 0; round < 20; ++round) {
    for (const NodeIndex i : rest.indices()) cloud.position[i] = rest[i] + offset[i];
    IndexedVector<NodeIndex, bool> folds(rest.size(), false);
    for (const auto& facet : cloud.facets) {
      const Vec3 was = area_normal<3>(corners_of(facet, rest)),
                 is = area_normal<3>(corners_of(facet, cloud.position));
      if (is.dot(was) > 0.2 * was.squaredNorm()) continue;
      for (const NodeIndex i : facet.node) folds[i] = true;
    }
    for (const auto& [a, b] : cloud.twins) folds[a] = folds[b] = folds[a] || folds[b];
    for (const NodeIndex i : rest.indices())
      if (folds[i]) offset[i] *= 0.5;
  }
}

inline void deform(Cloud<3>& cloud, const SpaceCloud& how, Random& random) {
  const auto moved = static_cast<Eigen::Index>(how.shear_plane % 3);
  const Eigen::Index along = (moved + 1 + how.shear_plane / 3) % 3, third = 3 - moved - along;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  if (how.turned) {
    Eigen::Quaterniond turn;
    for (Eigen::Index k = 0; k < 4; ++k) turn.coeffs()[k] = random.uniform(-1, 1);
    rotation = turn.normalized().toRotationMatrix();
  }
  for (Vec3& x : cloud.position) {
    x[moved] += how.shear * x[along];
    x[third] += how.wave * std::sin(5.0 * x[along] + 2.0 * x[moved]);
    if (how.turned) x = rotation * x;
  }
}

} // namespace space

/// The cloud before its boundary is recovered: valid, with random diagonals.
inline Cloud<3> unrecovered(const SpaceCloud& how) {
  Random random(how.seed);
  Cloud<3> cloud;
  const double spacing = 1.0 / how.cells;
  if (how.shape == SpaceShape::torus || how.shape == SpaceShape::shell) {
    if (how.shape == SpaceShape::torus) {
      space::add_torus(cloud, spacing, how.jitter, random);
    } else {
      space::add_sphere(cloud, space::outer_radius, spacing, false, how.jitter, random);
      space::add_sphere(cloud, space::inner_radius, spacing, true, how.jitter, random);
    }
    space::fill_round(cloud, how.shape, spacing, how.jitter, random);
  } else {
    IndexedVector<NodeIndex, std::array<bool, 3>> movable;
    space::add_cells(cloud, space::cell_body(how.shape, how.cells), random, movable);
    space::shake(cloud, movable, how.jitter, random);
    for (Vec3& x : cloud.position) x *= spacing;
  }
  space::deform(cloud, how, random);
  return cloud;
}

/// The cloud that triangulate() takes.
inline voronoi::RecoveredBoundary recovered(const SpaceCloud& how) {
  return voronoi::recover_boundary(unrecovered(how));
}

/// A notch whose faces have been bent onto each other but for a gap, in spacings; `how` gives jitter and
/// seed.
inline Cloud<3> closed_notch(double gap, SpaceCloud how) {
  how.shape = SpaceShape::notch;
  Cloud<3> cloud = unrecovered(how);
  const double h = 1.0 / how.cells, root = h * (how.cells / 2), upper = root + h; // m, in x, and in y
  for (Vec3& x : cloud.position)
    if (x.y() > upper - 0.5 * h) x.y() -= (1.0 - gap) * std::clamp(root - x.x(), 0.0, h);
  return cloud;
}

/// Two cubes with their nodes in turns, the second on the first and `deep` into it, turned about z.
inline Cloud<3> pressed_cubes(int cells, double deep, bool with_bodies) {
  const Cloud<3> one = unrecovered({.shape = SpaceShape::cube, .cells = cells});
  const NodeIndex nodes = one.position.next();
  Cloud<3> both;
  both.piece_names = one.piece_names;
  const double c = std::cos(0.3), s = std::sin(0.3);
  for (const Vec3& x : one.position) {
    both.position.push_back(x);
    both.position.push_back({c * x.x() - s * x.y(), s * x.x() + c * x.y(), x.z() + 1.0 - deep});
  }
  for (std::size_t k = 0; k < 2; ++k)
    for (Facet<3> facet : one.facets) {
      for (NodeIndex& i : facet.node) i = as<NodeIndex>(2 * index_of(i) + k);
      both.facets.push_back(facet);
    }
  if (with_bodies)
    for (std::size_t i = 0; i < 2 * index_of(nodes); ++i) both.body.push_back(as<std::int32_t>(i % 2));
  return both;
}

/// A tetrahedron a, b, c, d of `thick` metal whose edges ac and bd pass above each other, and, beyond its
/// faces acd and bcd, enough metal that cd lies inside. Nodes 0 to 3 are a, b, c and d.
inline Cloud<3> film(double thick, const Vec2& at_d) {
  Cloud<3> cloud;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, thick), Vec3(at_d.x(), at_d.y(), -thick),
                        Vec3(0.3, 1.5, 1), Vec3(0.7, 1.5, -1)})
    cloud.position.push_back(x);
  cloud.piece_names = {"side"};
  const std::array<std::array<std::size_t, 3>, 8> facets{
      {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}, {3, 0, 4}, {2, 1, 5}, {1, 3, 5}, {4, 2, 5}, {3, 4, 5}}};
  for (const auto& [i, j, k] : facets)
    cloud.facets.push_back({{as<NodeIndex>(i), as<NodeIndex>(j), as<NodeIndex>(k)}, as<PieceIndex>(0)});
  return cloud;
}

} // namespace cnem::testing
