#pragma once
// Collects what is wrong with a case, so that a user sees several mistakes at once.
#include "core/error.hpp"
#include "input/schema/document.hpp"

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace cnem::input {

/// Kinds of mistakes; each is reported up to three times, then counted. `promise`: what the case asks for its
/// method does not promise.
enum class Mistake { unknown_key, missing_key, type, unit, range, reference, conflict, geometry, promise };

/// A case with which nothing is wrong but that its method cannot give what it asks for: another method may.
struct MethodRefusal : InputError {
  using InputError::InputError;
};

class Diagnostics {
public:
  /// Records "location: key 'key': message".
  void add(Mistake kind, const Location& where, const std::string& key, const std::string& message);
  /// Whether another mistake of this kind is told in words; else `count` does for it.
  bool tells(Mistake kind) const;
  /// What is wrong at a place follows from what has been told elsewhere: it is not recorded.
  void follows(const Location& where) { following_.insert(where.text()); }
  /// Records a mistake without words.
  void count(Mistake kind) { ++counts_[kind]; }
  bool empty() const { return counts_.empty(); }
  /// Throws InputError with all that was recorded, if anything was; MethodRefusal where that is promises
  /// alone.
  void throw_if_any() const;

private:
  std::vector<std::string> told_;
  std::set<std::string> following_; ///< places
  std::map<Mistake, std::size_t> counts_;
};

} // namespace cnem::input
