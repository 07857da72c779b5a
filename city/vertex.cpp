#include "city/vertex.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace vicus::city {
namespace {

float signNotZero(float v) {
  return v < 0 ? -1.0f : 1.0f;
}

/// Folds the sphere onto the square [−1, 1]².
glm::vec2 octahedral(glm::vec3 n) {
  const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  if (!(sum > 0) || !std::isfinite(sum)) return {0, 0};
  const glm::vec2 p = glm::vec2(n) / sum;
  if (n.z >= 0) return p;
  return {(1 - std::abs(p.y)) * signNotZero(p.x), (1 - std::abs(p.x)) * signNotZero(p.y)};
}

glm::vec3 fromOctahedral(glm::vec2 e) {
  glm::vec3 n(e, 1 - std::abs(e.x) - std::abs(e.y));
  if (n.z < 0) n = {(1 - std::abs(e.y)) * signNotZero(e.x), (1 - std::abs(e.x)) * signNotZero(e.y), n.z};
  return glm::normalize(n);
}

}  // namespace

uint32_t packNormal(glm::vec3 unit) {
  return glm::packSnorm2x16(octahedral(unit));
}

glm::vec3 unpackNormal(uint32_t packed) {
  return fromOctahedral(glm::unpackSnorm2x16(packed));
}

uint32_t packSlide(glm::vec3 axis, float depth) {
  const uint32_t axisBits = glm::packSnorm2x8(octahedral(axis));
  const uint32_t depthBits = glm::packHalf1x16(depth);
  return axisBits | depthBits << 16;
}

Slide unpackSlide(uint32_t packed) {
  return {fromOctahedral(glm::unpackSnorm2x8(static_cast<uint16_t>(packed & 0xffffU))),
          glm::unpackHalf1x16(static_cast<uint16_t>(packed >> 16))};
}

}  // namespace vicus::city
