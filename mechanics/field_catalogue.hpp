#pragma once
// The fields that users ask for by name, in pictures, probes, lines and files: those that are declared as
// shown (core/fields/state.hpp), and those derived from the state, one line each (field_catalogue.cpp).
#include "core/fields/state.hpp"

#include <functional>
#include <string>
#include <vector>

namespace cnem {

/// What shown fields are made from.
template<int dim> struct FieldSource {
  const State<dim>& state;
  const AdaptationFields* adaptation = nullptr; ///< null: the cloud is not adapted
};

/// Files give vectors and tensors whole: the array that a field is a component of.
struct ArrayPart {
  std::string label;                          ///< "stress"; "": the field is an array of its own
  std::size_t component = 0;                  ///< its number in `component_names`
  std::vector<std::string> component_names{}; ///< of all; those that no field is are zero
};

/// A field by its case-file name.
template<int dim> struct FieldInfo {
  std::string name; ///< "plastic_strain", as in case files and history columns
  std::string unit; ///< SI unit, "" when dimensionless
  Shown shown;
  bool at_nodes = false; ///< lives at nodes (else at stress points)
  bool adaptive = false; ///< only where the cloud is adapted
  bool switched = false; ///< of a group that may be off: then zero, and left out of files
  std::function<double(const FieldSource<dim>&, std::size_t)> at; ///< value at a stress point or node
  ArrayPart part{};
  /// The values themselves where the state keeps them; empty for a field that is calculated.
  std::function<const Field*(const FieldSource<dim>&)> kept{};
};

/// All fields, in the order files list them.
template<int dim> const std::vector<FieldInfo<dim>>& field_catalogue();

/// Throws InputError for an unknown name.
template<int dim> const FieldInfo<dim>& field_info(const std::string& name);

extern template const std::vector<FieldInfo<2>>& field_catalogue();
extern template const std::vector<FieldInfo<3>>& field_catalogue();
extern template const FieldInfo<2>& field_info(const std::string& name);
extern template const FieldInfo<3>& field_info(const std::string& name);

} // namespace cnem
