#include "report/body_view.hpp"

#include "core/fields/vector_at.hpp"
#include "core/geometry/facets.hpp"
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

  void add(std::span<const Vec2> corners, double value) {
    auto& index = scene_.cells.index;
    const std::size_t first = index.size();
    for (const Vec2& x : corners) {
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
    scene_.value.push_back(value);
  }

  Scene& scene() { return scene_; }

private:
  std::int32_t vertex(const Vec2& x) {
    const std::pair key(std::llround(x.x() / unit_), std::llround(x.y() / unit_));
    const auto v = as<std::int32_t>(scene_.cells.vertex.size());
    const auto [place, fresh] = at_.emplace(key, v);
    if (!fresh) return place->second;
    scene_.cells.vertex.push_back(x);
    scene_.cells.vertex_node.push_back(as<NodeIndex>(v));
    scene_.cells.vertex_weight.push_back(1.0);
    scene_.cells.vertex_begin.push_back(v + 1);
    for (std::size_t k = 0; k < 2; ++k) scene_.position[k].push_back(x[static_cast<Eigen::Index>(k)]);
    return v;
  }

  double unit_; ///< m
  Scene scene_;
  std::map<std::pair<long long, long long>, std::int32_t> at_;
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

Scene surface_scene(const IndexedVector<CloudFacetIndex, Facet<3>>& facets, const Fields<3>& position,
                    std::span<const double> value, const BodyView& view) {
  const Mat<3> axes = view.axes();
  const Vec3 light = axes.transpose() * Vec3(-0.4, 0.6, 1.0).normalized();
  struct Seen {
    double depth;
    CloudFacetIndex facet;
  };
  std::vector<Seen> seen;
  for (const CloudFacetIndex f : facets.indices()) {
    const auto corner = corners_of<3>(facets[f], position);
    const Vec3 normal = area_normal<3>(corner);
    if (!(axes.row(2).dot(normal) > 0.0)) continue;
    seen.push_back({axes.row(2).dot(corner[0] + corner[1] + corner[2]), f});
  }
  std::stable_sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) { return a.depth < b.depth; });
  Polygons polygons(size_of(position));
  for (const Seen& s : seen) {
    const Facet<3>& facet = facets[s.facet];
    const auto corner = corners_of<3>(facet, position);
    const double lit = std::max(0.0, light.dot(area_normal<3>(corner).normalized()));
    std::array<Vec2, 3> x;
    for (std::size_t a = 0; a < 3; ++a) x[a] = (axes * corner[a]).head<2>();
    const Vec2 centre = (x[0] + x[1] + x[2]) / 3.0;
    for (std::size_t a = 0; a < 3; ++a) {
      const Vec2 after = 0.5 * (x[a] + x[(a + 1) % 3]), before = 0.5 * (x[a] + x[(a + 2) % 3]);
      polygons.add(std::array{x[a], after, centre, before}, value[index_of(facet.node[a])]);
      polygons.scene().darkness.resize(polygons.scene().value.size(), static_cast<float>(1.0 - lit));
    }
  }
  return std::move(polygons.scene());
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

/// What is left where `inside`, linear over the polygon, is not negative.
template<class Inside> void clip(Polygon& polygon, Polygon& scratch, Inside&& inside) {
  scratch.clear();
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Corner &a = polygon[n], &b = polygon[(n + 1) % polygon.size()];
    const double at_a = inside(a), at_b = inside(b);
    if (at_a >= 0.0) scratch.push_back(a);
    if ((at_a >= 0.0) != (at_b >= 0.0)) scratch.push_back(between(a, b, at_a / (at_a - at_b)));
  }
  polygon.swap(scratch);
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

using Tetrahedron = std::array<NodeIndex, 4>;

/// The nodes of those that share a face with each tetrahedron, beside its own; [tetrahedron][4], none: there
/// is no neighbour.
std::vector<Tetrahedron> nodes_across(std::span<const Tetrahedron> tetrahedra) {
  struct Face {
    std::array<NodeIndex, 3> key;
    std::size_t tetrahedron, opposite;
  };
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

Scene section_scene(std::span<const Tetrahedron> tetrahedra, const Fields<3>& position,
                    std::span<const double> value, const Vec3& at, const Vec3& normal, SectionCells cells) {
  const Mat<3> axes = BodyView{normal}.axes();
  const Vec3 towards = axes.row(2);
  const std::vector<Tetrahedron> across =
      cells == SectionCells::voronoi ? nodes_across(tetrahedra) : std::vector<Tetrahedron>();
  Polygons polygons(size_of(position));
  Polygon part, scratch;
  std::vector<Vec2> corners;
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
          clip(part, scratch, [&](const Corner& c) { return c.share[a] - c.share[b]; });
        } else {
          const Vec3 own = vector_at<3>(position, index_of(candidates[a])),
                     other = vector_at<3>(position, index_of(candidates[b]));
          clip(part, scratch, [&](const Corner& c) {
            Vec3 x = Vec3::Zero();
            for (std::size_t k = 0; k < 4; ++k) x += c.share[k] * corner[k];
            return (other - x).squaredNorm() - (own - x).squaredNorm();
          });
        }
      }
      if (part.size() < 3) continue;
      corners.clear();
      for (const Corner& c : part) corners.push_back(c.x);
      polygons.add(corners, value[index_of(candidates[a])]);
    }
  }
  return std::move(polygons.scene());
}

} // namespace cnem::report
