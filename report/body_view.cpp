#include "report/body_view.hpp"

#include "core/fields/vector_at.hpp"
#include "core/geometry/clip_polygon.hpp"
#include "core/geometry/facets.hpp"
#include "core/geometry/plane_section.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace cnem::report {
namespace {

/// Polygons that share vertices where they meet: lines between them are drawn once, and the rim of the body
/// is where none meets another.
class Polygons {
public:
  /// size: m, of what is drawn: places nearer than a ten-millionth of it are one.
  explicit Polygons(double size) : unit_(1e-7 * size) {
    scene_.cells.begin.push_back(0);
    scene_.cells.vertex_begin.push_back(0);
  }

  /// Corners with their heights towards the eye, m.
  void add(std::span<const Vec3> corners, NodeIndex node) {
    auto& index = scene_.cells.index;
    const std::size_t first = index.size();
    for (const Vec3& x : corners) {
      const std::int32_t v = vertex(x);
      if (index.size() > first && index.back() == v) continue;
      index.push_back(v);
    }
    if (index.size() > first + 1 && index.back() == index[first]) index.pop_back();
    if (index.size() < first + 3) return index.resize(first);
    double twice = 0.0;
    for (std::size_t k = first; k < index.size(); ++k)
      twice += cross(scene_.cells.vertex[index_of(index[k])],
                     scene_.cells.vertex[index_of(index[k + 1 < index.size() ? k + 1 : first])]);
    if (twice < 0.0) std::reverse(index.begin() + static_cast<std::ptrdiff_t>(first), index.end());
    scene_.cells.begin.push_back(as<std::int32_t>(index.size()));
    scene_.node.push_back(node);
  }

  Scene& scene() { return scene_; }

private:
  std::int32_t vertex(const Vec3& x) {
    const std::array key{std::llround(x.x() / unit_), std::llround(x.y() / unit_),
                         std::llround(x.z() / unit_)};
    const auto v = as<std::int32_t>(scene_.cells.vertex.size());
    const auto [place, fresh] = at_.emplace(key, v);
    if (!fresh) return place->second;
    scene_.cells.vertex.emplace_back(x.head<2>());
    scene_.cells.vertex_node.push_back(as<NodeIndex>(v));
    scene_.cells.vertex_weight.push_back(1.0);
    scene_.cells.vertex_begin.push_back(v + 1);
    for (std::size_t k = 0; k < 2; ++k) scene_.position[k].push_back(x[static_cast<Eigen::Index>(k)]);
    scene_.depth.push_back(x.z());
    return v;
  }

  double unit_; ///< m
  Scene scene_;
  std::map<std::array<long long, 3>, std::int32_t> at_;
};

double size_of(const Fields<3>& position) {
  double size = 0.0;
  for (const Field& component : position) {
    const auto [low, high] = std::minmax_element(component.begin(), component.end());
    if (low != component.end()) size = std::max(size, *high - *low);
  }
  return size;
}

} // namespace

Mat<3> BodyView::axes() const {
  const Vec3 towards = eye.normalized();
  constexpr double steep = 0.999;
  const Vec3 upwards = std::abs(towards.z()) < steep ? Vec3::UnitZ() : Vec3::UnitY();
  const Vec3 right = upwards.cross(towards).normalized();
  Mat<3> axes;
  axes.row(0) = right;
  axes.row(1) = towards.cross(right);
  axes.row(2) = towards;
  return axes;
}

namespace {

/// From above the eye's left, a unit vector in the axes of the picture.
Vec3 light() { return Vec3(-0.4, 0.6, 1.0).normalized(); }

float darkness_of(const Vec3& normal) {
  return static_cast<float>(1.0 - std::max(0.0, light().dot(normal.normalized())));
}

void keep(std::vector<Vec3>& polygon, std::vector<Vec3>& scratch, const KeptSide& side) {
  clip_polygon(polygon, scratch, [&](const Vec3& x) { return side.normal.dot(x - side.at); });
}

/// Where planes that face the eye have cut a solid open.
void fill_openings(SolidFaces& faces, const TriangleSurface& surface, std::span<const KeptSide> sides,
                   const Mat<3>& axes) {
  constexpr float shade = 0.55F; // whatever the light
  std::vector<Vec3> polygon, scratch;
  for (const KeptSide& side : sides) {
    if (!(axes.row(2).dot(side.normal) > 1e-9)) continue;
    const Mat<3> own = BodyView{side.normal}.axes();
    const CutPlane plane{side.at, own.row(0), own.row(1)};
    for (const SectionLoop& loop : cut(surface, plane)) {
      if (!(loop.area() > 0.0)) continue; // cavities are closed over
      polygon.clear();
      for (const Vec2& x : loop.point)
        polygon.emplace_back(plane.at + x.x() * plane.right + x.y() * plane.up);
      for (const KeptSide& other : sides)
        if (&other != &side) keep(polygon, scratch, other);
      std::vector<Vec2> flat;
      for (const Vec3& x : polygon) flat.push_back(plane.flat(x));
      for (const auto& [a, b, c] : ear_triangles(flat)) {
        faces.corner.push_back({Vec3(axes * polygon[a]), Vec3(axes * polygon[b]), Vec3(axes * polygon[c])});
        faces.darkness.push_back(shade);
      }
    }
  }
}

} // namespace

Field Scene::values(std::span<const double> at_nodes) const {
  Field values;
  values.reserve(node.size());
  for (const NodeIndex i : node) values.push_back(at_nodes[index_of(i)]);
  return values;
}

Scene surface_scene(std::span<const std::array<NodeIndex, 3>> facets, const Fields<3>& position,
                    const BodyView& view) {
  const Mat<3> axes = view.axes();
  Polygons polygons(size_of(position));
  for (const auto& facet : facets) {
    std::array<Vec3, 3> x;
    for (std::size_t a = 0; a < 3; ++a) x[a] = axes * vector_at<3>(position, index_of(facet[a]));
    const Vec3 normal = area_normal<3>(x);
    if (!(normal.z() > 0.0)) continue;
    const Vec3 centre = (x[0] + x[1] + x[2]) / 3.0;
    for (std::size_t a = 0; a < 3; ++a) {
      const Vec3 after = 0.5 * (x[a] + x[(a + 1) % 3]), before = 0.5 * (x[a] + x[(a + 2) % 3]);
      polygons.add(std::array{x[a], after, centre, before}, facet[a]);
      polygons.scene().darkness.resize(polygons.scene().node.size(), darkness_of(normal));
    }
  }
  return std::move(polygons.scene());
}

void add_solid(SolidFaces& faces, const TriangleSurface& surface, std::span<const KeptSide> sides,
               const BodyView& view) {
  const Mat<3> axes = view.axes();
  std::vector<Vec3> polygon, scratch;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto corner = surface.corners(t);
    const Vec3 normal = axes * area_normal<3>(corner);
    if (!(normal.z() > 0.0)) continue;
    polygon.assign(corner.begin(), corner.end());
    for (const KeptSide& side : sides) keep(polygon, scratch, side);
    for (Vec3& x : polygon) x = axes * x;
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      faces.corner.push_back({polygon[0], polygon[k - 1], polygon[k]});
      faces.darkness.push_back(darkness_of(normal));
    }
  }
  fill_openings(faces, surface, sides, axes);
}

namespace {

using Tetrahedron = std::array<NodeIndex, 4>;

struct Face {
  std::array<NodeIndex, 3> key; ///< its nodes, the lowest first
  std::size_t tetrahedron, opposite;
};

/// The faces of all tetrahedra, those with the same nodes one after the other.
std::vector<Face> sorted_faces(std::span<const Tetrahedron> tetrahedra) {
  std::vector<Face> faces;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t)
    for (std::size_t k = 0; k < 4; ++k) {
      Face face{{tetrahedra[t][(k + 1) % 4], tetrahedra[t][(k + 2) % 4], tetrahedra[t][(k + 3) % 4]}, t, k};
      std::sort(face.key.begin(), face.key.end());
      faces.push_back(face);
    }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return a.key != b.key ? a.key < b.key : a.tetrahedron < b.tetrahedron;
  });
  return faces;
}

} // namespace

std::vector<std::array<NodeIndex, 3>> boundary_of(std::span<const Tetrahedron> tetrahedra) {
  constexpr std::array<std::array<std::size_t, 3>, 4> outwards{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  const std::vector<Face> faces = sorted_faces(tetrahedra);
  std::vector<std::array<NodeIndex, 3>> boundary;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const bool shared = (f > 0 && faces[f - 1].key == faces[f].key) ||
                        (f + 1 < faces.size() && faces[f + 1].key == faces[f].key);
    if (shared) continue;
    const Tetrahedron& corner = tetrahedra[faces[f].tetrahedron];
    const auto& [a, b, c] = outwards[faces[f].opposite];
    boundary.push_back({corner[a], corner[b], corner[c]});
  }
  return boundary;
}

namespace {

/// A corner of a convex polygon in the plane of a section.
struct Corner {
  Vec2 x;
  std::array<double, 4> share; ///< barycentric coordinates in its tetrahedron
};
using Polygon = std::vector<Corner>;

Corner between(const Corner& a, const Corner& b, double t) {
  Corner c{a.x + t * (b.x - a.x), {}};
  for (std::size_t k = 0; k < 4; ++k) c.share[k] = a.share[k] + t * (b.share[k] - a.share[k]);
  return c;
}

/// Where a plane cuts a tetrahedron, height: [corner] over the plane. In order around.
Polygon section_of(const std::array<Vec3, 4>& corner, const std::array<double, 4>& height,
                   const Mat<3>& axes) {
  Polygon polygon;
  const auto crossing = [&](std::size_t a, std::size_t b) {
    const double t = height[a] / (height[a] - height[b]);
    Corner c{(axes * (corner[a] + t * (corner[b] - corner[a]))).head<2>(), {}};
    c.share[a] = 1.0 - t;
    c.share[b] = t;
    polygon.push_back(c);
  };
  std::vector<std::size_t> above, below;
  for (std::size_t a = 0; a < 4; ++a) (height[a] >= 0.0 ? above : below).push_back(a);
  if (above.size() == 2) {
    crossing(above[0], below[0]);
    crossing(above[0], below[1]);
    crossing(above[1], below[1]);
    crossing(above[1], below[0]);
  } else if (above.size() == 1 || above.size() == 3) {
    const std::size_t single = above.size() == 1 ? above[0] : below[0];
    for (const std::size_t b : above.size() == 1 ? below : above) crossing(single, b);
  }
  return polygon;
}

/// The nodes of those that share a face with each tetrahedron, beside its own; [tetrahedron][4], none: there
/// is no neighbour.
std::vector<Tetrahedron> nodes_across(std::span<const Tetrahedron> tetrahedra) {
  const std::vector<Face> faces = sorted_faces(tetrahedra);
  constexpr NodeIndex none = NodeIndex::none;
  std::vector<Tetrahedron> across(tetrahedra.size(), {none, none, none, none});
  for (std::size_t f = 0; f + 1 < faces.size(); ++f)
    if (faces[f].key == faces[f + 1].key) {
      const auto &a = faces[f], &b = faces[f + 1];
      across[a.tetrahedron][a.opposite] = tetrahedra[b.tetrahedron][b.opposite];
      across[b.tetrahedron][b.opposite] = tetrahedra[a.tetrahedron][a.opposite];
    }
  return across;
}

} // namespace

Scene section_scene(std::span<const Tetrahedron> tetrahedra, const Fields<3>& position, const Vec3& at,
                    const Vec3& normal, SectionCells cells) {
  const Mat<3> axes = BodyView{normal}.axes();
  const Vec3 towards = axes.row(2);
  const std::vector<Tetrahedron> across =
      cells == SectionCells::voronoi ? nodes_across(tetrahedra) : std::vector<Tetrahedron>();
  Polygons polygons(size_of(position));
  Polygon part, scratch;
  std::vector<Vec3> corners;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    std::array<Vec3, 4> corner;
    std::array<double, 4> height{};
    for (std::size_t a = 0; a < 4; ++a) {
      corner[a] = vector_at<3>(position, index_of(tetrahedra[t][a]));
      height[a] = towards.dot(corner[a] - at);
    }
    const Polygon whole = section_of(corner, height, axes);
    if (whole.empty()) continue;
    std::vector<NodeIndex> candidates(tetrahedra[t].begin(), tetrahedra[t].end());
    if (cells == SectionCells::voronoi)
      for (const NodeIndex i : across[t])
        if (exists(i)) candidates.push_back(i);
    for (std::size_t a = 0; a < candidates.size(); ++a) {
      part = whole;
      for (std::size_t b = 0; b < candidates.size() && !part.empty(); ++b) {
        if (a == b) continue;
        if (cells == SectionCells::median) {
          clip_polygon(
              part, scratch, [&](const Corner& c) { return c.share[b] - c.share[a]; }, between);
        } else {
          const Vec3 own = vector_at<3>(position, index_of(candidates[a])),
                     other = vector_at<3>(position, index_of(candidates[b]));
          clip_polygon(
              part, scratch,
              [&](const Corner& c) {
                Vec3 x = Vec3::Zero();
                for (std::size_t k = 0; k < 4; ++k) x += c.share[k] * corner[k];
                return (own - x).squaredNorm() - (other - x).squaredNorm();
              },
              between);
        }
      }
      if (part.size() < 3) continue;
      corners.clear();
      for (const Corner& c : part) corners.emplace_back(c.x.x(), c.x.y(), 0.0);
      polygons.add(corners, candidates[a]);
    }
  }
  polygons.scene().depth.clear();
  return std::move(polygons.scene());
}

} // namespace cnem::report
