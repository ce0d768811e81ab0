#include "machining/structure/part.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/parameter.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace cnem::machining {

namespace {

using Eigen::Index;

/// Ends of cells that are nearer are the same, of the size of the box.
constexpr double same = 1e-9;

std::vector<double> lines(const PartShape& shape, Index axis) {
  const double size = shape.size[axis];
  const int divisions = shape.divisions[index_of(axis)];
  std::vector<double> at;
  for (int i = 0; i <= divisions; ++i) at.push_back(size * i / divisions);
  for (const PartZone& zone : shape.zones)
    for (const double end : {zone.low[axis], zone.high[axis]})
      if (end > 0.0 && end < size) at.push_back(end);
  for (const double end : shape.more[index_of(axis)]) at.push_back(end);
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end(), [&](double a, double b) { return b - a < same * size; }),
           at.end());
  return at;
}

bool within(const Vec3& point, const Vec3& low, const Vec3& high, double slack) {
  return ((point - low).array() >= -slack).all() && ((high - point).array() >= -slack).all();
}

/// The one that counts at a point; null: none.
const PartZone* zone_at(const PartShape& shape, const Vec3& point) {
  const PartZone* there = nullptr;
  for (const PartZone& zone : shape.zones)
    if (within(point, zone.low, zone.high, 0.0)) there = &zone;
  return there;
}

/// Calls body(place, low, high, zone) for cells that are there: their numbers along the axes, corners, m, and
/// the zone that counts, or null.
template<class Body>
void for_each_cell(const PartShape& shape, const std::array<std::vector<double>, 3>& line, const Body& body) {
  for (std::size_t i = 0; i + 1 < line[0].size(); ++i)
    for (std::size_t j = 0; j + 1 < line[1].size(); ++j)
      for (std::size_t k = 0; k + 1 < line[2].size(); ++k) {
        const Vec3 low(line[0][i], line[1][j], line[2][k]),
            high(line[0][i + 1], line[1][j + 1], line[2][k + 1]);
        const PartZone* zone = zone_at(shape, 0.5 * (low + high));
        if (!zone || zone->taken < 1.0) body(std::array{i, j, k}, low, high, zone);
      }
}

} // namespace

std::size_t cells_of(const PartShape& shape) {
  std::size_t cells = 0;
  for_each_cell(shape, {lines(shape, 0), lines(shape, 1), lines(shape, 2)},
                [&](const auto&, const Vec3&, const Vec3&, const PartZone*) { ++cells; });
  return cells;
}

std::array<std::vector<double>, 3> beside_steps(const PartShape& shape) {
  std::array<std::vector<double>, 3> steps, beside;
  double smallest = infinite; // m
  for (Index axis = 0; axis < 3; ++axis) {
    std::vector<double>& at = steps[index_of(axis)];
    for (const PartZone& zone : shape.zones)
      for (const double end : {zone.low[axis], zone.high[axis]})
        if (zone.taken > 0.0 && end > same * shape.size[axis] && end < (1.0 - same) * shape.size[axis])
          at.push_back(end);
    std::sort(at.begin(), at.end());
    double before = 0.0;
    for (const double end : at) {
      if (end - before > same * shape.size[axis]) smallest = std::min(smallest, end - before);
      before = end;
    }
    if (!at.empty()) smallest = std::min(smallest, shape.size[axis] - before);
  }
  // places that differ by a slip are no step
  constexpr double share = 0.25, least = 0.1; // the latter of a cell
  for (Index axis = 0; axis < 3; ++axis)
    smallest = std::max(smallest, least * shape.size[axis] / shape.divisions[index_of(axis)]);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double end : steps[axis])
      for (const double place : {end - share * smallest, end + share * smallest})
        beside[axis].push_back(place);
  return beside;
}

std::array<std::vector<double>, 3> beside_clamps(const PartShape& shape,
                                                 std::span<const PartSupport> supports) {
  constexpr double share = 0.25, least = 0.1, most = 0.75; // the latter two of a cell
  std::array<std::vector<double>, 3> beside;
  for (const PartSupport& support : supports) {
    if (support.turns) continue;
    const auto axis = index_of(support.axis);
    const double size = shape.size[support.axis], cell = size / shape.divisions[axis],
                 side = std::min(shape.size[(support.axis + 1) % 3], shape.size[(support.axis + 2) % 3]),
                 in = std::max(share * side, least * cell);
    if (in < most * cell) beside[axis].push_back(support.far ? size - in : in);
  }
  return beside;
}

Part::Part(PartShape shape, PartElement element, std::span<const PartSupport> supports)
    : shape_(std::move(shape)), element_(element) {
  for (Index axis = 0; axis < 3; ++axis) line_[index_of(axis)] = lines(shape_, axis);
  divide();
  number(supports);
  fill_pattern();
}

void Part::divide() {
  const ElementForm& form = form_of(element_);
  const auto places = [&](std::size_t axis) {
    return static_cast<std::int64_t>(line_[axis].size() - 1) * form.order + 1;
  };
  const std::int64_t nx = places(0), ny = places(1), nz = element_ == PartElement::plate_8 ? 1 : places(2);
  std::vector<std::int64_t> node(index_of(nx * ny * nz), -1);
  const auto place = [&](std::size_t axis,
                         std::int64_t i) { // halfway between lines where there are two steps
    const auto cell = index_of(i / form.order);
    const double begin = line_[axis][cell];
    return i % form.order == 0 ? begin : 0.5 * (begin + line_[axis][cell + 1]);
  };
  for_each_cell(
      shape_, line_, [&](const auto& number_along, const Vec3& low, const Vec3& high, const PartZone* zone) {
        const auto [i, j, k] = number_along;
        Cell cell{.low = low, .size = high - low, .node = {}};
        cell.matrices = matrices_of(cell.size, height(low.z()), zone ? zone->material : 0);
        for (const auto& [a, b, c] : form.lattice_node) {
          const auto at = [&](std::size_t line, int step) {
            return static_cast<std::int64_t>(line) * form.order + step;
          };
          const std::int64_t x = at(i, a), y = at(j, b), z = nz == 1 ? 0 : at(k, c);
          std::int64_t& number = node[index_of((x * ny + y) * nz + z)];
          if (number < 0) {
            number = static_cast<std::int64_t>(position_.size());
            position_.emplace_back(place(0, x), place(1, y), nz == 1 ? 0.5 * shape_.size.z() : place(2, z));
          }
          cell.node.push_back(number);
        }
        cell_.push_back(std::move(cell));
        presence_.push_back(1.0 - (zone ? zone->taken : 0.0));
      });
  if (cell_.empty()) throw InputError("zones take the whole part, expected that something is left");
}

std::size_t Part::matrices_of(const Vec3& size, double low, std::size_t material) {
  const auto whole = [&](double length) { return std::llround(length / (same * shape_.size.maxCoeff())); };
  const std::array<std::int64_t, 5> key{whole(size.x()), whole(size.y()), whole(size.z()),
                                        element_ == PartElement::plate_8 ? whole(low) : 0,
                                        static_cast<std::int64_t>(material)};
  const auto [found, added] = known_.try_emplace(key, matrices_.size());
  if (added) matrices_.push_back(cell_matrices(element_, size, low, shape_.materials[material]));
  return found->second;
}

void Part::number(std::span<const PartSupport> supports) {
  const int freedoms = form_of(element_).freedoms;
  unknown_.assign(position_.size(), {-1, -1, -1, -1, -1});
  for (std::size_t n = 0; n < position_.size(); ++n) {
    std::array<bool, 5> held{};
    for (const PartSupport& support : supports) {
      const Index axis = support.axis;
      const double end = support.far ? shape_.size[axis] : 0.0;
      if (std::abs(position_[n][axis] - end) > same * shape_.size[axis]) continue;
      for (std::size_t k = 0; k < held.size(); ++k)
        held[k] = held[k] || !support.turns || k != 3 + index_of(support.axis);
    }
    for (std::size_t k = 0; k < index_of(freedoms); ++k)
      if (!held[k]) unknown_[n][k] = unknowns_++;
  }
}

template<class Visit> void Part::each_entry(const Cell& cell, Visit&& visit) const {
  const auto freedoms = index_of(form_of(element_).freedoms);
  for (std::size_t n = 0; n < cell.node.size(); ++n)
    for (std::size_t k = 0; k < freedoms; ++k)
      if (const std::int64_t unknown = unknown_[index_of(cell.node[n])][k]; unknown >= 0)
        visit(as<Eigen::Index>(n * freedoms + k), static_cast<Index>(unknown));
}

void Part::fill_pattern() {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Cell& cell : cell_)
    each_entry(cell, [&](Index, Index i) {
      each_entry(cell, [&](Index, Index j) { entries.emplace_back(as<int>(i), as<int>(j), 0.0); });
    });
  pattern_.resize(unknowns_, unknowns_);
  pattern_.setFromTriplets(entries.begin(), entries.end());
}

SparseMatrix Part::assemble(Eigen::MatrixXd CellMatrices::*which, std::span<const double> presence) const {
  assert(presence.size() == cell_.size());
  SparseMatrix sum = pattern_;
  for (std::size_t c = 0; c < cell_.size(); ++c) {
    const Eigen::MatrixXd& matrix = matrices_[cell_[c].matrices].*which;
    each_entry(cell_[c], [&](Index a, Index i) {
      each_entry(cell_[c], [&](Index b, Index j) { sum.coeffRef(i, j) += presence[c] * matrix(a, b); });
    });
  }
  return sum;
}

SparseMatrix Part::stiffness(std::span<const double> presence) const {
  return assemble(&CellMatrices::stiffness, presence);
}

SparseMatrix Part::mass(std::span<const double> presence) const {
  return assemble(&CellMatrices::mass, presence);
}

void Part::add_cell(std::size_t cell, double times, SparseMatrix& stiffness, SparseMatrix& mass) const {
  const CellMatrices& matrices = matrices_[cell_[cell].matrices];
  each_entry(cell_[cell], [&](Index a, Index i) {
    each_entry(cell_[cell], [&](Index b, Index j) {
      stiffness.coeffRef(i, j) += times * matrices.stiffness(a, b);
      mass.coeffRef(i, j) += times * matrices.mass(a, b);
    });
  });
}

void Part::add_rows(const Cell& cell, const Vec3& point, double weight, Index row,
                    std::vector<Eigen::Triplet<double>>& entries) const {
  const Vec3 place = (point - cell.low).cwiseQuotient(cell.size).cwiseMax(0.0).cwiseMin(1.0);
  const Eigen::MatrixXd rows = cell_interpolation(element_, place, height(point.z()));
  each_entry(cell, [&](Index a, Index unknown) {
    for (Index k = 0; k < 3; ++k)
      if (rows(k, a) != 0.0) entries.emplace_back(as<int>(row + k), as<int>(unknown), weight * rows(k, a));
  });
}

SparseMatrix Part::displacement_at(std::span<const Vec3> points) const {
  std::vector<Eigen::Triplet<double>> entries;
  Index row = 0;
  for (const Vec3& point : points) {
    const auto cell = std::find_if(cell_.begin(), cell_.end(), [&](const Cell& c) {
      return within(point, c.low, c.low + c.size, same * shape_.size.maxCoeff());
    });
    if (cell == cell_.end())
      throw InputError(
          fmt::format("there is no material at ({:g}, {:g}, {:g}) m, expected a point of the part", point.x(),
                      point.y(), point.z()));
    add_rows(*cell, point, 1.0, row, entries);
    row += 3;
  }
  SparseMatrix all(row, unknowns_);
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

SparseMatrix Part::displacement_near(std::span<const Vec3> points) const {
  std::vector<Eigen::Triplet<double>> entries;
  Index row = 0;
  for (const Vec3& point : points) {
    const auto distance = [&](const Cell& c) {
      return (point - point.cwiseMax(c.low).cwiseMin(c.low + c.size)).squaredNorm();
    };
    const auto nearest = std::min_element(
        cell_.begin(), cell_.end(), [&](const Cell& a, const Cell& b) { return distance(a) < distance(b); });
    add_rows(*nearest, point, 1.0, row, entries);
    row += 3;
  }
  SparseMatrix all(row, unknowns_);
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

SparseMatrix Part::displacement_of(int axis, bool far) const {
  const double end = far ? shape_.size[axis] : 0.0, third = 0.5 / std::sqrt(3.0);
  double area = 0.0;
  std::vector<Eigen::Triplet<double>> entries;
  for (const Cell& cell : cell_) {
    const Vec3 high = cell.low + cell.size;
    if (std::abs((far ? high : cell.low)[axis] - end) > same * shape_.size[axis]) continue;
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    area += cell.size[a] * cell.size[b];
    for (const double s : {0.5 - third, 0.5 + third})
      for (const double t : {0.5 - third, 0.5 + third}) { // exact for functions of third degree
        Vec3 point = cell.low;
        point[axis] = end;
        point[a] += s * cell.size[a];
        point[b] += t * cell.size[b];
        add_rows(cell, point, 0.25 * cell.size[a] * cell.size[b], 0, entries);
      }
  }
  if (!(area > 0.0)) throw InputError("nothing is left of that face, expected one of the part");
  SparseMatrix mean(3, unknowns_);
  mean.setFromTriplets(entries.begin(), entries.end());
  mean /= area;
  return mean;
}

std::vector<Vec3> Part::displacements(const Eigen::VectorXd& q) const {
  std::vector<Vec3> all(position_.size(), Vec3::Zero());
  for (std::size_t n = 0; n < all.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k)
      if (const std::int64_t unknown = unknown_[n][k]; unknown >= 0) all[n][as<Eigen::Index>(k)] = q[unknown];
  return all;
}

std::vector<std::size_t> Part::corners(std::size_t cell) const {
  const ElementForm& form = form_of(element_);
  std::vector<std::size_t> all;
  const bool plate = element_ == PartElement::plate_8;
  for (const int k : {0, form.order}) {
    if (plate && k > 0) continue;
    for (const auto& [i, j] :
         {std::array{0, 0}, {form.order, 0}, {form.order, form.order}, {0, form.order}}) {
      const std::array<int, 3> corner{i, j, k};
      const auto at = std::find(form.lattice_node.begin(), form.lattice_node.end(), corner);
      all.push_back(index_of(cell_[cell].node[index_of(at - form.lattice_node.begin())]));
    }
  }
  return all;
}

} // namespace cnem::machining
