/// The vertex that all drawn surfaces of a city share, and the packing of its fields.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace vicus::city {

using MaterialId = uint16_t;

/// One vertex, 32 bytes, as the graphics card gets it.
struct Vertex {
  glm::vec3 position{0};    ///< metres in the geometry's frame: z up, origin on the ground
  glm::vec2 uv{0};          ///< metres along the surface; the material's size turns them into texture repeats
  uint32_t normal = 0;      ///< unit normal, `packNormal`
  MaterialId material = 0;  ///< index into City::materials
  uint16_t item = 0;        ///< 0: the wall or roof itself; else 1 + index of the external item that it belongs to
  uint32_t slide = 0;       ///< how house LOD slides it, `packSlide`: axis out of the wall, metres from its surface

  bool operator==(const Vertex&) const = default;
};
static_assert(sizeof(Vertex) == 32);

/// A run of `count` entries from `first`.
struct Range {
  uint32_t first = 0;
  uint32_t count = 0;

  uint32_t end() const { return first + count; }
  bool operator==(const Range&) const = default;
};

/// Unit normal to two signed 16-bit octahedral coordinates, x in the low half (Cigolle et al. 2014, "A Survey of
/// Efficient Representations for Independent Unit Vectors"). Largest error 0.0046°. A zero or NaN vector gives +z.
uint32_t packNormal(glm::vec3 unit);
/// The inverse of `packNormal`; always of unit length.
glm::vec3 unpackNormal(uint32_t packed);

/// Slide axis (unit, out of the wall) as two signed 8-bit octahedral coordinates in the low half, metres from the
/// wall's surface as a half float in the high half: positive lies before it, negative behind.
uint32_t packSlide(glm::vec3 axis, float depth);
struct Slide {
  glm::vec3 axis;
  float depth;
};
Slide unpackSlide(uint32_t packed);

/// Triangles with vertices: three indices for each, counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;

  uint32_t triangleCount() const { return static_cast<uint32_t>(indices.size() / 3); }
};

}  // namespace vicus::city
