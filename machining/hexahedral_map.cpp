#include "machining/hexahedral_map.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <fmt/format.h>

namespace cnem::machining {

HexahedralMap::HexahedralMap(const Vec3& low, const Vec3& high, const std::array<int, 3>& cells,
                             const Vec3& border) {
  assert(((high - low).array() > 0.0).all() && (border.array() > 0.0).all());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = as<Eigen::Index>(axis);
    assert(cells[axis] > 0);
    line_[axis].push_back(low[a] - border[a]);
    for (int i = 0; i <= cells[axis]; ++i)
      line_[axis].push_back(low[a] + (high[a] - low[a]) * i / cells[axis]);
    line_[axis].push_back(high[a] + border[a]);
  }
  for (std::size_t i = 1; i + 1 < line_[0].size(); ++i)
    for (std::size_t j = 1; j + 1 < line_[1].size(); ++j)
      for (std::size_t k = 1; k + 1 < line_[2].size(); ++k)
        place_.emplace_back(line_[0][i], line_[1][j], line_[2][k]);
  q_ = Eigen::VectorXd::Zero(unknowns());
}

double HexahedralMap::size() const { return (place_.back() - place_.front()).norm(); }

void HexahedralMap::displace(const Eigen::VectorXd& q) {
  assert(q.size() == q_.size());
  q_ = q;
}

double HexahedralMap::largest() const {
  double most = 0.0;
  for (Eigen::Index n = 0; n < q_.size(); n += 3) most = std::max(most, q_.segment<3>(n).norm());
  return most;
}

bool HexahedralMap::may_meet(const Vec3& from, const Vec3& to) const {
  const double moved = largest();
  for (Eigen::Index a = 0; a < 3; ++a)
    if (std::min(from[a], to[a]) > place_.back()[a] + moved ||
        std::max(from[a], to[a]) < place_.front()[a] - moved)
      return false;
  return true;
}

std::optional<HexahedralMap::At> HexahedralMap::find(const Vec3& material) const {
  At at;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double>& line = line_[axis];
    const double x = material[as<Eigen::Index>(axis)];
    if (!(x >= line.front() && x <= line.back())) return std::nullopt;
    const auto above = std::upper_bound(line.begin() + 1, line.end() - 1, x);
    const auto cell = index_of(above - line.begin()) - 1;
    at.cell[axis] = as<int>(cell);
    at.place[as<Eigen::Index>(axis)] = (x - line[cell]) / (line[cell + 1] - line[cell]);
  }
  return at;
}

Eigen::Index HexahedralMap::node(int i, int j, int k) const {
  const auto inner = [&](std::size_t axis) { return as<int>(line_[axis].size()) - 2; };
  if (i < 1 || j < 1 || k < 1 || i > inner(0) || j > inner(1) || k > inner(2)) return -1;
  return 3 * ((static_cast<Eigen::Index>(i - 1) * inner(1) + j - 1) * inner(2) + k - 1);
}

Vec3 HexahedralMap::node_displacement(int i, int j, int k) const {
  const Eigen::Index at = node(i, j, k);
  return at < 0 ? Vec3(Vec3::Zero()) : Vec3(q_.segment<3>(at));
}

Vec3 HexahedralMap::cell_size(const std::array<int, 3>& cell) const {
  Vec3 size;
  for (std::size_t axis = 0; axis < 3; ++axis)
    size[as<Eigen::Index>(axis)] = line_[axis][index_of(cell[axis] + 1)] - line_[axis][index_of(cell[axis])];
  return size;
}

Vec3 HexahedralMap::interpolate(const At& at, Mat<3>* gradient) const {
  Vec3 u = Vec3::Zero();
  if (gradient) gradient->setZero();
  const Vec3 size = cell_size(at.cell);
  for (const int a : {0, 1})
    for (const int b : {0, 1})
      for (const int c : {0, 1}) {
        const Eigen::Index n = node(at.cell[0] + a, at.cell[1] + b, at.cell[2] + c);
        if (n < 0) continue;
        const Vec3 of_node = q_.segment<3>(n);
        const auto share = [](int end, double x) { return end == 1 ? x : 1.0 - x; };
        const double x = share(a, at.place[0]), y = share(b, at.place[1]), z = share(c, at.place[2]);
        u += x * y * z * of_node;
        if (gradient)
          *gradient += of_node * Vec3((2 * a - 1) * y * z, (2 * b - 1) * x * z, (2 * c - 1) * x * y)
                                     .cwiseQuotient(size)
                                     .transpose();
      }
  return u;
}

Vec3 HexahedralMap::displacement(const Vec3& material) const {
  const auto at = find(material);
  return at ? interpolate(*at, nullptr) : Vec3(Vec3::Zero());
}

Vec3 HexahedralMap::material(const Vec3& current, int* steps) const {
  constexpr int most = 30;
  constexpr double close = 1e-13;
  const double enough = close * size();
  Vec3 x = current;
  std::optional<At> at;
  for (int step = 0; step < most; ++step) {
    at = find(x);
    Mat<3> gradient = Mat<3>::Zero();
    const Vec3 beside = at ? Vec3(x + interpolate(*at, &gradient) - current) : Vec3(x - current);
    if (beside.lpNorm<Eigen::Infinity>() <= enough) return x;
    x -= (Mat<3>::Identity() + gradient).inverse() * beside;
    if (steps) ++*steps;
    if (!x.allFinite()) break;
  }
  throw DivergenceError(
      fmt::format("no point of the workpiece is found for ({:.6g}, {:.6g}, {:.6g}) m, {}: expected "
                  "displacements that are small beside the hexahedra",
                  current.x(), current.y(), current.z(), at ? name(at->cell) : std::string("beyond all")),
      -1, "displacement");
}

void HexahedralMap::press(const Vec3& material, const Vec3& force, Eigen::VectorXd& load) const {
  const auto at = find(material);
  if (!at) return;
  for (const int a : {0, 1})
    for (const int b : {0, 1})
      for (const int c : {0, 1}) {
        const Eigen::Index n = node(at->cell[0] + a, at->cell[1] + b, at->cell[2] + c);
        if (n < 0) continue;
        const auto share = [](int end, double x) { return end == 1 ? x : 1.0 - x; };
        load.segment<3>(n) +=
            share(a, at->place[0]) * share(b, at->place[1]) * share(c, at->place[2]) * force;
      }
}

namespace {

/// Values at 0, ½, 1 along each of three axes into Bernstein coefficients of the polynomial through them.
void to_bernstein(std::array<double, 27>& value) {
  for (const std::size_t stride : {1U, 3U, 9U})
    for (std::size_t begin = 0; begin < value.size(); ++begin)
      if (begin / stride % 3 == 0)
        value[begin + stride] =
            2.0 * value[begin + stride] - 0.5 * (value[begin] + value[begin + 2 * stride]);
}

} // namespace

std::optional<std::array<int, 3>> HexahedralMap::folded() const {
  const auto cells = [&](std::size_t axis) { return as<int>(line_[axis].size()) - 1; };
  for (int i = 0; i < cells(0); ++i)
    for (int j = 0; j < cells(1); ++j)
      for (int k = 0; k < cells(2); ++k) {
        At at{{i, j, k}, Vec3::Zero()};
        // ‖∇u‖ is at most the sum over axes of what it is along the edges: below 1 nothing can fold.
        const Vec3 size = cell_size(at.cell);
        Vec3 steepest = Vec3::Zero();
        for (int axis = 0; axis < 3; ++axis)
          for (const int a : {0, 1})
            for (const int b : {0, 1}) {
              std::array<int, 3> from = at.cell;
              from[index_of((axis + 1) % 3)] += a;
              from[index_of((axis + 2) % 3)] += b;
              std::array<int, 3> to = from;
              ++to[index_of(axis)];
              const Vec3 change =
                  node_displacement(to[0], to[1], to[2]) - node_displacement(from[0], from[1], from[2]);
              steepest[axis] = std::max(steepest[axis], change.norm() / size[axis]);
            }
        if (steepest.sum() < 1.0) continue;
        std::array<double, 27> determinant{};
        for (std::size_t n = 0; n < determinant.size(); ++n) {
          at.place = 0.5 * Vec3(static_cast<double>(n / 9), static_cast<double>(n / 3 % 3),
                                static_cast<double>(n % 3));
          Mat<3> gradient;
          interpolate(at, &gradient);
          determinant[n] = (Mat<3>::Identity() + gradient).determinant();
        }
        to_bernstein(determinant);
        if (!(*std::min_element(determinant.begin(), determinant.end()) > 0.0)) return at.cell;
      }
  return std::nullopt;
}

std::string HexahedralMap::name(const std::array<int, 3>& cell) const {
  Vec3 low, high;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[as<Eigen::Index>(axis)] = 1e3 * line_[axis][index_of(cell[axis])];
    high[as<Eigen::Index>(axis)] = 1e3 * line_[axis][index_of(cell[axis] + 1)];
  }
  return fmt::format("hexahedron ({}, {}, {}), from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) mm",
                     cell[0], cell[1], cell[2], low.x(), low.y(), low.z(), high.x(), high.y(), high.z());
}

} // namespace cnem::machining
