#include "plasticity/box2.hpp"
#include "plasticity/laws/list.hpp"
#include "plasticity/point_packs.hpp"
#include "plasticity/with_law.hpp"

namespace cnem::plasticity::CNEM_ISA {

template<int dim>
std::ptrdiff_t return_map(const ReturnMapParameters& parameters, const StressPoints<dim>& points,
                          std::ptrdiff_t begin, std::ptrdiff_t end) {
  return with_law(
      HardeningLaws{}, parameters.hardening.law, parameters.hardening.constants,
      [&](const auto& law) { return update(parameters, kernel_of(law, parameters.dt), points, begin, end); });
}

template std::ptrdiff_t return_map<2>(const ReturnMapParameters&, const StressPoints<2>&, std::ptrdiff_t,
                                      std::ptrdiff_t);
template std::ptrdiff_t return_map<3>(const ReturnMapParameters&, const StressPoints<3>&, std::ptrdiff_t,
                                      std::ptrdiff_t);

} // namespace cnem::plasticity::CNEM_ISA
