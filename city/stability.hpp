/// The result of one stiff or extreme case, as the report's table and the tests both read it.
#pragma once

#include <string>
#include <utility>

namespace vicus::city {

struct StabilityRow {
  std::string part;      ///< "coordinates", "view", "frustum", …
  std::string caseName;  ///< "eye at 50 km"
  std::string what;      ///< what the figure counts, with its unit: "visible boxes culled"
  double figure = 0;
  double bound = 0;  ///< the figure may reach it
  bool ok = false;   ///< figure ≤ bound; a NaN is never ok
};

inline StabilityRow stabilityRow(std::string part, std::string caseName, std::string what, double figure,
                                 double bound) {
  return {std::move(part), std::move(caseName), std::move(what), figure, bound, figure <= bound};
}

}  // namespace vicus::city
