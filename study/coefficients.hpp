#pragma once
// A cutting law from a finished sweep of orthogonal cuts: cnem coefficients (docs/cutting.md).
#include "core/error.hpp"
#include "machining/orthogonal_fit.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cnem::study {

/// A run that says nothing, and why.
struct LeftOut {
  std::string run, reason;
};

/// What a folder of runs holds for a law.
struct CutsOfSweep {
  std::vector<machining::OrthogonalCut> cuts;
  std::vector<LeftOut> left_out; ///< failed, unsteady, or no cuts
};

/// The means of the steady parts of all runs that are done, with standard errors s/√N: s the deviation of the
/// filtered force, N the lengths of the filter in the steady part. Throws InputError where the folder holds
/// no sweep, IoError where a file cannot be read.
CutsOfSweep read_cuts(const std::filesystem::path& folder);

/// What cuts of one rake and speed, or all together, say.
struct LawFit {
  std::string name; ///< "rake 10 deg, 4 m/s"
  std::vector<machining::OrthogonalCut> cuts;
  machining::LinearFit linear;
  std::optional<machining::KienzleFit> kienzle;
  std::optional<machining::ShearPlaneFit> shear_plane; ///< none of several rakes
};

struct CuttingCoefficients {
  std::string source;         ///< the folder
  std::string law;            ///< which one stands for the cuts: linear, or table of several rakes or speeds
  LawFit all;                 ///< of all cuts
  std::vector<LawFit> groups; ///< of each rake and speed with two thicknesses; of one group: that one
  std::optional<machining::CutTable> table;
  std::vector<LeftOut> left_out;
  std::vector<std::string> notes; ///< what is not there, or to be doubted
};

/// Throws InputError where there are not two thicknesses at one rake and speed.
CuttingCoefficients fit_coefficients(const CutsOfSweep& cuts, const std::string& source);

/// law.toml, coefficients.json, coefficients.csv, coefficients.svg, coefficients.html.
struct CoefficientsFiles {
  std::string law, json, table, picture, report;
};
CoefficientsFiles coefficients_files(const CuttingCoefficients& found, const std::string& version);

/// Reads, fits, writes the files into the folder and tells what was found. Throws InputError and IoError.
Exit coefficients(const std::filesystem::path& folder, const std::string& version);

} // namespace cnem::study
