// What a calibration leaves behind for programs and for cases.
#include "input/schema/document.hpp"
#include "input/schema/settings.hpp"
#include "results/json_number.hpp"
#include "study/calibration.hpp"
#include "study/calibration_report.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::study {
namespace {

using Json = nlohmann::ordered_json;

Json list_of(const Eigen::VectorXd& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(results::json_number(value));
  return list;
}

Json rows_of(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index k = 0; k < matrix.rows(); ++k) rows.push_back(list_of(matrix.row(k).transpose()));
  return rows;
}

double value_of(const Calibration& calibration, std::size_t k, double place) {
  return calibration.constants[k].at(place);
}

/// A key as TOML writes it after a dot: bare where it can be.
std::string dotted(const std::string& key) {
  std::string text;
  for (std::size_t from = 0; from <= key.size();) {
    const std::size_t to = std::min(key.find('.', from), key.size());
    const std::string part = key.substr(from, to - from);
    text += (text.empty() ? "" : ".") + (input::valid_name(part) ? part : input::toml_quoted(part));
    from = to + 1;
  }
  return text;
}

/// A title as a comment of TOML can have it: in one line.
std::string in_a_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return text;
}

std::string constants_text(const Calibration& calibration, const CalibrationResult& result) {
  std::string text = fmt::format(
      "# Constants found by `cnem calibrate`, {}: misfit {:.3g}% of the measured peaks, {} at the "
      "start.\n"
      "# Values of a case stand before those of what it includes. To use these, a case of two lines:\n"
      "#   include = [\"case.toml\", \"calibrated.toml\"]\n",
      in_a_line(calibration.title.empty() ? calibration.name : calibration.title),
      100.0 * std::sqrt(result.best.misfit),
      result.start.good() ? fmt::format("{:.3g}%", 100.0 * std::sqrt(result.start.misfit)) : "failed");
  for (std::size_t k = 0; k < calibration.constants.size(); ++k) {
    const SoughtConstant& constant = calibration.constants[k];
    const std::string value =
        constant.text(value_of(calibration, k, result.best.place[static_cast<Eigen::Index>(k)]), 8);
    text += fmt::format("{} = {}{}\n", dotted(constant.key),
                        constant.unit_text.empty() ? value : input::toml_quoted(value),
                        result.inference.told[k] ? "" : " # not told by the curves");
  }
  return text;
}

Json json_of(const Calibration& calibration, const CalibrationResult& result,
             const std::vector<FlowBand>& bands, const std::string& version) {
  const Inference& inference = result.inference;
  Json json{{"calibration", calibration.name},
            {"version", version},
            {"evaluations", result.evaluations},
            {"failures", result.failures}};
  json["misfit"] = {
      {"start", result.start.good() ? results::json_number(std::sqrt(result.start.misfit)) : Json(nullptr)},
      {"best", results::json_number(std::sqrt(result.best.misfit))}};
  Json& constants = json["constants"] = Json::object();
  for (std::size_t k = 0; k < calibration.constants.size(); ++k) {
    const SoughtConstant& constant = calibration.constants[k];
    const auto at = static_cast<Eigen::Index>(k);
    const double place = result.best.place[at], width = inference.half_width[at];
    Json& one = constants[constant.name] = Json{{"key", constant.key},
                                                {"unit", constant.si_unit},
                                                {"value", value_of(calibration, k, place)},
                                                {"start", constant.start},
                                                {"low", constant.low},
                                                {"high", constant.high},
                                                {"told", static_cast<bool>(inference.told[k])}};
    one["interval"] =
        inference.told[k] && inference.intervals()
            ? Json{value_of(calibration, k, place - width), value_of(calibration, k, place + width)}
            : Json(nullptr);
  }
  Json& curves = json["curves"] = Json::array();
  for (const CalibratedCurve& curve : result.best.curves) {
    const CalibratedCurve* before = result.start.curve(curve.name);
    Json& one = curves.emplace_back();
    one = {{"name", curve.name},
           {"fitted", curve.fitted},
           {"rms_share_start", before ? results::json_number(before->rms_share) : Json(nullptr)},
           {"rms_share", results::json_number(curve.rms_share)}};
    if (!curve.single_number()) continue;
    one["unit"] = curve.y_unit;
    one["measured"] = curve.measured.y.front();
    one["standard_error"] = curve.relative_error * curve.peak;
    one["start"] = before ? results::json_number(before->computed.y.front()) : Json(nullptr);
    one["computed"] = results::json_number(curve.computed.y.front());
  }
  json["singular_values"] = list_of(inference.singular);
  json["logarithmic_singular_values"] = list_of(result.logarithmic);
  json["directions"] = rows_of(inference.directions.transpose());
  json["covariance_of_places"] = rows_of(inference.covariance);
  json["independent_residuals"] = inference.independent;
  json["degrees_of_freedom"] = inference.degrees;
  json["not_told"] = inference.words;
  json["warnings"] = warnings_of(calibration, result);
  Json& flow = json["flow_stress"] = Json::array();
  for (const FlowBand& band : bands)
    flow.push_back({{"name", band.name},
                    {"rate[1/s]", band.rate},
                    {"temperature[K]", band.temperature},
                    {"strain", band.strain},
                    {"stress[Pa]", band.stress},
                    {"half_width[Pa]", band.half_width}});
  return json;
}

std::string course_table(const Calibration& calibration, const CalibrationResult& result) {
  std::string csv = "start,evaluation,misfit";
  for (const SoughtConstant& constant : calibration.constants)
    csv += constant.si_unit.empty() ? fmt::format(",{}", constant.name)
                                    : fmt::format(",{}[{}]", constant.name, constant.si_unit);
  for (std::size_t s = 0; s < result.searches.size(); ++s)
    for (std::size_t k = 0; k < result.searches[s].course.size(); ++k) {
      const VisitedPlace& visited = result.searches[s].course[k];
      csv += fmt::format("\n{},{},{}", s + 1, k + 1, input::format_number(std::sqrt(visited.misfit)));
      for (std::size_t c = 0; c < calibration.constants.size(); ++c)
        csv += fmt::format(",{}", input::format_number(
                                      value_of(calibration, c, visited.place[static_cast<Eigen::Index>(c)])));
    }
  return csv + "\n";
}

} // namespace

CalibrationFiles calibration_files(const Calibration& calibration, const CalibrationResult& result,
                                   const std::vector<FlowBand>& bands, const std::string& version) {
  return {.constants = constants_text(calibration, result),
          .json = json_of(calibration, result, bands, version).dump(1) + "\n",
          .table = course_table(calibration, result),
          .report = calibration_report(calibration, result, bands, version)};
}

} // namespace cnem::study
