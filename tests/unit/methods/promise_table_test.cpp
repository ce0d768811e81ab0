// The table of promises in docs/methods.md is that of the registry.
#include "methods/registry.hpp"

#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <set>

namespace cnem::methods {
namespace {

/// Beginnings of the rows as the document must have them: "| promise | yes | | ".
std::set<std::string> wanted_rows() {
  std::set<std::string> rows;
  std::string head = "| promise |", places = "| exists in |";
  for (const Entry& method : registry()) {
    head += fmt::format(" `{}` |", method.name);
    places += !method.exists_in(2) ? " space |" : method.exists_in(3) ? " plane, space |" : " plane |";
  }
  rows = {head, places};
  for (const Promise promise : all_promises) {
    std::string row = fmt::format("| {} |", name_of(promise));
    for (const Entry& method : registry()) row += method.promises.keep(promise) ? " yes |" : " |";
    rows.insert(row);
  }
  return rows;
}

TEST(PromiseTable, of_the_documents_is_that_of_the_registry) {
  std::set<std::string> missing = wanted_rows();
  std::ifstream document(CNEM_SOURCE_DIR "/docs/methods.md");
  for (std::string line; std::getline(document, line);)
    std::erase_if(missing, [&](const std::string& row) { return line.starts_with(row); });
  for (const std::string& row : missing) ADD_FAILURE() << "docs/methods.md lacks: " << row;
}

} // namespace
} // namespace cnem::methods
