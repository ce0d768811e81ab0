// The outlines of slug and skeleton at a cut, in the coordinates of their faces.
#include "core/index.hpp"
#include "evaluate/blanking.hpp"
#include "evaluate/sheared_face.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cnem::evaluate {
namespace {

FaceSurface surface_of(const CutSheet& sheet, const Facet<2>& facet) {
  if (facet.piece == sheet.fracture_piece) return FaceSurface::fracture;
  const auto& others = sheet.other_pieces;
  if (std::find(others.begin(), others.end(), facet.piece) != others.end()) return FaceSurface::other;
  const bool broken =
      !sheet.broken.empty() && sheet.broken[index_of(facet.node[0])] && sheet.broken[index_of(facet.node[1])];
  return broken ? FaceSurface::broken : FaceSurface::metal;
}

/// Nodes of the longest boundary of a part, in order, and what the facet that leaves each is.
struct Loop {
  std::vector<NodeIndex> node;
  std::vector<FaceSurface> surface;
};
Loop outline_of(const CutSheet& sheet, std::int32_t part) {
  IndexedVector<NodeIndex, CloudFacetIndex> leaving(sheet.position.size(), CloudFacetIndex::none);
  for (const CloudFacetIndex f : sheet.facets.indices()) leaving[sheet.facets[f].node[0]] = f;
  IndexedVector<NodeIndex, char> seen(sheet.position.size(), 0);
  Loop longest;
  double most = -1.0;
  for (const Facet<2>& first : sheet.facets) {
    if (seen[first.node[0]] || sheet.part[index_of(first.node[0])] != part) continue;
    Loop loop;
    double length = 0.0;
    for (NodeIndex i = first.node[0]; !seen[i];) {
      const Facet<2>& facet = sheet.facets[leaving[i]];
      seen[i] = 1;
      loop.node.push_back(i);
      loop.surface.push_back(surface_of(sheet, facet));
      length += (sheet.position[index_of(facet.node[1])] - sheet.position[index_of(i)]).norm();
      i = facet.node[1];
    }
    if (length > most) {
      most = length;
      longest = std::move(loop);
    }
  }
  return longest;
}

/// Whether a plane of symmetry holds the body on its side of the cut.
bool held_by_plane(const Cut& cut, const CutTools& tools, const CutSheet& sheet, bool slug) {
  for (std::size_t i = 0; i < sheet.part.size(); ++i) {
    if (!sheet.on_plane[i] || sheet.part[i] != (slug ? cut.slug : cut.skeleton)) continue;
    const double t = tools.across(sheet.position[i]);
    if (slug ? cut.side * (t - cut.punch) <= 0.0 : cut.side * (t - cut.die) >= 0.0) return true;
  }
  return false;
}

/// The angle by which the metal beside a cut has turned since the start, rad, from u towards w of the face
/// (`in_face`): of the rigid motion nearest to its own between a quarter and one and a half thicknesses from
/// the edge of the tool, weighted with volume.
template<class InFace>
double turn_of(const CutSheet& sheet, std::int32_t part, double edge, double thickness, InFace&& in_face) {
  std::vector<std::size_t> members;
  double weight = 0.0;
  Vec2 mean = Vec2::Zero(), mean_before = Vec2::Zero();
  for (std::size_t i = 0; i < sheet.initial.size(); ++i) {
    if (sheet.part[i] != part) continue;
    const Vec2 before = in_face(sheet.initial[i]);
    if (const double away = edge - before.x(); away < 0.25 * thickness || away > 1.5 * thickness) continue;
    members.push_back(i);
    weight += sheet.volume[i];
    mean_before += sheet.volume[i] * before;
    mean += sheet.volume[i] * in_face(sheet.position[i]);
  }
  if (!(weight > 0.0)) return 0.0;
  mean /= weight;
  mean_before /= weight;
  double sine = 0.0, cosine = 0.0;
  for (const std::size_t i : members) {
    const Vec2 from = in_face(sheet.initial[i]) - mean_before, to = in_face(sheet.position[i]) - mean;
    sine += sheet.volume[i] * cross(from, to);
    cosine += sheet.volume[i] * from.dot(to);
  }
  return std::atan2(sine, cosine);
}

/// The body of one side of a cut, seen from its drawn-in surface.
ShearedFace measure_side(const Cut& cut, const CutTools& tools, const CutSheet& sheet, bool slug,
                         double parallel, double smoothing) {
  const std::int32_t part = slug ? cut.slug : cut.skeleton;
  ShearedFace face;
  if (part < 0) {
    face.measured = false;
    face.note = "nothing is left there";
  } else {
    // The die draws the slug in, the punch the skeleton.
    const double outwards = slug ? cut.side : -cut.side, into = slug ? -1.0 : 1.0;
    const auto in_face = [&](const Vec2& x) {
      return Vec2(outwards * tools.across(x), into * tools.along(x));
    };
    const Loop loop = outline_of(sheet, part);
    FaceOutline outline;
    outline.surface = loop.surface;
    for (const NodeIndex i : loop.node) outline.point.push_back(in_face(sheet.position[index_of(i)]));
    FaceRules rules;
    rules.thickness = cut.thickness;
    rules.parallel = parallel;
    rules.smoothing = smoothing > 0.0 ? smoothing : cut.thickness / 50.0;
    rules.edge = outwards * (slug ? cut.die : cut.punch);
    rules.limit = cut.slug == cut.skeleton
                      ? rules.edge + std::max(0.25 * cut.thickness, 2.0 * std::abs(cut.die - cut.punch))
                      : std::numeric_limits<double>::infinity(); // it may have moved on since
    rules.fixed = held_by_plane(cut, tools, sheet, slug) || (slug && cut.slug == cut.skeleton);
    rules.whole_surface = slug;
    if (!rules.fixed) rules.turn = turn_of(sheet, part, rules.edge, cut.thickness, in_face);
    face = measure_face(outline, rules);
  }
  face.cut = cut.name;
  face.body = slug ? "slug" : "skeleton";
  face.thickness = cut.thickness;
  return face;
}

} // namespace

std::vector<ShearedFace> measure_cut(const Cut& cut, const CutTools& tools, const CutSheet& sheet,
                                     double parallel, double smoothing) {
  return {measure_side(cut, tools, sheet, true, parallel, smoothing),
          measure_side(cut, tools, sheet, false, parallel, smoothing)};
}

} // namespace cnem::evaluate
