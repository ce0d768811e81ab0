#pragma once
// The part of report.html on an orthogonal cut: numbers, forces, chip, rake face, what lies below the
// surface.
#include "evaluate/cutting_result.hpp"
#include "report/chart.hpp"

#include <string>
#include <vector>

namespace cnem::report {

/// Forces and chip over the cut, the chip's thickness along it, stresses and heat along the rake face,
/// stresses and strain over depth; those that have nothing to show are left out.
std::vector<Chart> cutting_charts(const evaluate::CuttingResult& result,
                                  const results::ShownUnits& units = {});

/// Notes, tables and charts as HTML.
std::string render_cutting(const evaluate::CuttingResult& result, const results::ShownUnits& units = {});

} // namespace cnem::report
