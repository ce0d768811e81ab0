#pragma once
// The steps of reading a study, between its translation units.
#include "input/schema/diagnostics.hpp"
#include "study/study.hpp"

#include <string>
#include <vector>

namespace cnem::study {

/// Reads the members of one table and remembers what was wrong with them.
class TableReader {
public:
  TableReader(const input::Value& table, std::string path, const std::vector<std::string>& known,
              input::Diagnostics& diagnostics);

  /// The value of a key; nullptr when it is absent or, which is a mistake, of another kind.
  const input::Value* find(const std::string& key, input::Value::Kind kind, const std::string& expected);
  /// The same where the key has to be there.
  const input::Value* require(const std::string& key, input::Value::Kind kind, const std::string& expected);
  std::string text(const std::string& key);
  int count(const std::string& key, int fallback);
  std::vector<std::string> texts(const std::string& key);
  void wrong(const std::string& key, const input::Value& value, const std::string& expected);

private:
  const input::Value& table_;
  std::string path_;
  input::Diagnostics& diagnostics_;
};

/// Keys of the case in quotes, with their values.
std::vector<input::Override> read_set(const input::Value& table, const std::string& path,
                                      input::Diagnostics& diagnostics);

/// Fills axes, keys and runs of a study from [set], [grid] and [[axis]], or from [[run]]; `table` reads the
/// document. Throws InputError for all that was wrong up to there.
void read_runs(const input::Value& document, TableReader& table, Study& study,
               input::Diagnostics& diagnostics);

/// A number of status.json by its dotted name, or one of `also`; else a mistake of `key`.
void check_column(const std::string& name, const input::Location& where, const std::string& key,
                  std::vector<std::string> also, input::Diagnostics& diagnostics);

/// [laminate] of a study whose runs are known.
Laminate read_laminate(const input::Value& table, const Study& study, input::Diagnostics& diagnostics);

} // namespace cnem::study
