#include "app/machining/structure_modes.hpp"

#include "app/machining/left_workpiece.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "machining/structure/newmark_motion.hpp"
#include "machining/structure/theoretical_tool.hpp"

#include <array>
#include <fmt/format.h>

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

namespace {

machining::Eigenmodes modes_of_part(const input::Case& input, const SparseMatrix& stiffness,
                                    const SparseMatrix& mass) {
  return about(input, "part",
               [&] { return machining::lowest_modes(stiffness, mass, input.structure->part->count); });
}

} // namespace

SolvedPart::SolvedPart(const input::Case& input)
    : part(part_of(input)), stiffness(part.stiffness(part.presence())), mass(part.mass(part.presence())),
      modes(modes_of_part(input, stiffness, mass)) {}

SolvedPart::SolvedPart(const input::Case& input, machining::Part of, const std::vector<double>& presence)
    : part(std::move(of)), stiffness(part.stiffness(presence)), mass(part.mass(presence)),
      modes(modes_of_part(input, stiffness, mass)) {}

namespace {

Vec3 cutter_on_the_way(const input::PartCase& part, double place) {
  return *part.cutter + place * part.to_cutter.row(0).transpose();
}

} // namespace

SparseMatrix displacement_on_the_way(const input::Case& input, const machining::Part& part, double place) {
  return about(input, "stability.places", [&] {
    return part.displacement_at(std::array{cutter_on_the_way(*input.structure->part, place)});
  });
}

bool is_felt(const machining::Eigenmodes& modes, Eigen::Index mode, const Vec3& motion) {
  constexpr double still = 1e-6; // means over a face cancel to this
  return motion.norm() > still * modes.shape.col(mode).cwiseAbs().maxCoeff();
}

namespace {

/// Modes of a part where some place moves as `rows` say, along axes of the cut; named by their numbers among
/// all of them, as analysis.type = "modes" does.
std::vector<input::NamedMode> modes_along(const input::PartCase& part, const SolvedPart& solved,
                                          const SparseMatrix& rows) {
  const Eigen::MatrixXd motion = rows * solved.modes.shape;
  std::vector<input::NamedMode> modes;
  for (Eigen::Index i = 0; i < solved.modes.count(); ++i) {
    const Vec3 shape = part.to_cutter * motion.col(i);
    const double omega = solved.modes.omega[i];
    if (is_felt(solved.modes, i, motion.col(i)))
      modes.push_back({machining::mode_at(omega, part.damping_of(omega), shape, machining::Mode::Of::part),
                       fmt::format("{}", i + 1)});
  }
  return modes;
}

} // namespace

std::vector<input::NamedMode> modes_at_cutter(const input::Case& input, const SolvedPart& solved) {
  return modes_along(*input.structure->part, solved, displacement_at_cutter(input, solved.part));
}

std::vector<input::NamedMode> modes_met(const input::Case& input, double place) {
  std::vector<input::NamedMode> there;
  for (const input::NamedMode& mode : input.machining->modes)
    if (mode.moves_at(place)) there.push_back({mode.at(place), mode.name});
  if (!input.structure->part) return there;
  const input::PartCase& read = *input.structure->part;
  const Vec3 feed = read.to_cutter.row(0).transpose(), cutter = cutter_on_the_way(read, place);
  machining::Part part = part_of(input);
  std::vector<double> presence = part.presence();
  if (auto box = input.machining->stability.takes) {
    Eigen::Index axis = 0;
    feed.cwiseAbs().maxCoeff(&axis);
    double& end = (feed[axis] > 0.0 ? box->high : box->low)[axis];
    end = feed[axis] > 0.0 ? std::min(end, cutter[axis]) : std::max(end, cutter[axis]);
    constexpr double most = 0.999; // as what tools take in time
    if (box->low[axis] < box->high[axis])
      presence = machining::presence_without(part, box->low, box->high, most);
  }
  const SolvedPart solved(input, std::move(part), presence);
  const SparseMatrix rows = displacement_on_the_way(input, solved.part, place);
  for (const input::NamedMode& mode : modes_along(read, solved, rows)) there.push_back(mode);
  return there;
}

std::string mode_row(const std::string& of, const std::string& name, const machining::Mode& mode,
                     const std::string& place) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{}\n", of, name, mode.frequency, mode.damping, place,
                     mode.stiffness, mode.mass(), mode.direction.x(), mode.direction.y(), mode.direction.z());
}

namespace {

/// Axes of the cut in the part: at the height of the tip lies where the cutter is at first, on the machined
/// side of a straight way, or the origin of the axes in which passes are given.
struct CutAxes {
  explicit CutAxes(const input::Case& input)
      : turn(input.structure->part->to_cutter), origin(*input.structure->part->cutter) {
    if (!input.machining->passes.empty()) return;
    const machining::MillingCut& cut = input.machining->cut;
    const double r = cut.cutter.radius();
    origin.noalias() -=
        turn.transpose() * Vec3(0.0, cut.engagement.side == machining::Engagement::Side::up ? r : -r, 0.0);
  }
  Vec3 in_part(const Vec3& x) const { return origin + turn.transpose() * x; }
  Vec3 in_cut(const Vec3& x) const { return turn * (x - origin); }
  /// Turns displacements of `count` nodes one below the other, [3 · count] both ways.
  SparseMatrix turn_all(std::size_t count) const {
    std::vector<Eigen::Triplet<double>> entries;
    for (int node = 0; node < as<int>(count); ++node)
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          if (turn(i, k) != 0.0) entries.emplace_back(3 * node + i, 3 * node + k, turn(i, k));
    const auto rows = as<Eigen::Index>(3 * count);
    SparseMatrix all(rows, rows);
    all.setFromTriplets(entries.begin(), entries.end());
    return all;
  }
  Eigen::Matrix3d turn;
  Vec3 origin;
};

} // namespace

void check_mapped_workpiece(const input::Case& input, const machining::Part& part) {
  const input::MachiningCase& milling = *input.machining;
  if (milling.passes.empty()) {
    displacement_at_cutter(input, part);
    return;
  }
  const machining::Blank blank = blank_of(input).value();
  const CutAxes axes(input);
  const Vec3 one = axes.in_part(Vec3(blank.low.x(), blank.low.y(), 0.0)),
             other = axes.in_part(Vec3(blank.high.x(), blank.high.y(), blank.height));
  // Feed and axis may be oblique in the part: a box around what they span is enough to tell a slip.
  const Vec3& size = input.structure->part->shape.size;
  const Vec3 from = one.cwiseMin(other), to = one.cwiseMax(other);
  if ((from.array() < size.array()).all() && (to.array() > 0.0).all()) return;
  throw input.error(
      "part.cutter",
      fmt::format("puts the workpiece of the passes from ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}) mm in the "
                  "part, beside it, expected some of it within: with milling.passes part.cutter is where "
                  "their point (0, 0) lies, at the height 0 of tips",
                  1e3 * from.x(), 1e3 * from.y(), 1e3 * from.z(), 1e3 * to.x(), 1e3 * to.y(), 1e3 * to.z()));
}

std::unique_ptr<machining::FlexiblePart> flexible_part(const input::Case& input,
                                                       const machining::ProcessSettings& settings) {
  const auto& read = input.structure->part;
  if (!read || !read->mapped) return nullptr;
  machining::Part of_case = part_of(input);
  check_mapped_workpiece(input, of_case);
  const CutAxes axes(input);
  const machining::MillingCut& cut = input.machining->cut;
  const machining::Workpiece block = machining::workpiece_of(cut, settings);
  machining::HexahedralMap map =
      machining::hexahedra_over(block.low, block.high, cut.cutter.radius(), read->hexahedra);
  std::vector<Vec3> places;
  for (const Vec3& x : map.places()) places.push_back(axes.in_part(x));
  const auto moved_by = [&](const machining::Part& part) -> SparseMatrix { // (7), along axes of the cut
    return axes.turn_all(places.size()) * part.displacement_near(places);
  };
  if (read->newmark) {
    SparseMatrix follow = moved_by(of_case);
    machining::PresenceAtStep presence = [whole = of_case.presence()](std::int64_t) { return whole; };
    if (read->taking) {
      const auto tool = [&] {
        try {
          return std::make_shared<const machining::TheoreticalTool>(
              of_case, machining::MillingProcess(cut, {}, settings),
              [&](const Vec3& x) { return axes.in_cut(x); },
              machining::TheoreticalTool::Intervals{read->taking->interval, read->taking->most});
        } catch (const DivergenceError& error) {
          throw input.error("part.removal",
                            fmt::format("asks for a rigid run beforehand, which fails: {}", error.what()));
        }
      }();
      presence = [tool](std::int64_t step) { return tool->presence(step); };
    }
    return std::make_unique<machining::FlexiblePart>(
        std::move(map),
        std::make_unique<machining::NewmarkMotion>(
            std::move(of_case), std::move(follow),
            machining::NewmarkMotion::Settings{read->taking ? read->taking->interval : 0,
                                               read->rayleigh.value_or(machining::Rayleigh{})},
            std::move(presence)));
  }
  const SolvedPart solved(input);
  std::vector<machining::ModalMotion::Coordinate> coordinates;
  for (Eigen::Index i = 0; i < solved.modes.count(); ++i)
    coordinates.push_back({solved.modes.omega[i], read->damping_of(solved.modes.omega[i])});
  return std::make_unique<machining::FlexiblePart>(
      std::move(map),
      std::make_unique<machining::ModalMotion>(moved_by(solved.part) * solved.modes.shape, coordinates));
}

} // namespace cnem::app
