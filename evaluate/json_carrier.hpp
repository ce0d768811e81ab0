#pragma once
// Records out to JSON and in from it, with each member named once: carry(name, member) for both ways. Numbers
// that are not finite are null. And files of them that are read back.
#include "core/error.hpp"
#include "results/json_number.hpp"
#include "results/output_folder.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace cnem::evaluate {

using Json = nlohmann::ordered_json;

class JsonWriter {
public:
  void operator()(const char* name, const std::string& value) { json[name] = value; }
  void operator()(const char* name, double value) { json[name] = results::json_number(value); }
  void operator()(const char* name, bool value) { json[name] = value; }
  template<class Value> void newer(const char* name, const Value& value) { (*this)(name, value); }
  Json json = Json::object();
};

class JsonReader {
public:
  explicit JsonReader(const Json& from) : json(from) {}
  void operator()(const char* name, std::string& value) { value = json.at(name).get<std::string>(); }
  void operator()(const char* name, double& value) {
    const Json& number = json.at(name);
    value = number.is_null() ? std::numeric_limits<double>::quiet_NaN() : number.get<double>();
  }
  void operator()(const char* name, bool& value) { value = json.at(name).get<bool>(); }
  /// What files of older versions lack.
  template<class Value> void newer(const char* name, Value& value) {
    if (json.contains(name)) (*this)(name, value);
  }
  const Json& json;
};

template<class Record, class Carry> Json list_of(const std::vector<Record>& records, const Carry& carry) {
  Json list = Json::array();
  for (const Record& record : records) {
    JsonWriter writer;
    carry(record, writer);
    list.push_back(std::move(writer.json));
  }
  return list;
}

template<class Record, class Carry> std::vector<Record> records_of(const Json& list, const Carry& carry) {
  std::vector<Record> records;
  for (const Json& json : list) {
    JsonReader reader(json);
    carry(records.emplace_back(), reader);
  }
  return records;
}

/// read(json) of an evaluation that a run has left in a file; empty when there is no such file. Throws
/// IoError when it cannot be read.
template<class Read>
auto read_evaluation(const std::filesystem::path& path, const Read& read)
    -> std::optional<decltype(read(Json()))> {
  if (!std::filesystem::exists(path)) return std::nullopt;
  const std::string text = results::read_file(path);
  try {
    return read(Json::parse(text));
  } catch (const Json::exception& error) {
    throw IoError(
        fmt::format("{} is not what an evaluation of a run leaves: {}", path.string(), error.what()));
  }
}

} // namespace cnem::evaluate
