#pragma once
// Fields declared once: each field of a group is one line that says its name and unit, how it goes over to a
// resampled cloud, whether a checkpoint keeps it and how users see it. Allocation, checkpoint, transfer,
// files, pictures and the reference of names follow from that line.
#include "core/fields/aligned.hpp"
#include "core/fields/archive.hpp"
#include "core/operators/parcels.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cnem {

/// How a field goes over to the nodes of a resampled cloud and to new stress points
/// (core/operators/parcels.hpp); fields of points are carried by mass, or as labels.
enum class Carry {
  sum,              ///< what adds up: mass, heat capacity
  mass_mean,        ///< mean by mass
  inertia_mean,     ///< mean by what resists acceleration, so that momentum is kept
  capacity_mean,    ///< mean by heat capacity, so that heat is kept
  label,            ///< stays with the node; interpolated where one is inserted
  logarithmic_mean, ///< of a tensor, by mass: ln b_e (mechanics/mixing.hpp)
  renewed,          ///< each step or reference makes it anew
};

/// Whether checkpoints hold a field, or what they hold makes it anew.
enum class Checkpoint { holds, omits };

/// How a field is coloured in pictures (report/colour_map.hpp).
enum class ColourMap {
  strain,    ///< sequential: dark violet, blue, green, yellow
  heat,      ///< sequential: black, purple, orange, pale yellow
  diverging, ///< blue, near white, red: for fields with a sign, zero in the middle
};

/// What users see of a field in files, probes and pictures; without a label it is not shown. Texts are
/// literals.
struct Shown {
  const char* label = nullptr;   ///< "equivalent plastic strain", over pictures
  const char* meaning = nullptr; ///< one sentence for the reference of names
  const char* unit = "";         ///< in pictures
  double factor = 1.0;           ///< SI value of one unit of pictures
  ColourMap map = ColourMap::strain;
};

/// Values at rest of the components of a tensor.
using Rest = std::array<double, 9>;
inline constexpr Rest rest_zero{}, rest_one{1.0}, rest_unit_symmetric{1.0, 1.0, 1.0};
template<int dim>
inline constexpr Rest rest_unit_general =
    dim == 2 ? Rest{1.0, 0.0, 0.0, 1.0, 1.0} : Rest{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};

/// The line that declares a field.
struct FieldLine {
  const char* name;
  const char* unit; ///< SI, "1" for plain numbers
  Carry carry = Carry::renewed;
  Checkpoint checkpoint = Checkpoint::omits;
  Rest rest = rest_zero;
  Shown shown = {};
};

/// What the rules of carrying take their weights from, all of the old nodes or points.
template<IndexKind Index> struct CarryWeights {
  const SourceRows<Index>& parcels;
  const SourceRows<Index>& labels;
  Field mass;       ///< kg/m^(3−dim)
  Field inertia{};  ///< kg/m^(3−dim); empty for points
  Field capacity{}; ///< J/(K m^(3−dim)); empty for points
};

/// The fields of one group: those at nodes, at stress points, or those of one term of the step. Fields enter
/// it as they are constructed, in the order of their lines, and keep their place in memory with it: a copy of
/// a group makes a table of its own.
class FieldTable {
public:
  struct Entry {
    FieldLine line;
    Field* component = nullptr; ///< the first of `components`; null for labels
    std::size_t components = 0;
    std::vector<std::int32_t>* label = nullptr; ///< whole numbers instead
  };

  /// place: path of the group in checkpoints, "solver/point". A group that is off holds no values.
  explicit FieldTable(std::string place, bool on = true) : place_(std::move(place)), on_(on) {}
  ~FieldTable() = default;
  FieldTable(const FieldTable&) = delete;
  /// Fields are assigned one by one; what they are is said already.
  FieldTable& operator=(const FieldTable& other) {
    on_ = other.on_;
    return *this;
  }

  void enter(const Entry& entry) { entries_.push_back(entry); }
  const std::vector<Entry>& entries() const { return entries_; }

  bool on() const { return on_; }
  void switch_on(bool on) { on_ = on; }

  /// All fields to `size` values at rest.
  void rest(std::size_t size);
  /// Fields that each step or reference makes anew, alone.
  void rest_renewed(std::size_t size);
  /// One place to values at rest, but for labels and fields that are made anew.
  void rest_at(std::size_t place);
  /// Sums, means and labels over parcels.
  template<IndexKind Index> void carry_over(const CarryWeights<Index>& weights);
  /// Fields that checkpoints hold, at their present lengths.
  void archive(Archive& archive);

private:
  std::string place_;
  bool on_;
  std::vector<Entry> entries_;
};

/// A declared field of one component.
class ScalarField : public Field {
public:
  ScalarField(FieldTable& table, const FieldLine& line) { table.enter({line, this, 1}); }
  ScalarField(const ScalarField&) = delete;
  ~ScalarField() = default;
  ScalarField& operator=(const ScalarField&) = default;
  ScalarField& operator=(const Field& values) {
    Field::operator=(values);
    return *this;
  }
  ScalarField& operator=(Field&& values) {
    Field::operator=(std::move(values));
    return *this;
  }
};

/// A declared vector or tensor: n components, structure of arrays.
template<int n> class TensorField : public Fields<n> {
public:
  TensorField(FieldTable& table, const FieldLine& line) { table.enter({line, this->data(), n}); }
  TensorField(const TensorField&) = delete;
  ~TensorField() = default;
  TensorField& operator=(const TensorField&) = default;
  TensorField& operator=(const Fields<n>& values) {
    Fields<n>::operator=(values);
    return *this;
  }
  TensorField& operator=(Fields<n>&& values) {
    Fields<n>::operator=(std::move(values));
    return *this;
  }
};

/// A declared field of whole numbers; always a label.
class LabelField : public std::vector<std::int32_t> {
public:
  LabelField(FieldTable& table, const char* name) {
    table.enter({{name, "1", Carry::label, Checkpoint::holds}, nullptr, 0, this});
  }
  LabelField(const LabelField&) = delete;
  ~LabelField() = default;
  LabelField& operator=(const LabelField&) = default;
  LabelField& operator=(std::vector<std::int32_t>&& values) {
    std::vector<std::int32_t>::operator=(std::move(values));
    return *this;
  }
};

} // namespace cnem
