/// report.html: the report for people.
#pragma once

#include <string>

#include "report/report_data.hpp"

namespace vicus::report {

/// One HTML page with everything in it (styles, plots as SVG, pictures as data URIs): it opens anywhere without a
/// network. Sections that have nothing to show are left out.
std::string reportPage(const ReportData& report);

}  // namespace vicus::report
