#include "input/included_files.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace cnem::input {
namespace {

namespace fs = std::filesystem;
using Kind = Value::Kind;

/// Puts what `from` says into `into`.
void merge(Value& into, Value from) {
  for (Member& member : from.members) {
    Member* known = into.find(member.key);
    if (!known)
      into.members.push_back(std::move(member));
    else if (known->value.kind == Kind::table && member.value.kind == Kind::table)
      merge(known->value, std::move(member.value));
    else
      *known = std::move(member);
  }
}

/// Drawings and triangles that an included file names are seen from its folder, and so are cutting laws.
void place_drawings(Value& value, const fs::path& folder) {
  for (Member& member : value.members) {
    const bool names_file = member.key == "drawing" || member.key == "stl";
    Member* file = names_file ? member.value.find("file") : nullptr;
    if (file && file->value.kind == Kind::text) file->value.text = (folder / file->value.text).string();
    place_drawings(member.value, folder);
  }
}

[[noreturn]] void fail(const Value& name, const std::string& expected) {
  throw InputError(
      fmt::format("{}: key 'include': found {}, expected {}", name.where.text(), name.show(), expected));
}

class Inclusion {
public:
  Value expand(Value document, const fs::path& folder) {
    Member* include = document.find("include");
    if (!include) return document;
    const Value list = std::move(include->value);
    std::erase_if(document.members, [](const Member& member) { return member.key == "include"; });
    Value result;
    result.kind = Kind::table;
    result.where = document.where;
    if (list.kind == Kind::text) merge(result, file(list, folder));
    if (list.kind != Kind::text && list.kind != Kind::array)
      fail(list, "the name of a file or an array of them, such as [\"materials.toml\"]");
    for (const Value& name : list.elements) merge(result, file(name, folder));
    merge(result, std::move(document));
    return result;
  }

private:
  Value file(const Value& name, const fs::path& folder) {
    if (name.kind != Kind::text || name.text.empty())
      fail(name, "the name of a file such as \"materials.toml\"");
    const fs::path path = (folder / name.text).lexically_normal();
    std::error_code status;
    constexpr int most_files = 1000; // each as often as it is read
    if (++read_ > most_files) fail(name, fmt::format("at most {} files in all", most_files));
    if (fs::is_directory(path, status)) fail(name, fmt::format("a file: {} is a folder", path.string()));
    if (!fs::is_regular_file(path, status))
      fail(name, fmt::format("a file, seen from the folder of the file that includes it: there is no {}",
                             path.string()));
    const fs::path whole = fs::weakly_canonical(path, status);
    if (std::find(open_.begin(), open_.end(), whole) != open_.end())
      fail(name, fmt::format("a file that does not include itself: {} does", path.string()));
    open_.push_back(whole);
    Value document = expand(read_document(path.string()), path.parent_path());
    open_.pop_back();
    place_drawings(document, fs::path(name.text).parent_path());
    if (Member* cutting = document.find("cutting"))
      if (Member* law = cutting->value.find("law"); law && law->value.kind == Kind::text)
        law->value.text = (fs::path(name.text).parent_path() / law->value.text).string();
    return document;
  }

  int read_ = 0;
  std::vector<fs::path> open_; ///< files that are being read, each included by the one before
};

} // namespace

Value with_included(Value document, const fs::path& folder) {
  return Inclusion().expand(std::move(document), folder);
}

} // namespace cnem::input
