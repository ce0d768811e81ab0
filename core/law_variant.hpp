#pragma once
// One of a list of laws, chosen at run time.
#include "core/parameter.hpp"

#include <variant>

namespace cnem {

template<class List> struct VariantOfList;
template<class... Law> struct VariantOfList<Laws<Law...>> { using type = std::variant<Law...>; };

template<class List> using VariantOf = typename VariantOfList<List>::type;

} // namespace cnem
