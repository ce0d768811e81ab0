#include "input/triangle_file.hpp"

#include "core/error.hpp"
#include "core/fnv.hpp"
#include "core/geometry/triangle_surface.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace cnem::input {

std::string from_case(const std::string& given, const std::string& case_path) {
  namespace fs = std::filesystem;
  return fs::absolute(fs::path(case_path).parent_path() / given).lexically_normal().string();
}

std::optional<std::string> bytes_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  return std::string{std::istreambuf_iterator<char>(in), {}};
}

bool take_checksum(Setting& table, const char* named, const std::string& bytes, Diagnostics& diagnostics) {
  const std::string now = fmt::format("{:016x}", fnv(bytes));
  const Setting& file = *table.find(named);
  if (const Setting* then = table.find("content"); then && std::get<std::string>(then->value) != now) {
    diagnostics.add(Mistake::reference, file.where, file.path,
                    fmt::format("found {} with checksum {}, expected {}: it has changed since this case was "
                                "resolved (without '{}' the file is taken as it is)",
                                std::get<std::string>(file.value), now, std::get<std::string>(then->value),
                                then->path));
    return false;
  }
  table.set_default("content", now);
  return true;
}

std::optional<FacetSoup> read_triangles(Setting& stl, const std::string& case_path,
                                        Diagnostics& diagnostics) {
  Setting& file = *stl.find("file");
  const std::string path = from_case(std::get<std::string>(file.value), case_path);
  file.value = path;
  const std::optional<std::string> bytes = bytes_of_file(path);
  if (!bytes) {
    diagnostics.add(Mistake::reference, file.where, file.path,
                    fmt::format("cannot read '{}', expected an STL file", path));
    return std::nullopt;
  }
  if (!take_checksum(stl, "file", *bytes, diagnostics)) return std::nullopt;
  try {
    return welded(parse_stl(*bytes, stl.get<double>("unit")));
  } catch (const InputError& error) {
    const Setting& named = *stl.find("file");
    diagnostics.add(Mistake::reference, named.where, named.path, fmt::format("{}: {}", path, error.what()));
    return std::nullopt;
  }
}

} // namespace cnem::input
