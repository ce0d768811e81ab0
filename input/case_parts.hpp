#pragma once
// The steps of the case reader, between its translation units.
#include "input/case.hpp"
#include "input/outline.hpp"
#include "input/schema/settings.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cnem::machining {
struct Cutter;
}

namespace cnem::input {

/// Domain and tools: outlines, holes and cracks, and whether they fit into one another.
void read_domain(Setting& root, Case& result, Diagnostics& diagnostics);
/// The workpiece of a three-dimensional analysis, and the solid of a tool of one.
Block read_block(const Setting& table, Diagnostics& diagnostics);
/// What draws or turns outlines into a body in space, and a body from an STL file (into Case::domain; nothing
/// where the file is at fault).
Sweep read_extrusion(const Setting& table, Diagnostics& diagnostics);
Sweep read_revolution(const Setting& table, Diagnostics& diagnostics);
void read_faceted(Setting& table, Case& result, Diagnostics& diagnostics);
ToolSolid read_solid(Setting& table, const Case& input, Diagnostics& diagnostics);
/// The curve of a table with an outline; a wrong one is a mistake: then none.
std::optional<Curve> read_outline(const Setting& table, const OutlineNames& names, Diagnostics& diagnostics);
/// Why a point (m) is not in the block; "" when it is.
std::string outside_reason(const Block& block, const Vec3& x);

/// The table `cutter`. axial_depth: m, as far as a rake face has to reach.
machining::Cutter read_cutter(Setting& table, const std::string& case_path, double axial_depth,
                              Diagnostics& diagnostics);
/// Cutter, cut, law, modes and what is asked of a milling analysis.
void read_machining(Setting& root, Case& result, Diagnostics& diagnostics);
struct MachiningCase;
void read_drive(const Setting& milling, MachiningCase& read, Analysis::Type type, Diagnostics& diagnostics);
void read_path(Setting& root, MachiningCase& read, const std::string& case_path, Diagnostics& diagnostics);
/// Parts and shafts, of it and of analyses of modes.
void read_structure(Setting& root, Case& result, Diagnostics& diagnostics);

void read_contact(const Setting& root, Case& result, Diagnostics& diagnostics);
/// The thermal side of a tool, with its section. Expects its outline.
void read_tool_heat(const Setting& table, const Setting& root, const Case& input, Tool& tool,
                    Diagnostics& diagnostics);

/// A region of its own, or one at each end of cracks; none where the place is missing. cloud_spacing: m, of
/// which it may be a share.
std::vector<clouds::Refinement> read_refinement(const Setting& root, const Setting& table,
                                                double cloud_spacing, Diagnostics& diagnostics);

void read_tools(Setting& root, Case& result, Diagnostics& diagnostics);

/// The mass of a tool and what moves it. Expects the kinematics.
void read_drive(const Setting& table, const Case& input, Tool& tool, Diagnostics& diagnostics);

void read_mass_scaling(const Setting& root, Case& result, Diagnostics& diagnostics);

/// Parts of the workpiece with a state of their own. Expects the domain.
void read_regions(const Setting& root, Case& result, Diagnostics& diagnostics);

/// Initial state and body loads.
void read_initial_and_loads(const Setting& root, Case& result, Diagnostics& diagnostics);

/// Pieces that continue at others. Expects the domain.
void read_periodic(const Setting& root, Case& result, Diagnostics& diagnostics);

/// Names of the tools in their order.
std::vector<std::string> tool_names(const Case& input);
/// The index of the tool with that name; an unknown one is a mistake at `key`: then none.
std::optional<std::size_t> index_of_tool(const Setting& key, const std::string& name,
                                         const std::vector<std::string>& tools, Diagnostics& diagnostics);

/// Opposite corners of a box, the lower left one first.
std::array<Vec2, 2> read_box(const Setting& setting, Diagnostics& diagnostics);

/// Coolants of the boundary. Expects the tools.
void read_coolants(const Setting& root, Case& result, Diagnostics& diagnostics);

/// What pictures show, when, and how they are drawn; not their windows. Expects the time.
void read_pictures(const Setting& table, Case& result, Diagnostics& diagnostics);

/// Parts of pictures that are drawn enlarged. Expects domain and tools.
void read_windows(const Setting& root, Case& result, Diagnostics& diagnostics);

/// Spacing, refinements and node lists. A node file is read and its nodes are put into the settings,
/// so that the resolved case stands alone. Expects the domain, which may lack its outline.
void read_cloud(Setting& root, Case& result, Diagnostics& diagnostics);

/// Defaults of materials that depend on their other constants and on the temperature at the start, K.
void set_material_defaults(Setting& root, double temperature);

/// A material of its table. What is allowed and hardly meant goes to `warnings`.
plasticity::Material read_material(const Setting& table, std::vector<std::string>& warnings,
                                   Diagnostics& diagnostics);

/// Materials, and whether the domain's exists and has what is needed.
void read_materials(const Setting& root, Case& result, Diagnostics& diagnostics);

/// Boundary conditions: pieces exist, conditions do not fight over them. Expects the domain.
void read_boundary(const Setting& root, Case& result, Diagnostics& diagnostics);

/// How the cloud is adapted, with defaults from its spacing. Expects everything but crack tips.
void read_adaptation(Setting& root, Case& result, Diagnostics& diagnostics);

/// A key of a table of [report] that names the tool which leads: without it the usual one, else the only one
/// that moves.
struct LeadingTool {
  const char *key, *usual;
};
/// Its index; none where there is none, which is a mistake.
std::optional<std::size_t> read_leading_tool(Setting& root, const Case& input, const std::string& table,
                                             const LeadingTool& tool, Diagnostics& diagnostics);

/// What a cut is evaluated with, where [report.cutting] is there. Expects what read_report() does.
void read_cutting_report(Setting& root, Case& result, Diagnostics& diagnostics);

/// A single curve that stands in [report.experiment] itself gets a name: the schema sees it as one of
/// several.
void name_single_experiment(Value& document);
/// Measured curves, where [report.experiment] is there; those of files are put into the settings. Expects
/// what cuts are evaluated with.
void read_experiments(Setting& root, Case& result, Diagnostics& diagnostics);
/// Measured heights of faces, where [report.blanking.measured] is there.
void read_measured_faces(const Setting& root, BlankingReport& report, Diagnostics& diagnostics);
/// The units that pages show numbers in.
void read_shown_units(const Setting& root, Case& result, Diagnostics& diagnostics);

/// What is evaluated at the end, with defaults from the tools. Expects tools, domain and periodic pieces.
void read_report(Setting& root, Case& result, Diagnostics& diagnostics);

/// A window that moves with a tool, where [adapt.window] is there. Expects adaptation and what is evaluated.
void read_moving_window(Setting& root, Case& result, Diagnostics& diagnostics);

/// Crack tips: enrichment and domain of the interaction integral.
void read_fracture(const Setting& root, Case& result, Diagnostics& diagnostics);

/// What a case asks for at a key and a method that promises no more than `promises` cannot give, in words for
/// users.
struct Unmet {
  std::string path;
  Promise promise;
  std::string message;
};
std::vector<Unmet> unmet_needs(const Case& input, const Promises& promises);

/// What the case asks for and its method does not promise (core/operators/promises.hpp). Expects everything
/// else.
void check_promises(const Setting& root, const Case& result, Diagnostics& diagnostics);

/// What cannot be asked for together; defaults of such keys are dropped. Expects everything else.
void check_pairs(Setting& root, const Case& result, Diagnostics& diagnostics);

/// Points of a CSV file with a header such as "x[mm],y[mm]". Throws InputError with file, line and column for
/// a file that is absent or malformed, IoError when it cannot be read.
std::vector<Vec2> read_points(const std::string& path);

} // namespace cnem::input
