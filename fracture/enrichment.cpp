#include "fracture/enrichment.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "voronoi/plane/circumcircles.hpp"
#include "voronoi/plane/triangulation.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace cnem::fracture {

namespace {

/// Gauss-Legendre points and weights on [0, 1].
struct LineRule {
  std::vector<double> x, w;
};

template<unsigned n> LineRule line_rule() {
  using Rule = boost::math::quadrature::gauss<double, n>;
  LineRule rule;
  for (std::size_t k = 0; k < Rule::abscissa().size(); ++k)
    for (const double sign : {-1.0, 1.0}) {
      const double x = Rule::abscissa()[k];
      if (x == 0.0 && sign > 0.0) continue;
      rule.x.push_back(0.5 + 0.5 * sign * x);
      rule.w.push_back(0.5 * Rule::weights()[k]);
    }
  return rule;
}

struct QuadraturePoint {
  Vec2 position;
  double weight; ///< m²
};

/// The functions ψ of one node at a point of a facet that ends there, where φ is linear.
std::array<double, branch_count> on_facet(const EnrichedOperators::Function& function, const FacetLoad& facet,
                                          const FacetPoint& point) {
  const double phi = facet.node[0] == function.node ? 1.0 - point.s : point.s;
  auto psi = branch(point.r, point.theta);
  for (std::size_t k = 0; k < branch_count; ++k) psi[k] = phi * (psi[k] - function.shift[k]);
  return psi;
}

/// Points on the triangles between the node and the edges of its cell, collapsed towards the node. With
/// `at_tip` the radius goes with the square of its parameter, which takes out the singularity there.
std::vector<QuadraturePoint> fan(const CellGeometry<2>& cells, std::size_t cell, const Vec2& apex,
                                 bool at_tip, const LineRule& rule) {
  std::vector<QuadraturePoint> points;
  const auto first = index_of(cells.begin[cell]), last = index_of(cells.begin[cell + 1]);
  for (std::size_t k = first; k < last; ++k) {
    const Vec2& a = cells.vertex[index_of(cells.index[k])];
    const Vec2& b = cells.vertex[index_of(cells.index[k + 1 < last ? k + 1 : first])];
    const double twice_area = cross(a - apex, b - apex);
    if (std::abs(twice_area) < 1e-14 * ((a - apex).squaredNorm() + (b - apex).squaredNorm())) continue;
    for (std::size_t i = 0; i < rule.x.size(); ++i) {
      const double rho = at_tip ? rule.x[i] * rule.x[i] : rule.x[i];
      const double radial = rule.w[i] * rho * (at_tip ? 2.0 * rule.x[i] : 1.0);
      for (std::size_t j = 0; j < rule.x.size(); ++j)
        points.push_back({apex + rho * (a + rule.x[j] * (b - a) - apex), twice_area * radial * rule.w[j]});
    }
  }
  return points;
}

/// Which functions enrich, and where they are felt.
struct Layout {
  std::vector<std::vector<EnrichedOperators::Function>> of_node; ///< [node]
  std::vector<bool> enriched;       ///< [cell] where an enrichment function may be felt
  std::vector<double> tip_distance; ///< [cell] to the nearest tip, in its spacings
  std::int32_t columns = 0;
};

Layout lay_out(const Cloud<2>& cloud, const Approximation<2>& base, const std::vector<CrackTip>& tips,
               const std::vector<double>& radius) {
  const auto nodes = index_of(cloud.nodes());
  Layout layout;
  layout.of_node.resize(nodes);
  layout.enriched.assign(nodes, false);
  layout.tip_distance.assign(nodes, 1e9);
  layout.columns = cloud.nodes();
  for (const NodeIndex i : cloud.position.indices())
    for (std::size_t t = 0; t < tips.size(); ++t) {
      const Vec2& x = cloud.position[i];
      const double r = (x - tips[t].position).norm();
      layout.tip_distance[index_of(i)] = std::min(layout.tip_distance[index_of(i)], r / tips[t].spacing);
      if (r > radius[t] || radius[t] <= 0.0) continue;
      layout.of_node[index_of(i)].push_back({i, t, branch(r, tips[t].angle_of_node(i, x)), layout.columns});
      layout.columns += static_cast<std::int32_t>(branch_count);
      layout.enriched[index_of(i)] = true;
    }
  // φ_J is felt in the cells of its neighbours and may reach into those of theirs.
  for (int ring = 0; ring < 2; ++ring) {
    std::vector<bool> wider = layout.enriched;
    for (std::size_t i = 0; i < nodes; ++i)
      if (layout.enriched[i])
        for (auto l = index_of(base.links.begin[i]); l < index_of(base.links.begin[i + 1]); ++l)
          wider[index_of(base.links.neighbour[l])] = true;
    layout.enriched = std::move(wider);
  }
  return layout;
}

/// Rows in the making.
struct Rows {
  EnrichedOperators& result;
  DiscreteOperators<2>& op = result.operators;

  void entry(NodeIndex column, double value, const Vec2& b) {
    op.node.push_back(column);
    op.value.push_back(value);
    op.gradient[0].push_back(b.x());
    op.gradient[1].push_back(b.y());
  }
  void close(std::int32_t cell, double volume, const Vec2& position) {
    op.volume.push_back(volume);
    op.row_begin.push_back(static_cast<std::int32_t>(op.node.size()));
    result.position.push_back(position);
    result.cell.push_back(cell);
    ++op.points;
  }
};

Vec2 centroid(const CellGeometry<2>& cells, std::size_t cell) {
  const auto first = index_of(cells.begin[cell]), last = index_of(cells.begin[cell + 1]);
  const Vec2 origin = cells.vertex[index_of(cells.index[first])];
  double twice_area = 0.0;
  Vec2 moment = Vec2::Zero();
  for (std::size_t k = first; k < last; ++k) {
    const Vec2 a = cells.vertex[index_of(cells.index[k])] - origin;
    const Vec2 b = cells.vertex[index_of(cells.index[k + 1 < last ? k + 1 : first])] - origin;
    twice_area += cross(a, b);
    moment += cross(a, b) * (a + b) / 3.0;
  }
  return origin + moment / twice_area;
}

/// Functions and gradients at the points of one cell.
struct Sample {
  QuadraturePoint point;
  std::vector<NodeIndex> node;
  std::vector<double> value;
  std::vector<Vec2> gradient;
};

void integrate_cell(const Approximation<2>& base, const std::vector<CrackTip>& tips, const Layout& layout,
                    std::size_t cell, const std::vector<QuadraturePoint>& points,
                    voronoi::NaturalNeighbours& neighbours, voronoi::Functions functions, SimplexIndex hint,
                    Rows& rows) {
  const DiscreteOperators<2>& op = base.mechanics;
  double area = 0.0;
  for (const QuadraturePoint& point : points) area += point.weight;
  const double to_volume = op.volume[cell] / area;
  std::vector<Sample> samples;
  std::map<NodeIndex, Vec2> correction; // V b − ∫ ∇φ, then per volume
  for (auto e = index_of(op.row_begin[cell]); e < index_of(op.row_begin[cell + 1]); ++e)
    correction[op.node[e]] = op.volume[cell] * Vec2(op.gradient[0][e], op.gradient[1][e]);
  for (QuadraturePoint point : points) {
    point.weight *= to_volume;
    neighbours.evaluate_with_gradients(functions, point.position, hint);
    Sample& sample = samples.emplace_back();
    sample.point = point;
    sample.node.assign(neighbours.nodes().begin(), neighbours.nodes().end());
    sample.value.assign(neighbours.values().begin(), neighbours.values().end());
    sample.gradient.assign(neighbours.gradients().begin(), neighbours.gradients().end());
    for (std::size_t k = 0; k < sample.node.size(); ++k) {
      const auto [entry, fresh] = correction.try_emplace(sample.node[k], Vec2::Zero());
      entry->second -= point.weight * sample.gradient[k];
    }
  }
  for (auto& [node, sum] : correction) sum /= op.volume[cell];

  for (const Sample& sample : samples) {
    std::map<NodeIndex, std::pair<double, Vec2>> phi;
    for (const auto& [node, constant] : correction) phi[node] = {0.0, constant};
    for (std::size_t k = 0; k < sample.node.size(); ++k) {
      phi[sample.node[k]].first = sample.value[k];
      phi[sample.node[k]].second += sample.gradient[k];
    }
    for (const auto& [node, f] : phi) rows.entry(node, f.first, f.second);
    for (std::size_t j = 0; j < sample.node.size(); ++j)
      for (const auto& function : layout.of_node[index_of(sample.node[j])]) {
        const CrackTip& tip = tips[function.tip];
        const double r = (sample.point.position - tip.position).norm();
        const double theta = tip.angle(sample.point.position);
        const auto F = branch(r, theta);
        const auto dF = branch_gradient(r, theta);
        for (std::size_t k = 0; k < branch_count; ++k) {
          const Vec2 slope = dF[k].x() * tip.direction + dF[k].y() * left_normal(tip.direction);
          const double shifted = F[k] - function.shift[k];
          rows.entry(as<NodeIndex>(index_of(function.column) + k), sample.value[j] * shifted,
                     sample.gradient[j] * shifted + sample.value[j] * slope);
        }
      }
    rows.close(static_cast<std::int32_t>(cell), sample.point.weight, sample.point.position);
  }
}

/// Moves the gradients of each function ψ that enriches by a constant on its support, so that ∫ ∇ψ dA = ∮ ψ n
/// dΓ: quadrature leaves them off, and then a uniform stress acts on ψ (variational consistency, Chen,
/// Hillman and Rüter 2013).
void make_consistent(const Cloud<2>& cloud, const std::vector<CrackTip>& tips,
                     const std::vector<EnrichedOperators::Function>& functions, DiscreteOperators<2>& op) {
  const auto first = index_of(cloud.nodes()), count = index_of(op.nodes) - first;
  std::vector<Vec2> defect(count, Vec2::Zero());
  for (const auto& function : functions)
    for (const Facet<2>& facet : cloud.facets) {
      if (facet.node[0] != function.node && facet.node[1] != function.node) continue;
      const Vec2 &a = cloud.position[facet.node[0]], &b = cloud.position[facet.node[1]];
      const Vec2 outward = -left_normal(b - a).normalized();
      const FacetLoad load{facet.node, a, b, outward};
      for (const FacetPoint& point : facet_points(tips[function.tip], load)) {
        const auto psi = on_facet(function, load, point);
        for (std::size_t k = 0; k < branch_count; ++k)
          defect[index_of(function.column) + k - first] += point.weight * psi[k] * outward;
      }
    }
  std::vector<double> area(count, 0.0);
  const auto each_entry = [&](auto&& act) {
    for (std::size_t p = 0; p < index_of(op.points); ++p)
      for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e)
        if (index_of(op.node[e]) >= first) act(p, e, index_of(op.node[e]) - first);
  };
  each_entry([&](std::size_t p, std::size_t e, std::size_t a) {
    area[a] += op.volume[p];
    defect[a] -= op.volume[p] * Vec2(op.gradient[0][e], op.gradient[1][e]);
  });
  each_entry([&](std::size_t, std::size_t e, std::size_t a) {
    op.gradient[0][e] += defect[a].x() / area[a];
    op.gradient[1][e] += defect[a].y() / area[a];
  });
}

} // namespace

EnrichedOperators enrich(const Cloud<2>& cloud, const Approximation<2>& base,
                         const std::vector<CrackTip>& tips, const std::vector<double>& radius,
                         voronoi::Functions functions) {
  EnrichedOperators result;
  const bool wanted = std::any_of(radius.begin(), radius.end(), [](double r) { return r > 0.0; });
  if (!wanted) {
    result.operators = base.mechanics;
    result.links = base.links;
    for (std::size_t p = 0; p < index_of(base.mechanics.points); ++p) {
      result.position.push_back(centroid(base.cells, p));
      result.cell.push_back(static_cast<std::int32_t>(p));
    }
    return result;
  }
  if (!base.mechanics.nodal)
    throw InputError("enrichment needs natural-neighbour functions: expected method.name = \"cnem\"");
  const Layout layout = lay_out(cloud, base, tips, radius);
  const auto mesh = voronoi::triangulate(cloud);
  const auto circles = voronoi::circumcircles(cloud, mesh);
  voronoi::NaturalNeighbours neighbours(cloud, mesh, circles);
  const LineRule tip_rule = line_rule<12>(), enriched_rule = line_rule<5>(), plain_rule = line_rule<2>();
  constexpr double near = 2.2; // spacings of the tip

  Rows rows{result};
  DiscreteOperators<2>& op = result.operators;
  op.nodes = layout.columns;
  op.row_begin.push_back(0);
  for (std::size_t i = 0; i < index_of(cloud.nodes()); ++i) {
    const bool at_tip = std::any_of(tips.begin(), tips.end(),
                                    [&](const CrackTip& tip) { return tip.node == as<NodeIndex>(i); });
    try {
      integrate_cell(base, tips, layout, i,
                     fan(base.cells, i, cloud.position[i], at_tip,
                         layout.tip_distance[i] < near ? tip_rule
                         : layout.enriched[i]          ? enriched_rule
                                                       : plain_rule),
                     neighbours, functions, mesh.triangle_of_node[i], rows);
    } catch (const GeometryError& error) {
      throw GeometryError(fmt::format("the cell of the node at ({:g}, {:g}) m near a crack tip cannot be "
                                      "integrated ({}): refine the cloud there or leave enrichment out",
                                      cloud.position[i].x(), cloud.position[i].y(), error.what()));
    }
  }
  for (const auto& list : layout.of_node)
    result.functions.insert(result.functions.end(), list.begin(), list.end());
  make_consistent(cloud, tips, result.functions, op);
  op.build_transpose();
  result.links.begin.assign(index_of(cloud.nodes()) + 1, 0);
  return result;
}

int EnrichedOperators::enriched_nodes() const {
  std::set<NodeIndex> nodes;
  for (const Function& function : functions) nodes.insert(function.node);
  return static_cast<int>(nodes.size());
}

Fields<2> forces_on_functions(const EnrichedOperators& enriched, const std::vector<CrackTip>& tips,
                              const Fields<2>& nodal, const std::vector<FacetLoad>& loads,
                              const Vec2& body_force) {
  const DiscreteOperators<2>& op = enriched.operators;
  Fields<2> force = nodal;
  for (Field& component : force) component.resize(index_of(op.nodes), 0.0);
  const auto add = [&](std::int32_t column, const Vec2& f) {
    force[0][index_of(column)] += f.x();
    force[1][index_of(column)] += f.y();
  };
  for (const EnrichedOperators::Function& function : enriched.functions) {
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(branch_count); ++k) {
      const auto a = index_of(function.column + k);
      double integral = 0.0;
      for (auto e = index_of(op.col_begin[a]); e < index_of(op.col_begin[a + 1]); ++e)
        integral += op.weighted_value[e];
      add(function.column + k, integral * body_force);
    }
    for (const FacetLoad& load : loads) {
      if (load.node[0] != function.node && load.node[1] != function.node) continue;
      for (const FacetPoint& point : facet_points(tips[function.tip], load)) {
        const auto psi = on_facet(function, load, point);
        for (std::size_t k = 0; k < branch_count; ++k)
          add(function.column + static_cast<std::int32_t>(k), point.weight * psi[k] * load.traction);
      }
    }
  }
  return force;
}

} // namespace cnem::fracture
