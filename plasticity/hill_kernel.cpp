#include "plasticity/hill_return.hpp"
#include "plasticity/laws/list.hpp"
#include "plasticity/point_packs.hpp"
#include "plasticity/with_law.hpp"

namespace cnem::plasticity::CNEM_ISA {

template<int dim>
std::ptrdiff_t hill_return_map(const ReturnMapParameters& parameters, const HillForm& form,
                               const StressPoints<dim>& points, std::ptrdiff_t begin, std::ptrdiff_t end) {
  const HillParameters hill{parameters, form};
  return with_law(
      HardeningLaws{}, parameters.hardening.law, parameters.hardening.constants,
      [&](const auto& law) { return update(hill, kernel_of(law, parameters.dt), points, begin, end); });
}

template std::ptrdiff_t hill_return_map<2>(const ReturnMapParameters&, const HillForm&,
                                           const StressPoints<2>&, std::ptrdiff_t, std::ptrdiff_t);
template std::ptrdiff_t hill_return_map<3>(const ReturnMapParameters&, const HillForm&,
                                           const StressPoints<3>&, std::ptrdiff_t, std::ptrdiff_t);

} // namespace cnem::plasticity::CNEM_ISA
