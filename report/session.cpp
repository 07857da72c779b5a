#include "report/session.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/findings.hpp"
#include "viewer/tours.hpp"

namespace vicus::report {
namespace {

/// Takes out of a plan all buildings and monuments that are not in sight.
void keepOnly(const city::City& city, const std::vector<std::pair<uint32_t, uint32_t>>& items, city::FramePlan& plan) {
  city::SetPlan& buildings = plan.buildings;
  buildings.drawn.clear();
  buildings.drawnCount = 0;
  std::vector<uint32_t> monuments;
  const auto buildingCount = static_cast<uint32_t>(city.buildings.size());
  std::vector<uint32_t> people;
  for (const auto& [item, pixels] : items) {
    if (item >= city.itemCount()) {
      people.push_back(item - city.itemOfPerson(0));
      continue;
    }
    const uint32_t index = item - 1;
    if (index >= buildingCount) {
      if (std::binary_search(plan.monuments.begin(), plan.monuments.end(), index - buildingCount))
        monuments.push_back(index - buildingCount);
      continue;
    }
    if (!buildings.drawn.empty() && buildings.drawn.back().end() == index)
      ++buildings.drawn.back().count;
    else
      buildings.drawn.push_back({index, 1});
    ++buildings.drawnCount;
  }
  plan.monuments = std::move(monuments);
  std::erase_if(plan.avatars.drawn,
                [&](const city::AvatarDraw& a) { return !std::binary_search(people.begin(), people.end(), a.person); });
  plan.counts.instancesDrawn = buildings.drawnCount + plan.monuments.size();
  plan.counts.instancesOccluded = plan.counts.instancesInFrustum - plan.counts.instancesDrawn;
}

}  // namespace

void Session::progress(std::string_view stage, double work) {
  workDone += work;
  const double fraction = std::clamp(workDone / workInAll, 1e-3, 1.0);
  if (options.progress) options.progress(stage, fraction, budget.elapsed() * (1 - fraction) / fraction);
}

void Session::noteCut(const std::string& what, int count, int wanted) {
  if (count < wanted) data.notes.push_back(fmt::format("{} {} instead of {}, to end in time.", count, what, wanted));
}

void Session::keep() {
  data.seconds = budget.elapsed();
  data.findings = findFaults(data);
  if (options.keep) options.keep(data);
}

city::ViewState viewAt(const Session& s, const city::Tour& tour, double time, glm::ivec2 size) {
  city::ViewState view = city::makeView(viewer::poseAt(tour, time), glm::radians(s.knobs["viewer.fov"]), size);
  view.time = time;
  return view;
}

city::FramePlan planEverything(Session& s, const city::ViewState& view) {
  plan::PlannerState state;
  return s.everything.plan(s.city, view, 0, state);
}

std::vector<std::pair<uint32_t, uint32_t>> itemsInSight(Session& s, city::ViewState view, glm::ivec2 size) {
  view.viewport = size;
  viewer::ItemBuffer buffer = s.full->renderer->drawItems(planEverything(s, view));
  std::sort(buffer.ids.begin(), buffer.ids.end());
  std::vector<std::pair<uint32_t, uint32_t>> items;
  for (const uint32_t id : buffer.ids) {
    if (id == 0 || id == city::kItemOther) continue;
    if (items.empty() || items.back().first != id) items.emplace_back(id, 0U);
    ++items.back().second;
  }
  return items;
}

viewer::Picture referenceOf(Session& s, const city::ViewState& view) {
  return s.full->renderer->drawReference(planEverything(s, view));
}

city::FramePlan planFor(Session& s, Run& run, const Place& place, plan::PlannerState& state) {
  city::FramePlan plan = run.planner.plan(s.city, place.view, place.dt, state);
  if (run.configuration.limit) {
    keepOnly(s.city, place.items, plan);
    plan.stages.clear();
  }
  if (s.options.interference.plan) s.options.interference.plan(run.configuration.name, plan);
  return plan;
}

std::vector<Run> makeRuns(Session& s, const std::vector<Configuration>& wanted, std::string& error) {
  std::vector<Run> runs;
  for (const Configuration& c : wanted) {
    Rig* rig = s.rigs.rigFor(c.knobs, error);
    if (rig == nullptr) return {};
    runs.emplace_back(c, rig, plan::Planner(s.city, c.knobs));
  }
  return runs;
}

}  // namespace vicus::report
