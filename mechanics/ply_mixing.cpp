#include "mechanics/ply_mixing.hpp"

#include "core/index.hpp"
#include "plasticity/damage.hpp"
#include "plasticity/log_strain.hpp"
#include "plasticity/ply_update.hpp"
#include "plasticity/return_map.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace cnem {

namespace {

Mat<2> earlier_at(const PointState<2>& point, std::size_t p) {
  const auto& field = point.earlier_deformation;
  return (Mat<2>() << field[0][p], field[1][p], field[2][p], field[3][p]).finished();
}

Mat<2> turn(double angle) { return Eigen::Rotation2Dd(angle).toRotationMatrix(); }

/// Of the rotation R of F = R U.
double angle_of(const Mat<2>& F) { return std::atan2(F(1, 0) - F(0, 1), F(0, 0) + F(1, 1)); }

/// 2 ln U.
plasticity::Symmetric<2> twice_log_stretch(const Mat<2>& F) {
  const Mat<2> C = F.transpose() * F;
  return plasticity::logarithm<2>({C(0, 0), C(1, 1), 1.0, C(0, 1)});
}

/// ε11, ε22, γ12 in the axes of a ply from 2 ln U, and back.
std::array<double, 3> in_axes(const plasticity::Symmetric<2>& twice, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double xx = 0.5 * twice[0], yy = 0.5 * twice[1], xy = 0.5 * twice[3];
  return {c * c * xx + s * s * yy + 2.0 * c * s * xy, s * s * xx + c * c * yy - 2.0 * c * s * xy,
          2.0 * (c * s * (yy - xx) + (c * c - s * s) * xy)};
}
plasticity::Symmetric<2> twice_from_axes(const std::array<double, 3>& e, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {2.0 * (c * c * e[0] + s * s * e[1] - c * s * e[2]),
          2.0 * (s * s * e[0] + c * c * e[1] + c * s * e[2]), 0.0,
          2.0 * c * s * (e[0] - e[1]) + (c * c - s * s) * e[2]};
}

/// Mean of 2 ln U in which each component of the strain counts as much as its parcel resists it: the gap of
/// broken matter does not come to bear on sound matter, and the mean stores no more than the parcels did.
class HeldStretch {
public:
  HeldStretch(const plasticity::Material& material, bool plane_stress)
      : elastic_(plasticity::ply_constants(*material.ply, plane_stress)), angle_(material.ply->angle) {}

  void add(double share, const plasticity::Symmetric<2>& twice, const PointState<2>& point, std::size_t p) {
    const std::array<double, 3> strain = in_axes(twice, angle_);
    double damage[plasticity::ply_modes];
    for (std::size_t mode = 0; mode < plasticity::ply_modes; ++mode)
      damage[mode] = 1.0 - point.ply_left[mode][p];
    const plasticity::PlyShares left =
        plasticity::damaged_stress(elastic_, {strain[0], strain[1], strain[2]}, damage).left;
    const double held[] = {share * left.fibre, share * left.matrix, share * left.shear};
    for (std::size_t k = 0; k < 3; ++k) sum_[k] += held[k] * strain[k], weight_[k] += held[k];
  }
  plasticity::Symmetric<2> half_mean() const {
    return 0.5 * twice_from_axes({sum_[0] / weight_[0], sum_[1] / weight_[1], sum_[2] / weight_[2]}, angle_);
  }

private:
  plasticity::PlyConstants elastic_;
  double angle_;
  std::array<double, 3> sum_{}, weight_{};
};

bool damaged(const PointState<2>& point, std::size_t p) {
  return point.failing.on() && std::any_of(point.ply_left.begin(), point.ply_left.end(),
                                           [p](const Field& left) { return left[p] < 1.0; });
}

} // namespace

template<int dim>
PlyDeformation<dim> mixed_plies(const PointRows& parcels, const Field& mass,
                                const std::vector<plasticity::Material>& materials, bool plane_stress,
                                const PointState<dim>& point) {
  PlyDeformation<dim> plies;
  if constexpr (dim == 2) {
    if (!point.fibrous.on()) return plies;
    for (std::size_t p = 0; p < parcels.size(); ++p) {
      const auto first = index_of(parcels.begin[p]), last = index_of(parcels.begin[p + 1]);
      if (first == last || !materials[index_of(point.material[index_of(parcels.from[first])])].ply) continue;
      const Mat<2> start = earlier_at(point, index_of(parcels.from[first]));
      if (last - first == 1) {
        plies.emplace_back(p, start);
        continue;
      }
      const double near = angle_of(start); // turns are counted from this one, which may be any number of them
      plasticity::Symmetric<2> stretch = plasticity::Symmetric<2>::Zero();
      HeldStretch held(materials[index_of(point.material[index_of(parcels.from[first])])], plane_stress);
      bool broken = false;
      double angle = 0.0, total = 0.0;
      for (std::size_t e = first; e < last; ++e) {
        const auto k = index_of(parcels.from[e]);
        const double share = parcels.weight[e] * mass[k];
        const Mat<2> F = earlier_at(point, k);
        const plasticity::Symmetric<2> twice = twice_log_stretch(F);
        stretch += share * twice;
        if (point.failing.on()) held.add(share, twice, point, k);
        broken = broken || damaged(point, k);
        angle += share * angle_of(turn(-near) * F);
        total += share;
      }
      const plasticity::Symmetric<2> U =
          plasticity::exponential<2>(broken ? held.half_mean() : 0.5 / total * stretch);
      plies.emplace_back(p, turn(near + angle / total) * (Mat<2>() << U[0], U[3], U[3], U[1]).finished());
    }
  }
  return plies;
}

template<int dim>
void set_plies(const PlyDeformation<dim>& plies, const Field& elastic_volume, PointState<dim>& point) {
  for (const auto& [p, mean] : plies) {
    const double scale = elastic_volume.empty() ? 1.0 : std::sqrt(elastic_volume[p] / mean.determinant());
    const Mat<2> F = scale * mean;
    const Mat<2> b = F * F.transpose();
    const double whole[] = {F(0, 0), F(0, 1), F(1, 0), F(1, 1), 1.0};
    const double elastic[] = {b(0, 0), b(1, 1), 1.0, b(0, 1)};
    for (std::size_t k = 0; k < 5; ++k) point.earlier_deformation[k][p] = whole[k];
    for (std::size_t k = 0; k < 4; ++k) point.inverse_plastic_cauchy_green[k][p] = elastic[k];
  }
}

template<int dim>
void draw_back_plies(const PlyDeformation<dim>& plies, const std::vector<plasticity::Material>& materials,
                     PointState<dim>& point) {
  if constexpr (dim == 2) {
    if (!point.flowing.on()) return;
    const plasticity::StressPoints<2> points = plasticity::stress_points(point);
    for (const auto& [p, mean] : plies) {
      const plasticity::Material& material = materials[index_of(point.material[p])];
      if (!material.hardening) continue;
      const double share = material.damage ? plasticity::flow_share<2>(material, point, p, 0.0) : 1.0;
      plasticity::draw_back(material, points, static_cast<std::ptrdiff_t>(p), share * point.strength[p]);
    }
  }
}

template<int dim>
void let_go_of_shear(const std::vector<plasticity::Material>& materials, PointState<dim>& point) {
  if constexpr (dim == 2) {
    if (!point.flowing.on() || !point.damaged.on()) return;
    PlyDeformation<2> loose;
    for (std::size_t p = 0; p < point.size(); ++p) {
      const std::optional<plasticity::Orthotropic>& ply = materials[index_of(point.material[p])].ply;
      if (!ply || ply->measure != plasticity::StrainMeasure::logarithmic || point.softening[p] < 1.0)
        continue;
      const Mat<2> before = earlier_at(point, p);
      const double along = point.fibre_angle[p] - ply->angle;
      const Mat<2> after = std::sqrt(before.determinant()) * turn(along);
      const std::array<double, 3> had = in_axes(twice_log_stretch(before), ply->angle),
                                  has = in_axes(twice_log_stretch(after), ply->angle);
      for (std::size_t k = 0; k < 3; ++k) point.ply_flow[k][p] += has[k] - had[k];
      loose.emplace_back(p, after);
    }
    set_plies(loose, {}, point);
  }
}

template<int dim> void to_present_thickness(PointState<dim>& point) {
  for (std::size_t p = 0; p < point.thickness.size(); ++p)
    point.inverse_plastic_cauchy_green[2][p] *= point.thickness[p] * point.thickness[p];
}

template<int dim> void to_initial_thickness(PointState<dim>& point) {
  for (std::size_t p = 0; p < point.thickness.size(); ++p)
    point.inverse_plastic_cauchy_green[2][p] /= point.thickness[p] * point.thickness[p];
}

#define CNEM_INSTANTIATE(dim)                                                                                \
  template PlyDeformation<dim> mixed_plies<dim>(const PointRows&, const Field&,                              \
                                                const std::vector<plasticity::Material>&, bool,              \
                                                const PointState<dim>&);                                     \
  template void set_plies<dim>(const PlyDeformation<dim>&, const Field&, PointState<dim>&);                  \
  template void draw_back_plies<dim>(const PlyDeformation<dim>&, const std::vector<plasticity::Material>&,   \
                                     PointState<dim>&);                                                      \
  template void let_go_of_shear<dim>(const std::vector<plasticity::Material>&, PointState<dim>&);            \
  template void to_present_thickness<dim>(PointState<dim>&);                                                 \
  template void to_initial_thickness<dim>(PointState<dim>&);
CNEM_INSTANTIATE(2)
CNEM_INSTANTIATE(3)
#undef CNEM_INSTANTIATE

} // namespace cnem
