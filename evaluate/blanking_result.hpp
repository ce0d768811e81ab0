#pragma once
// What a blanking operation came to: sheared faces, forces and work, springback. blanking.json in the folder
// of results.
#include "core/vec.hpp"

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cnem::evaluate {

/// Zones of a sheared face, from the side that the edge was drawn in to the side of the burr. `surface` and
/// `burr_side` are the two surfaces of the sheet beside it, `broken` is metal that is broken but did not
/// open, `hole` the wall of a hole that the cut goes through.
enum class Zone { surface, rollover, burnish, broken, fracture, second_burnish, hole, burr, burr_side };
const char* zone_name(Zone zone);

/// A sheared face as docs/blanking.md defines it. Heights along the cutting direction, m. What was not found
/// is 0, and `note` says why; a face that is not `measured` has no heights at all.
struct ShearedFace {
  std::string cut;  ///< "left" or "right" where the punch cuts on both sides, else empty
  std::string body; ///< "slug" or "skeleton"
  double angle = std::numeric_limits<double>::quiet_NaN(); ///< rad, of the section in space; NaN in the plane
  bool parted = false;                                     ///< the body has come off at this cut
  bool measured = true;                                    ///< heights mean something
  std::string note;                                        ///< empty when there is nothing to say
  double thickness = 0.0;                      ///< m, of the sheet before, at the cut: shares are of it
  double rollover = 0.0, rollover_width = 0.0; ///< m
  double burnish = 0.0, fracture = 0.0, second_burnish = 0.0, burr = 0.0; ///< m
  double broken = 0.0, hole = 0.0;                                        ///< m
  double fracture_angle = std::numeric_limits<double>::quiet_NaN(); ///< rad, from the cutting direction; > 0:
                                                                    ///< the face recedes towards the burr
  double tilt = 0.0; ///< rad, of the body's surface against the sheet before
  std::vector<Vec2>
      profile;            ///< m, u towards the cut from the face, w from the drawn-in surface into the sheet
  std::vector<Zone> zone; ///< [segment of the profile]

  bool found() const { return rollover + burnish + broken + fracture > 0.0; }
};

/// Heights of a face in an experiment; not-a-number: not measured.
struct MeasuredHeights {
  std::string cut, body; ///< of the computed face that it stands beside
  double rollover = std::numeric_limits<double>::quiet_NaN(), burnish = rollover, fracture = rollover,
         burr = rollover;           ///< m
  double fracture_angle = rollover; ///< rad
};

/// The force of a tool along the cutting direction.
struct ToolForce {
  std::string tool;
  double largest = 0.0;        ///< N/m (N), of the low-passed force
  double stroke = 0.0;         ///< m, of the punch there
  double largest_sample = 0.0; ///< N/m (N), of single recorded values
  double work = 0.0;           ///< J/m (J), done by the tool
};

/// What letting go does to a body.
struct BodySpringback {
  std::string body;     ///< "slug", "skeleton" ("skeleton_left", …), or "body_1", … by their first nodes
  double largest = 0.0; ///< m, largest displacement
  double angle_before =
      std::numeric_limits<double>::quiet_NaN(); ///< rad, of the body against the sheet before
  double angle_change = std::numeric_limits<double>::quiet_NaN();   ///< rad
  double dishing_before = std::numeric_limits<double>::quiet_NaN(); ///< m, > 0: the middle leads the punch
  double dishing_change = std::numeric_limits<double>::quiet_NaN(); ///< m
};

struct BlankingResult {
  std::string punch;
  std::vector<std::string> dies;
  double direction_x = 0.0, direction_y = 0.0,
         direction_z = 0.0;               ///< of the cut: unit vector of the punch's motion against the die
  double stroke = 0.0;                    ///< m, of the punch against the die
  double time = 0.0;                      ///< s
  double smoothing = 0.0, parallel = 0.0; ///< m, rad, with which faces were measured
  std::string note;                       ///< why there are no faces, or not all; empty otherwise
  std::string force_unit = "N/m", work_unit = "J/m"; ///< of revolution and in space: N, J
  double cut_length =
      0.0; ///< that forces are of: number of cuts, per depth; of revolution and in space m, round the punch
  std::vector<ShearedFace> faces;        ///< in space by angle, slug and skeleton of each section in turn
  std::vector<MeasuredHeights> measured; ///< of some of the faces
  std::vector<ToolForce> forces;
  std::vector<BodySpringback> springback;
};

/// What was measured of a face; nullptr where nothing was.
const MeasuredHeights* measured_of(const BlankingResult& result, const ShearedFace& face);

/// Mean and standard deviation of a height round the punch, m.
struct RoundHeight {
  double mean = 0.0, spread = 0.0;
};
/// Faces of one body at one cut at all angles, in their order; in the plane one each.
std::vector<std::vector<const ShearedFace*>> faces_of_bodies(const BlankingResult& result);
/// Over the faces that are measured.
RoundHeight round_height(const std::vector<const ShearedFace*>& faces, double ShearedFace::*size);

/// Named numbers for status.json, in space means round the punch with their spread, with units:
/// "blanking.slug.rollover[m]", …
std::vector<std::pair<std::string, double>> metrics_of(const BlankingResult& result);
/// "springback.largest[m]", "springback.slug.angle_change[rad]", …
std::vector<std::pair<std::string, double>> metrics_of(const std::vector<BodySpringback>& bodies);

/// Written atomically to `folder`/blanking.json. Throws IoError.
void write_blanking(const std::filesystem::path& folder, const BlankingResult& result);
/// Empty when there is no such file. Throws IoError when it cannot be read.
std::optional<BlankingResult> read_blanking(const std::filesystem::path& folder);

} // namespace cnem::evaluate
