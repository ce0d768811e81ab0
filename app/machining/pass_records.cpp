#include "app/machining/pass_records.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace cnem::app {

double PassRecords::depth_of(const machining::MillingProcess& process, const std::vector<double>& before) {
  constexpr double share = 0.1; // thinner layers are what sprang back: no depth of cut
  std::vector<double> taken;
  for (std::size_t k = 0; k < before.size(); ++k) taken.push_back(before[k] - process.layers()[k].area());
  const double most = *std::max_element(taken.begin(), taken.end());
  double highest = process.pass_tip();
  for (std::size_t k = 0; k < taken.size(); ++k)
    if (most > 0.0 && taken[k] > share * most)
      highest = process.slices()[k].low + process.slices()[k].thickness;
  return highest - process.pass_tip();
}

void PassRecords::add(const machining::MillingProcess& process, const machining::ProcessStep& step) {
  const machining::ToolMotion& motion = process.motion();
  if (!motion.last_path()) return;
  const std::int64_t made = process.steps() - 1;
  const machining::ToolMotion::Pass& pass = motion.passes()[motion.pass_of(made)];
  if (made == pass.begin) {
    for (std::vector<double>* list : {&Fx_, &Fy_, &Fz_, &torque_, &thickest_, &removed_, &depth_})
      list->push_back(0.0);
    before_.clear(); // behind what a hole has taken
    for (const machining::DexelLayer& layer : process.layers()) before_.push_back(layer.area());
  }
  for (const auto& [list, value] : {std::pair{&Fx_, std::abs(step.force.x())},
                                    {&Fy_, std::abs(step.force.y())},
                                    {&Fz_, std::abs(step.force.z())},
                                    {&torque_, step.torque},
                                    {&thickest_, step.thickest}})
    list->back() = std::max(list->back(), value);
  removed_.back() += step.removed;
  if (made + 1 == pass.end) depth_.back() = depth_of(process, before_);
}

void PassRecords::tell(const machining::ToolMotion& motion, results::RunStatus& status) const {
  for (std::size_t k = 0; k < depth_.size(); ++k)
    for (const auto& [name, value] : {std::pair{"tip[m]", motion.tip(k)},
                                      {"depth[m]", depth_[k]},
                                      {"removed[m^3]", removed_[k]},
                                      {"Fx[N]", Fx_[k]},
                                      {"Fy[N]", Fy_[k]},
                                      {"Fz[N]", Fz_[k]},
                                      {"torque[N m]", torque_[k]},
                                      {"thickest[m]", thickest_[k]}})
      status.add_metric(fmt::format("milling.pass_{}.{}", k + 1, name), value);
}

PassRecords::Deepest PassRecords::deepest() const {
  const auto most = std::max_element(depth_.begin(), depth_.end());
  if (most == depth_.end()) return {};
  return {static_cast<std::size_t>(most - depth_.begin()), *most};
}

void PassRecords::archive(Archive& archive) {
  for (const auto& [name, unit, list] : {std::tuple{"Fx", "N", &Fx_},
                                         {"Fy", "N", &Fy_},
                                         {"Fz", "N", &Fz_},
                                         {"torque", "N m", &torque_},
                                         {"thickest", "m", &thickest_},
                                         {"removed", "m^3", &removed_},
                                         {"depth", "m", &depth_},
                                         {"before", "m^2", &before_}})
    archive.list(fmt::format("run/passes/{}", name), unit, *list);
}

} // namespace cnem::app
