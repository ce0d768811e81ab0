#pragma once
// An archive that stays in memory: a state to go back to.
#include "core/fields/archive.hpp"

#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cnem {

/// Keeps quantities with their bits. Collects after clear(), hands out after recall(). Loading throws IoError
/// as any archive does. Collecting the same again allocates nothing.
class MemoryArchive final : public Archive {
public:
  bool loading() const override { return loading_; }
  bool empty() const { return quantities_.empty(); }
  /// Forgets everything and collects from now on.
  void clear();
  /// Hands out from now on.
  void recall() { loading_ = true; }
  void swap(MemoryArchive& other) {
    quantities_.swap(other.quantities_);
    spare_.swap(other.spare_);
    std::swap(loading_, other.loading_);
  }

  /// Carries everything collected into another archive, or out of it, under `folder`.
  void archive(Archive& other, const std::string& folder);

private:
  struct Quantity {
    std::string unit; ///< SI; "" for integers and texts
    std::variant<std::vector<double>, std::vector<std::int64_t>, std::string> value;
  };
  template<class Value> const Value& known(const std::string& name) const;
  template<class Value> Value& collected(const std::string& name, const char* unit);
  std::size_t extent(const std::string& name) override;
  void carry(const std::string& name, const char* unit, std::span<double> values) override;
  void carry(const std::string& name, std::span<std::int64_t> values) override;
  void carry(const std::string& name, std::string& value) override;

  std::map<std::string, Quantity> quantities_;
  std::map<std::string, Quantity> spare_; ///< forgotten, for their memory
  bool loading_ = false;
};

} // namespace cnem
