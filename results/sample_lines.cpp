#include "results/sample_lines.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "results/fields.hpp"
#include "results/output_folder.hpp"

#include <fmt/format.h>

namespace cnem::results {

template<int dim>
SampleLines<dim>::SampleLines(const input::Case& input, const Cloud<dim>& cloud,
                              const Approximation<dim>& approximation)
    : input_(&input) {
  if (input.output.lines.empty()) return;
  const PointLocator<dim> locator(cloud, approximation.cells);
  for (const input::SampleLine& line : input.output.lines) {
    std::vector<PointWeights>& points = points_.emplace_back(index_of(line.samples));
    try {
      for (std::size_t k = 0; k < points.size(); ++k) points[k] = locator.weights(place(line, k));
    } catch (const GeometryError& error) { throw input.error("output.lines." + line.name, error.what()); }
  }
}

template<int dim> Vec<dim> SampleLines<dim>::place(const input::SampleLine& line, std::size_t k) const {
  const Vec<dim> from = line.from.head<dim>(), to = line.to.head<dim>();
  return from + (to - from) * (static_cast<double>(k) / (line.samples - 1));
}

template<int dim>
void SampleLines<dim>::resample(const Resampling<dim>& change, const Cloud<dim>& cloud,
                                const Approximation<dim>& approximation) {
  if (points_.empty()) return;
  const PointLocator<dim> locator(cloud, approximation.cells);
  for (std::vector<PointWeights>& points : points_)
    for (PointWeights& point : points) follow<dim>(change, locator, point);
}

template<int dim> void SampleLines<dim>::archive(Archive& archive) {
  for (std::size_t l = 0; l < points_.size(); ++l) {
    std::vector<NodeIndex> node;
    std::vector<double> weight;
    std::vector<std::int32_t> entries;
    for (const PointWeights& point : points_[l]) {
      entries.push_back(static_cast<std::int32_t>(point.node.size()));
      node.insert(node.end(), point.node.begin(), point.node.end());
      weight.insert(weight.end(), point.weight.begin(), point.weight.end());
    }
    const std::string name = "run/lines/" + input_->output.lines[l].name;
    archive.integers(name + "/entries", entries);
    archive.integers(name + "/node", node);
    archive.list(name + "/weight", "1", weight);
    auto first = std::ptrdiff_t{0};
    for (std::size_t k = 0; k < points_[l].size(); ++k) {
      const std::ptrdiff_t last = first + entries[k];
      points_[l][k].node.assign(node.begin() + first, node.begin() + last);
      points_[l][k].weight.assign(weight.begin() + first, weight.begin() + last);
      first = last;
    }
  }
}

template<int dim>
void SampleLines<dim>::write(const Snapshot<dim>& shot, const std::filesystem::path& folder) const {
  if (points_.empty()) return;
  std::filesystem::create_directories(folder / files::lines_folder);
  for (std::size_t l = 0; l < points_.size(); ++l) {
    const input::SampleLine& line = input_->output.lines[l];
    std::string text = dim == 2 ? "distance[m],x[m],y[m]" : "distance[m],x[m],y[m],z[m]";
    std::vector<Field> fields;
    for (const std::string& name : line.fields) {
      text += fmt::format(",{}", with_unit(name, field_info<dim>(name).unit));
      fields.push_back(values_at_nodes(shot, name));
    }
    text += "\n";
    for (std::size_t k = 0; k < points_[l].size(); ++k) {
      const Vec<dim> x = place(line, k);
      text += fmt::format("{}", (x - place(line, 0)).norm());
      for (int c = 0; c < dim; ++c) text += fmt::format(",{}", input_->origin[c] + x[c]);
      const PointWeights& point = points_[l][k];
      for (const Field& field : fields) {
        double sum = 0.0;
        for (std::size_t j = 0; j < point.node.size(); ++j)
          sum += point.weight[j] * field[index_of(point.node[j])];
        text += fmt::format(",{}", sum);
      }
      text += "\n";
    }
    write_atomically(folder / files::lines_folder / (line.name + ".csv"), text);
  }
}

template class SampleLines<2>;
template class SampleLines<3>;

} // namespace cnem::results
