#include "app/machining/modes_run.hpp"

#include "core/index.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"

#include <Eigen/LU>
#include <fmt/format.h>

namespace cnem::app {

namespace {

using results::si_format;

/// Legacy VTK, which ParaView reads: the cells of a part with the shapes of its modes at the nodes, the
/// largest displacement of each 1.
std::string vtk_file(const SolvedPart& solved) {
  const machining::Part& part = solved.part;
  std::string text =
      fmt::format("# vtk DataFile Version 3.0\nmodes\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} double\n",
                  part.nodes());
  for (const Vec3& x : part.positions()) text += fmt::format("{:.9g} {:.9g} {:.9g}\n", x.x(), x.y(), x.z());
  const std::size_t corners = part.corners(0).size();
  text += fmt::format("CELLS {} {}\n", part.cells(), part.cells() * (corners + 1));
  for (std::size_t c = 0; c < part.cells(); ++c)
    text += fmt::format("{} {}\n", corners, fmt::join(part.corners(c), " "));
  text += fmt::format("CELL_TYPES {}\n", part.cells());
  constexpr int hexahedron = 12, quadrangle = 9;
  for (std::size_t c = 0; c < part.cells(); ++c)
    text += fmt::format("{}\n", corners == 8 ? hexahedron : quadrangle);
  text += fmt::format("CELL_DATA {}\nSCALARS presence double 1\nLOOKUP_TABLE default\n", part.cells());
  for (const double presence : part.presence()) text += fmt::format("{:.9g}\n", presence);
  text += fmt::format("POINT_DATA {}\n", part.nodes());
  for (Eigen::Index i = 0; i < solved.modes.count(); ++i) {
    const std::vector<Vec3> shape = part.displacements(solved.modes.shape.col(i));
    double largest = 0.0;
    for (const Vec3& u : shape) largest = std::max(largest, u.norm());
    text += fmt::format("VECTORS mode_{}_at_{:.6g}_Hz double\n", i + 1, solved.modes.frequency(i));
    for (const Vec3& u : shape)
      text += fmt::format("{:.6g} {:.6g} {:.6g}\n", u.x() / largest, u.y() / largest, u.z() / largest);
  }
  return text;
}

} // namespace

void ModesRun::add_mode(const char* of, std::size_t number, const machining::Mode& mode,
                        const std::string& place) {
  table_ += mode_row(of, fmt::format("{}", number), mode, place);
  status_.add_metric(fmt::format("modes.{}.{}.k{}[N/m]", of, place, number), mode.stiffness);
  status_.add_metric(fmt::format("modes.{}.{}.m{}[kg]", of, place, number), mode.mass());
}

void ModesRun::solve_part(const input::PartCase& input) {
  const SolvedPart& solved = part_.emplace(input_);
  const machining::Eigenmodes& modes = solved.modes;
  for (Eigen::Index i = 0; i < modes.count(); ++i)
    status_.add_metric(fmt::format("modes.part.f{}[Hz]", i + 1), modes.frequency(i));
  Eigen::VectorXd load = Eigen::VectorXd::Zero(solved.part.unknowns());
  std::vector<SparseMatrix> rows;
  for (const input::PartPlace& place : input.places) {
    rows.push_back(displacement_at(input_, solved.part, place));
    load += rows.back().transpose() * place.force;
  }
  Eigen::VectorXd bent;
  if (load.squaredNorm() > 0.0) bent = SparseCholesky(solved.stiffness).solve(load);
  for (std::size_t p = 0; p < rows.size(); ++p) {
    const std::string& name = input.places[p].name;
    const Eigen::MatrixXd shapes = rows[p] * modes.shape;
    for (Eigen::Index i = 0; i < modes.count(); ++i)
      if (is_felt(modes, i, shapes.col(i)))
        add_mode("part", index_of(i) + 1,
                 machining::mode_at(modes.omega[i], input.damping_of(modes.omega[i]), shapes.col(i),
                                    machining::Mode::Of::part),
                 name);
    if (bent.size() == 0) continue;
    const Vec3 u = rows[p] * bent;
    for (std::size_t k = 0; k < 3; ++k)
      status_.add_metric(fmt::format("modes.part.{}.u{}[m]", name, axis_name(k)), u[as<Eigen::Index>(k)]);
  }
  status_.nodes = as<std::int64_t>(solved.part.nodes());
  status_.reason = fmt::format("the part vibrates first at {}", si_format(modes.frequency(0), "Hz"));
}

void ModesRun::solve_shaft(const input::ShaftCase& input) {
  const machining::Shaft shaft = shaft_of(input_);
  const std::vector<machining::Whirl> whirls = machining::whirls(shaft, input.speed, index_of(input.count));
  if (whirls.empty())
    throw input_.error("shaft.bearings", "the shaft does not vibrate, expected one that some "
                                         "bearing gives a stiffness");
  std::vector<Eigen::MatrixXd> rows;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(shaft.unknowns());
  for (const input::ShaftPlace& place : input.places) {
    rows.push_back(shaft.displacement_at(place.at));
    load += rows.back().row(0).transpose() * place.force;
  }
  for (std::size_t i = 0; i < whirls.size(); ++i) {
    const machining::Whirl& whirl = whirls[i];
    const double frequency = whirl.omega / machining::full_turn;
    status_.add_metric(fmt::format("modes.shaft.f{}[Hz]", i + 1), frequency);
    status_.add_metric(fmt::format("modes.shaft.damping{}", i + 1), whirl.damping);
    status_.add_metric(fmt::format("modes.shaft.direction{}", i + 1), whirl.direction);
    table_ += fmt::format("shaft,{},{},{},{},,,,,\n", i + 1, frequency, whirl.damping,
                          whirl.direction > 0.5    ? "forward"
                          : whirl.direction < -0.5 ? "backward"
                                                   : "");
  }
  if (load.squaredNorm() > 0.0) {
    const Eigen::VectorXd bent = shaft.stiffness().ldlt().solve(load);
    for (std::size_t p = 0; p < rows.size(); ++p)
      status_.add_metric(fmt::format("modes.shaft.{}.ux[m]", input.places[p].name), (rows[p] * bent)[0]);
  }
  status_.reason +=
      fmt::format("{}the shaft {} {}", status_.reason.empty() ? "" : "; ",
                  input.speed != 0.0 ? fmt::format("whirls at {} first at", speed_text(input.speed))
                                     : "vibrates first at",
                  si_format(whirls.front().omega / machining::full_turn, "Hz"));
}

bool ModesRun::solve() {
  const input::StructureCase& structure = *input_.structure;
  if (structure.part) solve_part(*structure.part);
  if (structure.shaft) solve_shaft(*structure.shaft);
  return true;
}

void ModesRun::write_files() {
  results::write_atomically(options_.output / results::files::modes, mode_table_head + table_);
  if (part_) results::write_atomically(options_.output / results::files::mode_shapes, vtk_file(*part_));
}

} // namespace cnem::app
