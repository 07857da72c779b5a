/// report.json: the report for programs.
#pragma once

#include <optional>
#include <string>

#include "report/report_data.hpp"

namespace vicus::report {

/// The report as JSON text. Each run holds what `walk --json` writes and an "error"; figures that were not measured,
/// and values that are not finite, are null. Pictures are not in it.
std::string reportJson(const ReportData& report);

/// The inverse of `reportJson`: unknown keys are passed over, missing ones keep their defaults. Nothing, with the
/// reason in `error`, where the text is not such a report.
std::optional<ReportData> parseReport(const std::string& text, std::string& error);

}  // namespace vicus::report
