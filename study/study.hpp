#pragma once
// A parameter study: one case, run with several values of its keys; the format is described in
// docs/user_guide.md.
#include "input/schema/document.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cnem::study {

struct StudyRun {
  std::string name;                    ///< of its folder
  input::Location where;               ///< of what sets its name
  std::vector<input::Override> common; ///< from [set]
  std::vector<input::Override> own;    ///< what sets it apart from the others

  std::vector<input::Override> changes() const;
  /// The own value of a case key, or none.
  const input::Value* find(const std::string& key) const;
};

/// Results against a parameter or another result.
struct StudyChart {
  std::string x; ///< a key of the grid, a variable of the case or a column
  std::vector<std::string> y;
  input::Location where;
  bool extrapolate = false;         ///< curves go on to x = 0
  std::string title{};              ///< of all y; empty: their names
  std::vector<std::string> names{}; ///< of each y in the legend; empty: those of the columns
};

/// Columns of history.csv over each other, all runs in one chart.
struct StudyHistory {
  std::string x, y;
};

/// Keys whose values change together.
struct StudyAxis {
  std::string name;
  std::vector<std::string> keys; ///< the values of the first one stand for all

  /// The key that is meant by one of them, or by the name of the axis.
  const std::string& of(const std::string& name_or_key) const;
};

/// A ply of a laminate, as thick along the cutting edge as it is; it is cut as one of the runs is.
struct LaminatePly {
  std::string name;
  double angle = 0.0, thickness = 0.0; ///< rad, m
  std::vector<input::Override> chosen; ///< values of other keys of the study that its run has
  input::Location where;
};

/// Plies of several angles that a tool cuts side by side: each as if it were alone.
struct Laminate {
  std::string angle;                ///< variable of the case or key of the study: of the fibres
  std::vector<std::string> columns; ///< of means; empty: the default ones
  std::vector<LaminatePly> plies;
  input::Location where;
};

struct Study {
  std::string name; ///< of the file, or of the folder of a study.toml
  std::string title;
  std::string text;                ///< of the file
  std::filesystem::path case_file; ///< TOML
  std::vector<std::string> keys;   ///< case keys in which the runs differ, the slowest first
  std::vector<StudyAxis> axes;     ///< the same keys: those of a list of runs have one each
  std::vector<StudyRun> runs;
  int processes = 0;                ///< 0: as many as there are cores for
  int threads = 1;                  ///< of each run
  std::vector<std::string> columns; ///< of the table; empty: the default ones
  std::vector<StudyChart> charts;
  std::vector<StudyHistory> history;
  std::optional<Laminate> laminate;

  /// The axis with this name or key; nullptr when there is none.
  const StudyAxis* axis_of(const std::string& name_or_key) const;
};

/// Reads a study and makes its list of runs: the Cartesian product of the keys of [grid], of which the first
/// varies slowest, and of the tables [[axis]], whose keys change together; or the [[run]] entries. Throws
/// InputError "file:line:column: key '…': …" for whatever is wrong in it, IoError when it cannot be read. The
/// keys and values of the case are not looked at.
Study read_study(const std::filesystem::path& path);

/// The same for text; `path` is what messages call it, and its folder is where the case is looked for.
Study read_study_text(std::string_view text, const std::filesystem::path& path);

/// Whether a key of a case is a variable's: "let.clearance".
bool is_variable(std::string_view key);

/// The text of a value as people write it: 30 deg, 0.5, [1, 2].
std::string plain_text(const input::Value& value);

/// The text with what is awkward in names of files replaced: "0.1 mm" → "0.1_mm".
std::string file_name(std::string_view text);

/// A value that begins with a number, such as 3 or "30 deg", and the text after it. False for others.
bool split_number(const input::Value& value, double& number, std::string& unit);

/// Whether two values say the same: numbers and quantities by their size ("10 um" and "0.01 mm", 1 and 1.0),
/// lists element by element, others by their text.
bool same_value(const input::Value& a, const input::Value& b);

} // namespace cnem::study
