#include "app/reload.hpp"

#include <algorithm>
#include <utility>

#include "assets/scene/apply_scene.hpp"
#include "assets/styles/styles.hpp"

namespace vicus::app {
namespace {

using Clock = std::chrono::steady_clock;

Rebuilt rebuild(const std::vector<std::string>& files, const std::vector<std::string>& inputs,
                const assets::LoadOptions& load, const city::Knobs& knobs) {
  const Clock::time_point begin = Clock::now();
  Rebuilt out;
  out.knobs = knobs;
  // Mistakes in rules are told at once; a first opening would show plain houses in their place.
  for (const std::string& file : files)
    if (file.ends_with(".rules")) assets::loadStyle(file, out.diagnostics);
  if (out.diagnostics.hasErrors()) return out;
  std::future<scenegraph::GroundDetail> painting = std::async(std::launch::async, [] {
    city::Diagnostics unheard;  // the same as when the scene was opened
    return scenegraph::paintGroundDetail(unheard);
  });
  assets::LoadResult loaded = assets::loadCity(inputs, load);
  out.diagnostics = std::move(loaded.diagnostics);
  if (!loaded.city) return out;
  out.ownFiles = ownFilesOf(loaded);
  out.city = std::make_unique<city::City>(std::move(*loaded.city));
  light::applyTime(out.city->environment, assets::placeOf(*out.city, load.shift), knobs);
  out.planner = std::make_unique<plan::Planner>(*out.city, knobs);
  out.scene = std::make_unique<scenegraph::Scene>(*out.city, knobs, out.diagnostics, assets::Progress(), painting.get(),
                                                  out.planner->houses());
  out.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return out;
}

bool sameValues(const city::Knobs& a, const city::Knobs& b) {
  return std::ranges::all_of(a.declared(), [&](const city::Knob& k) { return a[k.name] == b[k.name]; });
}

}  // namespace

Reload::Reload(const OpenScene& scene, const SceneOptions& options, std::string dataFolder)
    : inputs_(options.inputs), load_(loadOptions(options, std::move(dataFolder))) {
  watch(scene.ownFiles);
}

void Reload::watch(std::vector<std::string> files) {
  if (files == files_) return;
  files_ = std::move(files);
  watch_ = assets::FileWatch(files_);
}

std::optional<Rebuilt> Reload::poll(const city::Knobs& knobs) {
  constexpr auto kBetween = std::chrono::milliseconds(100);
  if (const Clock::time_point now = Clock::now(); now - looked_ >= kBetween) {
    looked_ = now;
    wanted_ |= !watch_.changed().empty();
  }
  if (working_.valid()) {
    if (working_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
    Rebuilt done = working_.get();
    if (done.city) watch(done.ownFiles);
    return done;
  }
  if (std::exchange(wanted_, false)) working_ = std::async(std::launch::async, rebuild, files_, inputs_, load_, knobs);
  return std::nullopt;
}

void show(Rebuilt rebuilt, OpenScene& scene, viewer::Drawing& drawing) {
  const std::unique_ptr<city::City> former = std::exchange(scene.city, std::move(rebuilt.city));
  // Knobs that were turned meanwhile count.
  if (!sameValues(rebuilt.knobs, drawing.knobs)) {
    rebuilt.planner = std::make_unique<plan::Planner>(*scene.city, drawing.knobs);
    rebuilt.scene.reset();
    rebuilt.scene =
        std::make_unique<scenegraph::Scene>(*scene.city, drawing.knobs, rebuilt.diagnostics, assets::Progress(),
                                            scenegraph::GroundDetail(), rebuilt.planner->houses());
  }
  viewer::showCity(drawing, *scene.city, std::move(rebuilt.planner), std::move(rebuilt.scene));
  scene.diagnostics = std::move(rebuilt.diagnostics);
}

}  // namespace vicus::app
