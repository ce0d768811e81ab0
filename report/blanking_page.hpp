#pragma once
// The part of report.html on a cut: faces as drawings, forces over stroke, what letting go does.
#include "evaluate/blanking_result.hpp"
#include "report/chart.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cnem::report {

/// Force of punch and dies along the cutting direction over the stroke, with the largest force marked; none
/// when the history lacks them.
std::optional<Chart> force_stroke_chart(const evaluate::BlankingResult& result,
                                        const results::HistoryTable& history,
                                        const results::ShownUnits& units = {});

/// Heights over the angle round the punch, a chart for each body that was measured in several sections.
std::vector<Chart> round_charts(const evaluate::BlankingResult& result,
                                const results::ShownUnits& units = {});

/// One face as an <svg> element: the body beside the cut, its zones in colours, shares at the side.
std::string face_drawing(const evaluate::ShearedFace& face);

/// Drawings with their tables, chart and tables as HTML; empty when there is nothing to show.
std::string render_blanking(const evaluate::BlankingResult& result, const std::optional<Chart>& forces,
                            const results::ShownUnits& units = {});

} // namespace cnem::report
