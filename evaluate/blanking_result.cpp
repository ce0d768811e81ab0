#include "evaluate/blanking_result.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "evaluate/json_carrier.hpp"
#include "results/output_folder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace cnem::evaluate {
namespace {

constexpr std::array<const char*, 9> zone_names{
    "surface", "rollover", "burnish", "broken", "fracture", "second_burnish", "hole", "burr", "burr_side"};

template<class Face, class Carry> void carry_face(Face& face, Carry& carry) {
  carry("cut", face.cut);
  carry("body", face.body);
  carry.newer("angle[rad]", face.angle);
  carry("parted", face.parted);
  carry.newer("measured", face.measured);
  carry("note", face.note);
  carry("thickness[m]", face.thickness);
  carry("rollover[m]", face.rollover);
  carry("rollover_width[m]", face.rollover_width);
  carry("burnish[m]", face.burnish);
  carry.newer("broken[m]", face.broken);
  carry("fracture[m]", face.fracture);
  carry("second_burnish[m]", face.second_burnish);
  carry.newer("hole[m]", face.hole);
  carry("burr[m]", face.burr);
  carry("fracture_angle[rad]", face.fracture_angle);
  carry("tilt[rad]", face.tilt);
}

template<class Heights, class Carry> void carry_measured(Heights& heights, Carry& carry) {
  carry("cut", heights.cut);
  carry("body", heights.body);
  carry("rollover[m]", heights.rollover);
  carry("burnish[m]", heights.burnish);
  carry("fracture[m]", heights.fracture);
  carry("burr[m]", heights.burr);
  carry("fracture_angle[rad]", heights.fracture_angle);
}

template<class Force, class Carry> void carry_force(Force& force, Carry& carry) {
  carry("tool", force.tool);
  carry("largest", force.largest);
  carry("stroke[m]", force.stroke);
  carry("largest_sample", force.largest_sample);
  carry("work", force.work);
}

template<class Body, class Carry> void carry_body(Body& body, Carry& carry) {
  carry("body", body.body);
  carry("largest[m]", body.largest);
  carry("angle_before[rad]", body.angle_before);
  carry("angle_change[rad]", body.angle_change);
  carry("dishing_before[m]", body.dishing_before);
  carry("dishing_change[m]", body.dishing_change);
}

template<class Result, class Carry> void carry_result(Result& result, Carry& carry) {
  carry("punch", result.punch);
  carry("direction_x", result.direction_x);
  carry("direction_y", result.direction_y);
  carry.newer("direction_z", result.direction_z);
  carry("stroke[m]", result.stroke);
  carry("time[s]", result.time);
  carry("smoothing[m]", result.smoothing);
  carry("parallel[rad]", result.parallel);
  carry("force_unit", result.force_unit);
  carry("work_unit", result.work_unit);
  carry.newer("cut_length", result.cut_length);
  carry("note", result.note);
}

constexpr auto face_carrier = [](auto& face, auto& carry) { carry_face(face, carry); };
constexpr auto measured_carrier = [](auto& heights, auto& carry) { carry_measured(heights, carry); };
constexpr auto force_carrier = [](auto& force, auto& carry) { carry_force(force, carry); };
constexpr auto body_carrier = [](auto& body, auto& carry) { carry_body(body, carry); };

std::size_t zone_index(const std::string& name) {
  for (std::size_t k = 0; k < zone_names.size(); ++k)
    if (name == zone_names[k]) return k;
  throw IoError(fmt::format("there is no zone '{}'", name));
}

} // namespace

const char* zone_name(Zone zone) { return zone_names[static_cast<std::size_t>(zone)]; }

std::vector<std::vector<const ShearedFace*>> faces_of_bodies(const BlankingResult& result) {
  std::vector<std::vector<const ShearedFace*>> bodies;
  for (const ShearedFace& face : result.faces) {
    const auto same = [&](const std::vector<const ShearedFace*>& body) {
      return body.front()->cut == face.cut && body.front()->body == face.body;
    };
    const auto known = std::find_if(bodies.begin(), bodies.end(), same);
    (known == bodies.end() ? bodies.emplace_back() : *known).push_back(&face);
  }
  return bodies;
}

RoundHeight round_height(const std::vector<const ShearedFace*>& faces, double ShearedFace::*size) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (const ShearedFace* face : faces)
    if (face->measured && std::isfinite(face->*size)) {
      sum += face->*size;
      count += 1.0;
    }
  if (count == 0.0) return {std::nan(""), std::nan("")};
  const double mean = sum / count;
  for (const ShearedFace* face : faces)
    if (face->measured && std::isfinite(face->*size)) squares += (face->*size - mean) * (face->*size - mean);
  return {mean, std::sqrt(squares / count)};
}

namespace {

using Metrics = std::vector<std::pair<std::string, double>>;

/// One body at one cut: in the plane a face, in space its mean and spread round the punch.
void add_body(const BlankingResult& result, const std::vector<const ShearedFace*>& faces, Metrics& metrics) {
  const ShearedFace& first = *faces.front();
  const bool round = std::isfinite(first.angle);
  const std::string at = first.cut.empty() ? fmt::format("blanking.{}", first.body)
                                           : fmt::format("blanking.{}.{}", first.cut, first.body);
  const auto parted =
      static_cast<double>(std::count_if(faces.begin(), faces.end(), [](auto* face) { return face->parted; }));
  metrics.emplace_back(at + ".parted", parted / static_cast<double>(faces.size()));
  if (std::none_of(faces.begin(), faces.end(), [](auto* face) { return face->measured; })) return;
  const auto add = [&](const std::string& name, const char* unit, double ShearedFace::*size) {
    const RoundHeight height = round_height(faces, size);
    if (!std::isfinite(height.mean)) return height.mean;
    metrics.emplace_back(fmt::format("{}.{}[{}]", at, name, unit), height.mean);
    if (round) metrics.emplace_back(fmt::format("{}.{}_spread[{}]", at, name, unit), height.spread);
    return height.mean;
  };
  const double thickness = round_height(faces, &ShearedFace::thickness).mean;
  for (const auto& [name, size] : {std::pair{"rollover", &ShearedFace::rollover},
                                   {"burnish", &ShearedFace::burnish},
                                   {"broken", &ShearedFace::broken},
                                   {"fracture", &ShearedFace::fracture},
                                   {"second_burnish", &ShearedFace::second_burnish},
                                   {"hole", &ShearedFace::hole},
                                   {"burr", &ShearedFace::burr}})
    metrics.emplace_back(fmt::format("{}.{}_share", at, name), add(name, "m", size) / thickness);
  add("rollover_width", "m", &ShearedFace::rollover_width);
  add("fracture_angle", "rad", &ShearedFace::fracture_angle);
  if (const MeasuredHeights* measured = measured_of(result, first))
    for (const auto& [name, there, size] :
         {std::tuple{"rollover", measured->rollover, &ShearedFace::rollover},
          {"burnish", measured->burnish, &ShearedFace::burnish},
          {"fracture", measured->fracture, &ShearedFace::fracture},
          {"burr", measured->burr, &ShearedFace::burr}})
      if (std::isfinite(there)) {
        metrics.emplace_back(fmt::format("{}.{}_measured[m]", at, name), there);
        metrics.emplace_back(fmt::format("{}.{}_difference[m]", at, name),
                             round_height(faces, size).mean - there);
      }
}

} // namespace

Metrics metrics_of(const BlankingResult& result) {
  Metrics metrics;
  metrics.emplace_back("blanking.stroke[m]", result.stroke);
  for (const ToolForce& force : result.forces) {
    metrics.emplace_back(fmt::format("blanking.largest_force.{}[{}]", force.tool, result.force_unit),
                         force.largest);
    metrics.emplace_back(fmt::format("blanking.stroke_at_largest_force.{}[m]", force.tool), force.stroke);
    metrics.emplace_back(fmt::format("blanking.work.{}[{}]", force.tool, result.work_unit), force.work);
  }
  for (const std::vector<const ShearedFace*>& faces : faces_of_bodies(result))
    add_body(result, faces, metrics);
  return metrics;
}

const MeasuredHeights* measured_of(const BlankingResult& result, const ShearedFace& face) {
  for (const MeasuredHeights& heights : result.measured)
    if (heights.cut == face.cut && heights.body == face.body) return &heights;
  return nullptr;
}

Metrics metrics_of(const std::vector<BodySpringback>& bodies) {
  Metrics metrics;
  double largest = 0.0;
  for (const BodySpringback& body : bodies) largest = std::max(largest, body.largest);
  metrics.emplace_back("springback.largest[m]", largest);
  for (const BodySpringback& body : bodies) {
    const std::string at = fmt::format("springback.{}", body.body);
    metrics.emplace_back(at + ".largest[m]", body.largest);
    if (std::isfinite(body.angle_change)) metrics.emplace_back(at + ".angle_change[rad]", body.angle_change);
    if (std::isfinite(body.dishing_change))
      metrics.emplace_back(at + ".dishing_change[m]", body.dishing_change);
  }
  return metrics;
}

void write_blanking(const std::filesystem::path& folder, const BlankingResult& result) {
  JsonWriter writer;
  carry_result(result, writer);
  Json& json = writer.json;
  json["dies"] = result.dies;
  json["forces"] = list_of(result.forces, force_carrier);
  json["measured"] = list_of(result.measured, measured_carrier);
  json["springback"] = list_of(result.springback, body_carrier);
  json["faces"] = list_of(result.faces, face_carrier);
  for (std::size_t k = 0; k < result.faces.size(); ++k) {
    Json& profile = json["faces"][k]["profile[m]"] = Json::array();
    for (const Vec2& x : result.faces[k].profile) profile.push_back({x.x(), x.y()});
    Json& zones = json["faces"][k]["zone"] = Json::array();
    for (const Zone zone : result.faces[k].zone) zones.push_back(zone_name(zone));
  }
  results::write_atomically(folder / results::files::blanking, json.dump(1) + "\n");
}

std::optional<BlankingResult> read_blanking(const std::filesystem::path& folder) {
  return read_evaluation(folder / results::files::blanking, [](const Json& json) {
    BlankingResult result;
    JsonReader reader(json);
    carry_result(result, reader);
    result.dies = json.at("dies").get<std::vector<std::string>>();
    result.forces = records_of<ToolForce>(json.at("forces"), force_carrier);
    if (json.contains("measured")) // folders of earlier versions have none
      result.measured = records_of<MeasuredHeights>(json.at("measured"), measured_carrier);
    result.springback = records_of<BodySpringback>(json.at("springback"), body_carrier);
    result.faces = records_of<ShearedFace>(json.at("faces"), face_carrier);
    for (std::size_t k = 0; k < result.faces.size(); ++k) {
      const Json& face = json.at("faces")[k];
      for (const Json& x : face.at("profile[m]"))
        result.faces[k].profile.emplace_back(x.at(0).get<double>(), x.at(1).get<double>());
      for (const Json& zone : face.at("zone"))
        result.faces[k].zone.push_back(static_cast<Zone>(zone_index(zone.get<std::string>())));
    }
    return result;
  });
}

} // namespace cnem::evaluate
