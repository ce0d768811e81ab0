#include "machining/orthogonal_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem::machining {

namespace {

constexpr double unit = 1e-3; ///< m, h1 of Kienzle

bool close(double a, double b) { return std::abs(a - b) <= 0.01 * std::max(std::abs(a), std::abs(b)); }
bool same_rake(double a, double b) { return std::abs(a - b) < 0.1 * std::numbers::pi / 180.0; }

/// Columns of cuts for a fit.
struct Columns {
  std::vector<double> h, force, error;
};
Columns columns(const std::vector<OrthogonalCut>& cuts, Estimate OrthogonalCut::*which) {
  Columns list;
  for (const OrthogonalCut& cut : cuts) {
    list.h.push_back(cut.thickness);
    list.force.push_back((cut.*which).value);
    list.error.push_back((cut.*which).error);
  }
  return list;
}

/// K, m of forces of one sign; none where they do not grow with h.
std::optional<PowerFit> fit_power(const std::vector<OrthogonalCut>& cuts, Estimate OrthogonalCut::*which) {
  Columns list = columns(cuts, which);
  const double sign = list.force.front() < 0.0 ? -1.0 : 1.0;
  std::vector<double> x, y, error;
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    const double force = sign * list.force[k];
    if (!(force > 0.0)) return std::nullopt;
    x.push_back(std::log(list.h[k] / unit));
    y.push_back(std::log(force / unit));
    error.push_back(list.error[k] / force);
  }
  LineFit line = fit_line(x, y, error);
  if (!(line.slope.value > 0.0)) return std::nullopt;
  if (line.slope.value > 1.0) { // the law knows no pressure that grows with h: m = 0
    for (std::size_t k = 0; k < y.size(); ++k) y[k] -= x[k];
    line = LineFit{.intercept = weighted_mean(y, error), .slope = {1.0, std::nan("")}, .residual = {}};
  }
  PowerFit fit;
  const double pressure = std::exp(line.intercept.value);
  fit.pressure = {sign * pressure, pressure * line.intercept.error};
  fit.exponent = {1.0 - line.slope.value, line.slope.error};
  double mean = 0.0, squares = 0.0, about_mean = 0.0;
  for (const double force : list.force) mean += force / static_cast<double>(cuts.size());
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    fit.residual.push_back(list.force[k] -
                           fit.pressure.value * unit * std::pow(list.h[k] / unit, line.slope.value));
    squares += fit.residual[k] * fit.residual[k];
    about_mean += (list.force[k] - mean) * (list.force[k] - mean);
  }
  if (about_mean > 0.0) fit.r_squared = 1.0 - squares / about_mean;
  return fit;
}

} // namespace

LinearFit fit_linear(const std::vector<OrthogonalCut>& cuts) {
  LinearFit fit;
  const Columns tangential = columns(cuts, &OrthogonalCut::tangential),
                radial = columns(cuts, &OrthogonalCut::radial);
  fit.tangential = fit_line(tangential.h, tangential.force, tangential.error);
  fit.radial = fit_line(radial.h, radial.force, radial.error);
  // An edge that pulls is none: the law has no such force.
  if (fit.tangential.intercept.value < 0.0) {
    fit.no_edge_force = true;
    fit.tangential = fit_line(tangential.h, tangential.force, tangential.error, true);
  }
  return fit;
}

std::optional<KienzleFit> fit_kienzle(const std::vector<OrthogonalCut>& cuts) {
  const std::optional<PowerFit> tangential = fit_power(cuts, &OrthogonalCut::tangential);
  if (!tangential || tangential->pressure.value < 0.0) return std::nullopt;
  return KienzleFit{*tangential, fit_power(cuts, &OrthogonalCut::radial)};
}

std::optional<ShearPlaneFit> fit_shear_plane(const std::vector<OrthogonalCut>& cuts,
                                             const LinearFit& linear) {
  std::vector<double> ratio;
  for (const OrthogonalCut& cut : cuts)
    if (cut.chip_thickness > 0.0) ratio.push_back(cut.thickness / cut.chip_thickness);
  if (ratio.empty()) return std::nullopt;
  const double rake = cuts.front().rake, c = std::cos(rake), s = std::sin(rake);
  ShearPlaneFit fit;
  fit.chip_ratio = weighted_mean(ratio, std::vector<double>(ratio.size(), 0.0));
  const double r = fit.chip_ratio.value, along = 1.0 - r * s;
  const double phi = std::atan2(r * c, along);
  // dφ/dr = cos α/((1 − r sin α)² + (r cos α)²)
  fit.shear_angle = {phi, fit.chip_ratio.error * c / (along * along + r * r * c * c)};
  const Estimate kt = linear.tangential.slope, kr = linear.radial.slope;
  if (!(kt.value > 0.0)) return std::nullopt;
  const double square = kt.value * kt.value + kr.value * kr.value;
  fit.friction_angle = {rake + std::atan2(kr.value, kt.value),
                        std::hypot(kt.value * kr.error, kr.value * kt.error) / square};
  const double sp = std::sin(phi), cp = std::cos(phi);
  fit.shear_stress.value = (kt.value * cp - kr.value * sp) * sp;
  const double by_angle = kt.value * std::cos(2.0 * phi) - kr.value * std::sin(2.0 * phi);
  fit.shear_stress.error =
      std::hypot(cp * sp * kt.error, sp * sp * kr.error, by_angle * fit.shear_angle.error);
  if (!(fit.shear_stress.value > 0.0)) return std::nullopt;
  return fit;
}

std::vector<double> CutGroup::thicknesses() const {
  std::vector<double> list;
  for (const OrthogonalCut& cut : cuts)
    if (list.empty() || !close(list.back(), cut.thickness)) list.push_back(cut.thickness);
  return list;
}

std::vector<CutGroup> groups_of(std::vector<OrthogonalCut> cuts) {
  std::vector<CutGroup> groups;
  const auto parted = [](std::vector<OrthogonalCut> list, double OrthogonalCut::*by, const auto& same) {
    std::stable_sort(list.begin(), list.end(),
                     [&](const OrthogonalCut& a, const OrthogonalCut& b) { return a.*by < b.*by; });
    std::vector<std::vector<OrthogonalCut>> parts;
    for (OrthogonalCut& cut : list) {
      if (parts.empty() || !same(parts.back().front().*by, cut.*by)) parts.emplace_back();
      parts.back().push_back(std::move(cut));
    }
    return parts;
  };
  for (std::vector<OrthogonalCut>& of_rake : parted(std::move(cuts), &OrthogonalCut::rake, same_rake))
    for (std::vector<OrthogonalCut>& one : parted(std::move(of_rake), &OrthogonalCut::speed, close)) {
      std::stable_sort(one.begin(), one.end(), [](const OrthogonalCut& a, const OrthogonalCut& b) {
        return a.thickness < b.thickness;
      });
      groups.push_back({one.front().rake, one.front().speed, std::move(one)});
    }
  return groups;
}

std::optional<CutTable> table_of(const std::vector<CutGroup>& groups) {
  if (groups.empty()) return std::nullopt;
  CutTable table;
  table.thickness = groups.front().thicknesses();
  for (const CutGroup& group : groups) {
    if (table.rake.empty() || !same_rake(table.rake.back(), group.rake)) table.rake.push_back(group.rake);
    if (same_rake(group.rake, table.rake.front())) table.speed.push_back(group.speed);
  }
  if (groups.size() != table.rake.size() * table.speed.size()) return std::nullopt;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const CutGroup& group = groups[g];
    const std::vector<double> there = group.thicknesses();
    if (!close(group.speed, table.speed[g % table.speed.size()]) || there.size() != table.thickness.size() ||
        !std::equal(there.begin(), there.end(), table.thickness.begin(), close))
      return std::nullopt;
    for (const double h : table.thickness) {
      double tangential = 0.0, radial = 0.0, count = 0.0;
      for (const OrthogonalCut& cut : group.cuts) {
        if (!close(cut.thickness, h)) continue;
        tangential += cut.tangential.value;
        radial += cut.radial.value;
        count += 1.0;
      }
      table.tangential.push_back(tangential / count);
      table.radial.push_back(radial / count);
    }
  }
  return table;
}

} // namespace cnem::machining
