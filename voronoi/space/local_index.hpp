#pragma once
// Numbers for the few of many that a search comes across.
#include "core/index.hpp"

#include <cstdint>
#include <vector>

namespace cnem::voronoi {

/// A table from indices to numbers that is emptied in no time.
class LocalIndex {
public:
  /// The number of a key; `fresh` of one that is not in the table, which enters with it.
  template<IndexKind Index> std::int32_t& at(Index key, std::int32_t fresh) {
    if (2 * count_ >= entry_.size()) grow();
    Entry& entry = slot(static_cast<std::int32_t>(key));
    if (entry.round != round_) {
      entry = {static_cast<std::int32_t>(key), fresh, round_};
      ++count_;
    }
    return entry.value;
  }

  void clear() {
    count_ = 0;
    if (++round_ == 0) { // marks of four thousand million searches ago would be taken for new ones
      entry_.assign(entry_.size(), {});
      round_ = 1;
    }
  }

private:
  struct Entry {
    std::int32_t key = 0, value = 0;
    std::uint32_t round = 0;
  };

  Entry& slot(std::int32_t key) {
    std::size_t k = (static_cast<std::uint32_t>(key) * 2654435769U) >> shift_;
    while (entry_[k].round == round_ && entry_[k].key != key) k = (k + 1) & (entry_.size() - 1);
    return entry_[k];
  }

  void grow() {
    std::vector<Entry> old(2 * entry_.size());
    old.swap(entry_);
    --shift_;
    for (const Entry& entry : old)
      if (entry.round == round_) slot(entry.key) = entry;
  }

  std::uint32_t shift_ = 24, round_ = 1;
  std::size_t count_ = 0;
  std::vector<Entry> entry_ = std::vector<Entry>(256);
};

} // namespace cnem::voronoi
