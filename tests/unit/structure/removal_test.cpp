#include "core/error.hpp"
#include "machining/structure/removal.hpp"
#include "tests/unit/structure/paper_plate.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace cnem;
using namespace cnem::machining;

namespace {

/// Paper 004, 3.3.2, with the step that its speed says (misprint): the tool goes along the plate at 1 m/s,
/// and a force goes with it.
struct Table2 {
  Part part{plate(), PartElement::hexahedron_8, {&base, 1}};
  double dt = 1e-5, omega = 21002.66;
  std::int64_t steps = 10000;

  PresenceAt presence() const {
    return [this](double time) {
      return presence_without(part, Vec3(0.0, 0.016, 0.002), Vec3(std::min(time, 0.1), 0.04, 0.004), 0.9);
    };
  }
  LoadAt load() const {
    return [this](double time, const Eigen::VectorXd&) -> Eigen::VectorXd {
      const std::vector<Vec3> tool{Vec3(std::min(time, 0.1), 0.04, 0.0)};
      return part.displacement_at(tool).transpose() * Vec3(0.0, 0.0, std::cos(omega * time));
    };
  }
  std::vector<double> path(std::int64_t interval, EffectiveInverse inverse,
                           int* most_iterations = nullptr) const {
    const std::vector<Vec3> corner{Vec3(0.1, 0.04, 0.0)};
    const SparseMatrix at = part.displacement_at(corner);
    std::vector<double> u;
    RemovalSettings settings{.dt = dt,
                             .steps = steps,
                             .interval = interval,
                             .damping = {0.0, 2.0 * 0.01 / omega},
                             .inverse = inverse};
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(part.unknowns());
    machine(part, settings, {zero, zero, zero}, presence(), load(), [&](const RemovalStep& step) {
      u.push_back((at * step.motion.q)[2]);
      if (most_iterations) *most_iterations = std::max(*most_iterations, step.iterations);
    });
    return u;
  }
};

double largest(const std::vector<double>& u) {
  double most = 0.0;
  for (const double x : u) most = std::max(most, std::abs(x));
  return most;
}
double error(const std::vector<double>& u, const std::vector<double>& reference) {
  double most = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) most = std::max(most, std::abs(u[i] - reference[i]));
  return most / largest(reference);
}

} // namespace

TEST(Removal, Dump) {
  const Table2 table;
  auto t0 = std::chrono::steady_clock::now();
  auto now = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count(); };
  int most = 0;
  const auto reference = table.path(100, EffectiveInverse::conjugate_gradients, &most);
  std::cout << "cg " << now() << " s, " << most << " max " << largest(reference) << "\n";
  for (int n : {100, 200, 500, 1000, 2000, 10000}) {
    std::cout << n << " " << 100 * error(table.path(n, EffectiveInverse::interpolated), reference) << " "
              << now() << "\n";
  }
  for (int n : {100, 200, 500}) {
    std::cout << n << " printed "
              << 100 * error(table.path(n, EffectiveInverse::interpolated_common), reference) << " " << now()
              << "\n";
  }
}
