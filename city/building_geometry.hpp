/// A type of building, shared by all instances of it.
///
/// Based on: Willmott et al. 2001, §2 and Figure 2 (levels → planes → external geometry and openings).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "city/aabb.hpp"
#include "city/vertex.hpp"

namespace vicus::city {

constexpr uint16_t kNoTexture = 0xffff;

/// Something on a wall that goes away when it is too far to be seen. Its triangles are modelled at full detail's
/// position.
struct ExternalItem {
  Range indices;    ///< triangles in BuildingGeometry::indices
  float depth = 0;  ///< metres that it reaches out of the wall (geometry) or into it (opening); never negative
};
using ExternalGeometry = ExternalItem;  ///< sticks out: frames, sills, beams, doors' surrounds
using ExternalOpening = ExternalItem;   ///< goes in: the reveal and the pane or door leaf at its back

enum class PlaneKind : uint8_t { Wall, Gable, Roof, Floor, Other };

/// A wall or a roof surface with what is attached to it. At full detail its `cut` triangles are drawn with its items;
/// flat, its `flat` triangles alone.
struct Plane {
  PlaneKind kind = PlaneKind::Wall;
  bool solid = true;                 ///< opaque and drawn over its whole outline: may hide what lies behind it
  MaterialId baseTexture = 0;        ///< material of the bare surface
  uint16_t lodTexture = kNoTexture;  ///< baked picture of the surface with its items, once there is one
  glm::vec3 normal{0, 0, 1};         ///< unit, outward
  Range cut;                         ///< triangles with holes where openings are
  Range flat;                        ///< triangles without holes; the same range as `cut` where there are no openings
  Range externalGeometry;            ///< in BuildingGeometry::externalGeometry
  Range externalOpenings;            ///< in BuildingGeometry::externalOpenings
};

/// A storey, or the roof.
struct Level {
  float bottom = 0;  ///< metres above the geometry's origin
  float top = 0;
  Range planes;  ///< in BuildingGeometry::planes
};

/// A vertical piece of solid, drawn wall from `bottom` to `top` between two points of the plan: what occluder shadows
/// start from.
struct OccluderLine {
  glm::vec2 a{0}, b{0};
  float bottom = 0, top = 0;
};

/// Frame: metres, z up, origin on the ground within the footprint. `indices` holds first every triangle of full detail
/// in one run, then the `flat` triangles that differ, so that each level of detail is one draw.
struct BuildingGeometry {
  std::string name;
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
  Range fullDetail;  ///< in indices: all cut surfaces and all items
  std::vector<Level> levels;
  std::vector<Plane> planes;
  std::vector<ExternalGeometry> externalGeometry;
  std::vector<ExternalOpening> externalOpenings;
  std::vector<OccluderLine> occluders;
  std::vector<std::vector<glm::vec2>> footprint;  ///< outer ring, counter-clockwise, then holes, clockwise; not closed
  Aabbf bounds;                                   ///< of all vertices
  float height = 0;                               ///< bounds.max.z

  uint32_t fullDetailTriangles() const { return fullDetail.count / 3; }
};

/// Puts a BuildingGeometry together piece by piece. Invariant: whatever the order of calls, the result keeps the layout
/// that BuildingGeometry promises (one run for full detail, ranges inside their parents, bounds of all vertices).
///
/// Polygons are counter-clockwise seen from outside. Positions in metres; uv in metres unless the material says
/// otherwise.
class BuildingBuilder {
 public:
  explicit BuildingBuilder(std::string name);

  void beginLevel(float bottom, float top);
  /// Begins a plane in the current level (begins a level where there is none).
  void beginPlane(PlaneKind kind, MaterialId baseTexture, glm::vec3 outwardNormal, bool solid = true);

  /// Where the triangles that follow go, until the next begin….
  void beginCut();   ///< the plane's surface at full detail (the default after beginPlane)
  void beginFlat();  ///< the plane's surface without openings; leave out where it equals the cut one
  /// Sticks out of (or for an opening goes into) the current plane by `depth` ≥ 0 metres.
  void beginExternalGeometry(float depth);
  void beginExternalOpening(float depth);

  /// Adds triangles with one normal. `positions` and `uvs` are of equal length; `triangles` has three indices for each.
  void addTriangles(std::span<const glm::vec3> positions, std::span<const glm::vec2> uvs,
                    std::span<const uint32_t> triangles, glm::vec3 normal, MaterialId material);
  /// Adds a flat quadrilateral a b c d with its normal from its corners; degenerate ones are dropped. uv: `uvA` at a,
  /// growing by |ab| to b and |ad| to d.
  void addQuad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, MaterialId material, glm::vec2 uvA = {0, 0});
  /// The same with uv given for each corner.
  void addQuad(const glm::vec3 (&corners)[4], const glm::vec2 (&uvs)[4], MaterialId material);
  /// A convex polygon as a fan, uv from metres along `uAxis` and `vAxis` from the first corner (both unit).
  void addConvex(std::span<const glm::vec3> corners, glm::vec3 uAxis, glm::vec3 vAxis, MaterialId material);
  /// The six faces of a box with corners `min`, `max`, in a frame with unit axes x, y, z and `origin`; `faces` masks
  /// −x +x −y +y −z +z from bit 0.
  void addBox(glm::vec3 origin, glm::vec3 x, glm::vec3 y, glm::vec3 z, glm::vec3 min, glm::vec3 max,
              MaterialId material, unsigned faces = 0x3f);

  void addOccluder(const OccluderLine& line);
  void setFootprint(std::vector<std::vector<glm::vec2>> rings);

  /// The finished geometry; the builder is empty afterwards.
  BuildingGeometry finish();

 private:
  enum class Target : uint8_t { Cut, Flat, Geometry, Opening };
  struct Piece {
    Target target;
    uint32_t plane;
    uint32_t item;  ///< index within its target's list
    std::vector<uint32_t> indices;
  };
  Piece& piece();
  void begin(Target target);
  uint16_t itemNumber() const;

  BuildingGeometry geometry_;
  std::vector<Piece> pieces_;
  std::vector<bool> hasFlat_;
};

}  // namespace vicus::city
