#include "core/fields/field_table.hpp"

#include <fmt/format.h>

namespace cnem {

namespace {

void rest_entry(const FieldTable::Entry& entry, std::size_t size) {
  if (entry.label) return entry.label->assign(size, 0);
  for (std::size_t k = 0; k < entry.components; ++k) entry.component[k].assign(size, entry.line.rest[k]);
}

template<IndexKind Index>
void carry_entry(const FieldTable::Entry& entry, const CarryWeights<Index>& weights) {
  if (entry.label) return carry_label(weights.labels, *entry.label);
  for (std::size_t k = 0; k < entry.components; ++k) {
    Field& values = entry.component[k];
    switch (entry.line.carry) {
    case Carry::sum:
      carry_sum(weights.parcels, values);
      break;
    case Carry::mass_mean:
      carry_mean(weights.parcels, weights.mass, values);
      break;
    case Carry::inertia_mean:
      carry_mean(weights.parcels, weights.inertia, values);
      break;
    case Carry::capacity_mean:
      carry_mean(weights.parcels, weights.capacity, values);
      break;
    case Carry::label:
      carry_label(weights.labels, values);
      break;
    case Carry::logarithmic_mean:
    case Carry::renewed:
      break;
    }
  }
}

} // namespace

void FieldTable::rest(std::size_t size) {
  for (const Entry& entry : entries_) rest_entry(entry, on_ ? size : 0);
}

void FieldTable::rest_renewed(std::size_t size) {
  if (!on_) return;
  for (const Entry& entry : entries_)
    if (entry.line.carry == Carry::renewed) rest_entry(entry, size);
}

void FieldTable::rest_at(std::size_t place) {
  if (!on_) return;
  for (const Entry& entry : entries_)
    if (!entry.label && entry.line.carry != Carry::renewed)
      for (std::size_t k = 0; k < entry.components; ++k) entry.component[k][place] = entry.line.rest[k];
}

template<IndexKind Index> void FieldTable::carry_over(const CarryWeights<Index>& weights) {
  if (!on_) return;
  for (const Entry& entry : entries_) carry_entry(entry, weights);
}
template void FieldTable::carry_over(const CarryWeights<NodeIndex>&);
template void FieldTable::carry_over(const CarryWeights<PointIndex>&);

void FieldTable::archive(Archive& archive) {
  if (!on_) return;
  for (const Entry& entry : entries_) {
    const std::string path = fmt::format("{}/{}", place_, entry.line.name);
    if (entry.line.checkpoint == Checkpoint::omits) continue;
    if (entry.label) {
      archive.integers(path, *entry.label);
    } else if (entry.components == 1) {
      archive.field(path, entry.line.unit, *entry.component);
    } else {
      for (std::size_t k = 0; k < entry.components; ++k)
        archive.field(fmt::format("{}.{}", path, k), entry.line.unit, entry.component[k]);
    }
  }
}

} // namespace cnem
