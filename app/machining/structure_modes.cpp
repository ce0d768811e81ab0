#include "app/machining/structure_modes.hpp"

#include "core/error.hpp"

#include <array>

namespace cnem::app {

namespace {

/// Does something whose InputError is about a key.
template<class Act> auto about(const input::Case& input, const std::string& key, Act&& act) {
  try {
    return act();
  } catch (const InputError& error) { throw input.error(key, error.what()); }
}

} // namespace

machining::Part part_of(const input::Case& input) {
  const input::PartCase& part = *input.structure->part;
  return about(input, "part.zones", [&] { return machining::Part(part.shape, part.element, part.supports); });
}

machining::Shaft shaft_of(const input::Case& input) {
  const input::ShaftCase& shaft = *input.structure->shaft;
  return about(input, "shaft",
               [&] { return machining::Shaft(shaft.sections, shaft.bearings, shaft.element); });
}

SparseMatrix displacement_at(const input::Case& input, const machining::Part& part,
                             const input::PartPlace& place) {
  return about(input, "part.points." + place.name, [&] {
    return place.at ? part.displacement_at(std::array{*place.at})
                    : part.displacement_of(place.axis, place.far);
  });
}

SparseMatrix displacement_at_cutter(const input::Case& input, const machining::Part& part) {
  return about(input, "part.cutter",
               [&] { return part.displacement_at(std::array{*input.structure->part->cutter}); });
}

SolvedPart::SolvedPart(const input::Case& input)
    : part(part_of(input)), stiffness(part.stiffness(part.presence())), mass(part.mass(part.presence())),
      modes(about(input, "part",
                  [&] { return machining::lowest_modes(stiffness, mass, input.structure->part->count); })) {}

bool is_felt(const machining::Eigenmodes& modes, Eigen::Index mode, const Vec3& motion) {
  constexpr double still = 1e-9;
  return motion.norm() > still * modes.shape.col(mode).cwiseAbs().maxCoeff();
}

std::vector<machining::Mode> modes_at_cutter(const input::Case& input, const SolvedPart& solved) {
  const input::PartCase& part = *input.structure->part;
  const Eigen::MatrixXd motion = displacement_at_cutter(input, solved.part) * solved.modes.shape;
  std::vector<machining::Mode> modes;
  for (Eigen::Index i = 0; i < solved.modes.count(); ++i) {
    const Vec3 shape = part.to_cutter * motion.col(i);
    const double omega = solved.modes.omega[i];
    if (is_felt(solved.modes, i, motion.col(i)))
      modes.push_back(machining::mode_at(omega, part.damping_of(omega), shape, machining::Mode::Of::part));
  }
  return modes;
}

} // namespace cnem::app
