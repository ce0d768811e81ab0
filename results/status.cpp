#include "results/status.hpp"

#include "core/error.hpp"
#include "results/history_writer.hpp"
#include "results/json_number.hpp"
#include "results/output_folder.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <sys/resource.h>

namespace cnem::results {
namespace {

using Json = nlohmann::ordered_json;
using Pairs = std::vector<std::pair<std::string, double>>;

double as_number(const Json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

Json object(const Pairs& pairs) {
  Json json = Json::object();
  for (const auto& [name, value] : pairs) json[name] = json_number(value);
  return json;
}

// "a.b" → {"a": {"b": …}}
Json tree(const Pairs& pairs, const std::vector<std::string>& flags) {
  Json json = Json::object();
  for (const auto& [name, value] : pairs) {
    Json* at = &json;
    std::size_t from = 0;
    for (std::size_t dot; (dot = name.find('.', from)) != std::string::npos; from = dot + 1) {
      at = &(*at)[name.substr(from, dot - from)];
      if (!at->is_object()) *at = Json::object();
    }
    const bool flag = std::find(flags.begin(), flags.end(), name) != flags.end();
    (*at)[name.substr(from)] = flag ? Json(value != 0.0) : json_number(value);
  }
  return json;
}

void flatten(const Json& json, const std::string& prefix, Pairs& pairs, std::vector<std::string>& flags) {
  for (const auto& [name, value] : json.items())
    if (value.is_object()) {
      flatten(value, prefix + name + ".", pairs, flags);
    } else if (value.is_boolean()) {
      pairs.emplace_back(prefix + name, value.get<bool>() ? 1.0 : 0.0);
      flags.push_back(prefix + name);
    } else {
      pairs.emplace_back(prefix + name, as_number(value));
    }
}

} // namespace

void RunStatus::add_metric(std::string_view column, double value) {
  ColumnName name = split_column_name(column);
  if (!name.unit.empty()) metric_units[name.name] = name.unit;
  metrics.emplace_back(std::move(name.name), value);
}

std::optional<double> RunStatus::metric(std::string_view name) const {
  for (const auto& [known, value] : metrics)
    if (known == name) return value;
  return std::nullopt;
}

std::string RunStatus::unit_of(const std::string& metric) const {
  const auto found = metric_units.find(metric);
  return found == metric_units.end() ? "" : found->second;
}

std::string status_json(const RunStatus& status) {
  Json json;
  json["exit"] = status.exit;
  json["reason"] = status.reason;
  json["version"] = status.version;
  json["case"] = status.case_name;
  json["time"] = json_number(status.time);
  json["steps"] = status.steps;
  json["nodes"] = status.nodes;
  json["points"] = status.points;
  json["node_steps"] = status.node_steps;
  json["threads"] = status.threads;
  json["wall_s"] = object(status.wall_s);
  json["cpu_s"] = json_number(status.cpu_s);
  json["peak_rss_bytes"] = status.peak_rss_bytes;
  json["energy_residual"] = json_number(status.energy_residual);
  json["metrics"] = tree(status.metrics, status.flags);
  json["metric_units"] = status.metric_units;
  json["step_limits"] = object(status.step_limits);
  json["warnings"] = status.warnings;
  if (status.post_mortem) {
    const PostMortem& post = *status.post_mortem;
    json["post_mortem"] = {{"step", post.step},           {"time", json_number(post.time)},
                           {"node", post.node},           {"x", json_number(post.x)},
                           {"y", json_number(post.y)},    {"field", post.field},
                           {"text", post.text},           {"causes", post.causes},
                           {"last_good", post.last_good}, {"picture", post.picture}};
    if (std::isfinite(post.z)) json["post_mortem"]["z"] = post.z;
  }
  // Names may come from a user's file in any encoding: never fail on them.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_status(const std::filesystem::path& folder, const RunStatus& status) {
  write_atomically(folder / files::status, status_json(status));
}

RunStatus read_status(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / files::status;
  const std::string text = read_file(path);
  try {
    const Json json = Json::parse(text);
    RunStatus status;
    status.exit = json.at("exit").get<int>();
    status.reason = json.at("reason").get<std::string>();
    status.version = json.value("version", "");
    status.case_name = json.value("case", "");
    status.time = as_number(json.value("time", Json(nullptr)));
    status.steps = json.value("steps", std::int64_t{0});
    status.nodes = json.value("nodes", std::int64_t{0});
    status.points = json.value("points", std::int64_t{0});
    status.cpu_s = as_number(json.value("cpu_s", Json(0.0)));
    status.node_steps = json.value("node_steps", std::int64_t{0});
    status.threads = json.value("threads", 1);
    status.peak_rss_bytes = json.value("peak_rss_bytes", std::uint64_t{0});
    status.energy_residual = as_number(json.value("energy_residual", Json(nullptr)));
    for (const auto& [name, list] : {std::pair{"wall_s", &status.wall_s},
                                     {"metrics", &status.metrics},
                                     {"step_limits", &status.step_limits}})
      flatten(json.value(name, Json::object()), "", *list, status.flags);
    status.metric_units = json.value("metric_units", std::map<std::string, std::string>{});
    status.warnings = json.value("warnings", std::vector<std::string>{});
    if (json.contains("post_mortem")) {
      const Json& post = json["post_mortem"];
      status.post_mortem = PostMortem{post.at("step").get<std::int64_t>(),
                                      as_number(post.at("time")),
                                      post.at("node").get<int>(),
                                      as_number(post.at("x")),
                                      as_number(post.at("y")),
                                      as_number(post.value("z", Json(nullptr))),
                                      post.at("field").get<std::string>(),
                                      post.at("text").get<std::string>(),
                                      post.value("causes", std::vector<std::string>{}),
                                      post.value("last_good", ""),
                                      post.value("picture", "")};
    }
    return status;
  } catch (const Json::exception& error) {
    throw IoError(fmt::format("{} is not the status of a run: {}", path.string(), error.what()));
  }
}

std::uint64_t peak_rss_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

} // namespace cnem::results
