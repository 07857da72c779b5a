#include "report/report_data.hpp"

#include <algorithm>

namespace vicus::report {

std::vector<const RunFigures*> runsOn(const ReportData& report, const std::string& path) {
  std::vector<const RunFigures*> out;
  for (const RunFigures& run : report.runs)
    if (run.path == path) out.push_back(&run);
  return out;
}

const RunFigures* findRun(const ReportData& report, const std::string& name, const std::string& path) {
  for (const RunFigures& run : report.runs)
    if (run.name == name && run.path == path) return &run;
  return nullptr;
}

std::vector<std::string> pathsOf(const ReportData& report) {
  std::vector<std::string> out;
  for (const RunFigures& run : report.runs)
    if (std::find(out.begin(), out.end(), run.path) == out.end()) out.push_back(run.path);
  return out;
}

}  // namespace vicus::report
