#pragma once
// Parts and shafts of a case, solved.
#include "input/case.hpp"
#include "input/case_machining.hpp"
#include "input/case_structure.hpp"
#include "machining/milling_process.hpp"
#include "machining/structure/eigenmodes.hpp"
#include "machining/structure/part.hpp"
#include "machining/structure/shaft.hpp"

#include <string>
#include <vector>

namespace cnem::app {

/// The part and the shaft of a case. Throw InputError with their key.
machining::Part part_of(const input::Case& input);
machining::Shaft shaft_of(const input::Case& input);

/// A place of a part: what the unknowns make of its displacement, [3 × unknowns]. Throws InputError with its
/// key where there is no material.
SparseMatrix displacement_at(const input::Case& input, const machining::Part& part,
                             const input::PartPlace& place);
/// Where the cutter is, and where it is when it has gone on along a path, m.
SparseMatrix displacement_at_cutter(const input::Case& input, const machining::Part& part);
SparseMatrix displacement_on_the_way(const input::Case& input, const machining::Part& part, double place);

/// Whether a mode moves a place at all, m as it is there: at its nodes there is rounding alone.
bool is_felt(const machining::Eigenmodes& modes, Eigen::Index mode, const Vec3& motion);

struct SolvedPart {
  explicit SolvedPart(const input::Case& input);
  /// presence: [cell] 1 − D.
  SolvedPart(const input::Case& input, machining::Part part, const std::vector<double>& presence);
  machining::Part part;
  SparseMatrix stiffness, mass;
  machining::Eigenmodes modes;
};

/// Modes of a part as its cutter sees them, along axes of the cut.
std::vector<input::NamedMode> modes_at_cutter(const input::Case& input, const SolvedPart& part);
/// Those that a cutter meets which has gone on by `place`, m, along its path: of the case as they are there,
/// and of its [part], which has lost behind the cutter what `stability.takes` says. Throws InputError.
std::vector<input::NamedMode> modes_met(const input::Case& input, double place);

/// Head and rows of modes.csv.
inline constexpr const char* mode_table_head =
    "of,mode,frequency[Hz],damping,place,stiffness[N/m],mass[kg],direction_x,direction_y,direction_z\n";
std::string mode_row(const std::string& of, const std::string& name, const machining::Mode& mode,
                     const std::string& place);

/// The part of a cut that is mapped by hexahedra (part.mapping), as modes or whole; none without one. What
/// the tool takes of it is known from a rigid run.
std::unique_ptr<machining::FlexiblePart> flexible_part(const input::Case& input,
                                                       const machining::ProcessSettings& settings);
/// Throws InputError where the cutter of a straight cut is not in the part, or the workpiece of passes has
/// nothing in common with it.
void check_mapped_workpiece(const input::Case& input, const machining::Part& part);

} // namespace cnem::app
