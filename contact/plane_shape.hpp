#pragma once
// A tool bounded by a plane: a wall, an anvil.
#include "contact/tool_shape.hpp"

#include <limits>

namespace cnem::contact {

/// The half-space behind a plane: solid where n·(x − point) < 0.
template<int dim> class PlaneShape final : public ToolShape<dim> {
public:
  /// point: m, on the plane; normal: out of the tool, of any length; reach: m, around the point, larger than
  /// the workpiece and its way. Throws InputError for a zero normal and a reach that is not positive.
  PlaneShape(const Vec<dim>& point, const Vec<dim>& normal, double reach);

  SurfacePoint<dim> closest(const Vec<dim>& x) const override;
  void entries(std::span<const Vec<dim>> from, std::span<const Vec<dim>> to,
               std::vector<Entry<dim>>& found) const override;
  const std::vector<Ridge<dim>>& ridges() const override { return ridges_; }
  Box<dim> bounds() const override;
  /// A half-space has no other side.
  double least_thickness() const override { return std::numeric_limits<double>::infinity(); }
  double thickness_along(const Vec<dim>&) const override { return least_thickness(); }
  double passed(const Vec<dim>&, const Vec<dim>&) const override { return 0.0; }

private:
  double distance(const Vec<dim>& x) const { return normal_.dot(x - point_); }

  Vec<dim> point_, normal_;
  double reach_;
  std::vector<Ridge<dim>> ridges_; ///< none
};

extern template class PlaneShape<2>;
extern template class PlaneShape<3>;

} // namespace cnem::contact
