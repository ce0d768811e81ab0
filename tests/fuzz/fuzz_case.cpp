// Any bytes are a case or are refused with words. The text ends at the first zero byte; what follows, up to
// each next one, are overrides as after --set.
#include "core/error.hpp"
#include "input/case_reader.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace cnem;

[[noreturn]] void fail(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

/// The resolved text without its first line, which names the file it came from.
std::string body(const input::Case& input) { return input.resolved.substr(input.resolved.find('\n')); }

/// What is accepted has to read back from its resolved text, to the same text.
void check_read_back(const input::Case& input) {
  try {
    const input::Case again = input::read_case_text(input.resolved, "resolved.toml");
    if (body(again) != body(input))
      fail("the resolved case reads back differently:\n" + input.resolved + "\n----\n" + again.resolved);
  } catch (const InputError& error) {
    fail("the resolved case is refused:\n" + input.resolved + "\n----\n" + error.what());
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  std::vector<std::string> parts;
  for (std::size_t zero = 0; zero != std::string_view::npos;) {
    zero = rest.find('\0');
    parts.emplace_back(rest.substr(0, zero));
    if (zero != std::string_view::npos) rest.remove_prefix(zero + 1);
  }
  const std::vector<std::string> overrides(parts.begin() + 1, parts.end());
  try {
    check_read_back(input::read_case_text(parts.front(), "fuzz.toml", overrides));
  } catch (const InputError& error) {
    if (std::string_view(error.what()).empty()) fail("refused without a word");
  } catch (const IoError&) {} // a node file that cannot be read
  return 0;
}
