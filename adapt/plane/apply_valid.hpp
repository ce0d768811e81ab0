#pragma once
// Changes of a cloud that may leave it without a valid structure.
#include "adapt/pass_report.hpp"
#include "adapt/plane/working_cloud.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace cnem::adapt {

/// Makes changes together where the cloud is valid after them, else those that may be made alone.
/// apply(work, changes): makes them, returns how many were made. Returns that of what was kept.
template<class Change, class Apply>
int apply_valid(WorkingCloud& work, Structure& structure, std::vector<Change> changes, Apply&& apply,
                PassReport& report) {
  if (changes.empty()) return 0;
  WorkingCloud changed = work;
  int count = 0;
  const auto after = [&](std::span<const Change> some) -> std::optional<Structure> {
    changed = work;
    count = apply(changed, some);
    return count > 0 ? structure_if_valid(changed.cloud(), structure.space) : std::nullopt;
  };
  std::optional<Structure> valid = after(changes);
  if (count == 0) return 0;
  if (!valid) {
    ++report.undone;
    std::erase_if(changes, [&](const Change& one) { return !after(std::span(&one, 1)); });
    if (!changes.empty()) valid = after(changes);
    if (!valid) return 0;
  }
  work = std::move(changed);
  structure = std::move(*valid);
  return count;
}

} // namespace cnem::adapt
