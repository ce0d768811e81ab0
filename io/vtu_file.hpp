#pragma once
// One .vtu file: an unstructured grid in VTK's XML format, arrays appended as compressed binary.
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace cnem::io {

/// Arrays as they stand in files of VTK: blocks compressed one by one behind a header of their sizes. What
/// two files share is compressed once.
class VtuArrays {
public:
  /// Takes note of an array, which must live until compress(). Returns its number.
  template<class Number> std::size_t add(std::span<const Number> values) {
    return add_bytes({reinterpret_cast<const char*>(values.data()), values.size_bytes()},
                     std::is_floating_point_v<Number>);
  }
  /// Compresses what was noted, on all threads. Throws IoError.
  void compress();
  /// Header and blocks of an array.
  const std::string& packed(std::size_t array) const { return packed_[array]; }

private:
  std::size_t add_bytes(std::string_view bytes, bool real);

  std::vector<std::string_view> bytes_;
  std::vector<bool> real_; ///< floating-point numbers
  std::vector<std::string> packed_;
  std::map<std::pair<const char*, std::size_t>, std::size_t> known_;
};

/// An array of a file: its place in VtuArrays and how VTK is to read it.
struct VtuEntry {
  std::string name;
  const char* type = "Float64"; ///< or "Int32", "UInt8"
  int components = 1;
  std::size_t array = 0;
};

struct VtuGrid {
  double time = 0.0; ///< s
  std::size_t points = 0, cells = 0;
  VtuEntry position;                     ///< three components
  VtuEntry connectivity, offsets, types; ///< as in VTK's file formats
  std::vector<VtuEntry> point_data, cell_data;
};

/// The file as text. The arrays must be compressed.
std::string vtu_text(const VtuGrid& grid, const VtuArrays& arrays);

} // namespace cnem::io
