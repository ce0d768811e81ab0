#include "contact/kept_impulses.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <tuple>

namespace cnem::contact {
namespace {

/// Whether what one contact is between comes before that of the other.
template<int dim> bool comes_before(const Contact<dim>& one, const Contact<dim>& other) {
  const auto pair = [](const Contact<dim>& c) { return std::tie(c.facet, c.feature, c.tool, c.node); };
  if (pair(one) != pair(other)) return pair(one) < pair(other);
  return std::lexicographical_compare(one.shift.begin(), one.shift.end(), other.shift.begin(),
                                      other.shift.end());
}

} // namespace

template<int dim> void KeptImpulses<dim>::clear() {
  contacts_.clear();
  has_node_.clear();
  left_ = 0.0;
}

template<int dim>
void KeptImpulses<dim>::keep(const std::vector<Contact<dim>>& contacts, double dt_mean, double left) {
  clear();
  for (const Contact<dim>& contact : contacts) {
    if (!contact.swept || contact.pressing == 0.0) continue;
    contacts_.push_back(contact);
    contacts_.back().pressing /= dt_mean;
    contacts_.back().sliding /= dt_mean;
  }
  if (!contacts_.empty()) left_ = left;
  index();
}

template<int dim> void KeptImpulses<dim>::index() {
  std::sort(contacts_.begin(), contacts_.end(), comes_before<dim>);
  for (const Contact<dim>& contact : contacts_)
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a) {
      if (contact.weight[a] == 0.0) continue;
      if (index_of(contact.node[a]) >= has_node_.size()) has_node_.resize(index_of(contact.node[a]) + 1, 0);
      has_node_[contact.node[a]] = 1;
    }
}

template<int dim> const Contact<dim>* KeptImpulses<dim>::find(const Contact<dim>& contact) const {
  const auto found = std::lower_bound(contacts_.begin(), contacts_.end(), contact, comes_before<dim>);
  return found != contacts_.end() && !comes_before(contact, *found) ? &*found : nullptr;
}

template<int dim> bool KeptImpulses<dim>::covers(const Contact<dim>& contact) const {
  for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
    if (contact.weight[a] != 0.0 &&
        (index_of(contact.node[a]) >= has_node_.size() || !has_node_[contact.node[a]]))
      return false;
  return true;
}

template<int dim> void KeptImpulses<dim>::archive(Archive& archive) {
  std::vector<std::int32_t> between;
  std::vector<double> force, shift;
  for (const Contact<dim>& contact : contacts_) {
    between.insert(between.end(),
                   {as<std::int32_t>(contact.facet), contact.feature, as<std::int32_t>(contact.tool)});
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a) {
      between.push_back(contact.weight[a] != 0.0 ? 1 : 0);
      between.push_back(as<std::int32_t>(contact.node[a]));
    }
    force.push_back(contact.pressing);
    force.insert(force.end(), contact.sliding.begin(), contact.sliding.end());
    shift.insert(shift.end(), contact.shift.begin(), contact.shift.end());
  }
  archive.integers("solver/body_contact/kept/between", between);
  archive.list("solver/body_contact/kept/force", "N/m", force);
  archive.list("solver/body_contact/kept/shift", "m", shift);
  archive.number("solver/body_contact/kept/left", "m", left_);
  if (!archive.loading()) return;
  constexpr std::size_t numbers = 3 + 2 * Contact<dim>::slots;
  contacts_.assign(between.size() / numbers, {});
  has_node_.clear();
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    Contact<dim>& contact = contacts_[c];
    const std::int32_t* const pair = between.data() + c * numbers;
    contact.facet = as<FacetIndex>(pair[0]);
    contact.feature = pair[1];
    contact.tool = as<ToolIndex>(pair[2]);
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a) {
      contact.weight[a] = pair[3 + 2 * a];
      contact.node[a] = as<BoundaryNodeIndex>(pair[4 + 2 * a]);
    }
    contact.pressing = force[c * (dim + 1)];
    for (std::size_t k = 0; k < dim; ++k) {
      contact.sliding[static_cast<Eigen::Index>(k)] = force[c * (dim + 1) + 1 + k];
      contact.shift[static_cast<Eigen::Index>(k)] = shift[c * dim + k];
    }
  }
  index();
}

template class KeptImpulses<2>;
template class KeptImpulses<3>;

} // namespace cnem::contact
