#include "plan/ground_weights.hpp"

#include <algorithm>
#include <cmath>

namespace vicus::plan {
namespace {

/// Gives the corners of all cells that a box covers on the plan a weight of at least `weight`.
void weigh(const city::HeightField& field, const city::Aabbf& box, float weight, std::vector<float>& weights) {
  if (box.empty()) return;
  const glm::dvec2 from = glm::floor((glm::dvec2(box.min) - field.origin) / field.spacing);
  const glm::dvec2 to = glm::ceil((glm::dvec2(box.max) - field.origin) / field.spacing);
  const glm::dvec2 last(field.size - 1);
  if (!(from.x <= last.x && from.y <= last.y && to.x >= 0 && to.y >= 0)) return;
  const glm::ivec2 low(glm::max(from, 0.0)), high(glm::min(to, last));
  for (int row = low.y; row <= high.y; ++row) {
    float* line = weights.data() + static_cast<size_t>(row) * static_cast<size_t>(field.size.x);
    for (int column = low.x; column <= high.x; ++column) line[column] = std::max(line[column], weight);
  }
}

}  // namespace

std::vector<float> groundWeights(const city::City& city) {
  if (!city.terrain || city.terrain->empty()) return {};
  const city::HeightField& field = *city.terrain;
  std::vector<float> weights(field.heights.size(), 1.0F);
  for (const city::InstanceSet* set : {&city.buildings, &city.trees})
    for (const city::Aabbf& box : set->bounds) weigh(field, box, kWeightUnderThings, weights);
  for (const city::Monument& m : city.monuments) weigh(field, m.bounds, kWeightUnderThings, weights);

  const auto columns = static_cast<size_t>(field.size.x), rows = static_cast<size_t>(field.size.y);
  for (size_t column = 0; column < columns; ++column)
    weights[column] = weights[(rows - 1) * columns + column] = kWeightOfBorder;
  for (size_t row = 0; row < rows; ++row) weights[row * columns] = weights[(row + 1) * columns - 1] = kWeightOfBorder;
  return weights;
}

}  // namespace vicus::plan
