#include "python/run.hpp"

#include "app/version.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "input/schema/nearest.hpp"
#include "report/colour_map.hpp"
#include "report/picture_source.hpp"
#include "results/fields.hpp"
#include "results/vtk_writer.hpp"

#include <fmt/format.h>
#include <stdexcept>

namespace cnem::python {

namespace {

app::RunOptions options_of(const std::string& output, bool force, int threads) {
  return {
      .output = output, .force = force, .threads = threads, .version = app::version(), .keep_history = true};
}

/// Whether the state has the field now.
template<int dim> bool is_there(const FieldInfo<dim>& info, const results::Snapshot<dim>& shot) {
  return !info.adaptive || shot.adaptation;
}

template<int dim> std::vector<std::string> names_in(const results::Snapshot<dim>& shot) {
  std::vector<std::string> names;
  for (const FieldInfo<dim>& info : field_catalogue<dim>())
    if (is_there(info, shot)) names.push_back(info.name);
  return names;
}

template<int dim> const FieldInfo<dim>& info_of(const std::string& name, const results::Snapshot<dim>& shot) {
  for (const FieldInfo<dim>& info : field_catalogue<dim>())
    if (info.name == name && is_there(info, shot)) return info;
  const std::vector<std::string> names = names_in(shot);
  throw InputError(fmt::format("field '{}': there is none in this run, expected one of {}{}", name,
                               fmt::join(names, ", "), input::did_you_mean(name, names)));
}

/// The field itself, where the run keeps its values; what is of adaptation is made anew for every look.
template<int dim> const Field* kept_field(const FieldInfo<dim>& info, const results::Snapshot<dim>& shot) {
  if (!info.kept || info.adaptive) return nullptr;
  const Field* field = info.kept({shot.state, shot.adaptation});
  return field->empty() ? nullptr : field;
}

template<int dim> results::Snapshot<dim> of_dimension(const PythonRun::Shot& shot) {
  return std::get<results::Snapshot<dim>>(shot);
}

} // namespace

PythonRun::PythonRun(const input::Case& input, const std::string& output, bool force, int threads) {
  run_.emplace(input, options_of(output, force, threads), watcher_);
}

PythonRun::PythonRun(const std::string& folder, int threads) {
  run_.emplace(options_of(folder, false, threads), watcher_);
}

void PythonRun::go_on(const Until& until, py::object callback) {
  if (going_.exchange(true))
    throw std::runtime_error(watcher_.calls_back() ? "a run cannot go on from within its own callback"
                                                   : "this run goes on in another thread");
  struct Guard {
    std::atomic<bool>& going;
    ~Guard() { going = false; }
  } const guard{going_};
  watcher_.expect(until, std::move(callback));
  try {
    std::optional<int> exit;
    {
      const py::gil_scoped_release others;
      exit = run_->go_on();
    }
    exit_ = exit; // others look at it with the lock of the interpreter
  } catch (...) {
    watcher_.expect({}, {});
    throw;
  }
  watcher_.settle();
}

app::Session& PythonRun::session() {
  if (going_ && !watcher_.calls_back()) throw std::runtime_error("this run goes on in another thread");
  return run_->session();
}

template<class Find> std::function<const Field*()> PythonRun::finder(Find find) {
  return [weak = weak_from_this(), find]() -> const Field* {
    const std::shared_ptr<PythonRun> run = weak.lock();
    return run ? find(run->session()) : nullptr;
  };
}

std::vector<std::string> PythonRun::field_names() {
  return std::visit([](const auto& shot) { return names_in(shot); }, shot());
}

py::array PythonRun::field(const std::string& name, const std::string& at) {
  if (!at.empty() && at != "nodes" && at != "points")
    throw InputError(fmt::format("at: found '{}', expected \"nodes\" or \"points\"", at));
  return std::visit(
      [&]<int dim>(const results::Snapshot<dim>& shot) {
        const FieldInfo<dim>& info = info_of(name, shot);
        const bool nodal = shot.approximation.mechanics.nodal; // points are nodes
        const bool at_nodes = at.empty() ? info.at_nodes : at == "nodes";
        const Field* kept = kept_field(info, shot);
        if (kept && (at_nodes == info.at_nodes || nodal))
          return view(*kept, finder([&info](app::Session& session) {
            return kept_field(info, of_dimension<dim>(session.snapshot()));
          }));
        return owned(at_nodes ? results::values_at_nodes(shot, name) : results::values_at_points(shot, name));
      },
      shot());
}

py::tuple PythonRun::positions() {
  return std::visit(
      [&]<int dim>(const results::Snapshot<dim>& shot) {
        py::tuple list(dim);
        for (int k = 0; k < dim; ++k) {
          const Field& values = shot.state.node.position[index_of(k)];
          const double origin = input().origin[k];
          if (origin == 0.0) {
            list[index_of(k)] = view(values, finder([k](app::Session& session) {
                                       return &std::get<results::Snapshot<dim>>(session.snapshot())
                                                   .state.node.position[index_of(k)];
                                     }));
            continue;
          }
          Field placed = values;
          for (double& x : placed) x += origin;
          list[index_of(k)] = owned(placed);
        }
        return list;
      },
      shot());
}

Cells PythonRun::cells() {
  return std::visit(
      [&]<int dim>(const results::Snapshot<dim>& shot) {
        const CellGeometry<dim>& geometry = shot.approximation.cells;
        std::array<std::span<const double>, dim> position;
        for (std::size_t k = 0; k < dim; ++k) position[k] = shot.state.node.position[k];
        Cells cells{.vertex = {}, .dimensions = dim, .begin = geometry.begin, .index = geometry.index};
        for (const Vec<dim>& x : results::moved_vertices<dim>(geometry, position))
          for (int k = 0; k < dim; ++k) cells.vertex.push_back(x[k] + input().origin[k]);
        return cells;
      },
      shot());
}

py::bytes PythonRun::picture(const std::string& field, int width) {
  const Shot now = shot();
  const auto* shot = std::get_if<results::Snapshot<2>>(&now);
  if (!shot) throw InputError("picture: the case is three-dimensional, expected one in the plane");
  constexpr int least = 300, most = 4000; // px
  if (width < least || width > most)
    throw InputError(fmt::format("width: found {}, expected {} to {} pixels", width, least, most));
  const std::string& name = field.empty() ? input().output.picture_fields.front() : field;
  info_of(name, *shot);
  const auto source = report::picture_source(input(), *shot, report::drawn_positions<2>(*shot), {name});
  report::Picture picture = report::picture_of(input(), *source, 0);
  picture.range = report::widened(picture.map, report::own_span(input(), name, picture));
  if (const auto& view = input().output.drawing.view)
    picture.window = report::PictureWindow{view->front(), view->back()};
  picture.width = width;
  return report::draw_png(picture);
}

py::array PythonRun::column(std::size_t k) {
  return view(session().history().columns().at(k), finder([k](app::Session& session) -> const Field* {
                const auto& columns = session.history().columns();
                return k < columns.size() ? &columns[k] : nullptr;
              }));
}

} // namespace cnem::python
