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
#include "city/roam_frame.hpp"
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
  /// Part of the wanted error at which splits begin, above 0 to 1. From there to the wanted error their vertices move
  /// from the coarser mesh to their own height, so that nothing jumps and the error stays below the wanted one. 0.75
  /// takes 1.65 times the triangles of 1, which splits at once; nearer to 1 the move is a jump at common speeds.
  double morph = 0.75;
  /// Refine only what may be seen. False for shadow views and references.
  bool frustum = true;
};

using city::RoamFrame;
using city::RoamMesh;
using city::StoppedBy;

/// Errors of the mesh in the frustum. A triangle counts with its largest vertical error over all its samples, and how
/// far its corners still are from their own heights, so the root mean squares (weighted by the triangles' area on the
/// plan) are upper bounds too.
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

/// Knobs `roam`, `roam.pixel_error`, `roam.budget`, `roam.milliseconds`.
std::span<const city::Knob> roamKnobs();

}  // namespace vicus::terrain
