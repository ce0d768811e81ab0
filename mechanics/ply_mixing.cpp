#include "mechanics/ply_mixing.hpp"

#include "core/index.hpp"
#include "plasticity/damage.hpp"
#include "plasticity/log_strain.hpp"
#include "plasticity/ply_update.hpp"
#include "plasticity/return_map.hpp"

#include <Eigen/Dense>
#include <cmath>

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

} // namespace

template<int dim>
PlyDeformation<dim> mixed_plies(const PointRows& parcels, const Field& mass,
                                const std::vector<plasticity::Material>& materials,
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
      double angle = 0.0, total = 0.0;
      for (std::size_t e = first; e < last; ++e) {
        const auto k = index_of(parcels.from[e]);
        const double share = parcels.weight[e] * mass[k];
        const Mat<2> F = earlier_at(point, k);
        stretch += share * twice_log_stretch(F);
        angle += share * angle_of(turn(-near) * F);
        total += share;
      }
      const plasticity::Symmetric<2> U = plasticity::exponential<2>(0.5 / total * stretch);
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

template<int dim> void to_present_thickness(PointState<dim>& point) {
  for (std::size_t p = 0; p < point.thickness.size(); ++p)
    point.inverse_plastic_cauchy_green[2][p] *= point.thickness[p] * point.thickness[p];
}

template<int dim> void to_initial_thickness(PointState<dim>& point) {
  for (std::size_t p = 0; p < point.thickness.size(); ++p)
    point.inverse_plastic_cauchy_green[2][p] /= point.thickness[p] * point.thickness[p];
}

#define CNEM_INSTANTIATE(dim)                                                                                \
  template PlyDeformation<dim> mixed_plies<dim>(                                                             \
      const PointRows&, const Field&, const std::vector<plasticity::Material>&, const PointState<dim>&);     \
  template void set_plies<dim>(const PlyDeformation<dim>&, const Field&, PointState<dim>&);                  \
  template void draw_back_plies<dim>(const PlyDeformation<dim>&, const std::vector<plasticity::Material>&,   \
                                     PointState<dim>&);                                                      \
  template void to_present_thickness<dim>(PointState<dim>&);                                                 \
  template void to_initial_thickness<dim>(PointState<dim>&);
CNEM_INSTANTIATE(2)
CNEM_INSTANTIATE(3)
#undef CNEM_INSTANTIATE

} // namespace cnem
