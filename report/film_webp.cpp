#include "core/error.hpp"
#include "core/index.hpp"
#include "report/film.hpp"

#include <fmt/format.h>

#include <webp/encode.h>
#include <webp/mux.h>

namespace cnem::report {
namespace {

class WebpEncoder final : public FilmEncoder {
public:
  ~WebpEncoder() override { WebPAnimEncoderDelete(encoder_); }

  void add(const PaletteImage& frame, int centiseconds) override {
    if (!encoder_) begin(frame);
    std::vector<std::uint32_t> pixels(frame.index.size());
    for (std::size_t k = 0; k < pixels.size(); ++k) pixels[k] = 0xFF000000U | frame.palette[frame.index[k]];
    WebPPicture picture;
    WebPConfig config;
    if (!WebPPictureInit(&picture) || !WebPConfigInit(&config))
      throw IoError("cannot encode a WebP film: the library is of another version");
    config.lossless = 1;
    config.quality = 30.0F; // of effort
    config.method = 2;
    picture.use_argb = 1;
    picture.width = frame.width;
    picture.height = frame.height;
    picture.argb = pixels.data(); // a view, which it does not free
    picture.argb_stride = frame.width;
    check(WebPAnimEncoderAdd(encoder_, &picture, milliseconds_, &config));
    milliseconds_ += 10 * centiseconds;
  }

  std::string finish() override {
    check(WebPAnimEncoderAdd(encoder_, nullptr, milliseconds_, nullptr));
    WebPData data;
    WebPDataInit(&data);
    check(WebPAnimEncoderAssemble(encoder_, &data));
    std::string content(reinterpret_cast<const char*>(data.bytes), data.size);
    WebPDataClear(&data);
    return content;
  }

private:
  void begin(const PaletteImage& frame) {
    WebPAnimEncoderOptions options;
    WebPAnimEncoderOptionsInit(&options);
    encoder_ = WebPAnimEncoderNew(frame.width, frame.height, &options);
    if (!encoder_) throw IoError("cannot encode a WebP film: there is no memory");
  }
  void check(int answer) const {
    if (!answer)
      throw IoError(fmt::format("cannot encode a WebP film: {}", WebPAnimEncoderGetError(encoder_)));
  }

  WebPAnimEncoder* encoder_ = nullptr;
  int milliseconds_ = 0; ///< when the next frame begins
};

} // namespace

std::unique_ptr<FilmEncoder> webp_encoder() { return std::make_unique<WebpEncoder>(); }

} // namespace cnem::report
