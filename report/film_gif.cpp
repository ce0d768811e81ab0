#include "core/error.hpp"
#include "core/index.hpp"
#include "report/film.hpp"

#include <fmt/format.h>

#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <utility>

namespace cnem::report {
namespace {

/// Pixels from `left`, `top` on.
struct Part {
  int left = 0, top = 0, width = 0, height = 0;
};

/// Where two frames differ; one pixel where they do not.
Part changed(const PaletteImage& before, const PaletteImage& now) {
  Part part{now.width, now.height, 0, 0};
  int right = -1, bottom = -1;
  for (int y = 0; y < now.height; ++y)
    for (int x = 0; x < now.width; ++x) {
      const auto k = index_of(y) * index_of(now.width) + index_of(x);
      if (before.index[k] == now.index[k]) continue;
      part.left = std::min(part.left, x);
      part.top = std::min(part.top, y);
      right = std::max(right, x);
      bottom = std::max(bottom, y);
    }
  if (right < 0) return {0, 0, 1, 1};
  part.width = right - part.left + 1;
  part.height = bottom - part.top + 1;
  return part;
}

class GifEncoder final : public FilmEncoder {
public:
  ~GifEncoder() override {
    int ignored = 0;
    if (file_) EGifCloseFile(file_, &ignored);
  }

  void add(const PaletteImage& frame, int centiseconds) override {
    if (!file_) begin(frame);
    const Part part = before_.index.empty() ? Part{0, 0, frame.width, frame.height} : changed(before_, frame);
    GraphicsControlBlock control{DISPOSE_DO_NOT, false, centiseconds, NO_TRANSPARENT_COLOR};
    std::array<GifByteType, 4> bytes{};
    EGifGCBToExtension(&control, bytes.data());
    check(EGifPutExtension(file_, GRAPHICS_EXT_FUNC_CODE, as<int>(bytes.size()), bytes.data()));
    check(EGifPutImageDesc(file_, part.left, part.top, part.width, part.height, false, nullptr));
    std::vector<GifPixelType> row(index_of(part.width));
    for (int y = part.top; y < part.top + part.height; ++y) {
      const auto first = frame.index.begin() + y * frame.width + part.left;
      std::copy(first, first + part.width, row.begin());
      check(EGifPutLine(file_, row.data(), part.width));
    }
    before_ = frame;
  }

  std::string finish() override {
    int error = 0;
    if (file_ && EGifCloseFile(std::exchange(file_, nullptr), &error) == GIF_ERROR) refuse(error);
    return std::move(content_);
  }

private:
  void begin(const PaletteImage& frame) {
    int error = 0;
    file_ = EGifOpen(
        this,
        [](GifFileType* file, const GifByteType* bytes, int count) {
          static_cast<GifEncoder*>(file->UserData)
              ->content_.append(reinterpret_cast<const char*>(bytes), index_of(count));
          return count;
        },
        &error);
    if (!file_) refuse(error);
    EGifSetGifVersion(file_, true);
    const std::unique_ptr<ColorMapObject, void (*)(ColorMapObject*)> colours(GifMakeMapObject(256, nullptr),
                                                                             GifFreeMapObject);
    if (!colours) refuse(E_GIF_ERR_NOT_ENOUGH_MEM);
    for (std::size_t k = 0; k < frame.palette.size(); ++k) {
      const std::uint32_t colour = frame.palette[k];
      colours->Colors[k] = {static_cast<GifByteType>(colour >> 16), static_cast<GifByteType>(colour >> 8),
                            static_cast<GifByteType>(colour)};
    }
    check(EGifPutScreenDesc(file_, frame.width, frame.height, 8, 0, colours.get()));
    // Netscape's extension: again and again.
    check(EGifPutExtensionLeader(file_, APPLICATION_EXT_FUNC_CODE));
    check(EGifPutExtensionBlock(file_, 11, "NETSCAPE2.0"));
    constexpr std::array<GifByteType, 3> without_end{1, 0, 0};
    check(EGifPutExtensionBlock(file_, 3, without_end.data()));
    check(EGifPutExtensionTrailer(file_));
  }
  void check(int answer) const {
    if (answer == GIF_ERROR) refuse(file_->Error);
  }
  [[noreturn]] static void refuse(int error) {
    const char* words = GifErrorString(error);
    throw IoError(fmt::format("cannot encode a GIF: {}", words ? words : "unknown error"));
  }

  GifFileType* file_ = nullptr;
  PaletteImage before_;
  std::string content_;
};

} // namespace

std::unique_ptr<FilmEncoder> gif_encoder() { return std::make_unique<GifEncoder>(); }

} // namespace cnem::report
