#include "core/fields/memory_archive.hpp"

#include "core/error.hpp"

#include <algorithm>

namespace cnem {

void MemoryArchive::clear() {
  if (!quantities_.empty()) spare_ = std::move(quantities_);
  quantities_.clear();
  loading_ = false;
}

void MemoryArchive::archive(Archive& other, const std::string& folder) {
  const std::string integers = "integers", text = "text", numbers = "numbers "; // the unit follows the last
  std::vector<std::string> names, kinds;
  for (const auto& [name, quantity] : quantities_) {
    names.push_back(name);
    kinds.push_back(std::holds_alternative<std::string>(quantity.value) ? text
                    : std::holds_alternative<std::vector<std::int64_t>>(quantity.value)
                        ? integers
                        : numbers + quantity.unit);
  }
  other.texts(folder + "/names", names);
  other.texts(folder + "/kinds", kinds);
  if (names.size() != kinds.size())
    throw IoError(fmt::format("'{}' has {} names and {} kinds", folder, names.size(), kinds.size()));
  if (other.loading()) clear();
  for (std::size_t k = 0; k < names.size(); ++k) {
    Quantity& quantity = quantities_[names[k]];
    const std::string path = fmt::format("{}/state/{}", folder, names[k]);
    if (other.loading()) {
      if (kinds[k] == text)
        quantity.value = std::string();
      else if (kinds[k] == integers)
        quantity.value = std::vector<std::int64_t>();
      else
        quantity.unit = kinds[k].substr(std::min(numbers.size(), kinds[k].size()));
    }
    if (auto* value = std::get_if<std::string>(&quantity.value))
      other.text(path, *value);
    else if (auto* whole = std::get_if<std::vector<std::int64_t>>(&quantity.value))
      other.integers(path, *whole);
    else
      other.list(path, quantity.unit.c_str(), std::get<std::vector<double>>(quantity.value));
  }
}

template<class Value> const Value& MemoryArchive::known(const std::string& name) const {
  const auto found = quantities_.find(name);
  if (found == quantities_.end()) throw IoError(fmt::format("it lacks '{}'", name));
  const Value* value = std::get_if<Value>(&found->second.value);
  if (!value) throw IoError(fmt::format("'{}' is of another type than expected", name));
  return *value;
}

std::size_t MemoryArchive::extent(const std::string& name) {
  const auto found = quantities_.find(name);
  if (found == quantities_.end()) throw IoError(fmt::format("it lacks '{}'", name));
  return std::visit([](const auto& value) { return value.size(); }, found->second.value);
}

namespace {

template<class T> void hand_out(const std::vector<T>& kept, const std::string& name, std::span<T> values) {
  if (kept.size() != values.size())
    throw IoError(fmt::format("'{}' has {} values, expected {}", name, kept.size(), values.size()));
  std::copy(kept.begin(), kept.end(), values.begin());
}

} // namespace

/// The place of a quantity that is collected.
template<class Value> Value& MemoryArchive::collected(const std::string& name, const char* unit) {
  auto spare = spare_.extract(name);
  Quantity& quantity = spare ? quantities_.insert(std::move(spare)).position->second : quantities_[name];
  quantity.unit = unit;
  Value* const value = std::get_if<Value>(&quantity.value);
  return value ? *value : quantity.value.emplace<Value>();
}

void MemoryArchive::carry(const std::string& name, const char* unit, std::span<double> values) {
  if (loading_)
    hand_out(known<std::vector<double>>(name), name, values);
  else
    collected<std::vector<double>>(name, unit).assign(values.begin(), values.end());
}

void MemoryArchive::carry(const std::string& name, std::span<std::int64_t> values) {
  if (loading_)
    hand_out(known<std::vector<std::int64_t>>(name), name, values);
  else
    collected<std::vector<std::int64_t>>(name, "").assign(values.begin(), values.end());
}

void MemoryArchive::carry(const std::string& name, std::string& value) {
  if (loading_)
    value = known<std::string>(name);
  else
    collected<std::string>(name, "") = value;
}

} // namespace cnem
