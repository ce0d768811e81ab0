// Any outline, holes, cracks, interfaces, regions and spacings or nodes: a cloud whose cells and operators
// keep their promises, whose parts are told apart and whose bonded faces match, and which can be deformed and
// resampled, its faces matched; or a GeometryError.
#include "adapt/plane/resample.hpp"
#include "app/problem/bodies.hpp"
#include "cnem/scni.hpp"
#include "core/error.hpp"
#include "core/geometry/mates.hpp"
#include "core/index.hpp"
#include "mechanics/ties.hpp"
#include "tests/fuzz/shapes.hpp"
#include "voronoi/plane/cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>

namespace {

using namespace cnem;

[[noreturn]] void fail(const char* what, double found, double expected) {
  std::fprintf(stderr, "%s: found %.17g, expected %.17g\n", what, found, expected);
  std::abort();
}

double polygon_area(const Cloud<2>& cloud) {
  const Vec2 origin = cloud.position[index_of(cloud.facets.front().node[0])];
  double area = 0.0;
  for (const Facet<2>& f : cloud.facets)
    area += 0.5 * cross(cloud.position[f.node[0]] - origin, cloud.position[f.node[1]] - origin);
  return area;
}

double extent(const Cloud<2>& cloud) {
  double size = 0.0;
  for (const Vec2& x : cloud.position) size = std::max(size, (x - cloud.position.front()).norm());
  return size;
}

/// Largest rounding error of a coordinate, m.
double last_bit(const Cloud<2>& cloud) {
  double size = 0.0;
  for (const Vec2& x : cloud.position) size = std::max(size, x.cwiseAbs().maxCoeff());
  return 0x1p-52 * size;
}

/// Least height of a triangle over the size of the domain.
double thinness(const Cloud<2>& cloud, const voronoi::Triangulation& mesh) {
  double least = 1.0;
  for (const auto& [i, j, k] : mesh.node) {
    const Vec2 a = cloud.position[j] - cloud.position[i], b = cloud.position[k] - cloud.position[i];
    least = std::min(least, std::abs(cross(a, b)) / std::max({a.norm(), b.norm(), (b - a).norm()}));
  }
  return least / extent(cloud);
}

void check_cells(const Cloud<2>& cloud, const voronoi::Triangulation& mesh) {
  const voronoi::Circumcircles circles = voronoi::circumcircles(cloud, mesh);
  const voronoi::Cells cells = voronoi::constrained_cells(cloud, mesh, circles);
  const CellGeometry<2> polygons = voronoi::cell_geometry(cloud, mesh, circles, cells);
  if (polygons.begin.size() != cloud.position.size() + 1)
    fail("cell polygons", double(polygons.begin.size()), double(cloud.nodes()) + 1.0);
  double sum = 0.0;
  for (const double v : cells.volume) {
    if (!(v > 0.0)) fail("volume of a cell", v, 0.0);
    sum += v;
  }
  const double area = polygon_area(cloud), size = extent(cloud);
  if (!(std::abs(sum - area) <= 1e-11 * area + 100.0 * last_bit(cloud) * size))
    fail("sum of cells", sum, area);
}

/// Constants have no gradient, linear fields the right one.
void check_operators(const Cloud<2>& cloud, const DiscreteOperators<2>& op) {
  const double size = extent(cloud);
  for (std::size_t p = 0; p < index_of(op.points); ++p) {
    if (!(op.volume[p] > 0.0)) fail("volume of a point", op.volume[p], 0.0);
    const Vec2 origin = cloud.position[op.nodal ? p : index_of(op.node[index_of(op.row_begin[p])])];
    Vec2 sum = Vec2::Zero();
    Mat2 identity = Mat2::Zero();
    double total = 0.0, scale = 1.0;
    for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
      const Vec2 b(op.gradient[0][e], op.gradient[1][e]), r = cloud.position[op.node[e]] - origin;
      sum += b;
      identity += r * b.transpose();
      total += b.norm();
      scale += r.norm() * b.norm();
    }
    // Sums over the boundary of a thin cell are rounded before they are divided by its volume.
    const double thin = 100.0 * 0x1p-52 * size / op.volume[p];
    const double rounding = 20.0 * last_bit(cloud) * total + thin * size;
    if (!(sum.norm() <= 1e-11 * total + thin)) fail("gradient of a constant", sum.norm(), 0.0);
    const double error = (identity - Mat2::Identity()).norm();
    if (!(error <= 1e-11 * scale + rounding)) fail("gradient of a linear field", error, 0.0);
  }
}

/// Constants and linear fields for either kind of functions; of conduction, whose operators are those of
/// finite-element triangles, too.
void check_operators(const Cloud<2>& cloud, const voronoi::Triangulation& mesh, bool smooth) {
  const auto functions = smooth ? scni::Functions::sibson : scni::Functions::laplace;
  const Approximation<2> built = scni::Cnem({.functions = functions}).rebuild(cloud);
  // The case reader lets no curves come closer than 1e-9 of their size, below which rounding decides.
  if (thinness(cloud, mesh) < 1e-9) return;
  check_operators(cloud, built.mechanics);
  check_operators(cloud, built.conduction);
}

/// What the case reader would have made of the shape, as far as the program reads it here.
input::Case case_of(const fuzz::Shape& shape) {
  input::Case input;
  const std::vector<clouds::Crack>& cracks = shape.domain.cracks;
  for (std::size_t k = 0; k < shape.interfaces; ++k) {
    const clouds::Crack& face = cracks[cracks.size() - shape.interfaces + k];
    input.domain.interfaces.push_back({face.name, face.path, {}, {}, {}, {}});
    if (k % 2 == 1) input.domain.interfaces.back().conductance = 1.0;
  }
  for (const Vec2& at : shape.regions)
    input.domain.regions.push_back(
        {fmt::format("region{}", input.domain.regions.size()), at, "", 0.0, {0, 0}});
  return input;
}

/// A region is bounded by loops of its own: they enclose what its cells make up. Its triangles lie in it as a
/// whole.
void check_regions(const input::Case& input, const Cloud<2>& cloud, const voronoi::Triangulation& mesh) {
  IndexedVector<NodeIndex, std::int32_t> region;
  try {
    region = app::region_of_nodes(input, cloud);
  } catch (const InputError&) { return; } // two in one part
  if (region.empty()) return;
  for (const auto& [i, j, k] : mesh.node)
    if (region[index_of(i)] != region[index_of(j)] || region[index_of(i)] != region[index_of(k)])
      fail("regions of one triangle", region[index_of(j)], region[index_of(i)]);
  const Field volume = adapt::build_structure(cloud).cells.volume;
  const double rounding = 1e-11 * polygon_area(cloud) + 100.0 * last_bit(cloud) * extent(cloud);
  const Vec2 origin = cloud.position.front();
  for (std::int32_t r = 0; r < static_cast<std::int32_t>(input.domain.regions.size()); ++r) {
    double enclosed = 0.0, cells = 0.0;
    for (const Facet<2>& f : cloud.facets)
      if (region[index_of(f.node[0])] == r)
        enclosed += 0.5 * cross(cloud.position[f.node[0]] - origin, cloud.position[f.node[1]] - origin);
    for (std::size_t i = 0; i < volume.size(); ++i)
      if (region[i] == r) cells += volume[i];
    if (!(cells > 0.0)) fail("cells of a region", cells, enclosed);
    if (!(std::abs(cells - enclosed) <= rounding)) fail("cells of a region", cells, enclosed);
  }
}

/// Each node on either face of an interface is tied to the one opposite, at the same place, and heat crosses
/// each facet to the one opposite.
void check_interfaces(const input::Case& input, const Cloud<2>& cloud) {
  const app::Pairs pairs = app::tied_pairs(input, cloud);
  for (const auto& [a, b] : pairs.motion)
    if (cloud.position[a] != cloud.position[b])
      fail("distance of tied nodes", (cloud.position[a] - cloud.position[b]).norm(), 0.0);
  const Ties<2> ties(pairs.motion, cloud.position);
  const std::vector<ContactConductance<2>> heat = app::conductances(input, cloud);
  std::size_t crossed = 0;
  for (const input::Interface& face : input.domain.interfaces) {
    const auto front = app::facets_of<2>(cloud, {face.name + "+"}),
               back = app::facets_of<2>(cloud, {face.name + "-"});
    if (front.empty() || front.size() != back.size())
      fail("facets of the faces of an interface", double(front.size()), double(back.size()));
    for (const auto& facets : {front, back})
      for (const NodeIndex i : app::nodes_of(facets))
        if (ties.group()[index_of(i)] < 0) fail("group of a node on an interface", -1.0, 0.0);
    if (!face.conductance) continue;
    const ContactConductance<2>& exchange = heat[crossed++];
    for (std::size_t f = 0; f < exchange.facets.size(); ++f)
      for (std::size_t k = 0; k < 2; ++k) {
        const Vec2 gap = cloud.position[exchange.opposite[f][k]] - cloud.position[exchange.facets[f].node[k]];
        if (gap != Vec2::Zero()) fail("gap of a conductance", gap.norm(), 0.0);
      }
  }
  if (crossed != heat.size()) fail("conductances", double(heat.size()), double(crossed));
}

double sum_of(const Field& field) {
  double sum = 0.0;
  for (const double v : field) sum += v;
  return sum;
}

/// A cloud on its way through deformations: what its nodes carry.
class Resampled {
public:
  Resampled(const Cloud<2>& cloud, bool smooth) : cloud_(cloud), smooth_(smooth) {
    const adapt::Structure structure = adapt::build_structure(cloud);
    mass_ = structure.cells.volume;
    for (const NodeIndex i : cloud.position.indices()) {
      double sum = 0.0;
      for (const NodeIndex k : structure.neighbours(i)) sum += (cloud.position[k] - cloud.position[i]).norm();
      size_.push_back(sum / static_cast<double>(structure.neighbours(i).size()));
    }
  }

  void deform_and_resample(const fuzz::Deformation& change) {
    deform(change);
    IndexedVector<NodeIndex, char> held(mass_.size(), 0);
    for (std::size_t f = 0; f < cloud_.facets.size(); ++f)
      held[index_of(cloud_.facets[f].node[0])] =
          change.held > 0 && f % static_cast<std::size_t>(change.held) == 0;
    const auto placement =
        change.at_vertices ? adapt::Placement::voronoi_vertices : adapt::Placement::between_nodes;
    adapt::PassReport report;
    const Resampling<2> made =
        adapt::resample(cloud_, adapt::structure_if_valid(cloud_),
                        {mass_, Field(mass_.size(), 0.0), Field(mass_.size(), 1.0), size_, held, {}},
                        {.placement = placement}, report);
    check_rows(made);
    for (std::size_t i = 0; i < held.size(); ++i) {
      if (!held[i]) continue;
      if (!exists(made.new_of[i])) fail("new number of a node that has to stay", -1.0, 0.0);
      if (made.cloud.position[made.new_of[i]] != cloud_.position[i])
        fail("motion of a node that has to stay",
             (made.cloud.position[made.new_of[i]] - cloud_.position[i]).norm(), 0.0);
    }
    const double before = sum_of(mass_);
    carry_sum(made.parcels, mass_);
    carry_label(made.labels, size_);
    if (!(std::abs(sum_of(mass_) - before) <= 1e-12 * before)) fail("mass", sum_of(mass_), before);
    for (const double m : mass_)
      if (!(m > 0.0)) fail("mass of a node", m, 0.0);
    cloud_ = made.cloud;
    for (const auto& [a, b] : mated_nodes(cloud_))
      if (cloud_.position[a] != cloud_.position[b])
        fail("distance of mates", (cloud_.position[a] - cloud_.position[b]).norm(), 0.0);
    const voronoi::Triangulation mesh = voronoi::triangulate(cloud_);
    check_cells(cloud_, mesh);
    check_operators(cloud_, mesh, smooth_);
  }

private:
  void deform(const fuzz::Deformation& change) {
    const Vec2 origin = cloud_.position.front();
    const double size = extent(cloud_);
    const auto node = [&](int k) { return static_cast<std::size_t>(k) % mass_.size(); };
    for (Vec2& x : cloud_.position) {
      Vec2 d = (x - origin) / size;
      d.x() += change.shear[0] * std::sin(change.wave[0] * d.y()) + change.shear[1] * d.y();
      d.y() += change.shear[2] * std::sin(change.wave[1] * d.x()) + change.shear[3] * d.x();
      x = origin + size * d;
    }
    for (const auto& jump : change.jumps) {
      const Vec2 from = cloud_.position[node(jump.node)], to = from + size_[node(jump.node)] * jump.by;
      for (Vec2& x : cloud_.position) // the faces of an interface move as one
        if (x == from) x = to;
    }
    for (const auto& wish : change.wishes) size_[node(wish.node)] *= wish.factor;
  }

  /// Every old node's matter is given away exactly once, every label is a mean.
  void check_rows(const Resampling<2>& made) const {
    Field given(mass_.size(), 0.0);
    for (std::size_t e = 0; e < made.parcels.from.size(); ++e) {
      if (!(made.parcels.weight[e] > 0.0)) fail("weight of a parcel", made.parcels.weight[e], 0.0);
      given[index_of(made.parcels.from[e])] += made.parcels.weight[e];
    }
    for (const double sum : given)
      if (!(std::abs(sum - 1.0) <= 1e-12)) fail("sum of the parcels of a node", sum, 1.0);
    for (std::size_t p = 0; p < made.labels.size(); ++p) {
      double sum = 0.0;
      for (auto e = index_of(made.labels.begin[p]); e < index_of(made.labels.begin[p + 1]); ++e)
        sum += made.labels.weight[e];
      if (!(std::abs(sum - 1.0) <= 1e-12)) fail("sum of the weights of a label", sum, 1.0);
    }
  }

  Cloud<2> cloud_;
  bool smooth_;
  Field mass_, size_;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::Shape shape = fuzz::shape_of(data, size);
  try {
    const clouds::GeneratedCloud made = clouds::generate_cloud(shape.domain, shape.spacing, shape.options);
    const voronoi::Triangulation mesh = voronoi::triangulate(made.cloud);
    check_cells(made.cloud, mesh);
    const bool smooth = shape.options.seed % 2 == 0;
    check_operators(made.cloud, mesh, smooth);
    const input::Case input = case_of(shape);
    check_regions(input, made.cloud, mesh);
    check_interfaces(input, made.cloud);
    if (shape.deformations.empty()) return 0;
    Cloud<2> matched = made.cloud;
    pair_coincident_facets(matched);
    Resampled cloud(matched, smooth);
    for (const fuzz::Deformation& change : shape.deformations) cloud.deform_and_resample(change);
  } catch (const GeometryError&) {} // refused with words
  return 0;
}
