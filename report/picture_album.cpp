#include "report/picture_album.hpp"

#include "core/error.hpp"
#include "results/output_folder.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <map>
#include <system_error>
#include <utility>

namespace cnem::report {
namespace fs = std::filesystem;
namespace {

constexpr const char* index_name = "index.json";

nlohmann::ordered_json as_json(const PictureScale& scale) {
  const PictureWindow& view = scale.view;
  return {{"range", {scale.range.low, scale.range.high}},
          {"view", {view.low.x(), view.low.y(), view.high.x(), view.high.y()}}};
}

PictureScale scale_of(const nlohmann::json& entry, const char* name) {
  if (!entry.contains(name)) return {};
  const nlohmann::json& json = entry.at(name);
  const auto range = json.at("range").get<std::array<double, 2>>();
  const auto view = json.at("view").get<std::array<double, 4>>();
  return {{range[0], range[1]}, {Vec2(view[0], view[1]), Vec2(view[2], view[3])}};
}

nlohmann::ordered_json as_json(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

Vec3 vector_of(const nlohmann::json& json) {
  const auto x = json.get<std::array<double, 3>>();
  return {x[0], x[1], x[2]};
}

void read_places(AlbumEntry& entry, const nlohmann::json& json) {
  if (!json.contains("tools")) return;
  for (const nlohmann::json& tool : json.at("tools")) entry.tools.push_back(vector_of(tool));
  for (const nlohmann::json& side : json.at("sides"))
    entry.sides.push_back({vector_of(side.at(0)), vector_of(side.at(1))});
}

} // namespace

PictureAlbum::PictureAlbum(const fs::path& output_folder)
    : folder_(output_folder / results::files::pictures_folder) {
  const fs::path index = folder_ / index_name;
  std::error_code error;
  if (!fs::exists(index, error)) return;
  try {
    for (const nlohmann::json& entry : nlohmann::json::parse(results::read_file(index))) {
      entries_.push_back({entry.at("file"), entry.at("field"), entry.at("time"), entry.at("caption"),
                          entry.at("note"), entry.value("series", std::string()), scale_of(entry, "own"),
                          scale_of(entry, "drawn")}); // without series and scales: of older versions
      read_places(entries_.back(), entry);
    }
  } catch (const nlohmann::json::exception& problem) {
    throw IoError(fmt::format("{} is not an index of pictures: {}", index.string(), problem.what()));
  }
}

std::string PictureAlbum::add(results::FileQueue& queue, const std::string& key, AlbumEntry entry,
                              results::FileQueue::Maker png, std::size_t bytes) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw IoError(fmt::format("cannot create {}: {}", folder_.string(), error.message()));
  int number = 0;
  const auto name = [&] { return fmt::format("{}_{:03}.png", key, number); };
  const auto taken = [&] {
    for (const AlbumEntry& known : entries_)
      if (known.file == name()) return true;
    return false;
  };
  while (taken()) ++number;
  queue.put(folder_ / name(), std::move(png), bytes);
  entry.file = name();
  entries_.push_back(std::move(entry));
  queue.put(folder_ / index_name, index());
  return entries_.back().file;
}

std::vector<PictureScale>
PictureAlbum::common_scales(const std::function<ColourMap(const std::string&)>& map,
                            const std::function<bool(const AlbumEntry&)>& shares_view) const {
  std::map<std::string, ColourRange> range;
  std::map<std::string, PictureWindow> view;
  for (const AlbumEntry& entry : entries_) {
    if (entry.series.empty()) continue;
    const auto [at, fresh] = range.emplace(entry.series, entry.own.range);
    if (!fresh) at->second = joined(at->second, entry.own.range);
    const auto [place, first] = view.emplace(entry.caption, entry.own.view);
    if (!first) place->second = joined(place->second, entry.own.view);
  }
  std::vector<PictureScale> common;
  for (const AlbumEntry& entry : entries_) {
    PictureScale& scale = common.emplace_back(entry.drawn);
    if (entry.series.empty()) continue;
    scale.range = widened(map(entry.series), range[entry.series]);
    if (shares_view(entry)) scale.view = view[entry.caption];
  }
  return common;
}

void PictureAlbum::redraw(results::FileQueue& queue, const std::vector<PictureScale>& wanted,
                          const std::vector<results::FieldFiles>& frames,
                          const std::function<Drawer(const results::FieldFiles&, const AlbumEntry&)>& open) {
  for (const results::FieldFiles& frame : frames) {
    std::optional<Drawer> drawer;
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      if (entries_[k].time != frame.time || wanted[k] == entries_[k].drawn) continue;
      if (!drawer) drawer = open(frame, entries_[k]);
      if (!*drawer) break;
      auto drawing = (*drawer)(entries_[k], wanted[k]);
      if (!drawing) continue;
      entries_[k].drawn = wanted[k];
      queue.put(path(entries_[k]), std::move(drawing->png), drawing->bytes);
      queue.put(folder_ / index_name, index());
    }
  }
}

void PictureAlbum::truncate(double time) {
  std::error_code ignored;
  const auto later = [&](const AlbumEntry& entry) { return entry.time > time; };
  for (const AlbumEntry& entry : entries_)
    if (later(entry)) fs::remove(path(entry), ignored);
  if (std::erase_if(entries_, later) > 0) results::write_atomically(folder_ / index_name, index());
}

std::string PictureAlbum::index() const {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const AlbumEntry& entry : entries_) {
    json.push_back({{"file", entry.file},
                    {"field", entry.field},
                    {"time", entry.time},
                    {"caption", entry.caption},
                    {"note", entry.note},
                    {"series", entry.series},
                    {"own", as_json(entry.own)},
                    {"drawn", as_json(entry.drawn)}});
    if (entry.tools.empty()) continue;
    auto& places = json.back();
    places["tools"] = nlohmann::ordered_json::array();
    places["sides"] = nlohmann::ordered_json::array();
    for (const Vec3& tool : entry.tools) places["tools"].push_back(as_json(tool));
    for (const auto& [at, normal] : entry.sides) places["sides"].push_back({as_json(at), as_json(normal)});
  }
  return json.dump(2) + "\n";
}

} // namespace cnem::report
