#pragma once
// The checkpoints of an output folder: checkpoint.h5 is the newest, checkpoint.1.h5 the one before it, and so
// on.
#include <filesystem>
#include <string_view>
#include <vector>

namespace cnem::results {

/// Makes `content` the newest checkpoint and keeps `keep` (at least 1) in all. It is written beside, flushed
/// and renamed; whenever this is interrupted, checkpoint.h5 is whole and the older ones keep their order.
/// Throws IoError.
void add_checkpoint(const std::filesystem::path& folder, std::string_view content, int keep);

/// All checkpoints there, the newest first.
std::vector<std::filesystem::path> list_checkpoints(const std::filesystem::path& folder);

/// Renames a checkpoint that is no use: checkpoint.h5 to checkpoint.refused.h5, checkpoint.1.h5 to
/// checkpoint.refused.1.h5.
void set_aside(const std::filesystem::path& checkpoint);

} // namespace cnem::results
