#include "viewer/item_buffers.hpp"

#include <algorithm>

namespace vicus::viewer {

bool plansItem(const city::City& city, const city::FramePlan& plan, uint32_t item) {
  if (item == 0 || item == city::kItemOther) return false;
  if (item >= city.itemCount()) {
    const uint32_t person = item - city.itemOfPerson(0);
    const auto& people = plan.avatars.drawn;
    const auto found = std::lower_bound(people.begin(), people.end(), person,
                                        [](const city::AvatarDraw& a, uint32_t p) { return a.person < p; });
    return found != people.end() && found->person == person;
  }
  const uint32_t index = item - 1;
  const auto buildings = static_cast<uint32_t>(city.buildings.size());
  if (index >= buildings) return std::binary_search(plan.monuments.begin(), plan.monuments.end(), index - buildings);
  // The last run that begins at or before the instance is the only one that may hold it.
  const std::vector<city::Range>& runs = plan.buildings.drawn;
  const auto after = std::upper_bound(runs.begin(), runs.end(), index,
                                      [](uint32_t i, const city::Range& run) { return i < run.first; });
  return after != runs.begin() && index < std::prev(after)->end();
}

ItemCheck checkItems(const city::City& city, const city::FramePlan& plan, const ItemBuffer& everything,
                     const ItemBuffer& planned) {
  ItemCheck out;
  const bool sameSize = everything.ids.size() == planned.ids.size() && everything.width == planned.width;
  uint32_t last = 0;
  bool lastIsPlanned = false;
  for (size_t p = 0; p < everything.ids.size(); ++p) {
    const uint32_t item = everything.ids[p];
    if (!sameSize || item != planned.ids[p]) ++out.differingPixels;
    if (item == 0 || item == city::kItemOther) continue;
    ++out.shownPixels;
    // Neighbouring pixels mostly show one item: look each run up once.
    if (item != last) last = item, lastIsPlanned = plansItem(city, plan, item);
    if (lastIsPlanned) continue;
    ++out.lostPixels;
    out.lostItems.push_back(item);
    out.lostAt.emplace_back(static_cast<int>(p) % everything.width, static_cast<int>(p) / everything.width);
  }
  std::sort(out.lostItems.begin(), out.lostItems.end());
  out.lostItems.erase(std::unique(out.lostItems.begin(), out.lostItems.end()), out.lostItems.end());
  return out;
}

}  // namespace vicus::viewer
