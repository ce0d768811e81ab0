#pragma once
// The units that a case wants its numbers shown in: report.units.
#include "input/schema/units.hpp"
#include "results/si_format.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cnem::results {

/// How numbers are shown on pages and pictures: in the units chosen, others as display_unit() does.
class ShownUnits {
public:
  ShownUnits() = default;
  /// Units as a case writes them: "degC", "kN/mm". Those of energies contain J, and are not those of forces
  /// of the same dimension. Throws InputError for what is no unit.
  explicit ShownUnits(const std::vector<std::string>& units);
  /// These, and others for what none of them is for. Throws InputError for what is no unit.
  ShownUnits otherwise(const std::vector<std::string>& units) const;
  /// Of the text of a resolved case; of another text none.
  static ShownUnits of_case(const std::string& resolved);

  /// The unit chosen for what has this one ("Pa", "MPa", "N/m"); none where none was.
  std::optional<DisplayUnit> chosen(std::string_view unit) const;
  /// The unit for numbers of a size in an SI unit.
  DisplayUnit of(double magnitude, std::string_view unit) const;
  /// A number in an SI unit with the one it is shown in.
  std::string format(double value, std::string_view unit, int digits = 4) const;

private:
  struct Choice {
    input::Dimension dimension;
    bool energy = false;
    DisplayUnit unit;
  };
  std::vector<Choice> choices_;
};

} // namespace cnem::results
