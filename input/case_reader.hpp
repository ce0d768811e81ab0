#pragma once
// Reads and checks case files; the format is described in docs/case_reference.md.
#include "input/case.hpp"
#include "input/schema/document.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace cnem::input {

/// Reads a case file and applies overrides of the form "key=value" (--set), in order.
/// Throws InputError when the file is absent or anything in it is wrong: each message begins with
/// file:line:column (or the override) and names the key, what was found and what was expected; up to three
/// mistakes of a kind are listed, then counted. Throws MethodRefusal (input/schema/diagnostics.hpp), an
/// InputError, when all that is wrong is that the method cannot give what the case asks for, and IoError when
/// a file that exists cannot be read.
Case read_case(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same with values that were written in another file, which messages about them name.
Case read_case_with(const std::string& path, const std::vector<Override>& changes);

/// The same for text; `source` is what messages call it, and its folder is where files it names are found.
Case read_case_text(std::string_view text, const std::string& source,
                    const std::vector<std::string>& overrides = {});

/// The same for a document that a program has made. path: of the file that it stands for: results are named
/// after it, and files it names are found in its folder.
Case read_case_document(Value document, const std::string& path, const std::vector<Override>& changes);

/// What the results of a file are named after: the file, or where it is called `generic`, as case.toml, the
/// folder it is in. Throws InputError where that can name no folder, as "...toml".
std::string name_after(const std::string& path, const std::string& generic);

} // namespace cnem::input
