#include "fracture/interaction_integral.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::fracture {

namespace {

double plateau(const Ring& ring, double r) {
  return std::clamp((ring.outer - r) / (ring.outer - ring.inner), 0.0, 1.0);
}

/// ∫ t·u^a_,1 q dΓ on one facet.
double facet_integral(const CrackTip& tip, const Ring& ring, const PlaneElasticity& elasticity, int mode,
                      const FacetLoad& load, const Mat2& to_frame) {
  const Vec2 t = to_frame * load.traction;
  // q is nodal and linear along the boundary, here as in the domain.
  const double q_from = plateau(ring, (load.from - tip.position).norm()),
               q_to = plateau(ring, (load.to - tip.position).norm());
  double sum = 0.0;
  for (const FacetPoint& point : facet_points(tip, load))
    sum += point.weight * ((1.0 - point.s) * q_from + point.s * q_to) *
           t.dot(tip_field(mode, elasticity, point.r, point.theta).gradient.col(0));
  return sum;
}

} // namespace

StressIntensity stress_intensity(const CrackTip& tip, const Ring& ring, const PlaneElasticity& elasticity,
                                 const ElasticField& field, const std::vector<FacetLoad>& loads) {
  const DiscreteOperators<2>& op = field.operators;
  Mat2 to_frame;
  to_frame.row(0) = tip.direction.transpose();
  to_frame.row(1) = left_normal(tip.direction).transpose();
  std::vector<double> q(field.node.size());
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = plateau(ring, (field.node[i] - tip.position).norm());

  std::array<double, 2> sum{0.0, 0.0};
  for (std::size_t p = 0; p < index_of(op.points); ++p) {
    Vec2 dq = Vec2::Zero();
    bool touched = false;
    for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
      const auto i = index_of(op.node[e]);
      if (i >= q.size() || q[i] == 0.0) continue;
      touched = true;
      dq += q[i] * Vec2(op.gradient[0][e], op.gradient[1][e]);
    }
    if (!touched || dq.squaredNorm() == 0.0) continue;
    const Vec2 slope = to_frame * dq;
    Mat2 gradient, stress;
    gradient << field.gradient[0][p], field.gradient[1][p], field.gradient[2][p], field.gradient[3][p];
    stress << field.stress[0][p], field.stress[3][p], field.stress[3][p], field.stress[1][p];
    gradient = to_frame * gradient * to_frame.transpose();
    stress = to_frame * stress * to_frame.transpose();
    const double r = (field.position[p] - tip.position).norm(), theta = tip.angle(field.position[p]);
    if (r == 0.0) continue;
    for (int mode = 0; mode < 2; ++mode) {
      const TipField unit = tip_field(mode, elasticity, r, theta);
      const Vec2 flow = stress * unit.gradient.col(0) + unit.stress * gradient.col(0);
      const double mixed = unit.stress.cwiseProduct(gradient).sum();
      sum[index_of(mode)] += op.volume[p] * (flow.dot(slope) - mixed * slope.x());
    }
  }
  for (const FacetLoad& load : loads) {
    const double nearest = std::min((load.from - tip.position).norm(), (load.to - tip.position).norm());
    if (nearest >= ring.outer || load.traction.squaredNorm() == 0.0) continue;
    for (int mode = 0; mode < 2; ++mode)
      sum[index_of(mode)] -= facet_integral(tip, ring, elasticity, mode, load, to_frame);
  }
  return {0.5 * elasticity.effective * sum[0], 0.5 * elasticity.effective * sum[1]};
}

std::vector<Ring> default_rings(const CrackTip& tip) {
  const double room = std::min({tip.half_length, tip.straight, tip.clearance});
  std::vector<Ring> rings;
  for (const double factor : {0.55, 0.7, 0.85, 1.0})
    rings.push_back({0.5 * factor * 0.7 * room, factor * 0.7 * room});
  return rings;
}

} // namespace cnem::fracture
