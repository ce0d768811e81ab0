#include "report/movie.hpp"

#include "core/error.hpp"
#include "input/case_reader.hpp"
#include "input/schema/nearest.hpp"
#include "report/film.hpp"
#include "report/picture_recorder.hpp"
#include "results/output_folder.hpp"
#include "results/vtk_reader.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

namespace cnem::report {
namespace fs = std::filesystem;
namespace {

input::Case case_of(const MovieOptions& options) {
  const fs::path resolved = options.folder / results::files::resolved_case;
  if (!fs::exists(resolved) || !fs::exists(options.folder / results::files::fields))
    throw InputError(
        fmt::format("{} holds no run with fields: expected the output folder of `cnem run`, with "
                    "its {} and {}",
                    options.folder.string(), results::files::resolved_case, results::files::fields));
  input::Case input = input::read_case(resolved.string());
  if (input.analysis.dimensions() == 3)
    throw InputError(fmt::format("{} is of three dimensions: films show the plane; ParaView opens {}",
                                 options.folder.string(), results::files::fields));
  input.output.drawing.mirror |= options.mirror;
  return input;
}

std::string field_of(const MovieOptions& options, const input::Case& input) {
  if (options.field.empty()) return input.output.picture_fields.front();
  const std::vector<std::string> known = input::field_names(2);
  if (std::find(known.begin(), known.end(), options.field) == known.end())
    throw InputError(fmt::format("--field: found '{}', expected one of {}{}", options.field,
                                 fmt::join(known, ", "), input::did_you_mean(options.field, known)));
  return options.field;
}

const input::Window* window_of(const MovieOptions& options, const input::Case& input) {
  if (options.window.empty()) return nullptr;
  std::vector<std::string> known;
  for (const input::Window& window : input.output.windows) {
    if (window.name == options.window) return &window;
    known.push_back(window.name);
  }
  throw InputError(fmt::format("--window: found '{}', expected {}", options.window,
                               known.empty() ? "none: the case has no output.windows"
                                             : fmt::format("one of {}", fmt::join(known, ", "))));
}

std::vector<results::FieldFiles> frames_of(const MovieOptions& options) {
  if (options.from.value_or(0.0) >= options.to.value_or(INFINITY))
    throw InputError(fmt::format("--from {:g} s is not before --to {:g} s", *options.from, *options.to));
  std::vector<results::FieldFiles> frames = results::read_field_series(options.folder);
  std::erase_if(frames, [&](const results::FieldFiles& frame) {
    const double slack = 1e-9 * frame.time;
    return frame.time < options.from.value_or(0.0) - slack ||
           frame.time > options.to.value_or(INFINITY) + slack;
  });
  if (frames.size() < 2)
    throw InputError(fmt::format("{} has {} of the times asked for, expected two or more: run with a smaller "
                                 "output.fields_every, or take a longer interval",
                                 (options.folder / results::files::fields).string(), frames.size()));
  return frames;
}

/// Pictures of one field at all times, on one scale.
class Series {
public:
  explicit Series(const MovieOptions& options)
      : folder_(options.folder), input_(case_of(options)), field_(field_of(options, input_)),
        window_(window_of(options, input_)), frames_(frames_of(options)), width_(options.width) {
    if (!results::has_cell_field(folder_ / frames_.front().cells,
                                 results::array_in_files(field_info<2>(field_))))
      throw InputError(
          fmt::format("--field: the run has no '{}': no material of it follows such a law, or it does not "
                      "adapt",
                      field_));
    std::optional<ColourRange> span;
    for (std::size_t k = 0; k < frames_.size(); ++k) {
      const auto source = read(k);
      const Picture picture = picture_of(input_, *source, 0);
      const ColourRange own = own_span(input_, field_, picture);
      const PictureWindow shown = whole_window(picture);
      span = span ? joined(*span, own) : own;
      whole_ = k == 0 ? shown : joined(whole_, shown);
      range_ = widened(picture.map, *span);
    }
    if (const auto& view = input_.output.drawing.view) whole_ = {view->front(), view->back()};
  }

  const std::string& field() const { return field_; }
  std::size_t size() const { return frames_.size(); }
  PaletteImage draw(std::size_t k) const {
    const auto source = read(k);
    Picture picture = picture_of(input_, *source, 0);
    picture.range = range_;
    picture.window = window_ ? window_at(*window_, picture.tools) : whole_;
    picture.width = width_;
    return report::draw(picture);
  }

private:
  std::shared_ptr<PictureSource> read(std::size_t k) const {
    return picture_source(input_, folder_, frames_[k], {field_});
  }

  fs::path folder_;
  input::Case input_;
  std::string field_;
  const input::Window* window_;
  std::vector<results::FieldFiles> frames_;
  int width_;
  ColourRange range_;
  PictureWindow whole_;
};

std::string encode(const Series& series, FilmEncoder& film, double frames_per_second) {
  const int delay = static_cast<int>(std::lround(100.0 / frames_per_second));
  constexpr int pause = 100; // before it begins again
  for (std::size_t k = 0; k < series.size(); ++k)
    film.add(series.draw(k), k + 1 < series.size() ? delay : delay + pause);
  return film.finish();
}

} // namespace

fs::path make_movie(const MovieOptions& options) {
  const std::string ending = options.output.empty() ? ".gif" : options.output.extension().string();
  if (ending != ".gif" && ending != ".webp" && ending != ".mp4")
    throw InputError(fmt::format("--output: found '{}', expected a name that ends in .gif, .webp or .mp4",
                                 options.output.string()));
  if (!(options.frames_per_second > 0.0))
    throw InputError(
        fmt::format("--fps: found {}, expected a number from 0.1 to 50", options.frames_per_second));
  const Series series(options);
  const fs::path path =
      options.output.empty()
          ? options.folder / (series.field() + (options.window.empty() ? "" : "_" + options.window) + ".gif")
          : options.output;
  const auto encoder = ending == ".webp" ? webp_encoder() : gif_encoder();
  const std::string film = encode(series, *encoder, options.frames_per_second);
  if (ending != ".mp4") {
    results::write_atomically(path, film);
    return path;
  }
  // Names that nobody else has, beside the film: it is renamed into place. Whole ones, lest ffmpeg takes
  // "-x.mp4" for an option or "film:1.mp4" for a protocol.
  const fs::path beside = fs::absolute(path).parent_path();
  const fs::path gif = beside / fmt::format(".film.{}.gif", getpid());
  const fs::path made = beside / fmt::format(".film.{}.mp4", getpid());
  results::write_atomically(gif, film);
  std::error_code error;
  try {
    convert_to_mp4(gif, made);
    fs::rename(made, path, error);
    if (error) throw IoError(fmt::format("cannot write {}: {}", path.string(), error.message()));
  } catch (...) {
    fs::remove(gif, error);
    fs::remove(made, error);
    throw;
  }
  fs::remove(gif, error);
  return path;
}

} // namespace cnem::report
