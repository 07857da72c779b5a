/// ROAM: the ground as a mesh of right triangles that follows the eye, with a known error and no cracks.
///
/// Based on: Duchaineau, Wolinsky, Sigeti, Miller, Aldrich, Mineev-Weinstein 1997, "ROAMing Terrain: Real-time
/// Optimally Adapting Meshes" (binary triangle trees, diamonds, forced splits, split and merge queues, deferral);
/// Willmott et al. 2001, §4.1. Departs from it: the error of a triangle is its own exact one (`ErrorTable`), which may
/// grow from parent to child. So the mesh is the smallest that (1) has every patch, (2) splits every triangle that is
/// in it, in the frustum and has more than the wanted error, and (3) has no cracks; and each split remembers the reason
/// it rests on, so that splits which only hold up each other are found and undone. After any motion the mesh is the one
/// that starting anew gives.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "city/height_field.hpp"
#include "city/knob.hpp"
#include "city/view_state.hpp"
#include "terrain/error_table.hpp"

namespace vicus::terrain {

/// The three rules that stop refinement. The first that is met stops it.
struct RoamSettings {
  /// Wanted error in pixels, > 0; 2 is hard to see. Smaller takes about (1/error)^1.75 times the triangles.
  double pixelError = 2;
  /// Most triangles drawn. The mesh never has fewer than two for each patch, so a smaller budget gives these.
  uint32_t budget = 100'000;
  /// Most time for the splits and merges of one frame; what is left waits for the next. Infinite: the same input gives
  /// the same mesh on every machine.
  double milliseconds = std::numeric_limits<double>::infinity();
  /// Refine only what may be seen. False for shadow views and references.
  bool frustum = true;
};

enum class StoppedBy : uint8_t { Error, Budget, Time };

/// A triangle of the index buffer that has new vertices, counter-clockwise from above.
struct TriangleWrite {
  uint32_t slot = 0;
  std::array<uint32_t, 3> vertices{};  ///< slots of the vertex buffer
};

/// A vertex of the vertex buffer that has a new place: a sample of the field and its height.
struct VertexWrite {
  uint32_t slot = 0;
  glm::ivec2 sample{0};  ///< column and row
  float height = 0;      ///< metres above the city's origin
};

struct RoamOperations {
  uint32_t splits = 0, merges = 0;  ///< triangles cut in two, pairs of triangles joined
  uint32_t evaluations = 0;         ///< priorities worked out
  uint32_t frustumTests = 0;
};

/// What one frame changed. Applied in order to the buffers of the frames before, they hold the mesh.
struct RoamFrame {
  std::vector<VertexWrite> vertices;
  std::vector<TriangleWrite> triangles;
  uint32_t triangleCount = 0;       ///< slots 0 … triangleCount − 1 are the mesh
  uint32_t vertexSlots = 0;         ///< vertex slots are below this; it never shrinks
  uint32_t trianglesInFrustum = 0;  ///< of the mesh, triangles that may be seen
  StoppedBy stoppedBy = StoppedBy::Error;
  /// No triangle in the frustum has more: the wanted error, or the largest left where budget or time stopped. Pixels.
  double pixelError = 0;
  RoamOperations operations;
};

/// Errors of the mesh in the frustum. A triangle counts with its largest vertical error over all its samples, so the
/// root mean squares (weighted by the triangles' area on the plan) are upper bounds too.
struct RoamErrors {
  double largestMetres = 0, rmsMetres = 0;
  double largestPixels = 0, rmsPixels = 0;
};

/// The mesh of one view, from frame to frame. Invariant: the mesh has no cracks and covers the field's ground once.
/// Copies go on independently (a frozen view). The field and the table must outlive it and stay as they are.
class Roam {
 public:
  Roam(const city::HeightField& field, const ErrorTable& errors);
  ~Roam();
  Roam(const Roam& other);
  Roam& operator=(const Roam& other);
  Roam(Roam&&) noexcept;
  Roam& operator=(Roam&&) noexcept;

  /// Brings the mesh to a view. An eye that is not finite leaves the mesh as it is.
  ///
  /// A triangle's error in pixels is its vertical error · pixelsPerUnitSlope / distance from the eye to the triangle:
  /// no point of the mesh is farther than that from the ground as the view shows it.
  RoamFrame update(const city::ViewState& view, const RoamSettings& settings);

  /// Brings the mesh to an error in metres, > 0, the same everywhere.
  RoamFrame refine(double metres, uint32_t budget = std::numeric_limits<uint32_t>::max());

  /// The whole mesh as writes, for buffers that are still empty.
  RoamFrame everything() const;

  /// Errors with regard to the last view; pixels are 0 after `refine`.
  RoamErrors errors() const;

  /// Height of the mesh at a position in metres from the city's origin; nothing outside the field or in its gaps.
  std::optional<double> heightAt(double x, double y) const;

  /// Bytes held for this view.
  size_t bytes() const;

  /// For tests: checks links, queues, reasons and buffers against each other; what is wrong first, or empty.
  std::string broken() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Knobs `roam`, `roam.pixel_error`, `roam.budget`.
std::span<const city::Knob> roamKnobs();

}  // namespace vicus::terrain
