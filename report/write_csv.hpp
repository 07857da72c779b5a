/// report.csv: the report for spreadsheets.
#pragma once

#include <string>

#include "report/report_data.hpp"

namespace vicus::report {

/// One line for each run and each point of a curve (column `kind`), after a line of column names (RFC 4180). Fields
/// that were not measured are empty.
std::string reportCsv(const ReportData& report);

}  // namespace vicus::report
