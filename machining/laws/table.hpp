#pragma once
#include "machining/laws/law_point.hpp"

#include <array>

namespace cnem::machining {

/// Forces over the chip thickness, and over the speed and the rake where they are given: linear between, the
/// last slope beyond the thickest chip, in proportion to h below the thinnest; constant beyond speeds and
/// rakes.
struct TableLaw {
  NumberList thickness, speed, rakes, Ft, Fr, Fa;

  static constexpr const char* name = "table";
  static constexpr const char* formula = "linear between the thicknesses (and speeds, and rakes) of tables";
  static constexpr const char* source = "";
  static constexpr std::array<Parameter<TableLaw>, 0> parameters{};
  static constexpr ListParameter<TableLaw> lists[] = {
      {&TableLaw::thickness,
       {.name = "thickness",
        .unit = "m",
        .range = positive,
        .required = true,
        .meaning = "Chip thicknesses, increasing.",
        .example = "\"0.02 0.05 0.1 mm\""}},
      {&TableLaw::speed,
       {.name = "speed",
        .unit = "m/s",
        .range = not_negative,
        .meaning =
            "Speeds of the edge, increasing: forces stand for all thicknesses of the first speed, then "
            "of the second, and so on.",
        .example = "\"2 4 m/s\""}},
      {&TableLaw::rakes,
       {.name = "rakes",
        .unit = "rad",
        .range = {.low = -1.0471975511965976, .high = 1.0471975511965976},
        .meaning = "Rakes of the edge, increasing: forces stand for all thicknesses and speeds of the first "
                   "rake, then of the second, and so on. `cutter.rake` says which one it is.",
        .example = "\"0 10 deg\""}},
      {&TableLaw::Ft,
       {.name = "Ft",
        .unit = "N/m",
        .required = true,
        .meaning = "Tangential forces per length of edge.",
        .example = "\"40 70 110 N/mm\""}},
      {&TableLaw::Fr,
       {.name = "Fr",
        .unit = "N/m",
        .required = true,
        .meaning = "Radial forces per length of edge.",
        .example = "\"30 35 42 N/mm\""}},
      {&TableLaw::Fa,
       {.name = "Fa",
        .unit = "N/m",
        .meaning = "Axial forces per length of edge; without them 0.",
        .example = "\"1 2 3 N/mm\""}}};

  /// Throws InputError unless thicknesses, speeds and rakes increase and every list has a force for each of
  /// them.
  void complete() const;
  /// The forces of one rake, rad: a table without rakes.
  TableLaw of_rake(double rake) const;
  LawPoint at(const Cut& cut) const;

private:
  LawPoint of_speed(int row, double thickness) const;
};

} // namespace cnem::machining
