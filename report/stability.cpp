#include "report/stability.hpp"

#include <iterator>

#include "assets/import/import_stability.hpp"
#include "avatars/stability.hpp"
#include "culling/cull_map_stability.hpp"
#include "culling/stability.hpp"
#include "facade/stability.hpp"
#include "houselod/stability.hpp"
#include "plan/shadow_stability.hpp"
#include "terrain/stability.hpp"

namespace vicus::report {

std::vector<city::StabilityRow> allStability() {
  std::vector<city::StabilityRow> rows;
  const auto add = [&](std::vector<city::StabilityRow> more) {
    rows.insert(rows.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  add(assets::importStability());
  add(culling::frustumStability());
  add(culling::cullMapStability());
  add(terrain::roamStability());
  add(facade::rulesStability());
  add(houselod::houseLodStability());
  add(avatars::avatarStability());
  add(plan::shadowStability());
  return rows;
}

}  // namespace vicus::report
