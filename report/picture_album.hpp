#pragma once
// Pictures of a run in its folder: PNG files and an index that says what each shows.
#include "report/picture.hpp"
#include "results/file_queue.hpp"
#include "results/vtk_reader.hpp"

#include <filesystem>
#include <functional>
#include <optional>
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
  std::vector<Vec3> tools{};     ///< [tool] m, how far each has moved
  std::vector<KeptSide> sides{}; ///< that tools are drawn to
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

  /// What pictures of a series share, [entry]: the range of a field, with the colours that `map` tells, and
  /// one view where `shares_view`, of all with its caption. Those of no series stay as they are.
  std::vector<PictureScale> common_scales(const std::function<ColourMap(const std::string& series)>& map,
                                          const std::function<bool(const AlbumEntry&)>& shares_view) const;

  /// A drawing of an entry with another scale: its maker, which holds about `bytes`.
  struct Drawing {
    results::FileQueue::Maker png;
    std::size_t bytes;
  };
  /// None where it stays as it is.
  using Drawer = std::function<std::optional<Drawing>(const AlbumEntry&, const PictureScale&)>;
  /// Draws anew what has another scale than the wanted one. `open` reads a time of the series of files, once
  /// and only where an entry needs it; an empty drawer leaves its pictures as they are. Throws IoError.
  void redraw(results::FileQueue& queue, const std::vector<PictureScale>& wanted,
              const std::vector<results::FieldFiles>& frames,
              const std::function<Drawer(const results::FieldFiles&, const AlbumEntry&)>& open);

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
