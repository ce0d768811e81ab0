#include "adapt/space/resample.hpp"

#include "adapt/space/refine_uncrossed.hpp"
#include "adapt/space/seams.hpp"
#include "adapt/space/unfold.hpp"
#include "core/error.hpp"
#include "core/geometry/facets.hpp"
#include "core/geometry/mates.hpp"
#include "core/geometry/place_text.hpp"
#include "core/index.hpp"
#include "voronoi/order.hpp"
#include "voronoi/space/bodies.hpp"
#include "voronoi/space/crossings.hpp"
#include "voronoi/space/recovery.hpp"
#include "voronoi/space/surface_flips.hpp"
#include "voronoi/space/triangulate.hpp"
#include "voronoi/space/walls.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <utility>

namespace cnem::adapt {

namespace {

/// The matter of nodes that are gone goes to nodes at the place where each was: those that have more volume
/// than matter take most. number: [node] in the structure; none: gone.
std::vector<Parcel> inheritance(const WorkingBody& body, const SpaceStructure& structure,
                                const std::vector<Removal>& list,
                                const IndexedVector<NodeIndex, NodeIndex>& number) {
  IndexedVector<NodeIndex, NodeIndex> body_number(structure.cell.size(), NodeIndex::none);
  Field room(structure.cell.size());
  for (const NodeIndex i : body.nodes())
    if (exists(number[i])) {
      body_number[number[i]] = i;
      room[index_of(number[i])] = structure.volume(number[i]) - body.node().filled(i);
    }
  IndexedVector<NodeIndex, NodeIndex> near(body.size(), NodeIndex::none);
  for (const Removal& removal : list) near[removal.gone] = removal.near;
  std::vector<Parcel> parcels;
  for (const Removal& removal : list) {
    const double matter = body.node().filled(removal.gone);
    if (matter == 0.0) continue;
    NodeIndex stays = removal.near;
    if (!exists(stays))
      throw GeometryError("nothing is left beside the node at " + place_text(body.at(removal.gone)) +
                          " m that may take its matter");
    while (exists(near[stays])) stays = near[stays];
    std::vector<NodeIndex> heirs{number[stays]};
    for (const NodeIndex k : structure.neighbours(number[stays])) heirs.push_back(k);
    Field share(heirs.size(), 0.0);
    const double h = body.spacing(removal.gone);
    double sum = 0.0;
    for (const double least : {0.0, 1.0}) { // where none has room, all take
      for (std::size_t n = 0; n < heirs.size(); ++n) {
        const NodeIndex k = body_number[heirs[n]];
        if (!body.may_mix(k, removal.gone)) continue;
        const double distance = (body.at(k) - body.at(removal.gone)).norm() / h;
        share[n] = std::max(room[index_of(heirs[n])], least * structure.volume(heirs[n])) /
                   (0.1 + distance * distance * distance);
        share[n] = std::max(share[n], 0.0);
        sum += share[n];
      }
      if (sum > 0.0) break;
    }
    if (!(sum > 0.0))
      throw GeometryError("no neighbour of the node at " + place_text(body.at(removal.gone)) +
                          " m may take its matter");
    for (std::size_t n = 0; n < heirs.size(); ++n) {
      if (!(share[n] > 0.0)) continue;
      parcels.push_back({removal.gone, body_number[heirs[n]], share[n] / sum});
      room[index_of(heirs[n])] -= share[n] / sum * matter;
    }
  }
  return parcels;
}

/// The node nearest to one that recovering the boundary has taken out.
NodeIndex nearest_left(const WorkingBody& body, const IndexedVector<NodeIndex, NodeIndex>& now,
                       NodeIndex gone) {
  NodeIndex best = NodeIndex::none;
  for (const NodeIndex i : body.nodes()) {
    if (!exists(now[i]) || !body.may_mix(i, gone)) continue;
    if (!exists(best) ||
        (body.at(i) - body.at(gone)).squaredNorm() < (body.at(best) - body.at(gone)).squaredNorm())
      best = i;
  }
  return best;
}

} // namespace

namespace {

/// Where the boundary could not be recovered.
struct NotRecovered {
  std::vector<Vec3> places;
  std::string message;
};

/// Throws, for an error of the triangulation, what it is about; the error itself where no facet is lost.
[[noreturn]] void tell_places(const Cloud<3>& cloud, const GeometryError& error) {
  constexpr double flat = 0.2443; // rad, as recover_boundary()
  NotRecovered failure{{}, error.what()};
  for (voronoi::SingleBody& body : voronoi::single_bodies(cloud)) {
    Cloud<3>& flipped = body.cloud;
    voronoi::flip_surface(flipped, flat);
    for (const CloudFacetIndex f : voronoi::find_walls(flipped, voronoi::delaunay(flipped)).lost)
      for (const Vec3& x : corners_of<3>(flipped.facets[f], flipped.position)) failure.places.push_back(x);
  }
  if (failure.places.empty()) throw GeometryError(error);
  throw failure;
}

voronoi::RecoveredBoundary recovered_boundary(const WorkingBody& body) {
  try {
    return voronoi::recover_boundary(body.cloud(), {.sound = body.sound()});
  } catch (const GeometryError& error) { tell_places(body.cloud(), error); }
}

using Corners = std::array<NodeIndex, 3>;

std::vector<Corners> sorted_facets(const Cloud<3>& cloud) {
  std::vector<Corners> list;
  for (const auto& facet : cloud.facets) {
    list.push_back(facet.node);
    std::sort(list.back().begin(), list.back().end());
  }
  std::sort(list.begin(), list.end());
  return list;
}

/// Where recovering has put other facets for those of the body, nodes of these give back the volume (m³), but
/// for those that would run into something.
void restore_volume(WorkingBody& body, const IndexedVector<CloudFacetIndex, Facet<3>>& facets, double gained,
                    const SpaceRules& rules) {
  const std::vector<Corners> before = sorted_facets(body.cloud());
  body.set_boundary(facets);
  std::vector<NodeIndex> owing;
  for (Corners corner : sorted_facets(body.cloud()))
    if (!std::binary_search(before.begin(), before.end(), corner))
      owing.insert(owing.end(), corner.begin(), corner.end());
  std::sort(owing.begin(), owing.end());
  owing.erase(std::unique(owing.begin(), owing.end()), owing.end());
  IndexedVector<NodeIndex, char> still = body.node().held;
  constexpr int times = 4;
  for (int n = 0; n < times && !owing.empty(); ++n) {
    const WorkingSurface surface = swollen_by(-gained, body.cloud(), owing, still, body.node().size,
                                              rules.surface, rules.thresholds.surface.give_back);
    Cloud<3> given = body.cloud();
    for (const NodeIndex i : body.nodes()) given.position[i] = surface.at(i);
    const auto pairs = voronoi::crossings(given, surface.changed_facets(body.cloud()));
    if (pairs.empty()) {
      for (const NodeIndex i : body.nodes()) body.place(i, given.position[i]);
      break;
    }
    for (const auto& pair : pairs)
      for (const CloudFacetIndex f : pair)
        for (const NodeIndex i : given.facets[f].node) still[i] = 1;
    std::erase_if(owing, [&](NodeIndex i) { return still[i] && !body.node().held[i]; });
  }
  body.set_sound(); // as faces of tetrahedra are
}

/// New numbers without those that go, along a space-filling curve when any came or went.
IndexedVector<NodeIndex, NodeIndex> numbers_in_order(const WorkingBody& body,
                                                     const IndexedVector<NodeIndex, char>& gone) {
  IndexedVector<NodeIndex, NodeIndex> number = numbers_without(gone);
  if (!body.came_or_went() && std::find(gone.begin(), gone.end(), 1) == gone.end()) return number;
  std::vector<NodeIndex> left;
  std::vector<Vec3> place;
  for (const NodeIndex i : body.nodes())
    if (exists(number[i])) {
      left.push_back(i);
      place.push_back(body.at(i));
    }
  const std::vector<std::int32_t> order = voronoi::hilbert_order(place);
  for (std::size_t n = 0; n < order.size(); ++n) number[left[index_of(order[n])]] = as<NodeIndex>(n);
  return number;
}

} // namespace

void remove(WorkingBody& body, SpaceStructure& structure, const std::vector<Removal>& list,
            const SpaceRules& rules, PassReport& report) {
  IndexedVector<NodeIndex, char> gone(body.size(), 0);
  for (const Removal& removal : list) gone[removal.gone] = 1;
  WorkingBody left = body;
  IndexedVector<NodeIndex, NodeIndex> number = numbers_in_order(body, gone);
  left.renumber(number);
  const double volume = enclosed_measure(body.cloud());
  voronoi::RecoveredBoundary recovered;
  constexpr int times = 3;
  for (int n = 0; n < times; ++n) {
    recovered = recovered_boundary(left);
    report.flipped += recovered.counts.flipped;
    for (NodeIndex& i : number)
      if (exists(i)) i = recovered.now[i];
    IndexedVector<NodeIndex, char> lost(left.size(), 0);
    for (const NodeIndex i : left.nodes()) lost[i] = !exists(recovered.now[i]);
    left.renumber(numbers_without(lost));
    constexpr double little = 1e-9; // of the body
    const double gained = enclosed_measure(recovered.cloud) - volume;
    if (n + 1 == times || std::abs(gained) < little * volume) break;
    restore_volume(left, recovered.cloud.facets, gained, rules);
  }
  std::vector<Removal> all = list;
  for (const NodeIndex i : body.nodes()) {
    if (exists(number[i])) body.place(i, recovered.cloud.position[number[i]]);
    if (gone[i] || exists(number[i])) continue;
    all.push_back({i, nearest_left(body, number, i)});
    ++report.removed;
  }
  structure = structure_of(recovered.cloud, std::move(recovered.tetrahedra), rules.cells);
  structure.flipped = recovered.flipped;
  body.move(inheritance(body, structure, all, number));
  body.renumber(number);
  body.set_boundary(std::move(recovered.cloud.facets));
  body.set_sound(); // facets are faces of tetrahedra
  endow(body, structure);
}

void endow(WorkingBody& body, const SpaceStructure& structure) {
  constexpr double enough = 0.7; // of its volume
  const NodeProperties& p = body.node();
  std::vector<NodeIndex> poor;
  IndexedVector<NodeIndex, char> is_poor(body.size(), 0);
  for (const NodeIndex i : body.nodes())
    if (p.mass[index_of(i)] == 0.0 ||
        (!exists(body.old_of(i)) && body.node().filled(i) < enough * structure.volume(i))) {
      poor.push_back(i);
      is_poor[i] = 1;
    }
  if (poor.empty()) return;
  const auto giver = [&](NodeIndex i, NodeIndex k) { return !is_poor[k] && body.may_mix(i, k); };
  // what neighbours have too much, shared out by what the poor lack
  Field lack(body.size(), 0.0), claims(body.size(), 0.0), given(body.size(), 0.0);
  for (const NodeIndex i : poor) {
    lack[index_of(i)] = structure.volume(i) - body.node().filled(i);
    for (const NodeIndex k : structure.neighbours(i))
      if (giver(i, k)) claims[index_of(k)] += lack[index_of(i)];
  }
  std::vector<Parcel> parcels;
  for (const NodeIndex i : poor) {
    const double wanted = lack[index_of(i)];
    double offered = 0.0;
    const auto surplus = [&](NodeIndex k) {
      return std::max(0.0, body.node().filled(k) - structure.volume(k)) * wanted / claims[index_of(k)];
    };
    for (const NodeIndex k : structure.neighbours(i))
      if (giver(i, k)) offered += surplus(k);
    const double taken = offered > 0.0 ? std::min(1.0, wanted / offered) : 0.0;
    double all = 0.0;
    for (const NodeIndex k : structure.neighbours(i))
      if (giver(i, k)) all += body.node().filled(k);
    // the rest comes evenly from all
    constexpr double most = 0.2;
    const double rest = all > 0.0 ? std::clamp((enough * wanted - offered) / all, 0.0, most) : 0.0;
    for (const NodeIndex k : structure.neighbours(i)) {
      if (!giver(i, k)) continue;
      const double fraction =
          std::min(taken * surplus(k) / body.node().filled(k) + rest, 0.8 * (1.0 - given[index_of(k)]));
      given[index_of(k)] += fraction;
      if (fraction > 0.0) parcels.push_back({k, i, fraction});
    }
  }
  body.move(parcels);
}

namespace {

/// A pass whose surface has this spacing (m, [node]). sound: whether that of the cloud is known not to cross
/// itself. recut: whether sides of periods are (recut_sides()).
Resampling<3> attempt(const Cloud<3>& cloud, NodeProperties properties, const Field& size,
                      const SpaceRules& rules, bool sound, bool recut, PassReport& report) {
  const SpaceThresholds& limits = rules.thresholds;
  UncrossedSurface first = refine_uncrossed(cloud, properties, size, rules, sound);
  report += first.report;
  WorkingBody body(cloud, std::move(properties));
  const std::size_t old_nodes = body.size();
  for (std::size_t n = 0; n < first.changes.made.size(); ++n) {
    const auto& [a, b] = first.changes.made[n];
    body.insert_between(a, b, first.surface.at(as<NodeIndex>(old_nodes + n)));
  }
  for (const NodeIndex i : body.nodes()) body.place(i, first.surface.at(i));
  body.set_boundary(first.surface.facets());
  if (first.sound) body.set_sound();

  std::vector<Removal> list;
  for (const NodeIndex i : body.nodes())
    if (exists(first.changes.into[i])) list.push_back({i, first.changes.into[i]});
  list = crowded(body, list, limits, report);
  SpaceStructure structure;
  remove(body, structure, list, rules, report);
  if (const int cuts = report.cuts; separate(body, structure, rules.separation, report), report.cuts > cuts)
    remove(body, structure, crowded(body, {}, limits, report), rules, report);
  bool stale = recut && recut_sides(body, structure, rules, report);
  list = stale ? crowded(body, {}, limits, report) : std::vector<Removal>{};
  for (int round = 0; round < limits.rounds; ++round) {
    if (!fill(body, structure, list, rules, report)) break;
    stale = false;
    list.clear();
  }
  if (stale) remove(body, structure, {}, rules, report);
  balance(body, structure, {limits.light, limits.heavy, limits.sweeps}, report);
  Resampling<3> change = body.finish(structure);
  if (change.cloud.simplices.empty()) { // whoever triangulates has to find a way to hold them too
    try {
      voronoi::Tetrahedra mesh = voronoi::triangulate(change.cloud);
      change.cloud.simplices = std::move(mesh.node);
      change.cloud.across = std::move(mesh.neighbour);
    } catch (const GeometryError& error) { tell_places(change.cloud, error); }
  }
  for (const Period& period : rules.periods) shifted_nodes(change.cloud, period); // throws where they are not
  return change;
}

/// Both sides of each period want the same spacing and have the same facets.
void align_periods(Cloud<3>& cloud, std::span<const Period> periods, Field& size) {
  for (const Period& period : periods)
    for (const auto& [a, b] : shifted_nodes(cloud, period))
      size[index_of(a)] = size[index_of(b)] = std::min(size[index_of(a)], size[index_of(b)]);
  repeat_facets(cloud, periods);
}

} // namespace

Resampling<3> resample(const Cloud<3>& present, NodeProperties properties, const SpaceRules& given,
                       PassReport& report) {
  assert(given.periods.empty() || properties.broken.empty());
  Cloud<3> cloud = present;
  SpaceRules rules = given;
  for (const Period& period : rules.periods)
    rules.surface.still.insert(rules.surface.still.end(), period.begin(), period.end());
  align_periods(cloud, rules.periods, properties.size);
  const PeriodImages images(cloud, rules.periods);
  const auto pairs = voronoi::crossings(cloud);
  if (!pairs.empty()) {
    report.crossings += static_cast<int>(pairs.size());
    report.side_crossings +=
        static_cast<int>(std::count_if(pairs.begin(), pairs.end(), [&](const auto& pair) {
          return std::any_of(pair.begin(), pair.end(), [&](CloudFacetIndex f) {
            return rules.surface.is_still(cloud.facets[f].piece);
          });
        }));
    unfold(cloud, properties.held, properties.size, images, rules.surface, report);
  }
  // Where facets are lost the other side of the body is nearer than they are long: they become shorter there,
  // once. More would not end beside crowded creases.
  constexpr int times = 2;
  constexpr double shorter = 0.7, beside = 1.5;
  Field size = properties.size;
  bool recut = true; // but where the cloud has no structure then
  for (int n = 1;;) {
    PassReport tried = report;
    const auto give_up_recut = [&] {
      if (tried.recut == report.recut) return false;
      recut = false;
      ++report.undone;
      return true;
    };
    try {
      Resampling<3> change = attempt(cloud, properties, size, rules, pairs.empty(), recut, tried);
      change.old_position = present.position;
      report = tried;
      report.volume_change += enclosed_measure(change.cloud) - enclosed_measure(present);
      return change;
    } catch (const GeometryError&) {
      if (!give_up_recut()) throw;
    } catch (const NotRecovered& failure) {
      if (give_up_recut()) continue;
      if (n == times) throw GeometryError(failure.message);
      ++report.undone;
      ++n;
      for (const NodeIndex i : cloud.position.indices()) {
        double& h = size[index_of(i)];
        const double reach = beside * h;
        if (std::any_of(failure.places.begin(), failure.places.end(),
                        [&](const Vec3& x) { return (cloud.position[i] - x).squaredNorm() < reach * reach; }))
          h *= shorter;
      }
    }
  }
}

} // namespace cnem::adapt
