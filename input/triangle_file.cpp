#include "input/triangle_file.hpp"

#include "core/error.hpp"
#include "core/fnv.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace cnem::input {

std::optional<FacetSoup> read_triangles(Setting& stl, const std::string& case_path,
                                        Diagnostics& diagnostics) {
  namespace fs = std::filesystem;
  Setting& file = *stl.find("file");
  const std::string given = std::get<std::string>(file.value);
  const std::string path =
      fs::absolute(fs::path(case_path).parent_path() / given).lexically_normal().string();
  file.value = path;
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    diagnostics.add(Mistake::reference, file.where, file.path,
                    fmt::format("cannot read '{}', expected an STL file", path));
    return std::nullopt;
  }
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::string now = fmt::format("{:016x}", fnv(bytes));
  if (const Setting* then = stl.find("content"); then && std::get<std::string>(then->value) != now) {
    diagnostics.add(Mistake::reference, file.where, file.path,
                    fmt::format("found {} with checksum {}, expected {}: it has changed since this case was "
                                "resolved (without '{}' the file is taken as it is)",
                                path, now, std::get<std::string>(then->value), then->path));
    return std::nullopt;
  }
  try {
    FacetSoup soup = parse_stl(bytes, stl.get<double>("unit"));
    stl.set_default("content", now); // moves the other members
    return soup;
  } catch (const InputError& error) {
    diagnostics.add(Mistake::reference, file.where, file.path, fmt::format("{}: {}", path, error.what()));
    return std::nullopt;
  }
}

} // namespace cnem::input
