#pragma once
// One checkpoint: an HDF5 file behind 512 bytes that say what it is, how long it has to be and its checksum.
// HDF5 tools skip those bytes, so h5dump and h5py open the file as it is.
#include "core/fields/archive.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace cnem::results {

/// Raised by every change of what is written or how; files of another format are refused.
inline constexpr int checkpoint_format = 33;

/// Whose checkpoint it is; kept under "info/".
struct CheckpointInfo {
  std::string version; ///< of the program
  std::string isa;     ///< instruction set of the kernels: the bits depend on it
  std::string name;    ///< of the case
  std::string inputs;  ///< hash of the resolved case
  std::int64_t step = 0;
  double time = 0.0; ///< s

  void archive(Archive& archive);
};

/// Hash of what a run depends on: the resolved case without its first line, which names a file.
std::string hash_of_inputs(std::string_view resolved_case);

/// Collects quantities in memory.
class CheckpointWriter final : public Archive {
public:
  /// Throws IoError when HDF5 fails, for want of memory say.
  CheckpointWriter();
  ~CheckpointWriter() override;

  bool loading() const override { return false; }
  /// The whole file, the same bytes for the same quantities. Nothing can be added afterwards.
  std::string content();

private:
  std::size_t extent(const std::string& name) override;
  void carry(const std::string& name, const char* unit, std::span<double> values) override;
  void carry(const std::string& name, std::span<std::int64_t> values) override;
  void carry(const std::string& name, std::string& value) override;

  struct File;
  std::unique_ptr<File> file_;
};

/// Hands out the quantities of a file.
class CheckpointReader final : public Archive {
public:
  /// Takes the content of a file. Throws IoError with the reason when it is no checkpoint, of another format,
  /// cut short or damaged.
  explicit CheckpointReader(std::string_view content);
  ~CheckpointReader() override;

  bool loading() const override { return true; }

private:
  std::size_t extent(const std::string& name) override;
  void carry(const std::string& name, const char* unit, std::span<double> values) override;
  void carry(const std::string& name, std::span<std::int64_t> values) override;
  void carry(const std::string& name, std::string& value) override;

  struct File;
  std::unique_ptr<File> file_;
};

} // namespace cnem::results
