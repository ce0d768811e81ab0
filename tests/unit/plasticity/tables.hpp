#pragma once
// Tables of reference numbers in tests/data.
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace cnem::plasticity::test {

using Row = std::vector<std::string>;

/// Rows below the header; '#' lines are comments.
inline std::vector<Row> read_csv(const std::string& name) {
  std::ifstream in(CNEM_SOURCE_DIR "/tests/data/" + name);
  std::vector<Row> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    Row row;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
    rows.push_back(row);
  }
  if (!rows.empty()) rows.erase(rows.begin());
  return rows;
}

} // namespace cnem::plasticity::test
