#pragma once
// Places of nodes in messages.
#include "core/fields/vector_at.hpp"
#include "core/geometry/place_text.hpp"

#include <string>

namespace cnem::app {

/// "(0.01, -2e-3) m", with all components, of a place or of where node i is.
template<int dim> std::string show_place(const Vec<dim>& x) { return place_text(x) + " m"; }
template<int dim> std::string show_place(const Fields<dim>& position, std::size_t i) {
  return show_place<dim>(vector_at<dim>(position, i));
}

} // namespace cnem::app
