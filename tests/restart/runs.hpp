#pragma once
// Small cases that hold every kind of state a run has, and the comparison of two runs bit for bit.
#include <filesystem>
#include <string>
#include <vector>

namespace cnem::app {

struct SmallCase {
  const char* name;
  std::string text;
};

/// Plasticity, heat, contact with friction, re-references, bulk viscosity, loads, supports, bodies of
/// revolution, finite elements, particles, damage, parts that touch or are bonded and adapt, a failure that
/// is gone back from, a window that moves, space.
const std::vector<SmallCase>& small_cases();
/// Those of them that are three-dimensional: a block that is hit, one that is refined, a strip that is
/// sheared until it parts, a slab between periodic planes, and a slot between them that closes.
std::string space_case();
std::string space_refined();
std::string space_edge();
std::string space_sheared();
std::string space_periodic();
std::string space_images();
/// Bonded, periodic and cracked.
std::string parts_case();
std::string delaminating_case();
/// A crack that runs, with damage averaged over a length.
std::string cracked_case();
/// A ply that fails while the cloud changes.
std::string ply_case();
/// One that flows and breaks.
std::string flowing_ply_case();
/// Functions at Gauss points, contact by springs.
std::string gauss_point_case();
/// A cut through a window that moves.
std::string window_case();
/// The case of a sheet that is cut, of two layers, and of a round one.
std::string in_layers(std::string text);
std::string of_revolution(std::string text);
std::string in_levels(std::string text);
/// A case with other lines of the method, in triangles with others, with a punch that conducts.
std::string with_method(std::string text, const std::string& lines);
std::string in_triangles(std::string text, const std::string& lagrangian);
std::string with_conducting_punch(std::string text);
/// The case that goes back, which does not adapt in triangles: once.
std::string set_back_in_triangles(std::string text);
const std::string& small_case(const std::string& name);

/// Differences of two output folders in history, fields, lines, pictures and in what status.json says of the
/// result; empty when there is none.
std::string difference(const std::filesystem::path& a, const std::filesystem::path& b);

} // namespace cnem::app
