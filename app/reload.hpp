/// A town whose rules change while it is shown: its files are watched, and what follows from a change is made in a
/// worker while the old town stays.
#pragma once

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/open_scene.hpp"
#include "assets/styles/file_watch.hpp"
#include "viewer/drawing.hpp"

namespace vicus::app {

/// What came of a change.
struct Rebuilt {
  std::unique_ptr<city::City> city;  ///< null: the old town stays, and `diagnostics` says why
  city::Knobs knobs;                 ///< by which the two below were made
  std::unique_ptr<plan::Planner> planner;
  std::unique_ptr<scenegraph::Scene> scene;
  city::Diagnostics diagnostics;
  std::vector<std::string> ownFiles;  ///< of the new town; see OpenScene
  double seconds = 0;                 ///< that the worker took
};

/// Invariant: at most one worker; a change that comes while it works is taken up when it is done.
class Reload {
 public:
  /// Watches the scene's own files of rules and its description. What is loaded anew is asked for as `options` say; the
  /// cache is neither read nor written.
  Reload(const OpenScene& scene, const SceneOptions& options, std::string dataFolder);

  /// To be called between frames; looks at the files ten times a second at most and never waits. A result once for each
  /// change. `knobs` are those of the drawing.
  std::optional<Rebuilt> poll(const city::Knobs& knobs);

 private:
  using Clock = std::chrono::steady_clock;
  void watch(std::vector<std::string> files);

  std::vector<std::string> inputs_;
  assets::LoadOptions load_;
  std::vector<std::string> files_;
  assets::FileWatch watch_;
  Clock::time_point looked_{};
  bool wanted_ = false;
  std::future<Rebuilt> working_;
};

/// Puts a rebuilt town, which there must be, in the place of the one that is drawn. Not within a frame.
void show(Rebuilt rebuilt, OpenScene& scene, viewer::Drawing& drawing);

}  // namespace vicus::app
