#pragma once
// Every discretisation that has to keep the contract. A new one is added here and nowhere else.
#include "cnem/scni.hpp"
#include "methods/fe_triangle.hpp"

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
  std::vector<Method> list{{"fe_triangle", [] { return std::make_unique<methods::FeTriangles>(); }}};
  for (const auto functions : {scni::Functions::sibson, scni::Functions::laplace})
    for (int points = 1; points <= 3; ++points) {
      const std::string name = functions == scni::Functions::sibson ? "sibson_" : "laplace_";
      list.push_back({name + std::to_string(points), [=] {
                        return std::make_unique<scni::Cnem>(
                            scni::Options{.functions = functions, .gauss_points = points});
                      }});
    }
  return list;
}

} // namespace cnem::testing
