#include "report/rigs.hpp"

namespace vicus::report {
namespace {

constexpr std::string_view kMultisamples = "viewer.multisamples";

}  // namespace

Rig* Rigs::rigFor(const city::Knobs& knobs, std::string& error) {
  std::vector<double> settings{knobs[kMultisamples]};
  for (const city::Knob& knob : scenegraph::sceneKnobs()) settings.push_back(knobs[knob.name]);
  for (const auto& rig : rigs_)
    if (rig->settings == settings) return rig.get();

  auto rig = std::make_unique<Rig>();
  rig->settings = std::move(settings);
  rig->context = viewer::makeOffscreenContext(error);
  if (!rig->context) return nullptr;
  rig->context->makeCurrent();
  city::Diagnostics diagnostics;
  city::Knobs forAll = knobs;
  forAll.set("house_lod", 1);  // runs without it draw the same scene, where nothing is flat
  rig->scene = std::make_unique<scenegraph::Scene>(city_, forAll, diagnostics);
  rig->renderer =
      std::make_unique<viewer::Renderer>(*rig->context, *rig->scene, static_cast<int>(knobs[kMultisamples]));
  return rigs_.emplace_back(std::move(rig)).get();
}

void Rigs::keepFirst(size_t count) {
  while (rigs_.size() > count) rigs_.pop_back();
}

}  // namespace vicus::report
