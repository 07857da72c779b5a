#include "report/configurations.hpp"

#include <algorithm>
#include <set>

namespace vicus::report {
namespace {

using plan::Technique;

std::vector<Technique> switched(const city::Knobs& knobs, std::span<const Technique> techniques) {
  std::vector<Technique> out;
  for (const Technique& t : techniques)
    if (!t.switchKnob.empty() && knobs.has(t.switchKnob)) out.push_back(t);
  return out;
}

/// The knobs with exactly those techniques on for which `on` says so.
template <typename Choice>
city::Knobs with(city::Knobs knobs, const std::vector<Technique>& techniques, const Choice& on) {
  for (const Technique& t : techniques) knobs.set(t.switchKnob, on(t) ? 1.0 : 0.0);
  return knobs;
}

}  // namespace

std::vector<Configuration> configurations(const city::Knobs& knobs, std::span<const Technique> techniques) {
  const std::vector<Technique> all = switched(knobs, techniques);
  const auto none = [](const Technique&) { return false; };
  const auto usual = [&](const Technique& t) { return knobs.on(t.switchKnob); };
  std::vector<Configuration> out;
  out.push_back({"all_off", with(knobs, all, none)});
  for (const Technique& t : all)
    out.push_back(
        {"only_" + std::string(t.name), with(knobs, all, [&](const Technique& u) { return u.name == t.name; })});
  out.push_back({"all_on", with(knobs, all, usual)});
  for (const Technique& t : all)
    if (usual(t))
      out.push_back({"all_on_less_" + std::string(t.name),
                     with(knobs, all, [&](const Technique& u) { return usual(u) && u.name != t.name; })});
  out.push_back({"visibility", with(knobs, all, [&](const Technique& u) { return usual(u) && u.visibility; })});
  // The limit keeps what makes drawing cheap and no picture worse, and leaves the choosing to the item buffer.
  Configuration limit{"limit",
                      with(knobs, all, [&](const Technique& u) { return usual(u) && !u.geometricErrorPixels; }), true};
  out.push_back(std::move(limit));
  return out;
}

std::vector<SweepPoint> sweepOf(const Technique& technique, const city::Knobs& knobs,
                                std::span<const Technique> techniques, size_t points) {
  std::vector<SweepPoint> out;
  if (technique.sweep.empty() || points == 0 || !knobs.has(technique.sweptKnob)) return out;
  const double usual = knobs[technique.sweptKnob];

  // Both ends and the default first, then what lies evenly between.
  const size_t last = technique.sweep.size() - 1;
  std::set<double> values{technique.sweep.front()};
  if (points >= 2) values.insert(technique.sweep.back());
  if (points >= 3) values.insert(usual);
  for (size_t k = 1; k + 1 < points && values.size() < points; ++k)
    values.insert(technique.sweep[k * last / (points - 1)]);

  const std::vector<Technique> all = switched(knobs, techniques);
  for (const double value : values) {
    city::Knobs turned =
        with(knobs, all, [&](const Technique& u) { return knobs.on(u.switchKnob) || u.name == technique.name; });
    if (!turned.set(technique.sweptKnob, value).empty()) continue;  // out of the knob's range
    out.push_back({value, value == usual, {std::string(technique.sweptKnob), std::move(turned)}});
  }
  return out;
}

}  // namespace vicus::report
