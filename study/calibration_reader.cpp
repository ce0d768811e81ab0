// The file of a calibration.
#include "core/error.hpp"
#include "core/index.hpp"
#include "input/case_reader.hpp"
#include "input/measured_file.hpp"
#include "input/schema/nearest.hpp"
#include "input/schema/settings.hpp"
#include "results/output_folder.hpp"
#include "study/calibration_reader_parts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::study {
namespace fs = std::filesystem;
namespace {

using Kind = input::Value::Kind;
using input::Mistake;

class CalibrationReader {
public:
  CalibrationReader(std::string_view text, const fs::path& path)
      : root_(input::parse_document(text, path.string())), folder_(path.parent_path()),
        table_(root_, "",
               {"title", "case", "set", "parameters", "targets", "cuts", "evaluations", "starts", "tolerance",
                "processes", "threads"},
               diagnostics_) {
    result_.name = input::name_after(path, "calibration");
  }

  Calibration read() {
    result_.title = table_.text("title");
    result_.evaluations = table_.count("evaluations", result_.evaluations);
    result_.starts = table_.count("starts", result_.starts);
    result_.processes = table_.count("processes", 0);
    result_.threads = table_.count("threads", 1);
    if (const auto tolerance = number(table_, root_, "", "tolerance", input::Dimension{}))
      result_.tolerance = tolerance->si;
    if (!(result_.tolerance > 0.0 && result_.tolerance < 1.0))
      table_.wrong("tolerance", root_.find("tolerance")->value, "a number between 0 and 1");
    if (root_.find("case")) case_ = case_file(table_, root_);
    closed_form_ = choice(table_, root_, "cuts", {"run", "shear-zone"}) == "shear-zone";
    if (const input::Value* set = table_.find("set", Kind::table, "a table of keys of the cases"))
      set_ = read_set(*set, "set.", diagnostics_);
    for_each_table("parameters", "[parameters.NAME]",
                   [&](const input::Member& member) { read_constant(member); });
    for_each_table("targets", "[targets.NAME]", [&](const input::Member& member) { read_target(member); });
    check_keys();
    check_weights();
    diagnostics_.throw_if_any();
    check_budget();
    read_cases();
    return std::move(result_);
  }

private:
  template<class F> void for_each_table(const char* key, const char* expected, F&& act) {
    const input::Value* tables = table_.require(key, Kind::table, std::string("tables ") + expected);
    if (!tables) return;
    if (tables->members.empty())
      diagnostics_.add(Mistake::missing_key, tables->where, key,
                       fmt::format("found none, expected {}", expected));
    for (const input::Member& member : tables->members) {
      if (!input::valid_name(member.key))
        diagnostics_.add(Mistake::type, member.where, key,
                         fmt::format("found the name '{}', expected letters, digits, '_' and '-'",
                                     input::shortened(member.key)));
      else if (member.value.kind == Kind::table)
        act(member);
      else
        diagnostics_.add(Mistake::type, member.where, fmt::format("{}.{}", key, member.key),
                         fmt::format("found {}, expected a table {}", member.value.show(), expected));
    }
  }

  std::optional<WrittenNumber> number(TableReader& reader, const input::Value& table, const std::string& path,
                                      const std::string& key, std::optional<input::Dimension> dimension) {
    return read_number(reader, table, path, key, dimension, diagnostics_);
  }

  fs::path case_file(TableReader& reader, const input::Value& table) {
    const input::Value* name = reader.require("case", Kind::text, "the case file or its folder");
    if (!name) return {};
    fs::path file = (folder_ / name->text).lexically_normal();
    if (fs::is_directory(file)) file /= "case.toml";
    if (!fs::exists(file))
      diagnostics_.add(Mistake::reference, table.find("case")->where, "case",
                       fmt::format("there is no file {}, expected a case file or its folder, seen from the "
                                   "folder of the calibration",
                                   file.string()));
    return file;
  }

  std::string choice(TableReader& reader, const input::Value& table, const std::string& key,
                     const std::vector<std::string>& choices) {
    const std::string text = reader.text(key);
    if (text.empty()) return choices.front();
    if (std::find(choices.begin(), choices.end(), text) == choices.end())
      reader.wrong(
          key, table.find(key)->value,
          fmt::format("one of \"{}\"{}", fmt::join(choices, "\", \""), input::did_you_mean(text, choices)));
    return text;
  }

  void read_constant(const input::Member& member) {
    const std::string path = fmt::format("parameters.{}.", member.key);
    const input::Value& table = member.value;
    TableReader reader(table, path, {"key", "low", "high", "start", "scale"}, diagnostics_);
    SoughtConstant constant;
    constant.name = member.key;
    constant.where = member.where;
    if (reader.require("key", Kind::text,
                       "a key of the cases such as \"materials.steel.plastic.A\", or "
                       "\"let.NAME\""))
      constant.key = reader.text("key");
    std::optional<input::Dimension> dimension;
    int known = 0;
    for (const auto& [key, value] :
         {std::pair{"start", &constant.start}, {"low", &constant.low}, {"high", &constant.high}}) {
      if (!table.find(key)) {
        diagnostics_.add(Mistake::missing_key, member.where, path + key,
                         "missing, expected a number with its unit such as \"250 MPa\"");
        continue;
      }
      const auto written = number(reader, table, path, key, dimension);
      if (!written) continue;
      *value = written->si;
      ++known;
      if (dimension) continue;
      dimension = written->unit.dimension;
      constant.unit = written->unit;
      constant.unit_text = written->unit_text;
      if (!dimension->dimensionless()) constant.si_unit = input::describe(*dimension).si_unit;
    }
    constant.logarithmic = choice(reader, table, "scale", {"linear", "log"}) == "log";
    const bool ordered =
        constant.low < constant.high && constant.start >= constant.low && constant.start <= constant.high;
    if (known == 3 && !ordered)
      diagnostics_.add(Mistake::range, member.where, path + "start",
                       fmt::format("found {} between {} and {}, expected low < high and a start between them",
                                   constant.text(constant.start), constant.text(constant.low),
                                   constant.text(constant.high)));
    if (known == 3 && constant.logarithmic && !(constant.low > 0.0))
      diagnostics_.add(
          Mistake::range, member.where, path + "low",
          fmt::format("found {}, expected more than 0 with scale = \"log\"", constant.text(constant.low)));
    result_.constants.push_back(std::move(constant));
  }

  void read_target(const input::Member& member) {
    const std::string path = fmt::format("targets.{}.", member.key);
    const input::Value& table = member.value;
    TableReader reader(table, path,
                       {"case", "set", "weight", "file", "columns", "units", "material", "test", "rate",
                        "temperature", "heating", "strain", "Fc", "Fc_error", "Ft", "Ft_error",
                        "chip_thickness", "chip_thickness_error"},
                       diagnostics_);
    CalibrationTarget target;
    target.name = member.key;
    target.where = member.where;
    target.set = set_;
    target.case_file = case_;
    if (table.find("case") || case_.empty()) target.case_file = case_file(reader, table);
    if (const input::Value* set = reader.find("set", Kind::table, "a table of keys of the case"))
      for (input::Override& change : read_set(*set, path + "set.", diagnostics_))
        target.set.push_back(std::move(change));
    if (const auto weight = number(reader, table, path, "weight", input::Dimension{}))
      target.weight = weight->si;
    if (!(target.weight >= 0.0)) reader.wrong("weight", table.find("weight")->value, "0 or more");
    target.cut = read_cut(reader, table, path, closed_form_, diagnostics_);
    if (table.find("file") && target.cut)
      diagnostics_.add(Mistake::conflict, table.find("file")->where, path + "file",
                       "found beside numbers of a cut, expected a curve or a cut");
    if (table.find("file"))
      target.point = read_point(reader, table, path);
    else
      for (const char* key :
           {"columns", "units", "material", "test", "rate", "temperature", "heating", "strain"})
        if (const input::Member* beside = table.find(key))
          diagnostics_.add(Mistake::conflict, beside->where, path + key,
                           "found without a file, expected it with the curve of a single point");
    result_.targets.push_back(std::move(target));
  }

  PointTarget read_point(TableReader& reader, const input::Value& table, const std::string& path) {
    using evaluate::PointTest;
    PointTarget point;
    point.material = reader.text("material");
    const std::string test = choice(reader, table, "test", {"tension", "compression", "shear"});
    point.test.kind = test == "shear"         ? PointTest::Kind::shear
                      : test == "compression" ? PointTest::Kind::compression
                                              : PointTest::Kind::tension;
    point.test.adiabatic = choice(reader, table, "heating", {"isothermal", "adiabatic"}) == "adiabatic";
    point.test.plastic = choice(reader, table, "strain", {"total", "plastic"}) == "plastic";
    for (const auto& [key, value, dimension] :
         {std::tuple{"rate", &point.test.rate, input::dimension::rate},
          {"temperature", &point.test.temperature, input::dimension::temperature}}) {
      if (!table.find(key))
        diagnostics_.add(Mistake::missing_key, table.where, path + key,
                         fmt::format("missing, expected {} such as \"{}\"", input::describe(dimension).name,
                                     input::describe(dimension).example));
      else if (const auto written = number(reader, table, path, key, dimension))
        *value = written->si;
    }
    if (!(point.test.rate > 0.0)) reader.wrong("rate", table.find("rate")->value, "a rate above 0");
    input::MeasuredColumns columns;
    columns.expected = {std::vector{input::Dimension{}}, std::vector{input::dimension::pressure}};
    columns.words = {"a strain", "a stress"};
    columns.examples = {"strain", "stress[MPa]"};
    columns.names = reader.texts("columns");
    const std::vector<std::string> units = reader.texts("units");
    for (std::size_t c = 0; c < std::min<std::size_t>(2, units.size()); ++c) {
      try {
        columns.units[c] = units[c] == "1" || units[c] == "-" ? input::Unit{} : input::parse_unit(units[c]);
      } catch (const input::UnitError& error) {
        diagnostics_.add(Mistake::unit, table.where, path + "units", error.what());
      }
    }
    for (const auto& [key, size] : {std::pair{"columns", columns.names.size()}, {"units", units.size()}})
      if (size != 0 && size != 2) reader.wrong(key, table.find(key)->value, "two of them");
    const input::Value* file = reader.find("file", Kind::text, "a CSV file");
    if (!file || !diagnostics_.empty()) return point;
    try {
      const std::string name = (folder_ / file->text).string();
      input::MeasuredCurve curve = input::read_measured(name, columns);
      if (const std::string gone = input::keep_growing(curve.x, curve.y, name, "strain"); !gone.empty())
        result_.warnings.push_back(path + "file: " + gone);
      point.measured = {std::move(curve.x), std::move(curve.y)};
      point.test.strain = point.measured.x.back();
      const double most = *std::max_element(point.measured.y.begin(), point.measured.y.end());
      if (!(point.test.strain > 0.0 && most > 0.0))
        diagnostics_.add(Mistake::range, file->where, path + "file",
                         "found no positive strain and stress, expected both as positive numbers, of "
                         "compression too");
    } catch (const InputError& error) {
      diagnostics_.add(Mistake::reference, file->where, path + "file", error.what());
    }
    return point;
  }

  /// Each key has one value: looked for, or set.
  void check_keys() {
    const auto look_at = [&](const std::vector<input::Override>& set, const std::string& path) {
      for (const input::Override& change : set)
        for (const SoughtConstant& constant : result_.constants)
          if (change.key == constant.key)
            diagnostics_.add(
                Mistake::conflict, change.where, path + change.key,
                fmt::format("found set where parameters.{} ({}) looks for it, expected one of them",
                            constant.name, constant.where.text()));
    };
    look_at(set_, "set.");
    for (const CalibrationTarget& target : result_.targets) {
      const std::vector<input::Override> own(target.set.begin() + as<std::ptrdiff_t>(set_.size()),
                                             target.set.end());
      look_at(own, fmt::format("targets.{}.set.", target.name));
    }
    for (std::size_t k = 0; k < result_.constants.size(); ++k)
      for (std::size_t other = 0; other < k; ++other) {
        const SoughtConstant &constant = result_.constants[k], &first = result_.constants[other];
        if (!constant.key.empty() && constant.key == first.key)
          diagnostics_.add(Mistake::conflict, constant.where, fmt::format("parameters.{}.key", constant.name),
                           fmt::format("found '{}', which parameters.{} ({}) looks for, expected another key",
                                       constant.key, first.name, first.where.text()));
      }
  }

  void check_weights() {
    const auto& targets = result_.targets;
    if (!targets.empty() &&
        std::none_of(targets.begin(), targets.end(), [](const auto& target) { return target.weight != 0.0; }))
      diagnostics_.add(Mistake::conflict, root_.find("targets")->where, "targets",
                       "found all of them with weight = 0, expected one at least that is fitted");
  }

  void check_budget() {
    const auto least = static_cast<int>(2 * std::max<std::size_t>(2, result_.constants.size()) + 2);
    if (result_.evaluations / result_.starts < least)
      throw InputError(fmt::format(
          "{}: key 'evaluations': found {} for {} starts, expected at least {} each: a quadratic model of {} "
          "constants needs as many",
          root_.where.text(), result_.evaluations, result_.starts, least, result_.constants.size()));
  }

  /// The cases at the start and at both bounds of each constant: a mistake shows before anything runs.
  void read_cases() {
    for (CalibrationTarget& target : result_.targets) {
      try {
        const auto n = static_cast<Eigen::Index>(result_.constants.size());
        Eigen::VectorXd start(n);
        for (Eigen::Index k = 0; k < n; ++k) {
          const SoughtConstant& constant = result_.constants[index_of(k)];
          start[k] = constant.place_of(constant.start);
        }
        const input::Case input =
            input::read_case_with(target.case_file.string(), result_.changes(target, start));
        if (!target.point)
          for (const std::string& warning : input.warnings)
            result_.warnings.push_back(fmt::format("target '{}': {}", target.name, warning));
        for (Eigen::Index k = 0; k < n; ++k)
          for (const double bound : {0.0, 1.0}) {
            Eigen::VectorXd place = start;
            place[k] = bound;
            input::read_case_with(target.case_file.string(), result_.changes(target, place));
          }
        finish(target, input);
      } catch (const InputError& error) {
        throw InputError(fmt::format("{}\nin target '{}' of the calibration", error.what(), target.name));
      }
    }
  }

  void finish(CalibrationTarget& target, const input::Case& input) {
    if (target.cut) {
      const bool fits =
          target.cut->closed_form ? input.cutting.has_value() : input.report.cutting.has_value();
      if (!fits)
        throw InputError(
            fmt::format("{}: key 'targets.{}': the case {} has no {}, expected it for the numbers "
                        "of a cut",
                        target.where.text(), target.name, target.case_file.string(),
                        target.cut->closed_form ? "[cutting]" : "[report.cutting]"));
      return;
    }
    if (!target.point) {
      if (input.report.experiments.empty())
        throw InputError(
            fmt::format("{}: key 'targets.{}': the case {} has no [report.experiment], expected "
                        "a measured curve in it, `file` for the curve of a single point, or `Fc`, `Ft` or "
                        "`chip_thickness` of a cut",
                        target.where.text(), target.name, target.case_file.string()));
      return;
    }
    if (target.point->material.empty()) target.point->material = input.domain.material;
    std::vector<std::string> names;
    for (const plasticity::Material& material : input.materials) names.push_back(material.name);
    if (std::find(names.begin(), names.end(), target.point->material) == names.end())
      throw InputError(fmt::format("{}: key 'targets.{}.material': found '{}', expected a material of the "
                                   "case{}",
                                   target.where.text(), target.name, target.point->material,
                                   input::did_you_mean(target.point->material, names)));
    const plasticity::Material& material = input.material(target.point->material);
    if (target.point->test.adiabatic && !(material.specific_heat > 0.0))
      throw InputError(
          fmt::format("{}: key 'targets.{}.heating': found \"adiabatic\" of material '{}' without "
                      "[materials.{}.heat], expected its specific heat",
                      target.where.text(), target.name, material.name, material.name));
  }

  input::Value root_;
  fs::path folder_, case_;
  bool closed_form_ = false; ///< of cuts
  input::Diagnostics diagnostics_;
  TableReader table_;
  std::vector<input::Override> set_;
  Calibration result_;
};

} // namespace

Calibration read_calibration(const fs::path& path) {
  const fs::path file = fs::is_directory(path) ? path / "calibration.toml" : path;
  if (!fs::exists(file))
    throw InputError(
        fmt::format("{}: no such file, expected a calibration such as calibration.toml", file.string()));
  return CalibrationReader(results::read_file(file), file).read();
}

} // namespace cnem::study
