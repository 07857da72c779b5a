/// What the window says in words: help, loading, errors, short messages. Drawn by us, for visitors.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "viewer/renderer.hpp"

namespace vicus::viewer {

/// A line of a panel: a heading alone, a text alone, or a key with what it does.
struct PanelLine {
  std::string text;
  std::string key;  ///< stands left of the text in its own column; empty: the text begins there
  bool heading = false;
  bool code = false;  ///< a line of a file: letters of one width, never broken
};

/// The keys, mode by mode.
std::vector<PanelLine> helpLines();

/// A panel as large as its lines need, at most `largest`: what is too wide is broken at spaces, what is too long is
/// left out. `scale` 1 gives letters of 16 pixels. One pixel is the least that comes out.
Picture drawPanel(std::span<const PanelLine> lines, double scale, glm::ivec2 largest);

/// The whole window while a city is read: its name, what is being done, and a bar filled from 0 to 1.
Picture drawLoading(glm::ivec2 size, double scale, const std::string& title, const std::string& stage, double fraction);

/// The whole window when there is nothing to show: what went wrong, in the given plain words.
Picture drawError(glm::ivec2 size, double scale, const std::string& title, std::span<const std::string> reasons);

}  // namespace vicus::viewer
