#include "thermal/boundaries.hpp"

#include "core/geometry/facets.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace cnem {

namespace {

template<int dim>
std::array<double, dim> areas(Space space, const Facet<dim>& facet, const Fields<dim>& position) {
  return corner_areas<dim>(space, corners_of<dim>(facet, position));
}

/// The facets of one face of an interface and, from their mates, the nodes of the other.
template<int dim> void renew_faces(const Cloud<dim>& cloud, ContactConductance<dim>& interface) {
  const std::vector<PieceIndex> pieces = pieces_of(std::span<const Facet<dim>>(interface.facets));
  interface.facets.clear();
  interface.opposite.clear();
  for (const CloudFacetIndex f : cloud.facets.indices()) {
    if (std::find(pieces.begin(), pieces.end(), cloud.facets[f].piece) == pieces.end()) continue;
    interface.facets.push_back(cloud.facets[f]);
    std::array<NodeIndex, dim> opposite = cloud.facets[cloud.mates[f]].node;
    std::reverse(opposite.begin(), opposite.end());
    interface.opposite.push_back(opposite);
  }
}

} // namespace

template<int dim>
void ThermalBoundaries<dim>::resample(const Resampling<dim>& change, const WithPartners& with_partners) {
  for (FixedTemperature& fixed : fixed_)
    fixed.nodes = with_partners(renumbered(change, std::span<const NodeIndex>(fixed.nodes),
                                           std::span<const PieceIndex>(fixed.pieces)));
  resample(change.cloud);
}

template<int dim> void ThermalBoundaries<dim>::archive_nodes(Archive& archive) {
  for (std::size_t k = 0; k < fixed_.size(); ++k)
    archive.integers(fmt::format("solver/fixed_temperatures/{}/nodes", k), fixed_[k].nodes);
}

template<int dim> void ThermalBoundaries<dim>::resample(const Cloud<dim>& cloud) {
  for (HeatFlux<dim>& flux : fluxes_) renew_facets(cloud, flux.facets);
  for (Convection<dim>& convection : convections_) renew_facets(cloud, convection.facets);
  for (ContactConductance<dim>& interface : interfaces_) renew_faces(cloud, interface);
  if (cooled()) boundary_ = cloud.facets;
}

template<int dim>
void ThermalBoundaries<dim>::cool(std::vector<Coolant<dim>> coolants, const Cloud<dim>& cloud) {
  coolants_ = std::move(coolants);
  if (cooled()) boundary_ = cloud.facets;
}

template<int dim>
void ThermalBoundaries<dim>::add_coolant_flow(double time, const Exposure<dim>& exposure,
                                              const Fields<dim>& position, const Field& temperature,
                                              Field& flow) const {
  for (const Coolant<dim>& coolant : coolants_) {
    const double h = coolant.coefficient(time), ambient = coolant.ambient(time);
    const Vec<dim> moved =
        exists(coolant.follow) ? exposure.tool_moved[coolant.follow] : Vec<dim>(Vec<dim>::Zero());
    const auto reached = [&](const Vec<dim>& x) {
      return !coolant.box || ((x.array() >= (coolant.box->front() + moved).array()).all() &&
                              (x.array() <= (coolant.box->back() + moved).array()).all());
    };
    for (const Facet<dim>& facet : boundary_) {
      const auto corner = corners_of<dim>(facet, position);
      const auto area = corner_areas<dim>(space_, corner);
      for (std::size_t end = 0; end < dim; ++end) {
        const NodeIndex node = facet.node[end];
        if ((!exposure.covered.empty() && exposure.covered[node]) || !reached(corner[end])) continue;
        flow[index_of(node)] += h * (ambient - temperature[index_of(node)]) * area[end];
      }
    }
  }
}

template<int dim>
void ThermalBoundaries<dim>::add_flow(double time, const Fields<dim>& position, const Field& temperature,
                                      Field& flow) const {
  for (const HeatFlux<dim>& flux : fluxes_) {
    const double value = flux.value(time);
    for (const Facet<dim>& facet : flux.facets) {
      const auto area = areas<dim>(space_, facet, position);
      for (std::size_t end = 0; end < dim; ++end) flow[index_of(facet.node[end])] += value * area[end];
    }
  }
  for (const Convection<dim>& convection : convections_) {
    const double h = convection.coefficient(time), ambient = convection.ambient(time);
    for (const Facet<dim>& facet : convection.facets) {
      const auto area = areas<dim>(space_, facet, position);
      for (std::size_t end = 0; end < dim; ++end) {
        const auto i = index_of(facet.node[end]);
        flow[i] += h * (ambient - temperature[i]) * area[end];
      }
    }
  }
  for (const ContactConductance<dim>& interface : interfaces_)
    for (std::size_t f = 0; f < interface.facets.size(); ++f) {
      const auto area = areas<dim>(space_, interface.facets[f], position);
      for (std::size_t end = 0; end < dim; ++end) {
        const auto i = index_of(interface.facets[f].node[end]);
        const auto j = index_of(interface.opposite[f][end]);
        const double crossing = interface.conductance * area[end] * (temperature[j] - temperature[i]);
        flow[i] += crossing;
        flow[j] -= crossing;
      }
    }
}

template<int dim> void HeatContacts<dim>::add_flow(const Field& temperature, Field& flow) const {
  for (const ToolConductance& tool : tools) {
    const auto i = index_of(tool.node);
    flow[i] += tool.conductance * tool.area * (tool.tool_temperature - temperature[i]);
  }
  for (const BodyConductance<dim>& body : bodies) {
    double opposite = 0.0;
    for (std::size_t a = 0; a < dim; ++a) opposite += body.weight[a] * temperature[index_of(body.facet[a])];
    const auto i = index_of(body.node);
    const double crossing = body.conductance * body.area * (opposite - temperature[i]);
    flow[i] += crossing;
    for (std::size_t a = 0; a < dim; ++a) flow[index_of(body.facet[a])] -= body.weight[a] * crossing;
  }
}

template<int dim> double HeatContacts<dim>::fastest_decay(const Field& heat_capacity) const {
  // Gershgorin: a node's row of exchange is twice what it gives; one node may stand in many
  std::map<NodeIndex, double> given;
  for (const ToolConductance& tool : tools) given[tool.node] += tool.conductance * tool.area;
  for (const BodyConductance<dim>& body : bodies) {
    given[body.node] += 2.0 * body.conductance * body.area;
    for (std::size_t a = 0; a < dim; ++a)
      given[body.facet[a]] += 2.0 * body.weight[a] * body.conductance * body.area;
  }
  double worst = 0.0;
  for (const auto& [node, sum] : given) worst = std::max(worst, sum / heat_capacity[index_of(node)]);
  return worst;
}

template<int dim>
double ThermalBoundaries<dim>::fastest_decay(double time, const Fields<dim>& position,
                                             const Field& heat_capacity) const {
  double worst = 0.0;
  const auto exchange = [&](double coefficient, const std::vector<Facet<dim>>& facets) {
    for (const Facet<dim>& facet : facets) {
      const auto area = areas<dim>(space_, facet, position);
      for (std::size_t end = 0; end < dim; ++end)
        worst = std::max(worst, 2.0 * coefficient * area[end] / heat_capacity[index_of(facet.node[end])]);
    }
  };
  for (const Convection<dim>& convection : convections_)
    exchange(convection.coefficient(time), convection.facets);
  double cooling = 0.0;
  for (const Coolant<dim>& coolant : coolants_) cooling += coolant.coefficient(time);
  exchange(cooling, boundary_);
  for (const ContactConductance<dim>& interface : interfaces_)
    for (std::size_t f = 0; f < interface.facets.size(); ++f) {
      const auto area = areas<dim>(space_, interface.facets[f], position);
      for (std::size_t end = 0; end < dim; ++end)
        for (const NodeIndex node : {interface.facets[f].node[end], interface.opposite[f][end]})
          worst = std::max(worst, 4.0 * interface.conductance * area[end] / heat_capacity[index_of(node)]);
    }
  return worst;
}

template struct HeatContacts<2>;
template struct HeatContacts<3>;
template class ThermalBoundaries<2>;
template class ThermalBoundaries<3>;

} // namespace cnem
