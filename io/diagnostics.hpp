#pragma once
// Collects what is wrong with a case, so that a user sees several mistakes at once.
#include "io/document.hpp"

#include <string>
#include <vector>

namespace cnem::io {

/// Kinds of mistakes; each is reported up to three times, then counted.
enum class Mistake { unknown_key, missing_key, type, unit, range, reference, conflict, geometry };

class Diagnostics {
public:
  /// Records "location: key 'key': message".
  void add(Mistake kind, const Location& where, const std::string& key, const std::string& message);
  bool empty() const { return entries_.empty(); }
  /// Throws InputError with all that was recorded, if anything was.
  void throw_if_any() const;

private:
  struct Entry {
    Mistake kind;
    std::string text;
  };
  std::vector<Entry> entries_;
};

} // namespace cnem::io
