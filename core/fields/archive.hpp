#pragma once
// How a checkpoint is described: an object lists what evolves in it once, and the same list writes and reads.
#include "core/fields/aligned.hpp"
#include "core/index.hpp"
#include "core/vec.hpp"

#include <array>
#include <cstdint>
#include <fmt/format.h>
#include <span>
#include <string>
#include <vector>

namespace cnem {

/// Carries named quantities out of an object (loading() is false) or into it. Names are paths such as
/// "solver/node/velocity"; units are SI, "1" for plain numbers. Loading throws IoError when a name is absent
/// or has another type or length than expected.
class Archive {
public:
  Archive() = default;
  virtual ~Archive() = default;
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  virtual bool loading() const = 0;

  void number(const std::string& name, const char* unit, double& value) { carry(name, unit, {&value, 1}); }
  template<int dim> void vector(const std::string& name, const char* unit, Vec<dim>& value) {
    carry(name, unit, {value.data(), index_of(dim)});
  }
  /// Keeps the length the field has.
  void field(const std::string& name, const char* unit, Field& values) { carry(name, unit, values); }
  template<std::size_t n>
  void field(const std::string& name, const char* unit, std::array<Field, n>& fields) {
    for (std::size_t k = 0; k < n; ++k) carry(fmt::format("{}.{}", name, k), unit, fields[k]);
  }
  /// Takes the length it finds.
  void list(const std::string& name, const char* unit, std::vector<double>& values) {
    if (loading()) values.resize(extent(name));
    carry(name, unit, values);
  }
  /// Takes the length it finds.
  void integers(const std::string& name, std::vector<std::int32_t>& values) {
    std::vector<std::int64_t> wide(values.begin(), values.end());
    if (loading()) wide.resize(extent(name));
    carry(name, std::span<std::int64_t>(wide));
    values.assign(wide.begin(), wide.end());
  }
  template<IndexKind Index> void integers(const std::string& name, std::vector<Index>& values) {
    std::vector<std::int64_t> wide;
    for (const Index value : values) wide.push_back(as<std::int64_t>(value));
    if (loading()) wide.resize(extent(name));
    carry(name, std::span<std::int64_t>(wide));
    values.clear();
    for (const std::int64_t value : wide) values.push_back(as<Index>(value));
  }
  void integers(const std::string& name, std::vector<std::int64_t>& values) {
    if (loading()) values.resize(extent(name));
    carry(name, std::span<std::int64_t>(values));
  }
  template<class Integer> void integer(const std::string& name, Integer& value) {
    auto wide = static_cast<std::int64_t>(value);
    carry(name, {&wide, 1});
    value = static_cast<Integer>(wide);
  }
  void text(const std::string& name, std::string& value) { carry(name, value); }
  /// Texts without line breaks.
  void texts(const std::string& name, std::vector<std::string>& values) {
    std::string lines;
    for (const std::string& value : values) lines += value + '\n';
    carry(name, lines);
    values.clear();
    for (std::size_t from = 0; from < lines.size();) {
      const std::size_t end = lines.find('\n', from);
      values.push_back(lines.substr(from, end - from));
      from = end + 1;
    }
  }

protected:
  /// Number of values under a name; called when loading.
  virtual std::size_t extent(const std::string& name) = 0;
  virtual void carry(const std::string& name, const char* unit, std::span<double> values) = 0;
  virtual void carry(const std::string& name, std::span<std::int64_t> values) = 0;
  virtual void carry(const std::string& name, std::string& value) = 0;
};

} // namespace cnem
