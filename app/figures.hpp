/// Figures as JSON, in the shapes that docs/command-line.md gives.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "app/open_scene.hpp"
#include "viewer/frame_loop.hpp"

namespace vicus::app {

/// A walk that is over.
struct WalkResult {
  const OpenScene& scene;
  std::span<const plan::FeatureReport> features;
  std::span<const viewer::FrameRecord> records;
  std::string renderer;
  glm::ivec2 size{0};
  double firstFrameSeconds = 0;  ///< from the program's start to the end of its first frame
  uint64_t gpuBytes = 0;
  uint64_t peakResidentBytes = 0;
};
std::string walkJson(const WalkResult& result);

std::string infoJson(const OpenScene& scene, std::span<const plan::FeatureReport> features);
std::string infoText(const OpenScene& scene, std::span<const plan::FeatureReport> features);

std::string knobsJson(const city::Knobs& knobs);
std::string knobsText(const city::Knobs& knobs);

}  // namespace vicus::app
