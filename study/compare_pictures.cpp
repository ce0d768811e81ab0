// Pictures of all methods, of the same field at the same time, with one scale of colours and one window.
#include "core/index.hpp"
#include "report/html.hpp"
#include "report/picture.hpp"
#include "report/picture_recorder.hpp"
#include "results/fields.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"
#include "results/vtk_reader.hpp"
#include "study/compare.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace cnem::study {

namespace {

namespace fs = std::filesystem;

/// What the pictures of one method at one time are drawn from; none where it has not come so far.
struct Frame {
  double time = 0.0; ///< s
  results::CellFields fields;
  std::vector<Vec2> displacement; ///< [tool] m
};

/// The fields on the disk of each method, by their times.
class Frames {
public:
  explicit Frames(const Compared& compared) : compared_(compared) {
    for (std::size_t k = 0; k < compared.outcome.size(); ++k) {
      series_.emplace_back();
      // Without a history nothing there belongs to this run.
      if (compared.outcome[k].history.rows() > 0 && fs::exists(folder(k) / results::files::fields))
        if_whole(k, [&] { series_.back() = results::read_field_series(folder(k)); });
    }
  }

  /// The time of the frame nearest to `time`, of the method that is done first, else of any; none without
  /// frames.
  std::optional<double> nearest_time(double time) const {
    for (const bool done : {true, false})
      for (std::size_t k = 0; k < series_.size(); ++k)
        if (compared_.outcome[k].done() == done && !series_[k].empty()) return nearest(k, time).time;
    return {};
  }

  /// The frames of all methods at a time, none where a method has none within a thousandth of the run.
  std::vector<std::optional<Frame>> at(double time, double tolerance,
                                       const std::vector<results::FileArray>& fields) const {
    std::vector<std::optional<Frame>> frames(series_.size());
    for (std::size_t k = 0; k < series_.size(); ++k) {
      if (series_[k].empty()) continue;
      const results::FieldFiles& files = nearest(k, time);
      if (std::abs(files.time - time) > tolerance) continue;
      const input::Case& input = *compared_.outcome[k].input;
      if_whole(k, [&] {
        frames[k] = Frame{files.time,
                          results::read_cell_fields(folder(k) / files.cells, fields, input.origin.head<2>()),
                          displacements(k, files.time)};
      });
    }
    enlarge(frames);
    return frames;
  }

private:
  /// What a run that failed has left may be damaged: it does without then.
  template<class Read> void if_whole(std::size_t k, Read&& read) const {
    try {
      read();
    } catch (const IoError&) {
      if (compared_.outcome[k].done()) throw;
    }
  }

  fs::path folder(std::size_t k) const { return compared_.folder / compared_.study.runs[k].name; }

  /// Displacements that files tell of their own are too small to be seen: all methods' are drawn alike, the
  /// largest as 5% of the body, as in the pictures of a static analysis.
  static void enlarge(std::vector<std::optional<Frame>>& frames) {
    double scale = std::numeric_limits<double>::infinity();
    for (const std::optional<Frame>& frame : frames)
      if (frame && !frame->fields.displacement[0].empty())
        scale = std::min(scale, drawing_scale(frame->fields));
    if (!std::isfinite(scale)) return;
    for (std::optional<Frame>& frame : frames)
      for (std::size_t k = 0; frame && k < 2; ++k)
        for (std::size_t v = 0; v < frame->fields.displacement[k].size(); ++v)
          frame->fields.position[k][v] += (scale - 1.0) * frame->fields.displacement[k][v];
  }
  static double drawing_scale(const results::CellFields& fields) {
    double size = 0.0, most = 0.0;
    for (std::size_t k = 0; k < 2; ++k) {
      Field initial = fields.position[k];
      for (std::size_t v = 0; v < initial.size(); ++v) initial[v] -= fields.displacement[k][v];
      const auto [low, high] = std::minmax_element(initial.begin(), initial.end());
      size = std::max(size, *high - *low);
    }
    for (std::size_t v = 0; v < fields.displacement[0].size(); ++v)
      most = std::max(most, std::hypot(fields.displacement[0][v], fields.displacement[1][v]));
    return 0.05 * size / most; // infinite where nothing moves
  }

  /// The beginning, where nothing has happened, stands for no later time.
  const results::FieldFiles& nearest(std::size_t k, double time) const {
    const auto distance = [&](const results::FieldFiles& files) {
      return files.time == 0.0 && time > 0.0 ? std::numeric_limits<double>::infinity()
                                             : std::abs(files.time - time);
    };
    return *std::min_element(series_[k].begin(), series_[k].end(), [&](const auto& one, const auto& other) {
      return distance(one) < distance(other);
    });
  }

  std::vector<Vec2> displacements(std::size_t k, double time) const {
    const results::HistoryTable& history = compared_.outcome[k].history;
    const auto column = [&](const std::string& name) {
      const int at = history.find(name);
      return at < 0 ? 0.0
                    : evaluate::interpolated(history.column.front(), history.column[index_of(at)], {time})
                          .front();
    };
    std::vector<Vec2> list;
    for (const input::Tool& tool : compared_.outcome[k].input->tools)
      list.emplace_back(column(tool.name + ".displacement_x"), column(tool.name + ".displacement_y"));
    return list;
  }

  const Compared& compared_;
  std::vector<std::vector<results::FieldFiles>> series_;
};

/// The case that says what is drawn: of the first method that runs.
const input::Case& leading_case(const Compared& compared) {
  return *std::find_if(compared.outcome.begin(), compared.outcome.end(), [](const Outcome& outcome) {
            return outcome.input.has_value();
          })->input;
}

report::PictureWindow shown_by(const report::PictureLayout& layout) {
  return {layout.origin, layout.origin + Vec2(layout.plot_width, layout.plot_height) / layout.scale};
}

/// Pictures of one field at one time, of those methods that have a frame.
class Row {
public:
  Row(const Compared& compared, const std::vector<std::optional<Frame>>& frames, const std::string& field,
      std::size_t index) {
    for (std::size_t k = 0; k < frames.size(); ++k) {
      picture_.emplace_back();
      if (!frames[k]) continue;
      report::Picture& picture = picture_.back().emplace();
      const results::CellFields& fields = frames[k]->fields;
      picture.cells = &fields.cells;
      picture.position = {fields.position[0], fields.position[1]};
      picture.value = fields.values[index];
      report::show_field(picture, field_info<2>(field).shown,
                         results::ShownUnits(compared.outcome[k].input->report.units));
      picture.title = compared.study.runs[k].name;
      picture.time = frames[k]->time;
      const std::vector<input::Tool>& tools = compared.outcome[k].input->tools;
      for (std::size_t t = 0; t < tools.size(); ++t)
        picture.tools.push_back({&tools[t].outline, frames[k]->displacement[t], tools[t].name});
    }
    share_scale(compared);
  }

  /// The PNG file of each method, "" for none. Without a window (null) the same part is shown of all.
  std::vector<std::string> draw(const input::Window* window) {
    std::vector<std::string> png;
    for (std::optional<report::Picture>& picture : picture_) {
      png.emplace_back();
      if (!picture) continue;
      picture->window = window ? report::window_at(*window, picture->tools) : common_;
      png.back() = report::draw_png(*picture);
    }
    return png;
  }

private:
  /// What a run that failed has come to says nothing of the others: it is drawn on their scale, where there
  /// are any.
  void share_scale(const Compared& compared) {
    bool any_done = false;
    for (std::size_t k = 0; k < picture_.size(); ++k)
      any_done = any_done || (picture_[k] && compared.outcome[k].done());
    std::vector<double> values;
    ColourMap map = ColourMap::strain;
    for (std::size_t k = 0; k < picture_.size(); ++k) {
      if (!picture_[k] || compared.outcome[k].done() != any_done) continue;
      values.insert(values.end(), picture_[k]->value.begin(), picture_[k]->value.end());
      map = picture_[k]->map;
      const report::PictureWindow own = shown_by(report::layout_picture(*picture_[k]));
      if (!common_) common_ = own;
      common_->low = common_->low.cwiseMin(own.low);
      common_->high = common_->high.cwiseMax(own.high);
    }
    for (std::optional<report::Picture>& picture : picture_)
      if (picture) picture->range = report::usual_range(map, values);
  }

  std::vector<std::optional<report::Picture>> picture_;
  std::optional<report::PictureWindow> common_;
};

std::string figure(const Compared& compared, std::size_t k, const std::string& png, const std::string& what,
                   double time) {
  const std::string& method = compared.study.runs[k].name;
  const std::string name = report::html_escape(method);
  if (!png.empty())
    return fmt::format("<figure><figcaption>{}</figcaption>{}</figure>\n", name,
                       report::picture_element(
                           png, fmt::format("{} of {} at {}", what, method, results::si_format(time, "s"))));
  const Outcome& outcome = compared.outcome[k];
  const std::string why = outcome.status && outcome.status->time < time
                              ? "ended at t = " + results::si_format(outcome.status->time, "s")
                              : "no fields on the disk";
  return fmt::format("<figure><figcaption>{}</figcaption><p>{}</p></figure>\n", name,
                     outcome.record.state == RunRecord::State::refused ? "refused"
                                                                       : report::html_escape(why));
}

/// Times of frames nearest to those of pictures, each once; `exact` becomes false when one differs.
std::vector<double> times_of(const input::Case& input, const Frames& frames, bool& exact) {
  std::vector<double> times;
  for (const double wanted : input.output.pictures) {
    if (wanted > input.time.end * (1.0 + 1e-9)) continue;
    const std::optional<double> time = frames.nearest_time(wanted);
    if (!time) continue;
    exact = exact && std::abs(*time - wanted) <= 1e-6 * input.time.end;
    if (times.empty() || times.back() != *time) times.push_back(*time);
  }
  return times;
}

} // namespace

std::string compare_pictures(const Compared& compared) {
  const input::Case& input = leading_case(compared);
  if (input.analysis.dimensions() != 2) return "";
  const Frames frames(compared);
  bool exact = true;
  const std::vector<double> times = times_of(input, frames, exact);
  if (times.empty()) return "";
  const std::vector<std::string>& fields = input.output.picture_fields;
  std::vector<results::FileArray> names;
  for (const std::string& field : fields) names.push_back(results::array_in_files(field_info<2>(field)));

  // By field and part of the body, as in the report of a run; frames are read once a time.
  std::vector<std::pair<std::string, std::string>> sections;
  std::map<std::string, std::size_t> section_of;
  const auto add = [&](const std::string& what, const std::vector<std::string>& png, double time) {
    if (const auto [at, fresh] = section_of.emplace(what, sections.size()); fresh)
      sections.emplace_back(what, "");
    std::string& html = sections[section_of[what]].second;
    html += "<div class=\"pictures side\">\n";
    for (std::size_t k = 0; k < png.size(); ++k) html += figure(compared, k, png[k], what, time);
    html += "</div>\n";
  };
  for (const double time : times) {
    const auto there = frames.at(time, 1e-3 * input.time.end, names);
    for (std::size_t f = 0; f < fields.size(); ++f) {
      Row row(compared, there, fields[f], f);
      const std::string label = field_info<2>(fields[f]).shown.label;
      add(label, row.draw(nullptr), time);
      for (const input::Window& window : input.output.windows)
        add(label + ", " + window.name, row.draw(&window), time);
    }
  }
  std::string html =
      "<section id=\"pictures\">\n<h2>Pictures</h2>\n<p class=\"hint\">Each row has one scale of "
      "colours and shows one part of space.";
  if (!exact)
    html +=
        " Drawn from the fields on the disk (output.fields_every) nearest to the times of output.pictures.";
  html += "</p>\n";
  for (const auto& [what, rows] : sections)
    html += fmt::format("<h3>{}</h3>\n{}", report::html_escape(what), rows);
  return html + "</section>\n";
}

} // namespace cnem::study
