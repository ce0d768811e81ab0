#include "contact/plane_shape.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::contact {

template<int dim>
PlaneShape<dim>::PlaneShape(const Vec<dim>& point, const Vec<dim>& normal, double reach)
    : point_(point), normal_(normal), reach_(reach) {
  if (!(normal.stableNorm() > 0.0))
    throw InputError(
        fmt::format("a plane needs a normal, got ({:g})", fmt::join(normal.begin(), normal.end(), ", ")));
  if (!(reach > 0.0)) throw InputError(fmt::format("a plane needs a reach, got {:g} m", reach));
  normal_.stableNormalize();
}

template<int dim> SurfacePoint<dim> PlaneShape<dim>::closest(const Vec<dim>& x) const {
  const double d = distance(x);
  return {d, normal_, x - d * normal_, 0};
}

template<int dim>
void PlaneShape<dim>::entries(std::span<const Vec<dim>> from, std::span<const Vec<dim>> to,
                              std::vector<Entry<dim>>& found) const {
  for (std::size_t i = 0; i < to.size(); ++i)
    if (distance(to[i]) < 0.0)
      found.push_back({static_cast<std::int32_t>(i), closest(to[i]), distance(from[i])});
}

template<int dim> Box<dim> PlaneShape<dim>::bounds() const {
  return {point_ - Vec<dim>::Constant(reach_), point_ + Vec<dim>::Constant(reach_)};
}

template class PlaneShape<2>;
template class PlaneShape<3>;

} // namespace cnem::contact
