// Boundary conditions of the case reader.
#include "input/case_parts.hpp"
#include "input/schema/nearest.hpp"
#include "input/space_domain.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

namespace cnem::input {
namespace {

/// Whether the pieces of that name are segments of one direction, or a plane face; cracks and arcs are not.
bool is_straight(const Domain& domain, const std::string& name) {
  if (domain.in_space()) return is_plane(domain, name);
  std::optional<Vec2> direction;
  const auto fits = [&](const Curve& curve) {
    for (const CurvePiece& piece : curve.pieces) {
      if (piece.name != name) continue;
      if (piece.is_arc()) return false;
      const Vec2 d = piece.tangent(0.0);
      if (direction && std::abs(cross(*direction, d)) > 1e-9) return false;
      direction = d;
    }
    return true;
  };
  return fits(domain.outer) &&
         std::all_of(domain.holes.begin(), domain.holes.end(),
                     [&](const Hole& h) { return fits(h.outline); }) &&
         direction.has_value();
}

/// Pieces a user named: "all" and names of cracks stand for several.
std::vector<std::string> chosen_pieces(const Setting& pieces, const Domain& domain,
                                       Diagnostics& diagnostics) {
  const std::vector<std::string> known = domain.piece_names();
  std::vector<std::string> chosen;
  const auto add = [&](const std::string& name) {
    if (std::find(chosen.begin(), chosen.end(), name) == chosen.end()) chosen.push_back(name);
  };
  const auto& names = std::get<std::vector<std::string>>(pieces.value);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    const bool is_crack = std::any_of(domain.cracks.begin(), domain.cracks.end(),
                                      [&](const Crack& crack) { return crack.name == name; });
    if (name == "all") {
      std::for_each(known.begin(), known.end(), add);
    } else if (std::find(known.begin(), known.end(), name) != known.end()) {
      add(name);
    } else if (is_crack) {
      add(name + "+");
      add(name + "-");
    } else {
      diagnostics.add(Mistake::reference, pieces.where_of(i), pieces.path,
                      fmt::format("found {}, expected a boundary piece: {} or all{}",
                                  toml_quoted(shortened(name)), fmt::join(known, ", "),
                                  did_you_mean(name, known)));
    }
  }
  return chosen;
}

/// What is prescribed on pieces, to find conditions that fight over one.
class Claims {
public:
  explicit Claims(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// Records that `setting` prescribes `quantity` on the pieces of its condition.
  void claim(const std::vector<std::string>& pieces, const std::string& quantity, const Setting& setting) {
    for (const std::string& piece : pieces) {
      for (const auto& [other, owner] : claims_[piece]) {
        if (!fight(quantity, other)) continue;
        diagnostics_.add(Mistake::conflict, setting.where, setting.path,
                         fmt::format("sets {} on piece '{}', where {} sets {} already, expected one of them",
                                     quantity, piece, owner, other));
        return;
      }
      claims_[piece].emplace_back(quantity, setting.path);
    }
  }

private:
  static bool fight(const std::string& a, const std::string& b) {
    static const std::vector<std::pair<std::string, std::string>> rivals{
        {"symmetry", "motion along x"},         {"symmetry", "motion along y"},
        {"symmetry", "motion along z"},         {"motion along x", "traction along x"},
        {"motion along y", "traction along y"}, {"motion along z", "traction along z"},
        {"temperature", "heat flux"},           {"temperature", "convection"}};
    return a == b || std::any_of(rivals.begin(), rivals.end(), [&](const auto& pair) {
             return pair == std::pair(a, b) || pair == std::pair(b, a);
           });
  }

  Diagnostics& diagnostics_;
  std::map<std::string, std::vector<std::pair<std::string, std::string>>> claims_;
};

/// Motion begins in the initial position: a jump at time 0 would have no speed.
void check_start(const Setting& table, const BoundaryCondition& condition, const Analysis& analysis,
                 Diagnostics& diagnostics) {
  if (analysis.type == Analysis::Type::statics) return;
  for (std::size_t k = 0; k < condition.displacement.size(); ++k)
    if (const auto& function = condition.displacement[k]; function && (*function)(0.0) != 0.0)
      diagnostics.add(
          Mistake::conflict, table.find("displacement")->where, table.find("displacement")->path,
          fmt::format("found {:g} m along {} at time 0, expected a displacement that begins with 0, "
                      "such as {{ value = \"{:g} m\", ramp = \"1 us\" }}",
                      (*function)(0.0), axis_name(k), (*function)(0.0)));
}

void claim_all(const Setting& table, const BoundaryCondition& condition, Claims& claims) {
  const auto components = [&](const char* key, const std::string& what, const VectorFunction& function) {
    for (std::size_t k = 0; k < function.size(); ++k)
      if (function[k])
        claims.claim(condition.pieces, fmt::format("{} along {}", what, axis_name(k)), *table.find(key));
  };
  if (condition.symmetry) claims.claim(condition.pieces, "symmetry", *table.find("symmetry"));
  components("velocity", "motion", condition.velocity);
  components("displacement", "motion", condition.displacement);
  components("traction", "traction", condition.traction);
  if (condition.pressure) claims.claim(condition.pieces, "pressure", *table.find("pressure"));
  if (condition.temperature) claims.claim(condition.pieces, "temperature", *table.find("temperature"));
  if (condition.heat_flux) claims.claim(condition.pieces, "heat flux", *table.find("heat_flux"));
  if (condition.convection) claims.claim(condition.pieces, "convection", *table.find("convection"));
}

} // namespace

void read_boundary(const Setting& root, Case& result, Diagnostics& diagnostics) {
  Claims claims(diagnostics);
  for (const Setting& table : root.entries("boundary")) {
    BoundaryCondition condition;
    condition.name = table.name;
    const Setting* pieces = table.find("pieces");
    if (pieces) condition.pieces = chosen_pieces(*pieces, result.domain, diagnostics);
    const Setting* points = table.find("points");
    condition.points = table.vectors("points");
    if (!pieces && !points)
      diagnostics.add(Mistake::missing_key, table.where, table.path + ".pieces",
                      "missing, expected " + find_key("boundary.*.pieces")->expectation() +
                          ", or points that name single nodes");
    condition.symmetry = table.get<bool>("symmetry");
    const auto goes_with_points = [&](const Setting& member) {
      return member.name == "pieces" || member.name == "points" || member.name == "velocity" ||
             member.name == "displacement" || (member.name == "symmetry" && !condition.symmetry);
    };
    if (points)
      for (const Setting& member : table.members)
        if (member.given && !goes_with_points(member))
          diagnostics.add(Mistake::conflict, member.where, member.path,
                          "found in a condition with points, expected velocity or displacement there");
    condition.velocity = table.maybe<VectorFunction>("velocity").value_or(VectorFunction{});
    condition.displacement = table.maybe<VectorFunction>("displacement").value_or(VectorFunction{});
    check_start(table, condition, result.analysis, diagnostics);
    condition.traction = table.maybe<VectorFunction>("traction").value_or(VectorFunction{});
    condition.pressure = table.maybe<TimeTable>("pressure");
    condition.temperature = table.maybe<TimeTable>("temperature");
    condition.heat_flux = table.maybe<TimeTable>("heat_flux");
    if (const Setting* convection = table.find("convection"))
      condition.convection = ConvectionLaw{condition.name, TimeTable(convection->get<double>("coefficient")),
                                           convection->get<TimeTable>("ambient")};

    const bool nothing = std::all_of(table.members.begin(), table.members.end(), [](const Setting& member) {
      return member.name == "pieces" || member.name == "points" || member.name == "symmetry";
    });
    if (nothing && !condition.symmetry)
      diagnostics.add(Mistake::missing_key, table.where, table.path,
                      "sets nothing, expected symmetry = true, velocity, displacement, traction, pressure, "
                      "temperature, heat_flux or convection");
    for (const char* key : {"temperature", "heat_flux", "convection"})
      if (const Setting* thermal = table.find(key); thermal && !result.analysis.thermal)
        diagnostics.add(Mistake::conflict, thermal->where, thermal->path,
                        "found a thermal condition, expected it with analysis.thermal = true only");
    if (condition.symmetry)
      for (const std::string& piece : condition.pieces)
        if (!is_straight(result.domain, piece))
          diagnostics.add(
              Mistake::geometry, table.find("symmetry")->where, table.find("symmetry")->path,
              fmt::format("found piece '{}', which is not straight, expected straight pieces", piece));
    claim_all(table, condition, claims);
    result.boundary.push_back(std::move(condition));
  }
}

} // namespace cnem::input
