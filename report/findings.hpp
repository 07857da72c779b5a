/// What a report's figures say is wrong, in plain words.
#pragma once

#include <string>
#include <vector>

#include "report/report_data.hpp"

namespace vicus::report {

/// Goes through the figures and names each fault with its run, tour and size: visible buildings that are missing,
/// pictures that are moved, stages that are slow for what they do, techniques that cost more than they save, stability
/// rows out of bound. Empty is good.
std::vector<std::string> findFaults(const ReportData& report);

}  // namespace vicus::report
