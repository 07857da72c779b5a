/// Bodies from rings: tubes about limbs, shells about heads.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "city/avatars.hpp"

namespace vicus::assets::people {

/// Up to two joints with their shares of a vertex.
struct Hold {
  uint32_t a = 0, b = 0;
  float ofB = 0;  ///< 0 to 1
};

/// An ellipse of a tube.
struct Ring {
  glm::vec3 centre{0};
  glm::vec2 radii{0.1F};  ///< along the tube's u and v
  Hold hold;
  uint8_t part = 0;  ///< of the dress
  float shade = 1;   ///< multiplies the colour: folds and hems
};

/// Collects the pieces of a body. Invariant: every triangle is counter-clockwise from outside and every weight set sums
/// to 255.
class BodyBuilder {
 public:
  /// A tube through the rings, `sides` round, closed at both ends. `u` and `v` span the rings; u × v points along the
  /// tube. `holdOf` may take the place of a ring's own hold, vertex by vertex (returns true where it does).
  void addTube(
      std::span<const Ring> rings, glm::vec3 u, glm::vec3 v, int sides = 8,
      const std::function<bool(const glm::vec3&, std::array<uint8_t, 4>&, std::array<uint8_t, 4>&)>& holdOf = {});
  /// An ellipsoid; `partOf` tells the part of a vertex from its unit direction.
  void addEllipsoid(glm::vec3 centre, glm::vec3 radii, uint32_t joint, int sides, int bands,
                    const std::function<uint8_t(const glm::vec3&)>& partOf, float shade = 1);

  /// The mesh, with smooth normals within each piece.
  city::AvatarMesh finish();

 private:
  void addVertex(const glm::vec3& p, const Hold& hold, uint8_t part, float shade);
  void smooth(size_t firstVertex, size_t firstIndex);
  city::AvatarMesh mesh_;
};

/// Three levels: the mesh itself and two that have about a half and a fifth of its triangles.
std::array<city::AvatarMesh, city::kAvatarMeshLevels> levelsOf(city::AvatarMesh mesh);

}  // namespace vicus::assets::people
