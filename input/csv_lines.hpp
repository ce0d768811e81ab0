#pragma once
// Text files with columns that users bring: their lines, and where each field stands, for messages.
#include "input/schema/document.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cnem::input {

struct FileLine {
  std::string text;
  std::uint32_t number = 0; ///< from 1
};

/// A part of a line and where it begins.
struct FileField {
  std::string_view text; ///< without blanks at its ends
  Location where;
};

/// The lines of a file that are neither blank nor begin with a sign of `comments`, the mark at the beginning
/// of UTF-8 taken off. Throws InputError "found no file …, expected WHAT" where there is none and for UTF-16,
/// IoError when it cannot be read.
std::vector<FileLine> csv_lines(const std::string& path, const std::string& expected,
                                std::string_view comments = "#");

/// The fields of a line of a file; views of the line.
std::vector<FileField> csv_fields(const FileLine& line, const std::string& path, char separator);

/// "FILE:LINE:COLUMN: found '…', expected WHAT", as an InputError's text.
std::string found_in_file(const FileField& field, const std::string& expected);

} // namespace cnem::input
