#pragma once
// Places of nodes in messages.
#include "core/aligned.hpp"
#include "core/index.hpp"
#include "core/vec.hpp"

#include <fmt/format.h>
#include <string>

namespace cnem::app {

/// Where node i is, m; positions [component][node].
template<int dim> Vec<dim> place_of_node(const Fields<dim>& position, std::size_t i) {
  Vec<dim> x;
  for (int k = 0; k < dim; ++k) x[k] = position[index_of(k)][i];
  return x;
}

/// "(0.01, -2e-3) m", with all components.
template<int dim> std::string show_place(const Vec<dim>& x) {
  std::string text;
  for (const double component : x) text += fmt::format("{}{:.6g}", text.empty() ? "(" : ", ", component);
  return text + ") m";
}
template<int dim> std::string show_place(const Fields<dim>& position, std::size_t i) {
  return show_place<dim>(place_of_node<dim>(position, i));
}

} // namespace cnem::app
