#pragma once
// Pictures of a run in its folder: PNG files and an index that says what each shows.
#include "report/picture.hpp"
#include "results/file_queue.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace cnem::report {

/// Colours and part of space of a picture.
struct PictureScale {
  ColourRange range;  ///< SI
  PictureWindow view; ///< m

  bool operator==(const PictureScale&) const = default;
};

struct AlbumEntry {
  std::string file{};   ///< name in the pictures folder
  std::string field;    ///< what is coloured, "equivalent plastic strain"
  double time = 0.0;    ///< s
  std::string caption;  ///< further words, may be empty ("zoom on the band")
  std::string note{};   ///< what the case says of it, may be empty
  std::string series{}; ///< name of the field where it is one of several times; "" of a picture alone
  PictureScale own{};   ///< that of its values and its body alone
  PictureScale drawn{}; ///< as it is on the disk
  // in space, where files of fields do not tell them
  std::vector<Vec3> tools{}; ///< [tool] m, how far each has moved
  std::vector<std::array<Vec3, 2>>
      sides{}; ///< planes that tools are drawn to: m, a place; normal out of the body
};

/// pictures/ of an output folder.
class PictureAlbum {
public:
  /// Goes on with the pictures that are there.
  explicit PictureAlbum(const std::filesystem::path& output_folder);

  /// Hands the maker of a PNG, which holds about `bytes`, to `queue` under a name made of `key`
  /// ("plastic_strain") and a running number, which becomes the file of the entry, then the index. Returns
  /// that name. Throws IoError.
  std::string add(results::FileQueue& queue, const std::string& key, AlbumEntry entry,
                  results::FileQueue::Maker png, std::size_t bytes);

  /// Hands another drawing of an entry to `queue`, then the index. Throws IoError.
  void replace(results::FileQueue& queue, std::size_t entry, const PictureScale& drawn,
               results::FileQueue::Maker png, std::size_t bytes);

  /// Drops the pictures later than `time` (s), for a restart.
  void truncate(double time);

  const std::vector<AlbumEntry>& entries() const { return entries_; }
  std::filesystem::path path(const AlbumEntry& entry) const { return folder_ / entry.file; }

private:
  std::string index() const;
  std::filesystem::path folder_;
  std::vector<AlbumEntry> entries_;
};

} // namespace cnem::report
