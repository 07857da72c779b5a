/// What item buffers tell about a plan.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "city/city.hpp"
#include "city/frame_plan.hpp"
#include "viewer/renderer.hpp"

namespace vicus::viewer {

/// Pixels in which two item buffers of one view disagree.
struct ItemCheck {
  /// Falsely culled: the full buffer shows a building, monument or person that the plan does not list. Must be 0.
  uint64_t lostPixels = 0;
  std::vector<uint32_t> lostItems;  ///< their item ids, ascending, each once
  std::vector<glm::ivec2> lostAt;   ///< the pixels, row by row from the top
  uint64_t shownPixels = 0;         ///< pixels of the full buffer that show one
  /// Pixels whose ids differ for whatever reason: also a missing tree or piece of ground, or another depth order.
  uint64_t differingPixels = 0;
};

/// Whether the plan draws the building, monument or person of an item id; false for 0, kItemOther and ids out of range.
bool plansItem(const city::City& city, const city::FramePlan& plan, uint32_t item);

/// Compares the item buffer of everything with the planned one of the same view. Buffers of different sizes differ
/// everywhere.
ItemCheck checkItems(const city::City& city, const city::FramePlan& plan, const ItemBuffer& everything,
                     const ItemBuffer& planned);

}  // namespace vicus::viewer
