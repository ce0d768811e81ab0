#include "study/coefficients.hpp"

#include "core/parameter.hpp"
#include "evaluate/cutting_result.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"
#include "study/manifest.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>

namespace cnem::study {
namespace {

namespace fs = std::filesystem;
using machining::CutGroup;
using machining::Estimate;
using machining::LineFit;
using machining::OrthogonalCut;

constexpr double degree = std::numbers::pi / 180.0;

/// Why a cut says nothing of a law; empty where it does.
std::string fault_of(const evaluate::CuttingResult& cut) {
  if (cut.breaks) return "its chip breaks off a ply";
  if (!cut.steady)
    return cut.steady_note.empty() ? "not steady" : fmt::format("not steady: {}", cut.steady_note);
  if (!std::isfinite(cut.Fc) || !std::isfinite(cut.Ft)) return "it has no forces";
  if (!(cut.feed > 0.0) || !std::isfinite(cut.speed)) return "it has no feed or no speed";
  return "";
}

OrthogonalCut cut_of(const std::string& name, const evaluate::CuttingResult& cut) {
  const double parts = cut.filter > 0.0 ? (cut.steady_to - cut.steady_from) / cut.filter : 1.0;
  const double root = std::sqrt(std::max(1.0, parts));
  return {.name = name,
          .thickness = cut.feed,
          .speed = cut.speed,
          .rake = cut.rake,
          .tangential = {cut.Fc, cut.Fc_spread / root},
          .radial = {cut.Ft, cut.Ft_spread / root},
          .chip_thickness = cut.chip_thickness};
}

std::string name_of(double rake, double speed) {
  return fmt::format("rake {} deg, {}", results::number_format(rake / degree, 4),
                     results::si_format(speed, "m/s"));
}

LawFit fit_of(std::string name, std::vector<OrthogonalCut> cuts, bool one_rake) {
  LawFit fit;
  fit.name = std::move(name);
  fit.linear = machining::fit_linear(cuts);
  fit.kienzle = machining::fit_kienzle(cuts);
  if (one_rake) fit.shear_plane = machining::fit_shear_plane(cuts, fit.linear);
  fit.cuts = std::move(cuts);
  return fit;
}

void note_missing(CuttingCoefficients& found) {
  const auto note = [&](std::string text) { found.notes.push_back(std::move(text)); };
  const LawFit& all = found.all;
  if (all.linear.no_edge_force)
    note("the tangential edge force came out below 0 and is taken as 0: the line goes through the origin");
  if (!all.kienzle)
    note("no Kienzle law: tangential forces are not all positive, or do not grow with the thickness");
  else if (!all.kienzle->radial)
    note("no radial part of Kienzle's law: radial forces change their sign or fall with the thickness");
  if (all.linear.tangential.degrees < 1)
    note("as many cuts as constants: standard errors are those of the cuts alone, without their scatter "
         "about the line");
  if (found.groups.size() == 1 && !all.shear_plane)
    note("no shear plane: the chips have no thickness, or it says no angle");
  constexpr double good = 0.95;
  if (found.law == "linear" && all.linear.tangential.r_squared < good)
    note(fmt::format("a straight line leaves much of the tangential forces (R² = {:.3f}): is the sweep over "
                     "the thickness alone?",
                     all.linear.tangential.r_squared));
}

std::string with_error(const Estimate& estimate, double unit, const char* name) {
  std::string text = results::number_format(estimate.value / unit, 5);
  if (std::isfinite(estimate.error))
    text += fmt::format(" ± {}", results::number_format(estimate.error / unit, 2));
  return fmt::format("{}{}", text, *name ? fmt::format(" {}", name) : "");
}

void tell(const CuttingCoefficients& found) {
  for (const LeftOut& run : found.left_out) fmt::print(stderr, "left out: {}: {}\n", run.run, run.reason);
  for (const LawFit& group : found.groups) {
    const auto& [t, r, none] = group.linear;
    fmt::print("{} ({} cuts): Ktc = {}, Kte = {}, R² = {:.5f}; Krc = {}, Kre = {}, R² = {:.5f}\n", group.name,
               group.cuts.size(), with_error(t.slope, 1e6, "MPa"), with_error(t.intercept, 1e3, "N/mm"),
               t.r_squared, with_error(r.slope, 1e6, "MPa"), with_error(r.intercept, 1e3, "N/mm"),
               r.r_squared);
    if (group.kienzle)
      fmt::print("  Kienzle: Kt1 = {}, mt = {}\n", with_error(group.kienzle->tangential.pressure, 1e6, "MPa"),
                 with_error(group.kienzle->tangential.exponent, 1.0, ""));
    if (group.shear_plane)
      fmt::print("  shear plane: stress {}, angle {}, friction angle {}\n",
                 with_error(group.shear_plane->shear_stress, 1e6, "MPa"),
                 with_error(group.shear_plane->shear_angle, degree, "deg"),
                 with_error(group.shear_plane->friction_angle, degree, "deg"));
  }
  for (const std::string& note : found.notes) fmt::print(stderr, "warning: {}\n", note);
}

} // namespace

CutsOfSweep read_cuts(const fs::path& folder) {
  CutsOfSweep result;
  for (const RunNote& run : read_run_notes(folder, "sweep")) {
    std::string reason = run.reason;
    if (run.done) {
      const auto cut = evaluate::read_cutting_numbers(folder / run.name);
      reason = cut ? fault_of(*cut) : "it evaluates no cut ([report.cutting])";
      if (reason.empty()) result.cuts.push_back(cut_of(run.name, *cut));
    }
    if (!reason.empty()) result.left_out.push_back({run.name, reason});
  }
  return result;
}

CuttingCoefficients fit_coefficients(const CutsOfSweep& cuts, const std::string& source) {
  CuttingCoefficients found;
  found.source = source;
  found.left_out = cuts.left_out;
  const std::vector<CutGroup> groups = machining::groups_of(cuts.cuts);
  for (const CutGroup& group : groups)
    if (group.thicknesses().size() >= 2)
      found.groups.push_back(fit_of(name_of(group.rake, group.speed), group.cuts, true));
    else
      found.notes.push_back(fmt::format("{}: one thickness alone, expected two to fit a line through",
                                        name_of(group.rake, group.speed)));
  if (found.groups.empty()) {
    std::vector<std::string> reasons;
    for (const LeftOut& run : found.left_out)
      reasons.push_back(fmt::format("\n  {}: {}", run.run, run.reason));
    throw InputError(
        fmt::format("{}: found {} steady cuts, expected two thicknesses (cutting.feed) at least at "
                    "one rake and speed{}{}",
                    source, cuts.cuts.size(), reasons.empty() ? "" : "; left out:", fmt::join(reasons, "")));
  }
  if (found.groups.size() == 1) {
    found.all = found.groups.front();
  } else {
    std::vector<OrthogonalCut> all;
    for (const LawFit& group : found.groups) all.insert(all.end(), group.cuts.begin(), group.cuts.end());
    found.all = fit_of("all cuts", std::move(all), false);
  }
  if (const double slope = found.all.linear.tangential.slope.value; !(slope > 0.0))
    throw InputError(
        fmt::format("{}: tangential forces do not grow with the thickness of the chip ({:.4g} N/m² "
                    "of {} cuts), expected a sweep over cutting.feed at the same rake and speed",
                    source, slope, found.all.cuts.size()));
  found.table = machining::table_of(groups);
  constexpr std::size_t most = NumberList::capacity;
  if (found.table && found.table->tangential.size() > most) {
    found.notes.push_back(
        fmt::format("no table: {} forces, expected at most {}", found.table->tangential.size(), most));
    found.table.reset();
  }
  found.law = groups.size() > 1 && found.table ? "table" : "linear";
  if (found.groups.size() > 1 && !found.table)
    found.notes.push_back("the linear law is one for all rakes and speeds: there is no table of them, which "
                          "needs a steady cut at "
                          "each thickness with each rake and speed");
  note_missing(found);
  return found;
}

Exit coefficients(const fs::path& folder, const std::string& version) {
  const CuttingCoefficients found = fit_coefficients(read_cuts(folder), folder.string());
  const CoefficientsFiles files = coefficients_files(found, version);
  results::write_atomically(folder / "law.toml", files.law);
  results::write_atomically(folder / "coefficients.json", files.json);
  results::write_atomically(folder / "coefficients.csv", files.table);
  results::write_atomically(folder / "coefficients.svg", files.picture);
  results::write_atomically(folder / "coefficients.html", files.report);
  tell(found);
  fmt::print("law: {}\nreport: {}\n", (folder / "law.toml").string(),
             (folder / "coefficients.html").string());
  return Exit::done;
}

} // namespace cnem::study
