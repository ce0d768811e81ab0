// Constants that are looked for, as values of keys.
#include "core/index.hpp"
#include "study/calibration.hpp"

#include <cmath>
#include <fmt/format.h>

namespace cnem::study {

double SoughtConstant::place_of(double value) const {
  return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

double SoughtConstant::at(double place) const {
  if (place <= 0.0 || place >= 1.0) return place <= 0.0 ? low : high;
  return logarithmic ? low * std::pow(high / low, place) : low + place * (high - low);
}

std::string SoughtConstant::text(double value, int digits) const {
  const double written = (value - unit.offset) / (unit.factor * std::pow(10.0, unit.power));
  return fmt::format("{:.{}g}{}{}", written, digits, unit_text.empty() ? "" : " ", unit_text);
}

input::Override SoughtConstant::change(double value) const {
  input::Override override{key, {}, where};
  override.value.where = where;
  override.value.kind = si_unit.empty() ? input::Value::Kind::real : input::Value::Kind::text;
  override.value.real = value;
  if (!si_unit.empty())
    override.value.text = fmt::format("{} {}", input::format_number(value),
                                      si_unit.starts_with("1/") ? si_unit.substr(1) : si_unit);
  return override;
}

std::vector<input::Override> Calibration::changes(const CalibrationTarget& target,
                                                  const Eigen::VectorXd& place) const {
  std::vector<input::Override> list = target.set;
  for (std::size_t k = 0; k < constants.size(); ++k)
    list.push_back(constants[k].change(constants[k].at(place[static_cast<Eigen::Index>(k)])));
  return list;
}

} // namespace cnem::study
