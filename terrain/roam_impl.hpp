/// What ROAM remembers of one view, and the names of what is done to it. Private to terrain/roam*.cpp: the trees and
/// the index buffer (roam_splits.cpp), priorities and the frustum (roam_priorities.cpp), why a diamond is split
/// (roam_reasons.cpp), geomorphs (roam_morph.cpp), a frame (roam.cpp), what the mesh says of itself (roam_measure.cpp).
#pragma once

#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "terrain/bucket_queue.hpp"
#include "terrain/deferral.hpp"
#include "terrain/patch_grid.hpp"
#include "terrain/roam.hpp"
#include "terrain/roam_eye.hpp"
#include "terrain/triangle_distance.hpp"

namespace vicus::terrain {

constexpr uint32_t kNone = 0xffffffffU;

/// Masks of frustum planes that a triangle may cross; 0 is wholly inside.
constexpr uint8_t kOutside = 0x80;

/// Why a diamond is split: side 0 or 1 has too much error, or child kBecauseOfChild + k is split.
constexpr uint8_t kBecauseOfChild = 2;
constexpr uint8_t kNoReason = 0xff;

/// Buckets of priorities: 0 for triangles that have no more than the wanted error, then 8 for each doubling of it.
constexpr uint32_t kLastBucket = 250;

/// One triangle of a diamond, while it is in the tree: drawn, or split into two of the next level.
struct Side {
  float error = 0;         ///< metres
  float weight = 0;        ///< how far this side wants its split to be complete, 0 … 1
  BucketLinks queue;       ///< its place in its bucket
  uint32_t stamp = 0;      ///< changes whenever a deferred look at it becomes void
  uint32_t slot = kNone;   ///< in the index buffer, while it is drawn
  uint8_t bucket = 0;      ///< of its priority
  uint8_t planes = 0;      ///< frustum planes that it may cross, or kOutside
  uint8_t childIndex = 0;  ///< which child of its parent the diamond is
  bool present = false;
  bool wanted = false;  ///< its diamond is split because of it (perhaps among other reasons)
  bool ground = false;  ///< covers ground that has data: drawn where it is a leaf
};

/// See `DiamondShape` for the drawing. Coordinates are half samples, so that the finest triangles' diamonds, centred
/// between the samples, have whole ones.
struct alignas(128) Diamond {
  glm::ivec2 centre{0}, u{0};
  std::array<uint32_t, 2> parent{kNone, kNone};  ///< the diamond whose split made the side; none for roots
  std::array<uint32_t, 4> child{kNone, kNone, kNone, kNone};
  std::array<uint32_t, 4> corner{};  ///< vertex slots of b, p0, a, p1
  std::array<Side, 2> side;
  float weight = 0;  ///< while it is split: how far its centre is from where it was to its own height
  uint8_t splitChildren = 0;
  uint8_t reason = kNoReason;
  bool split = false;
  bool marked = false;   ///< belongs to the diamonds that `reground` looks at
  bool pressed = false;  ///< reaches beyond the field
  bool finest = false;   ///< has no sample at its centre: cannot be split

  glm::ivec2 v() const { return {-u.y, u.x}; }
  /// From the centre to the middle of child k's diamond.
  glm::ivec2 childOffset(uint32_t k) const {
    const int alongU = k == 0 || k == 3 ? 1 : -1, alongV = k < 2 ? 1 : -1;
    return {(alongU * u.x - alongV * u.y) >> 1, (alongU * u.y + alongV * u.x) >> 1};
  }
};

/// A slot of the index buffer.
struct Drawn {
  uint32_t owner;    ///< the side drawn there
  uint64_t touched;  ///< revision in which it last changed
};

/// Bucket of a priority: the square of error / wanted error, in quarters of its octaves.
inline uint32_t bucketOf(float ratioSquared) {
  if (!(ratioSquared > 1)) return 0;
  const uint32_t quarter = (std::bit_cast<uint32_t>(ratioSquared) - std::bit_cast<uint32_t>(1.0F)) >> 21;
  return std::min(1 + quarter, kLastBucket);
}
/// The smallest squared ratio of a bucket ≥ 1.
inline float bucketFloor(uint32_t bucket) {
  return std::bit_cast<float>(((bucket - 1) << 21) + std::bit_cast<uint32_t>(1.0F));
}

struct Roam::Impl {
  const city::HeightField* field;
  const ErrorTable* table;
  const float* heights;  ///< corners' heights: gaps filled
  PatchGrid patches;
  glm::ivec2 lastHalf;  ///< half samples at the field's far corner
  glm::vec2 halfStep;   ///< metres
  int columns;          ///< of the table
  uint32_t roots;       ///< patches

  std::vector<Diamond> diamonds;  ///< the patches' own first
  std::vector<uint32_t> freeDiamonds;
  uint32_t cornerSlots = 0;          ///< vertex slots of the patches' corners, before those of the diamonds' centres
  std::vector<float> vertexHeights;  ///< by vertex slot

  BucketQueue wanting;   ///< sides with too much error that are not wanted yet: the split queue
  BucketQueue standing;  ///< wanted sides: the merge queue
  Deferral deferral;
  double path = 0;       ///< metres that the eye has gone
  bool ordered = false;  ///< priorities are kept to their bucket, not only to the wanted error: a budget may bind
  Eye eye;
  bool started = false;

  std::shared_ptr<RoamMesh> mesh = std::make_shared<RoamMesh>();
  std::vector<Drawn> drawn;  ///< by slot of the mesh's triangles
  std::vector<uint32_t> touchedSlots, touchedVertices;
  std::vector<uint32_t> reweigh;  ///< diamonds whose weight may have changed
  double statedPixels = 0;        ///< the error of the last frame
  uint32_t visible = 0;           ///< triangles in the frustum

  city::RoamOperations operations;
  std::vector<uint32_t> group, work;  ///< of `reground`

  Impl(const city::HeightField& f, const ErrorTable& t)
      : field(&f),
        table(&t),
        heights(t.filled.empty() ? f.heights.data() : t.filled.data()),
        patches(t.patches),
        lastHalf(2 * t.patches.cells),
        halfStep(0.5 * f.spacing),
        columns(t.patches.span().x + 1),
        roots(static_cast<uint32_t>(t.patches.count.x * t.patches.count.y)) {
    if (!patches.empty()) makeRoots();
  }

  // --- samples -------------------------------------------------------------------------------------------------------

  Side& side(uint32_t id) { return diamonds[id >> 1].side[id & 1]; }
  const Side& side(uint32_t id) const { return diamonds[id >> 1].side[id & 1]; }
  bool isRoot(uint32_t d) const { return d < roots; }
  uint32_t vertexOf(uint32_t d) const { return cornerSlots + d; }

  /// The field's sample at a place in half samples.
  glm::ivec2 sampleAt(glm::ivec2 halves) const {
    return {std::min(halves.x >> 1, patches.cells.x), std::min(halves.y >> 1, patches.cells.y)};
  }
  float heightOf(glm::ivec2 sample) const {
    return heights[static_cast<size_t>(sample.y) * static_cast<size_t>(field->size.x) + static_cast<size_t>(sample.x)];
  }
  bool hasData(glm::ivec2 sample) const { return std::isfinite(field->at(sample.x, sample.y)); }

  /// Places of a side's corners a, b, apex in half samples.
  static std::array<glm::ivec2, 3> cornersOf(const Diamond& d, uint32_t s) {
    const int sign = s == 0 ? 1 : -1;
    return {d.centre - sign * d.u, d.centre + sign * d.u, d.centre + sign * d.v()};
  }
  /// Their vertex slots, counter-clockwise.
  static std::array<uint32_t, 3> verticesOf(const Diamond& d, uint32_t s) {
    return s == 0 ? std::array{d.corner[2], d.corner[0], d.corner[1]}
                  : std::array{d.corner[0], d.corner[2], d.corner[3]};
  }
  glm::vec3 fromEye(glm::ivec2 halves, uint32_t vertex) const {
    const int x = std::min(halves.x, lastHalf.x) - eye.place.x, y = std::min(halves.y, lastHalf.y) - eye.place.y;
    return {static_cast<float>(x) * halfStep.x - eye.rest.x, static_cast<float>(y) * halfStep.y - eye.rest.y,
            vertexHeights[vertex] - eye.height - eye.heightRest};
  }

  /// Sets a side's error and whether it is ground, from the table.
  void describe(Diamond& d, uint32_t s) const;
  /// Whether a triangle has area and, where it is one of the finest, data at its corners.
  bool coversGround(const Diamond& d, uint32_t s) const;

  bool reachesOut(const Diamond& d) const;

  void makeRoots();

  void placeVertex(uint32_t vertex, glm::ivec2 sample);

  // --- the index buffer ----------------------------------------------------------------------------------------------

  void putTriangle(uint32_t slot, uint32_t id);
  void draw(uint32_t id);
  void undraw(uint32_t id);
  /// `to` is drawn in the place of `from`.
  void redraw(uint32_t from, uint32_t to);

  // --- priorities ----------------------------------------------------------------------------------------------------

  auto links() {
    return [this](uint32_t id) -> BucketLinks& { return side(id).queue; };
  }
  void setBucket(uint32_t id, Side& t, uint32_t bucket) {
    takeFromQueue(id, t);
    t.bucket = static_cast<uint8_t>(bucket);
    putInQueue(id, t);
  }
  void putInQueue(uint32_t id, Side& t) {
    if (t.wanted || t.bucket > 0) (t.wanted ? standing : wanting).push(t.bucket, id, links());
  }
  void takeFromQueue(uint32_t id, Side& t) {
    if (t.wanted || t.bucket > 0) (t.wanted ? standing : wanting).remove(t.bucket, id, links());
  }

  void addToBatch(Batch& batch, uint32_t id) const {
    const Diamond& d = diamonds[id >> 1];
    const auto places = cornersOf(d, id & 1);
    const auto vertices = verticesOf(d, id & 1);
    setLane(batch, id, d.side[id & 1].error, fromEye(places[0], vertices[0]), fromEye(places[1], vertices[1]),
            fromEye(places[2], vertices[2]));
  }
  static void setLane(Batch& batch, uint32_t id, float error, const glm::vec3& a, const glm::vec3& b,
                      const glm::vec3& apex) {
    const size_t lane = batch.count++;
    batch.side[lane] = id;
    batch.error[lane] = error;
    batch.a[0][lane] = a.x, batch.a[1][lane] = a.y, batch.a[2][lane] = a.z;
    batch.b[0][lane] = b.x, batch.b[1][lane] = b.y, batch.b[2][lane] = b.z;
    batch.apex[0][lane] = apex.x, batch.apex[1][lane] = apex.y, batch.apex[2][lane] = apex.z;
  }

  /// Works out the priorities of a batch and empties it.
  void evaluate(Batch& batch);

  /// Metres that the eye can go before a triangle's bucket may change. `reach` is the distance at which it has just the
  /// wanted error.
  float slackOf(float ratioSquared, uint32_t bucket, float distance, float reach) const;
  float slackInOrder(float ratioSquared, uint32_t bucket, float distance) const;

  // --- geomorphs -----------------------------------------------------------------------------------------------------

  /// Weights are looked at again when they may be off by this; at two pixels that is a sixteenth of one.
  static constexpr float kWeightStep = 1.0F / 32;

  /// How far a split must be complete: from 0 where it begins to 1 at the wanted error. A step more than that, so that
  /// it suffices until the next look.
  float weightOf(float reach, float distance) const {
    if (!(reach > distance)) return 0;
    const float needed = (reach / distance - 1) * eye.band / (1 - eye.band);
    return needed + kWeightStep < 1 ? needed + kWeightStep : 1;
  }
  void setWeight(uint32_t id, Side& t, float weight) {
    if (t.weight == weight) return;
    t.weight = weight;
    if (diamonds[id >> 1].split) reweigh.push_back(id >> 1);
  }

  /// Brings weights and the heights that hang on them up to date.
  ///
  /// Let the mesh of u, 0 < u ≤ 1, be the one that splits just the diamonds whose weight is at least u. A diamond has
  /// no smaller a weight than those that need its split, so each is a mesh without cracks; and none leaves a triangle
  /// whose own weight is 1 unsplit, so each has no more than the wanted error. What is drawn is the mean of them all,
  /// and has no more than that either.
  void morph();
  float weightNeeded(uint32_t d) const;

  /// Mean height of the meshes of u = 0 … 1 at a diamond's centre. Up from it, each triangle is the one around it
  /// in the meshes of u between its own weight and the weight of the split that made it.
  float morphedHeight(uint32_t d) const;
  /// How far the farthest corner of a triangle is from its own height.
  float displacement(uint32_t id) const;
  /// Height of a triangle's plane, corners at their own heights, at a place in half samples.
  float heightInTriangle(uint32_t id, glm::ivec2 at) const;

  /// A side that needs no look until its place in the frustum changes.
  bool idle(const Side& t) const { return t.error == 0 || t.planes == kOutside; }

  /// Brings a side's priority up to date.
  void look(Batch& batch, uint32_t id);

  void lookAtAll();

  void lookAtDue();

  // --- the frustum ---------------------------------------------------------------------------------------------------

  /// Planes of `mask` that the ground under a triangle may cross: the triangle moved up and down by its error contains
  /// that ground.
  uint8_t planesCrossed(uint8_t mask, float error, const glm::vec3& a, const glm::vec3& b, const glm::vec3& apex) {
    ++operations.frustumTests;
    uint32_t crossed = mask;
    for (uint32_t left = mask; left != 0; left &= left - 1) {
      const Plane& plane = eye.planes[static_cast<size_t>(std::countr_zero(left))];
      const float da = plane.x * a.x + plane.y * a.y + plane.z * a.z;
      const float db = plane.x * b.x + plane.y * b.y + plane.z * b.z;
      const float dp = plane.x * apex.x + plane.y * apex.y + plane.z * apex.z;
      const float most = da > db ? (da > dp ? da : dp) : (db > dp ? db : dp);
      const float least = da < db ? (da < dp ? da : dp) : (db < dp ? db : dp);
      const float thickness = error * plane.steepness;
      if (most + plane.distance + thickness < 0) return kOutside;
      if (least + plane.distance - thickness >= 0) crossed ^= left & (~left + 1);
    }
    return static_cast<uint8_t>(crossed);
  }
  uint8_t planesCrossed(uint8_t mask, uint32_t id);
  /// Whether a side's own triangle reaches beyond the field: pressed back onto it, its children may reach out of it.
  bool sideReachesOut(const Diamond& d, uint32_t s) const {
    if (!d.pressed) return false;
    for (const glm::ivec2& corner : cornersOf(d, s))
      if (corner.x > lastHalf.x || corner.y > lastHalf.y) return true;
    return false;
  }
  /// What the children of a side begin with. Those of one that reaches beyond the field ask all planes again.
  uint8_t inherited(const Diamond& d, uint32_t s) const {
    return sideReachesOut(d, s) ? eye.allPlanes : d.side[s].planes;
  }

  /// Carries the frustum down the trees. Triangles that stay wholly inside or outside end the descent.
  void carryFrustumDown();

  // --- splits and merges ---------------------------------------------------------------------------------------------

  uint32_t sideToward(uint32_t child, uint32_t parent) const { return diamonds[child].parent[0] == parent ? 0 : 1; }

  struct Neighbour {
    uint32_t diamond = kNone;
    uint32_t edge = 0;  ///< which of its edges is the shared one
  };
  /// The diamond of the same level beyond edge k; none at the field's edge. The side with that edge must be present.
  Neighbour across(uint32_t d, uint32_t k) const;
  Neighbour acrossPatches(const Diamond& here, uint32_t k) const;

  /// The parent that has yet to be split for a side to be there; none at the field's edge.
  Neighbour missingParent(const Diamond& d, uint32_t s) const;

  void makeRoom();

  /// Splits a diamond, and before it whatever must be split to keep the mesh free of cracks.
  void forceSplit(uint32_t d, uint8_t reason);

  void split(uint32_t d);

  /// How far from the eye the four triangles around a diamond's centre are: the centre belongs to each of them, and all
  /// lie within the distance of its farthest corner.
  struct Around {
    float least = 0, centre = 0;  ///< metres
  };
  Around aroundCentre(const Diamond& d, uint32_t vertex) const;
  /// Gives a new side its bucket where the distances around it settle that; false where only its own distance does.
  bool settle(uint32_t id, Side& t, const Around& around);

  /// Puts the triangle over edge k of a split diamond into the tree.
  uint32_t makeChild(uint32_t d, uint32_t k);

  void merge(uint32_t d);

  void unwant(uint32_t id);

  /// Takes a side from the split queue to the merge queue and sees to it that its diamond is split.
  void want(uint32_t id);

  /// Takes a side from the merge queue; what was split only because of it is merged.
  void release(uint32_t id);

  /// The diamond that a split diamond's reason is; none for the patches themselves.
  uint32_t reasonOf(const Diamond& d) const;
  /// Whether d's chain of reasons passes through `through`.
  bool restsOn(uint32_t d, uint32_t through) const;

  /// A side that wants the split of a diamond without split children and does not rest on it, or kNoReason.
  uint8_t otherSide(uint32_t d) const;
  /// Merges a diamond that nothing needs; parents that were split for it lose their reason.
  void mergeWithParents(uint32_t d);

  /// Whether anything rests directly on a diamond.
  bool isReason(uint32_t d) const;

  void mark(uint32_t d);
  void unmark(uint32_t d, uint8_t reason);

  /// A reason outside the marked diamonds, or kNoReason.
  uint8_t reasonOutside(const Diamond& d) const;

  /// A diamond has lost its reason. All that rest on it look for another one; those that find none are merged.
  ///
  /// Reasons lead from a patch down to a diamond (a triangle that must be split) or up (a child's split needs it), so
  /// what must be split is what a patch reaches. This keeps a tree of those ways: the part of it that hangs on the lost
  /// reason is cut off, tied on again wherever another way leads into it, and the rest has none.
  void reground(uint32_t lost);
  bool restsDirectlyOn(uint32_t d, uint32_t reason) const;

  // --- a frame -------------------------------------------------------------------------------------------------------

  RoamFrame run(const Eye& next, uint32_t budget, double milliseconds);

  /// Brings frustum and priorities to the new eye.
  void turnTo(const Eye& next, uint32_t budget);
  bool mayBind(uint32_t budget) const { return drawn.size() > (ordered ? budget / 2 : budget - budget / 4); }

  void start();

  /// Splits for a side unless that takes more triangles than the budget has.
  bool fits(uint32_t id, uint32_t budget);

  StoppedBy refineAndCoarsen(uint32_t budget, double milliseconds);

  /// Largest ratio of error to wanted error of what is drawn, where that is more than 1.
  double largestRatio() const;
  Batch::Lanes ratiosOf(const Batch& batch) const;

  // --- what the mesh says --------------------------------------------------------------------------------------------

  /// Height at a place in samples, among the triangles of sides first … first + count − 1 of a diamond or, where it is
  /// split, its children over the same edges.
  std::optional<double> heightWithin(uint32_t d, uint32_t first, uint32_t count, const glm::dvec2& at) const;
  /// Barycentric weights of a place; far below 0 for a triangle without area.
  glm::dvec3 weightsIn(uint32_t id, const glm::dvec2& at) const;

  std::string broken() const;

  void finish(RoamFrame& result);
};

}  // namespace vicus::terrain
