#pragma once
// Every discretisation that has to keep the contract. A new one is added here and nowhere else.
#include "alternatives/fe_triangle.hpp"

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace cnem::testing {

struct Method {
  std::string name;
  std::function<std::unique_ptr<Discretisation<2>>()> make;
};

inline void PrintTo(const Method& method, std::ostream* os) { *os << method.name; }

inline std::vector<Method> methods() {
  const std::vector<Method> list{
      {"fe_triangle", [] { return std::make_unique<alternatives::FeTriangles>(); }}};
  return list;
}

} // namespace cnem::testing
