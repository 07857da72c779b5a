#include "terrain/roam.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>

#include "terrain/bucket_queue.hpp"
#include "terrain/deferral.hpp"
#include "terrain/patch_grid.hpp"

namespace vicus::terrain {
namespace {

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

/// Corners of up to four triangles from the eye, coordinate by coordinate, so that they are worked on side by side.
struct Batch {
  static constexpr size_t kLanes = 4;
  using Lanes = std::array<float, kLanes>;
  std::array<Lanes, 3> a{}, b{}, apex{};
  Lanes error{};
  std::array<uint32_t, kLanes> side{};
  size_t count = 0;
};

/// Squares of the distances from the eye to the batch's triangles.
Batch::Lanes distancesSquared(const Batch& t) {
  Batch::Lanes result;
  for (size_t l = 0; l < Batch::kLanes; ++l) {
    const float ax = t.a[0][l], ay = t.a[1][l], az = t.a[2][l];
    const float bx = t.b[0][l], by = t.b[1][l], bz = t.b[2][l];
    const float px = t.apex[0][l], py = t.apex[1][l], pz = t.apex[2][l];
    const float abx = bx - ax, aby = by - ay, abz = bz - az;
    const float bpx = px - bx, bpy = py - by, bpz = pz - bz;
    const float pax = ax - px, pay = ay - py, paz = az - pz;
    const float aa = ax * ax + ay * ay + az * az, bb = bx * bx + by * by + bz * bz, pp = px * px + py * py + pz * pz;
    const float ab = abx * abx + aby * aby + abz * abz, bp = bpx * bpx + bpy * bpy + bpz * bpz,
                pa = pax * pax + pay * pay + paz * paz;
    // The nearest points of the three edges; an edge without length is its end.
    const float toAb = -(ax * abx + ay * aby + az * abz), toBp = -(bx * bpx + by * bpy + bz * bpz),
                toPa = -(px * pax + py * pay + pz * paz);
    const float alongAb = toAb > 0 ? (toAb < ab ? toAb : ab) : 0, alongBp = toBp > 0 ? (toBp < bp ? toBp : bp) : 0,
                alongPa = toPa > 0 ? (toPa < pa ? toPa : pa) : 0;
    const float tiny = 1e-30F;
    const float tAb = alongAb / (ab + tiny), tBp = alongBp / (bp + tiny), tPa = alongPa / (pa + tiny);
    const float dAb = aa + tAb * (tAb * ab - 2 * toAb), dBp = bb + tBp * (tBp * bp - 2 * toBp),
                dPa = pp + tPa * (tPa * pa - 2 * toPa);
    float d = dAb < dBp ? dAb : dBp;
    d = d < dPa ? d : dPa;
    // The plane, where the eye is over the triangle's inside.
    const float nx = aby * bpz - abz * bpy, ny = abz * bpx - abx * bpz, nz = abx * bpy - aby * bpx;
    const float nn = nx * nx + ny * ny + nz * nz, na = nx * ax + ny * ay + nz * az;
    const float sideAb = nx * (ay * bz - az * by) + ny * (az * bx - ax * bz) + nz * (ax * by - ay * bx);
    const float sideBp = nx * (by * pz - bz * py) + ny * (bz * px - bx * pz) + nz * (bx * py - by * px);
    const float sidePa = nx * (py * az - pz * ay) + ny * (pz * ax - px * az) + nz * (px * ay - py * ax);
    float inside = sideAb < sideBp ? sideAb : sideBp;
    inside = inside < sidePa ? inside : sidePa;
    const float plane = na * na / (nn + tiny);
    d = inside > 0 ? plane : d;
    result[l] = d > 0 ? d : 0;
  }
  return result;
}

/// Bucket of a priority: the square of error / wanted error, in quarters of its octaves.
uint32_t bucketOf(float ratioSquared) {
  if (!(ratioSquared > 1)) return 0;
  const uint32_t quarter = (std::bit_cast<uint32_t>(ratioSquared) - std::bit_cast<uint32_t>(1.0F)) >> 21;
  return std::min(1 + quarter, kLastBucket);
}
/// The smallest squared ratio of a bucket ≥ 1.
float bucketFloor(uint32_t bucket) {
  return std::bit_cast<float>(((bucket - 1) << 21) + std::bit_cast<uint32_t>(1.0F));
}

/// A place p from the eye is inside where normal · p + distance ≥ 0.
struct Plane {
  float x = 0, y = 0, z = 0;  ///< unit normal
  float steepness = 0;        ///< |z|: how far moving up by 1 leads from the plane
  float distance = 0;
  bool operator==(const Plane&) const = default;
};

/// The eye as the mesh sees it.
struct Eye {
  bool perspective = false;
  glm::dvec3 position{0};  ///< x, y from the field's first sample; metres
  /// The position as a place in half samples and the rest of the way, and as a height and the rest, so that differences
  /// from near places are as good in float as in double.
  glm::ivec2 place{0};
  glm::vec2 rest{0};
  float height = 0, heightRest = 0;
  /// Squared ratio of a triangle's error to the wanted one: error² · scaleSquared / distance² (distance 1 without an
  /// eye).
  float scaleSquared = 0;
  float scale = 0;
  double pixelsPerRatio = 0;      ///< the error in pixels at which splits begin
  double wantedPixels = 0;        ///< at which they are complete
  float band = 1;                 ///< pixelsPerRatio / wantedPixels; 1: splits are complete at once
  std::array<Plane, 6> planes{};  ///< the four sides, near and far
  uint8_t allPlanes = 0;

  bool operator==(const Eye&) const = default;
};

constexpr double kFarthestPlace = 1 << 20;  // half samples; 32 times the largest field

Eye eyeOf(const city::ViewState& view, const RoamSettings& settings, const city::HeightField& field) {
  Eye eye;
  eye.perspective = true;
  eye.position = view.eye - glm::dvec3(field.origin, 0);
  const glm::dvec2 halves = 2.0 * glm::dvec2(eye.position) / field.spacing;
  eye.place = glm::ivec2(glm::clamp(halves, -kFarthestPlace, kFarthestPlace));
  eye.rest = glm::vec2(glm::dvec2(eye.position) - glm::dvec2(eye.place) * field.spacing / 2.0);
  eye.height = static_cast<float>(eye.position.z);
  eye.heightRest = static_cast<float>(eye.position.z - static_cast<double>(eye.height));
  eye.wantedPixels = settings.pixelError;
  eye.pixelsPerRatio = settings.pixelError * settings.morph;
  eye.band = static_cast<float>(settings.morph);
  const double scale = city::pixelsPerUnitSlope(view) / eye.pixelsPerRatio;
  eye.scaleSquared = static_cast<float>(scale * scale);
  eye.scale = static_cast<float>(scale);
  if (!settings.frustum) return eye;

  const double tanY = std::tan(view.verticalFov / 2), tanX = tanY * view.aspect();
  // Wider by 2⁻²⁰ of the distance: what rounding may move.
  constexpr double kSlack = 0x1p-20;
  uint32_t count = 0;
  const auto add = [&](const glm::dvec3& normal, double distance) {
    const glm::vec3 unit(glm::normalize(normal));
    eye.planes[count++] = {unit.x, unit.y, unit.z, std::abs(unit.z), static_cast<float>(distance)};
  };
  add(view.forward * (tanX + kSlack) + view.right, 0);
  add(view.forward * (tanX + kSlack) - view.right, 0);
  add(view.forward * (tanY + kSlack) + view.up, 0);
  add(view.forward * (tanY + kSlack) - view.up, 0);
  add(view.forward, -view.nearDistance * (1 - kSlack));
  if (std::isfinite(view.farDistance)) add(-view.forward, view.farDistance * (1 + kSlack));
  eye.allPlanes = static_cast<uint8_t>((1U << count) - 1);
  return eye;
}

}  // namespace

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
  void describe(Diamond& d, uint32_t s) const {
    Side& t = d.side[s];
    if (d.finest) {
      t.error = 0;
      t.ground = true;
    } else {
      const auto centre =
          static_cast<size_t>(d.centre.y >> 1) * static_cast<size_t>(columns) + static_cast<size_t>(d.centre.x >> 1);
      const ErrorCode code = table->codes[2 * centre + canonicalSide(s == 0 ? d.v() : -d.v())];
      t.error = decodeError(code);
      t.ground = code != kNoGround;
    }
    if (d.pressed || (d.finest && !table->filled.empty())) t.ground = t.ground && coversGround(d, s);
  }
  /// Whether a triangle has area and, where it is one of the finest, data at its corners.
  bool coversGround(const Diamond& d, uint32_t s) const {
    const auto corners = cornersOf(d, s);
    const glm::ivec2 a = sampleAt(corners[0]), b = sampleAt(corners[1]), p = sampleAt(corners[2]);
    if (d.finest && !(hasData(a) && hasData(b) && hasData(p))) return false;
    const glm::ivec2 ab = b - a, ap = p - a;
    return int64_t{ab.x} * ap.y != int64_t{ab.y} * ap.x;
  }

  bool reachesOut(const Diamond& d) const {
    const int reach = std::max(std::abs(d.u.x), std::abs(d.u.y));
    return d.centre.x + reach > lastHalf.x || d.centre.y + reach > lastHalf.y;
  }

  void makeRoots() {
    const glm::ivec2 corners = patches.count + 1;
    cornerSlots = static_cast<uint32_t>(corners.x * corners.y);
    const auto cornerSlot = [&](int x, int y) { return static_cast<uint32_t>(y * corners.x + x); };
    vertexHeights.resize(cornerSlots);
    mesh->vertices.resize(cornerSlots);
    for (int y = 0; y < corners.y; ++y)
      for (int x = 0; x < corners.x; ++x) placeVertex(cornerSlot(x, y), sampleAt(2 * patches.side * glm::ivec2(x, y)));
    diamonds.resize(roots);
    vertexHeights.resize(cornerSlots + roots);
    mesh->vertices.resize(cornerSlots + roots);
    for (int y = 0; y < patches.count.y; ++y)
      for (int x = 0; x < patches.count.x; ++x) {
        Diamond& d = diamonds[static_cast<size_t>(y * patches.count.x + x)];
        const int half = patches.side;
        d.centre = half * (2 * glm::ivec2(x, y) + 1);
        const bool rising = (x + y) % 2 == 0;
        d.u = rising ? glm::ivec2(half, half) : glm::ivec2(half, -half);
        d.finest = patches.side == 1;
        d.pressed = reachesOut(d);
        const uint32_t sw = cornerSlot(x, y), se = cornerSlot(x + 1, y), nw = cornerSlot(x, y + 1),
                       ne = cornerSlot(x + 1, y + 1);
        d.corner = rising ? std::array{ne, nw, sw, se} : std::array{se, ne, nw, sw};
        for (uint32_t s = 0; s < 2; ++s) {
          d.side[s].present = true;
          describe(d, s);
        }
      }
  }

  void placeVertex(uint32_t vertex, glm::ivec2 sample) {
    vertexHeights[vertex] = heightOf(sample);
    mesh->vertices[vertex] = {sample, vertexHeights[vertex]};
    touchedVertices.push_back(vertex);
  }

  // --- the index buffer ----------------------------------------------------------------------------------------------

  void putTriangle(uint32_t slot, uint32_t id) {
    Diamond& d = diamonds[id >> 1];
    d.side[id & 1].slot = slot;
    mesh->triangles[slot] = verticesOf(d, id & 1);
    drawn[slot].owner = id;
    if (drawn[slot].touched == mesh->revision) return;
    drawn[slot].touched = mesh->revision;
    touchedSlots.push_back(slot);
  }
  void draw(uint32_t id) {
    Diamond& d = diamonds[id >> 1];
    Side& t = d.side[id & 1];
    if (!t.ground) return;
    t.slot = static_cast<uint32_t>(drawn.size());
    visible += t.planes != kOutside;
    touchedSlots.push_back(t.slot);
    mesh->triangles.push_back(verticesOf(d, id & 1));
    drawn.push_back({id, mesh->revision});
  }
  void undraw(uint32_t id) {
    Side& t = side(id);
    if (t.slot == kNone) return;
    visible -= t.planes != kOutside;
    const auto last = static_cast<uint32_t>(drawn.size() - 1);
    if (t.slot != last) putTriangle(t.slot, drawn[last].owner);
    t.slot = kNone;
    drawn.pop_back();
    mesh->triangles.pop_back();
  }
  /// `to` is drawn in the place of `from`.
  void redraw(uint32_t from, uint32_t to) {
    Side &f = side(from), &t = side(to);
    if (f.slot == kNone || !t.ground) {
      undraw(from);
      draw(to);
      return;
    }
    visible -= f.planes != kOutside;
    visible += t.planes != kOutside;
    putTriangle(f.slot, to);
    f.slot = kNone;
  }

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
  void evaluate(Batch& batch) {
    Batch::Lanes distances{}, reaches{}, ratios{};
    if (eye.perspective)
      distances = distancesSquared(batch);
    else
      distances.fill(1);
    for (size_t l = 0; l < Batch::kLanes; ++l) {
      reaches[l] = batch.error[l] * batch.error[l] * eye.scaleSquared;
      ratios[l] = reaches[l] / distances[l];
      reaches[l] = std::sqrt(reaches[l]);
      distances[l] = std::sqrt(distances[l]);
    }
    for (size_t l = 0; l < batch.count; ++l) {
      const uint32_t id = batch.side[l];
      Side& t = side(id);
      setWeight(id, t, weightOf(reaches[l], distances[l]));
      const uint32_t bucket = bucketOf(ratios[l]);
      if (bucket != t.bucket) setBucket(id, t, bucket);
      ++t.stamp;
      if (eye.perspective) deferral.put(id, t.stamp, path, slackOf(ratios[l], bucket, distances[l], reaches[l]));
    }
    operations.evaluations += static_cast<uint32_t>(batch.count);
    batch.count = 0;
  }

  /// Metres that the eye can go before a triangle's bucket may change. `reach` is the distance at which it has just the
  /// wanted error.
  float slackOf(float ratioSquared, uint32_t bucket, float distance, float reach) const {
    if (bucket == 0) return distance - reach;
    if (eye.band < 1) {  // below the band it rests; within it, until the weight is a step on
      const float complete = reach * eye.band;
      const float step = kWeightStep * distance * distance * (1 - eye.band) / complete;
      return std::min(distance <= complete ? complete - distance : step, slackInOrder(ratioSquared, bucket, distance));
    }
    return std::min(reach - distance, slackInOrder(ratioSquared, bucket, distance));
  }
  float slackInOrder(float ratioSquared, uint32_t bucket, float distance) const {
    if (!ordered) return std::numeric_limits<float>::infinity();
    const float farther = distance * (std::sqrt(ratioSquared / bucketFloor(bucket)) - 1);
    if (bucket == kLastBucket) return farther;
    const float nearer = distance * (1 - std::sqrt(ratioSquared / bucketFloor(bucket + 1)));
    return std::min(farther, nearer);
  }

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
  void morph() {
    for (size_t i = 0; i < reweigh.size(); ++i) {
      const uint32_t d = reweigh[i];
      if (!diamonds[d].split) continue;
      const float weight = eye.band < 1 ? weightNeeded(d) : 1;
      if (weight == diamonds[d].weight) continue;
      diamonds[d].weight = weight;
      for (const uint32_t parent : diamonds[d].parent)
        if (parent != kNone) reweigh.push_back(parent);
      group.clear();
      group.push_back(d);
      while (!group.empty()) {  // a centre's height moves those of the splits around it
        const uint32_t at = group.back();
        group.pop_back();
        if (diamonds[at].marked) continue;
        diamonds[at].marked = true;
        work.push_back(at);
        for (const uint32_t child : diamonds[at].child)
          if (child != kNone && diamonds[child].split && !diamonds[child].marked) group.push_back(child);
      }
    }
    reweigh.clear();
    for (const uint32_t d : work) {
      diamonds[d].marked = false;
      const float height = morphedHeight(d);
      RoamMesh::Vertex& vertex = mesh->vertices[vertexOf(d)];
      if (height == vertex.height) continue;
      vertex.height = height;
      touchedVertices.push_back(vertexOf(d));
      ++operations.morphs;
    }
    work.clear();
  }
  float weightNeeded(uint32_t d) const {
    const Diamond& here = diamonds[d];
    if (here.pressed) return 1;  // its triangles' places in samples are not halved where they are pressed together
    float weight = 0;
    for (const Side& t : here.side)
      if (t.present) weight = std::max(weight, t.weight);
    if (here.splitChildren > 0)
      for (const uint32_t child : here.child)
        if (child != kNone && diamonds[child].split) weight = std::max(weight, diamonds[child].weight);
    return weight;
  }

  /// Mean height of the meshes of u = 0 … 1 at a diamond's centre. Up from it, each triangle is the one around it
  /// in the meshes of u between its own weight and the weight of the split that made it.
  float morphedHeight(uint32_t d) const {
    const Diamond& here = diamonds[d];
    const float own = vertexHeights[vertexOf(d)];
    float below = here.weight;
    if (below >= 1) return own;
    float height = below * own;
    uint32_t id = 2 * d + (here.side[0].present ? 0U : 1U);
    while (below < 1) {
      const uint32_t parent = diamonds[id >> 1].parent[id & 1];
      const float above = parent == kNone ? 1 : std::max(diamonds[parent].weight, below);
      if (above > below) height += (above - below) * heightInTriangle(id, here.centre);
      below = above;
      if (parent == kNone) break;
      id = 2 * parent + (side(id).childIndex >> 1);
    }
    return height;
  }
  /// How far the farthest corner of a triangle is from its own height.
  float displacement(uint32_t id) const {
    float most = 0;
    for (const uint32_t v : verticesOf(diamonds[id >> 1], id & 1))
      most = std::max(most, std::abs(mesh->vertices[v].height - vertexHeights[v]));
    return most;
  }
  /// Height of a triangle's plane, corners at their own heights, at a place in half samples.
  float heightInTriangle(uint32_t id, glm::ivec2 at) const {
    const Diamond& d = diamonds[id >> 1];
    const auto places = cornersOf(d, id & 1);
    const auto vertices = verticesOf(d, id & 1);
    const float za = vertexHeights[vertices[0]], zb = vertexHeights[vertices[1]], zp = vertexHeights[vertices[2]];
    const glm::vec2 ab(places[1] - places[0]), fromMiddle(at - d.centre), up(places[2] - d.centre);
    const float along = glm::dot(fromMiddle, ab) / glm::dot(ab, ab), rise = glm::dot(fromMiddle, up) / glm::dot(up, up);
    const float middle = (za + zb) / 2;
    return middle + along * (zb - za) + rise * (zp - middle);
  }

  /// A side that needs no look until its place in the frustum changes.
  bool idle(const Side& t) const { return t.error == 0 || t.planes == kOutside; }

  /// Brings a side's priority up to date.
  void look(Batch& batch, uint32_t id) {
    Side& t = side(id);
    if (idle(t)) {
      ++t.stamp;
      setWeight(id, t, 0);
      if (t.bucket != 0) setBucket(id, t, 0);
      return;
    }
    addToBatch(batch, id);
    if (batch.count == Batch::kLanes) evaluate(batch);
  }

  void lookAtAll() {
    deferral.clear();
    Batch batch;
    for (uint32_t d = 0; d < diamonds.size(); ++d)
      for (uint32_t s = 0; s < 2; ++s)
        if (diamonds[d].side[s].present) look(batch, 2 * d + s);
    evaluate(batch);
  }

  void lookAtDue() {
    Batch batch;
    deferral.takeDue(path, [&](const Deferral::Entry& due) {
      const Side& t = side(due.item);
      if (!t.present || t.stamp != due.stamp) return;
      look(batch, due.item);
    });
    evaluate(batch);
  }

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
  uint8_t planesCrossed(uint8_t mask, uint32_t id) {
    const Diamond& d = diamonds[id >> 1];
    const auto places = cornersOf(d, id & 1);
    const auto vertices = verticesOf(d, id & 1);
    return planesCrossed(mask, d.side[id & 1].error, fromEye(places[0], vertices[0]), fromEye(places[1], vertices[1]),
                         fromEye(places[2], vertices[2]));
  }
  /// What the children of a side begin with. Those of a pressed one may reach out of it.
  uint8_t inherited(const Diamond& d, uint32_t s) const { return d.pressed ? eye.allPlanes : d.side[s].planes; }

  /// Carries the frustum down the trees. Triangles that stay wholly inside or outside end the descent.
  void carryFrustumDown() {
    struct Visit {
      uint32_t id;
      uint8_t planes;
    };
    std::vector<Visit> stack;
    Batch batch;
    for (uint32_t id = 0; id < 2 * roots; ++id) stack.push_back({id, eye.allPlanes});
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      const Diamond& d = diamonds[visit.id >> 1];
      const uint32_t s = visit.id & 1;
      Side& t = side(visit.id);
      const uint8_t before = t.planes;
      t.planes = visit.planes == 0 || visit.planes == kOutside ? visit.planes : planesCrossed(visit.planes, visit.id);
      if (t.planes == before && (before == 0 || before == kOutside) && !d.pressed) continue;
      if ((t.planes == kOutside) != (before == kOutside)) {
        if (t.slot != kNone) visible += t.planes != kOutside ? 1U : 0xffffffffU;
        look(batch, visit.id);
      }
      if (!d.split) continue;
      for (uint32_t k = 2 * s; k < 2 * s + 2; ++k)
        stack.push_back({2 * d.child[k] + sideToward(d.child[k], visit.id >> 1), inherited(d, s)});
    }
    evaluate(batch);
  }

  // --- splits and merges ---------------------------------------------------------------------------------------------

  uint32_t sideToward(uint32_t child, uint32_t parent) const { return diamonds[child].parent[0] == parent ? 0 : 1; }

  struct Neighbour {
    uint32_t diamond = kNone;
    uint32_t edge = 0;  ///< which of its edges is the shared one
  };
  /// The diamond of the same level beyond edge k; none at the field's edge. The side with that edge must be present.
  Neighbour across(uint32_t d, uint32_t k) const {
    const Diamond& here = diamonds[d];
    if (isRoot(d)) return acrossPatches(here, k);
    // Both are children of the diamond at the apex, one after the other around it.
    const uint32_t s = k >> 1;
    const bool next = (k & 1) == 0;
    const uint32_t parent = here.parent[s];
    const uint32_t index = (here.side[s].childIndex + (next ? 1U : 3U)) & 3;
    const uint32_t there = diamonds[parent].child[index];
    if (there == kNone) return {};
    return {there, 2 * sideToward(there, parent) + (next ? 1U : 0U)};
  }
  Neighbour acrossPatches(const Diamond& here, uint32_t k) const {
    const glm::ivec2 offset = here.childOffset(k);
    const glm::ivec2 patch = here.centre / (2 * patches.side) + glm::sign(offset);
    if (patch.x < 0 || patch.y < 0 || patch.x >= patches.count.x || patch.y >= patches.count.y) return {};
    const auto there = static_cast<uint32_t>(patch.y * patches.count.x + patch.x);
    for (uint32_t edge = 0; edge < 4; ++edge)
      if (diamonds[there].childOffset(edge) == -offset) return {there, edge};
    return {};
  }

  /// The parent that has yet to be split for a side to be there; none at the field's edge.
  Neighbour missingParent(const Diamond& d, uint32_t s) const {
    return across(d.parent[1 - s], d.side[1 - s].childIndex);
  }

  void makeRoom() {
    while (freeDiamonds.size() < 4) {
      freeDiamonds.push_back(static_cast<uint32_t>(diamonds.size()));
      diamonds.emplace_back();
      vertexHeights.push_back(0);
      mesh->vertices.emplace_back();
    }
  }

  /// Splits a diamond, and before it whatever must be split to keep the mesh free of cracks.
  void forceSplit(uint32_t d, uint8_t reason) {
    for (uint32_t s = 0; s < 2; ++s) {
      if (diamonds[d].side[s].present) continue;
      const Neighbour parent = missingParent(diamonds[d], s);
      if (parent.diamond != kNone) forceSplit(parent.diamond, static_cast<uint8_t>(kBecauseOfChild + parent.edge));
    }
    split(d);
    diamonds[d].reason = reason;
  }

  void split(uint32_t d) {
    makeRoom();
    Diamond& here = diamonds[d];
    assert(!here.split && !here.finest);
    here.split = true;
    here.weight = eye.band < 1 ? -1.0F : 1.0F;  // not yet worked out
    if (eye.band < 1) reweigh.push_back(d);
    for (const uint32_t parent : here.parent)
      if (parent != kNone) ++diamonds[parent].splitChildren;

    const uint32_t vertex = vertexOf(d);
    placeVertex(vertex, sampleAt(here.centre));
    const Around around = aroundCentre(here, vertex);
    Batch batch;
    for (uint32_t s = 0; s < 2; ++s) {
      if (!here.side[s].present) continue;
      ++operations.splits;
      const uint8_t mask = inherited(here, s);
      for (uint32_t k = 2 * s; k < 2 * s + 2; ++k) {
        const uint32_t id = makeChild(d, k);
        Diamond& child = diamonds[id >> 1];
        Side& t = child.side[id & 1];
        describe(child, id & 1);
        t.planes = mask == 0 || mask == kOutside ? mask : planesCrossed(mask, id);
        if (k == 2 * s)
          redraw(2 * d + s, id);
        else
          draw(id);
        if (!idle(t) && !settle(id, t, around)) addToBatch(batch, id);
      }
    }
    if (batch.count > 0) evaluate(batch);
  }

  /// How far from the eye the four triangles around a diamond's centre are: the centre belongs to each of them, and all
  /// lie within the distance of its farthest corner.
  struct Around {
    float least = 0, centre = 0;  ///< metres
  };
  Around aroundCentre(const Diamond& d, uint32_t vertex) const {
    const glm::vec3 c = fromEye(d.centre, vertex);
    const float distance = std::sqrt(c.x * c.x + c.y * c.y + c.z * c.z);
    const float ux = static_cast<float>(d.u.x), uy = static_cast<float>(d.u.y);
    const float xx = halfStep.x * halfStep.x, yy = halfStep.y * halfStep.y;
    const float level = std::max(ux * ux * xx + uy * uy * yy, uy * uy * xx + ux * ux * yy);
    const float height = vertexHeights[vertex];
    float rise = 0;
    for (uint32_t k = 0; k < 4; ++k)
      if (d.side[0].present || k != 1) rise = std::max(rise, std::abs(vertexHeights[d.corner[k]] - height));
    return {distance - std::sqrt(level + rise * rise), distance};
  }
  /// Gives a new side its bucket where the distances around it settle that; false where only its own distance does.
  bool settle(uint32_t id, Side& t, const Around& around) {
    const float reach = t.error * eye.scale;
    if (!eye.perspective) return false;
    if (reach < around.least) {
      ++t.stamp;
      deferral.put(id, t.stamp, path, around.least - reach);
    } else if (reach * eye.band > around.centre && !ordered) {
      setWeight(id, t, 1);
      const float ratio = reach / around.centre;
      setBucket(id, t, std::max(1U, bucketOf(ratio * ratio)));
      ++t.stamp;
      deferral.put(id, t.stamp, path, reach * eye.band - around.centre);
    } else {
      return false;
    }
    ++operations.evaluations;
    return true;
  }

  /// Puts the triangle over edge k of a split diamond into the tree.
  uint32_t makeChild(uint32_t d, uint32_t k) {
    Diamond& here = diamonds[d];
    const Neighbour beyond = across(d, k);
    uint32_t m = kNone, s = 0;
    if (beyond.diamond != kNone && diamonds[beyond.diamond].split) {
      m = diamonds[beyond.diamond].child[beyond.edge];
      s = diamonds[m].side[0].present ? 1 : 0;
    } else {
      m = freeDiamonds.back();
      freeDiamonds.pop_back();
      Diamond& fresh = diamonds[m];
      const glm::ivec2 offset = here.childOffset(k);
      fresh.centre = here.centre + offset;
      fresh.u = {-offset.y, offset.x};  // so that v leads back to this diamond's centre: its apex is p0
      fresh.corner[0] = here.corner[(k + 1) & 3];
      fresh.corner[2] = here.corner[k];
      fresh.finest = (fresh.centre.x & 1) != 0;
      fresh.pressed = reachesOut(fresh);
      fresh.reason = kNoReason;
    }
    Diamond& child = diamonds[m];
    here.child[k] = m;
    child.parent[s] = d;
    child.corner[s == 0 ? 1 : 3] = vertexOf(d);
    Side& t = child.side[s];
    t.present = true;
    t.wanted = false;
    t.bucket = 0;
    t.weight = 0;
    t.slot = kNone;
    t.childIndex = static_cast<uint8_t>(k);
    return 2 * m + s;
  }

  void merge(uint32_t d) {
    Diamond& here = diamonds[d];
    assert(here.split && here.splitChildren == 0);
    here.split = false;
    here.reason = kNoReason;
    for (const uint32_t parent : here.parent)
      if (parent != kNone) {
        --diamonds[parent].splitChildren;
        if (eye.band < 1) reweigh.push_back(parent);
      }
    for (uint32_t s = 0; s < 2; ++s) {
      if (!here.side[s].present) continue;
      ++operations.merges;
      for (uint32_t k = 2 * s; k < 2 * s + 2; ++k) {
        const uint32_t m = here.child[k];
        Diamond& child = diamonds[m];
        const uint32_t id = 2 * m + sideToward(m, d);
        Side& t = side(id);
        if (k == 2 * s)
          redraw(id, 2 * d + s);
        else
          undraw(id);
        takeFromQueue(id, t);
        t.bucket = 0;
        t.present = false;
        ++t.stamp;
        child.parent[id & 1] = kNone;
        if (!child.side[1 - (id & 1)].present) freeDiamonds.push_back(m);
        here.child[k] = kNone;
      }
      if (here.side[s].wanted) unwant(2 * d + s);
    }
  }

  void unwant(uint32_t id) {
    Side& t = side(id);
    takeFromQueue(id, t);
    t.wanted = false;
    putInQueue(id, t);
  }

  /// Takes a side from the split queue to the merge queue and sees to it that its diamond is split.
  void want(uint32_t id) {
    Side& t = side(id);
    takeFromQueue(id, t);
    t.wanted = true;
    putInQueue(id, t);
    const uint32_t d = id >> 1;
    if (!diamonds[d].split)
      forceSplit(d, static_cast<uint8_t>(id & 1));
    else if (diamonds[d].reason >= kBecauseOfChild && !restsOn(diamonds[d].parent[id & 1], d))
      diamonds[d].reason = static_cast<uint8_t>(id & 1);
  }

  /// Takes a side from the merge queue; what was split only because of it is merged.
  void release(uint32_t id) {
    unwant(id);
    if (diamonds[id >> 1].reason == (id & 1)) reground(id >> 1);
  }

  /// The diamond that a split diamond's reason is; none for the patches themselves.
  uint32_t reasonOf(const Diamond& d) const {
    return d.reason < kBecauseOfChild ? d.parent[d.reason] : d.child[d.reason - kBecauseOfChild];
  }
  /// Whether d's chain of reasons passes through `through`.
  bool restsOn(uint32_t d, uint32_t through) const {
    if (!isReason(through)) return false;
    while (d != kNone && d != through) d = reasonOf(diamonds[d]);
    return d == through && d != kNone;
  }

  /// A side that wants the split of a diamond without split children and does not rest on it, or kNoReason.
  uint8_t otherSide(uint32_t d) const {
    for (uint8_t s = 0; s < 2; ++s)
      if (diamonds[d].side[s].wanted && !restsOn(diamonds[d].parent[s], d)) return s;
    return kNoReason;
  }
  /// Merges a diamond that nothing needs; parents that were split for it lose their reason.
  void mergeWithParents(uint32_t d) {
    const std::array<uint32_t, 2> parents = diamonds[d].parent;
    std::array<bool, 2> rests{};
    for (size_t s = 0; s < 2; ++s)
      rests[s] = parents[s] != kNone && diamonds[parents[s]].reason == kBecauseOfChild + diamonds[d].side[s].childIndex;
    merge(d);
    for (size_t s = 0; s < 2; ++s)
      if (rests[s]) reground(parents[s]);
  }

  /// Whether anything rests directly on a diamond.
  bool isReason(uint32_t d) const {
    const Diamond& here = diamonds[d];
    for (uint32_t s = 0; s < 2; ++s)
      if (here.parent[s] != kNone && diamonds[here.parent[s]].reason == kBecauseOfChild + here.side[s].childIndex)
        return true;
    if (here.splitChildren > 0)
      for (const uint32_t child : here.child)
        if (child != kNone && diamonds[child].split && diamonds[child].reason == sideToward(child, d)) return true;
    return false;
  }

  void mark(uint32_t d) {
    diamonds[d].marked = true;
    group.push_back(d);
  }
  void unmark(uint32_t d, uint8_t reason) {
    diamonds[d].marked = false;
    diamonds[d].reason = reason;
    work.push_back(d);
  }

  /// A reason outside the marked diamonds, or kNoReason.
  uint8_t reasonOutside(const Diamond& d) const {
    for (uint8_t s = 0; s < 2; ++s)
      if (d.side[s].wanted && (d.parent[s] == kNone || !diamonds[d.parent[s]].marked)) return s;
    for (uint8_t k = 0; k < 4; ++k)
      if (d.child[k] != kNone && diamonds[d.child[k]].split && !diamonds[d.child[k]].marked)
        return static_cast<uint8_t>(kBecauseOfChild + k);
    return kNoReason;
  }

  /// A diamond has lost its reason. All that rest on it look for another one; those that find none are merged.
  ///
  /// Reasons lead from a patch down to a diamond (a triangle that must be split) or up (a child's split needs it), so
  /// what must be split is what a patch reaches. This keeps a tree of those ways: the part of it that hangs on the lost
  /// reason is cut off, tied on again wherever another way leads into it, and the rest has none.
  void reground(uint32_t lost) {
    if (diamonds[lost].splitChildren == 0) {
      if (const uint8_t reason = otherSide(lost); reason != kNoReason)
        diamonds[lost].reason = reason;
      else
        mergeWithParents(lost);
      return;
    }
    group.clear();
    work.clear();
    mark(lost);
    for (size_t i = 0; i < group.size(); ++i) {
      const Diamond& d = diamonds[group[i]];
      for (const uint32_t child : d.child)
        if (child != kNone && restsDirectlyOn(child, group[i])) mark(child);
      for (const uint32_t parent : d.parent)
        if (parent != kNone && restsDirectlyOn(parent, group[i])) mark(parent);
    }
    for (const uint32_t d : group)
      if (const uint8_t reason = reasonOutside(diamonds[d]); reason != kNoReason) unmark(d, reason);
    while (!work.empty()) {
      const uint32_t d = work.back();
      work.pop_back();
      for (uint32_t s = 0; s < 2; ++s) {
        const uint32_t parent = diamonds[d].parent[s];
        if (parent != kNone && diamonds[parent].marked)
          unmark(parent, static_cast<uint8_t>(kBecauseOfChild + diamonds[d].side[s].childIndex));
      }
      for (const uint32_t child : diamonds[d].child) {
        if (child == kNone || !diamonds[child].marked) continue;
        const uint32_t s = sideToward(child, d);
        if (diamonds[child].side[s].wanted) unmark(child, static_cast<uint8_t>(s));
      }
    }
    std::erase_if(group, [&](uint32_t d) { return !diamonds[d].marked; });
    const auto size = [&](uint32_t d) { return std::abs(diamonds[d].u.x) + std::abs(diamonds[d].u.y); };
    const auto extent = [&](uint32_t d) {  // grows with each level up: squares of side 2h lie over edges of length 2h
      return std::max(std::abs(diamonds[d].u.x), std::abs(diamonds[d].u.y)) * 4 + size(d);
    };
    if (group.size() > 1)
      std::sort(group.begin(), group.end(), [&](uint32_t x, uint32_t y) { return extent(x) < extent(y); });
    for (const uint32_t d : group) {
      diamonds[d].marked = false;
      merge(d);
    }
  }
  bool restsDirectlyOn(uint32_t d, uint32_t reason) const {
    const Diamond& diamond = diamonds[d];
    return diamond.split && !diamond.marked && reasonOf(diamond) == reason;
  }

  // --- a frame -------------------------------------------------------------------------------------------------------

  RoamFrame run(const Eye& next, uint32_t budget, double milliseconds) {
    operations = {};
    ++mesh->revision;
    if (started) touchedVertices.clear();  // the corners' places belong to the first frame
    touchedSlots.clear();
    RoamFrame result;
    result.stoppedBy = StoppedBy::Error;
    result.pixelError = next.wantedPixels;
    if (!patches.empty()) {
      turnTo(next, budget);
      result.stoppedBy = refineAndCoarsen(budget, milliseconds);
      if (result.stoppedBy != StoppedBy::Error)
        result.pixelError = std::max(next.wantedPixels, largestRatio() * next.pixelsPerRatio);
      work.clear();
      morph();
    }
    statedPixels = result.pixelError;
    finish(result);
    return result;
  }

  /// Brings frustum and priorities to the new eye.
  void turnTo(const Eye& next, uint32_t budget) {
    const Eye before = std::exchange(eye, next);
    const bool first = !started;
    if (first) start();
    if (!first && before == next && ordered == mayBind(budget)) return;
    if (before.planes != next.planes || before.position != next.position || first) carryFrustumDown();
    const bool rescaled =
        before.scaleSquared != next.scaleSquared || before.perspective != next.perspective || before.band != next.band;
    if (before.band != next.band)
      for (uint32_t d = 0; d < diamonds.size(); ++d)
        if (diamonds[d].split) reweigh.push_back(d);
    const bool wasOrdered = std::exchange(ordered, first || mayBind(budget));
    const bool reordered = ordered && !wasOrdered;
    if (next.perspective && before.perspective) path += glm::length(next.position - before.position);
    if (first || rescaled || reordered)
      lookAtAll();
    else
      lookAtDue();
    if (deferral.size() > 8 * diamonds.size() + 4096)
      deferral.purge([&](const Deferral::Entry& e) { return side(e.item).present && side(e.item).stamp == e.stamp; });
  }
  bool mayBind(uint32_t budget) const { return drawn.size() > (ordered ? budget / 2 : budget - budget / 4); }

  void start() {
    started = true;
    for (uint32_t id = 0; id < 2 * roots; ++id) draw(id);
  }

  /// Splits for a side unless that takes more triangles than the budget has.
  bool fits(uint32_t id, uint32_t budget) {
    want(id);
    if (drawn.size() <= budget) return true;
    release(id);
    return false;
  }

  StoppedBy refineAndCoarsen(uint32_t budget, double milliseconds) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    const bool timed = std::isfinite(milliseconds);
    uint32_t steps = 0;
    const auto late = [&] {
      return timed && (++steps & 15) == 0 &&
             std::chrono::duration<double, std::milli>(Clock::now() - begin).count() >= milliseconds;
    };

    // Coarsen: bucket 0 holds the sides that no longer need their split.
    while (!standing.empty() && standing.lowest() == 0) {
      if (late()) return StoppedBy::Time;
      release(standing.first(0));
    }
    // Refine from the worst down. At the budget the least needed splits make room for more needed ones; what has been
    // given up is not taken back in this frame, so it ends.
    uint32_t least = 1;
    while (true) {
      if (late()) return StoppedBy::Time;
      const bool over = drawn.size() > budget;
      const bool pending = !wanting.empty() && wanting.highest() >= least;
      if (!over && !pending) break;
      const uint32_t worst = pending ? wanting.highest() : 0;
      const uint32_t id = pending ? wanting.first(worst) : 0;
      if (!over && fits(id, budget)) continue;
      if (!ordered) {  // from here on the order counts
        ordered = true;
        lookAtAll();
        continue;
      }
      const bool canRelease = !standing.empty() && (over || standing.lowest() < worst);
      if (!canRelease) break;
      const uint32_t lowest = standing.lowest();
      least = std::max(least, lowest + 1);
      release(standing.first(lowest));
    }
    return drawn.size() > budget || !wanting.empty() ? StoppedBy::Budget : StoppedBy::Error;
  }

  /// Largest ratio of error to wanted error of what is drawn, where that is more than 1.
  double largestRatio() const {
    double largest = 1;
    // What waits in the split queue but is split already is not drawn, so lower buckets may hold the largest; and where
    // priorities are not kept to their bucket, any may.
    for (uint32_t bucket = wanting.empty() ? 0 : wanting.highest(); bucket > 0; --bucket) {
      if (ordered && largest > 1) break;
      Batch batch;
      for (uint32_t id = wanting.first(bucket), next = 0; id != BucketQueue::kEnd; id = next) {
        next = side(id).queue.next;
        if (!diamonds[id >> 1].split) addToBatch(batch, id);
        if (batch.count < Batch::kLanes && next != BucketQueue::kEnd) continue;
        const Batch::Lanes ratios = ratiosOf(batch);
        for (size_t l = 0; l < batch.count; ++l) largest = std::max(largest, static_cast<double>(ratios[l]));
        batch.count = 0;
      }
    }
    return largest;
  }
  Batch::Lanes ratiosOf(const Batch& batch) const {
    Batch::Lanes ratios{};
    if (eye.perspective)
      ratios = distancesSquared(batch);
    else
      ratios.fill(1);
    for (size_t l = 0; l < batch.count; ++l) ratios[l] = batch.error[l] * std::sqrt(eye.scaleSquared / ratios[l]);
    return ratios;
  }

  // --- what the mesh says --------------------------------------------------------------------------------------------

  /// Height at a place in samples, among the triangles of sides first … first + count − 1 of a diamond or, where it is
  /// split, its children over the same edges.
  std::optional<double> heightWithin(uint32_t d, uint32_t first, uint32_t count, const glm::dvec2& at) const {
    const Diamond* here = &diamonds[d];
    while (true) {
      // Of triangles around one point, that which has the place farthest inside.
      std::optional<uint32_t> best;
      double most = 0;
      glm::dvec3 bestWeights(0);
      const auto consider = [&](uint32_t id) {
        const glm::dvec3 weights = weightsIn(id, at);
        const double least = std::min({weights.x, weights.y, weights.z});
        if (best && !(least > most)) return;
        best = id, most = least, bestWeights = weights;
      };
      if (here->split)
        for (uint32_t k = 0; k < 4; ++k) {
          if (here->child[k] != kNone) consider(2 * here->child[k] + sideToward(here->child[k], d));
        }
      else
        for (uint32_t s = first; s < first + count; ++s) consider(2 * d + s);
      if (!best) return std::nullopt;
      if (here->split) {
        d = *best >> 1, first = *best & 1, count = 1;
        here = &diamonds[d];
        if (here->split) continue;
      }
      if (!side(*best).ground) return std::nullopt;
      const auto vertices = verticesOf(diamonds[*best >> 1], *best & 1);
      double height = 0;
      for (int i = 0; i < 3; ++i)
        height += bestWeights[i] * static_cast<double>(mesh->vertices[vertices[static_cast<size_t>(i)]].height);
      return height;
    }
  }
  /// Barycentric weights of a place; far below 0 for a triangle without area.
  glm::dvec3 weightsIn(uint32_t id, const glm::dvec2& at) const {
    const auto places = cornersOf(diamonds[id >> 1], id & 1);
    const glm::dvec2 a(sampleAt(places[0])), b(sampleAt(places[1])), p(sampleAt(places[2]));
    const auto cross = [](const glm::dvec2& u, const glm::dvec2& v) { return u.x * v.y - u.y * v.x; };
    const double area = cross(b - a, p - a);
    if (area == 0) return glm::dvec3(-1e300);
    return glm::dvec3(cross(b - at, p - at), cross(p - at, a - at), cross(a - at, b - at)) / area;
  }

  std::string broken() const {
    const auto name = [](uint32_t id) {
      return "side " + std::to_string(id & 1) + " of diamond " + std::to_string(id >> 1);
    };
    size_t leaves = 0, inQueues = 0, inFrustum = 0;
    for (uint32_t d = 0; d < diamonds.size(); ++d) {
      const Diamond& here = diamonds[d];
      if (here.marked) return "diamond " + std::to_string(d) + " is still marked";
      if (here.split && started) {
        const float needed = eye.band < 1 ? weightNeeded(d) : 1;
        if (here.weight != needed) return "diamond " + std::to_string(d) + " has another weight than it needs";
        if (mesh->vertices[vertexOf(d)].height != morphedHeight(d))
          return "the centre of diamond " + std::to_string(d) + " is not at its height";
      }
      uint32_t splitChildren = 0;
      for (uint32_t k = 0; k < 4; ++k) {
        if (here.child[k] == kNone) continue;
        if (!here.split) return "diamond " + std::to_string(d) + " is not split and has a child";
        splitChildren += diamonds[here.child[k]].split;
        const Side& t = side(2 * here.child[k] + sideToward(here.child[k], d));
        if (!t.present || t.childIndex != k) return "a child of diamond " + std::to_string(d) + " does not lead back";
      }
      if (splitChildren != here.splitChildren) return "diamond " + std::to_string(d) + " miscounts its split children";
      for (uint32_t s = 0; s < 2; ++s) {
        const uint32_t id = 2 * d + s;
        const Side& t = here.side[s];
        if (!t.present) {
          if (here.split && missingParent(here, s).diamond != kNone) return name(id) + " is missing under a split";
          continue;
        }
        if (!isRoot(d) && (here.parent[s] == kNone || !diamonds[here.parent[s]].split))
          return name(id) + " has no split parent";
        if (t.wanted && !here.split) return name(id) + " is wanted and not split";
        const bool leaf = started && !here.split && t.ground;
        if (leaf != (t.slot != kNone)) return name(id) + (leaf ? " is not drawn" : " is drawn");
        leaves += leaf;
        inFrustum += leaf && t.planes != kOutside;
        if (leaf && drawn[t.slot].owner != id) return name(id) + " does not own its slot";
        if (leaf && mesh->triangles[t.slot] != verticesOf(here, s)) return name(id) + " has other vertices in its slot";
        inQueues += t.wanted || t.bucket > 0;
      }
      if (!here.split) continue;
      if (here.reason < kBecauseOfChild ? !here.side[here.reason].wanted
                                        : here.child[here.reason - kBecauseOfChild] == kNone ||
                                              !diamonds[here.child[here.reason - kBecauseOfChild]].split)
        return "diamond " + std::to_string(d) + " is split for a reason that does not hold";
      size_t steps = 0;
      for (uint32_t at = d; at != kNone; at = reasonOf(diamonds[at]))
        if (++steps > diamonds.size()) return "diamond " + std::to_string(d) + " rests on itself";
    }
    size_t queued = 0;
    for (uint32_t b = 0; b < 256; ++b)
      for (const bool wanted : {false, true})
        for (uint32_t id = (wanted ? standing : wanting).first(b); id != BucketQueue::kEnd; id = side(id).queue.next) {
          if (++queued > inQueues || !side(id).present || side(id).wanted != wanted || side(id).bucket != b)
            return name(id) + " is in a queue that it does not belong to";
        }
    if (queued != inQueues) return "the queues hold sides that are gone";
    if (leaves != drawn.size() || leaves != mesh->triangles.size())
      return "the index buffer holds triangles that are gone";
    if (inFrustum != visible) return "triangles in the frustum are miscounted";
    return {};
  }

  void finish(RoamFrame& result) {
    result.mesh = mesh;
    result.revision = mesh->revision;
    result.triangleCount = static_cast<uint32_t>(drawn.size());
    result.trianglesInFrustum = visible;
    result.operations = operations;
    std::sort(touchedVertices.begin(), touchedVertices.end());
    touchedVertices.erase(std::unique(touchedVertices.begin(), touchedVertices.end()), touchedVertices.end());
    result.changedVertices = touchedVertices;
    result.changedTriangles.reserve(touchedSlots.size());
    std::sort(touchedSlots.begin(), touchedSlots.end());
    for (const uint32_t slot : touchedSlots)
      if (slot < drawn.size() && (result.changedTriangles.empty() || result.changedTriangles.back() != slot))
        result.changedTriangles.push_back(slot);
  }
};

Roam::Roam(const city::HeightField& field, const ErrorTable& errors) : impl_(std::make_unique<Impl>(field, errors)) {}
Roam::~Roam() = default;
Roam::Roam(const Roam& other) : impl_(std::make_unique<Impl>(*other.impl_)) {
  impl_->mesh = std::make_shared<RoamMesh>(*impl_->mesh);
}
Roam& Roam::operator=(const Roam& other) {
  if (this != &other) *this = Roam(other);
  return *this;
}
Roam::Roam(Roam&&) noexcept = default;
Roam& Roam::operator=(Roam&&) noexcept = default;

RoamFrame Roam::update(const city::ViewState& view, const RoamSettings& settings) {
  assert(settings.pixelError > 0 && "the wanted error is above 0 pixels");
  assert(settings.morph > 0 && settings.morph <= 1 && "splits begin between no error and the wanted one");
  const bool finite = std::isfinite(view.eye.x) && std::isfinite(view.eye.y) && std::isfinite(view.eye.z);
  const Eye next = finite || !impl_->started ? eyeOf(view, settings, *impl_->field) : impl_->eye;
  return impl_->run(next, settings.budget, settings.milliseconds);
}

RoamFrame Roam::refine(double metres, uint32_t budget) {
  assert(metres > 0 && "the wanted error is above 0 metres");
  Eye eye;
  eye.scaleSquared = static_cast<float>(1 / (metres * metres));
  eye.scale = static_cast<float>(1 / metres);
  return impl_->run(eye, budget, std::numeric_limits<double>::infinity());
}

RoamErrors Roam::errors() const {
  const Impl& roam = *impl_;
  RoamErrors errors;
  double area = 0, metresSquared = 0, pixelsSquared = 0;
  Batch batch;
  for (size_t i = 0; i < roam.drawn.size(); ++i) {
    const uint32_t id = roam.drawn[i].owner;
    if (roam.side(id).planes != kOutside) {
      roam.addToBatch(batch, id);
      batch.error[batch.count - 1] += roam.displacement(id);
    }
    if (batch.count < Batch::kLanes && i + 1 < roam.drawn.size()) continue;
    const Batch::Lanes ratios = roam.ratiosOf(batch);
    for (size_t l = 0; l < batch.count; ++l) {
      const auto metres = static_cast<double>(batch.error[l]);
      const double pixels =
          metres > 0 ? std::min(static_cast<double>(ratios[l]) * roam.eye.pixelsPerRatio, roam.statedPixels) : 0;
      const double abx = static_cast<double>(batch.b[0][l] - batch.a[0][l]),
                   aby = static_cast<double>(batch.b[1][l] - batch.a[1][l]);
      const double apx = static_cast<double>(batch.apex[0][l] - batch.a[0][l]),
                   apy = static_cast<double>(batch.apex[1][l] - batch.a[1][l]);
      const double weight = std::abs(abx * apy - aby * apx);
      area += weight;
      metresSquared += weight * metres * metres;
      pixelsSquared += weight * pixels * pixels;
      errors.largestMetres = std::max(errors.largestMetres, metres);
      errors.largestPixels = std::max(errors.largestPixels, pixels);
    }
    batch.count = 0;
  }
  if (area > 0) {
    errors.rmsMetres = std::sqrt(metresSquared / area);
    errors.rmsPixels = std::sqrt(pixelsSquared / area);
  }
  return errors;
}

std::optional<double> Roam::heightAt(double x, double y) const {
  const Impl& roam = *impl_;
  if (roam.patches.empty() || !std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
  const glm::dvec2 at = (glm::dvec2(x, y) - roam.field->origin) / roam.field->spacing;
  if (at.x < 0 || at.y < 0 || at.x > roam.patches.cells.x || at.y > roam.patches.cells.y) return std::nullopt;
  const glm::ivec2 patch = glm::min(glm::ivec2(at) / roam.patches.side, roam.patches.count - 1);
  return roam.heightWithin(static_cast<uint32_t>(patch.y * roam.patches.count.x + patch.x), 0, 2, at);
}

std::string Roam::broken() const {
  return impl_->broken();
}

size_t Roam::bytes() const {
  const Impl& roam = *impl_;
  return sizeof(Impl) + roam.diamonds.capacity() * sizeof(Diamond) + roam.vertexHeights.capacity() * sizeof(float) +
         roam.drawn.capacity() * sizeof(Drawn) + roam.mesh->triangles.capacity() * sizeof(roam.mesh->triangles[0]) +
         roam.mesh->vertices.capacity() * sizeof(RoamMesh::Vertex) + roam.deferral.size() * sizeof(Deferral::Entry);
}

}  // namespace vicus::terrain
