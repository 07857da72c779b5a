/// Based on: the levels, planes, external geometry and openings of Willmott et al. 2001, §2 and §4.2. The forms are
/// those of north-west European towns between about 1400 and 1600: timber frames with jetties, hall houses, brick
/// stepped gables, flint with brick edges, thatched cottages. A house is described by a `HousePlan` of storeys with
/// their front openings; `buildHouse` makes every kind from one, so that all of them keep the same rules: roofs rest on
/// the walls, every hole has its opening, occluders only where a wall is solid from its foot to its top.
#include "assets/norvic/houses.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "assets/norvic/palette.hpp"
#include "assets/norvic/wall_kit.hpp"

namespace vicus::assets::norvic {
namespace {

using city::BuildingBuilder;
using city::MaterialId;
using city::PlaneKind;
using glm::vec2;
using glm::vec3;

constexpr float kWindowDepth = 0.12f, kThickWallWindowDepth = 0.24f, kDoorDepth = 0.16f, kPassageDepth = 0.25f;

enum class Fill : uint8_t { Window, Shuttered, Tall, Door, Shop, Gate, Loading };

/// How much is made of what is in a wall: backs are plain, timber frames have rails for lintels.
enum class Finish : uint8_t { Plain, Framed, Dressed };

/// Something in a storey's wall; heights from the storey's floor.
struct Feature {
  Fill fill = Fill::Window;
  float centre = 0;  ///< metres right of the wall's middle
  float width = 1;
  float sill = 0.9f, head = 2.0f;

  WallHole hole(float floor) const {
    return {centre - 0.5f * width, centre + 0.5f * width, floor + sill, floor + head};
  }
};

struct Storey {
  float height = 2.6f;
  MaterialId wall = kPlaster;
  bool timber = false;  ///< framing shows on the front
  float jetty = 0;      ///< how far its front stands out before the storey below
  std::vector<Feature> front, back;
  std::vector<Feature> side;  ///< on both sides, where the house is detached
};

enum class RoofForm : uint8_t { GableToStreet, EavesToStreet, Hip, SteppedGable };

struct HousePlan {
  HouseKind kind{};
  float width = 6, depth = 10;
  std::vector<Storey> storeys;
  RoofForm roof = RoofForm::EavesToStreet;
  float slope = 1.2f;
  float eaves = 0.35f, verge = 0.02f, thickness = 0.16f;
  MaterialId covering = kTile, roofEdge = kTimber;
  MaterialId gableWall = kPlaster;
  bool gableTimber = false;
  std::vector<Feature> gable;  ///< heights from the eaves
  MaterialId plinth = kRubble;
  float plinthHeight = 0.45f;
  MaterialId frame = kTimber;  ///< of doors and windows
  MaterialId door = kDoor, pane = kLeadGlass;
  float windowDepth = kWindowDepth;
  MaterialId quoins = kPaintCount;  ///< none
  std::vector<vec2> chimneys;       ///< centres
  MaterialId chimney = kBrick;
  float chimneyRise = 1.0f;         ///< above the ridge
  float dormer = 0;                 ///< width of a dormer over the front; 0: none
  MaterialId awning = kPaintCount;  ///< none
};

/// Features of one sort evenly across a width.
std::vector<Feature> evenly(Fill fill, int count, float across, float width, float sill, float head) {
  std::vector<Feature> out;
  for (int i = 0; i < count; ++i)
    out.push_back(
        {fill, across * ((static_cast<float>(i) + 0.5f) / static_cast<float>(count) - 0.5f), width, sill, head});
  return out;
}

/// Puts one house together.
class HouseMaker {
 public:
  explicit HouseMaker(const HousePlan& plan, std::string name) : plan_(plan), builder_(std::move(name)) {}

  city::BuildingGeometry make() {
    float floor = 0, reach = 0;
    for (size_t i = 0; i < plan_.storeys.size(); ++i) {
      const Storey& s = plan_.storeys[i];
      reach += s.jetty;
      addStorey(s, i == 0 ? -kFoundationDepth : floor, floor, reach);
      floor += s.height;
    }
    addRoof(floor, reach);
    const float w = 0.5f * plan_.width, d = 0.5f * plan_.depth;
    builder_.setFootprint({{{-w, -d}, {w, -d}, {w, d}, {-w, d}}});
    return builder_.finish();
  }

  float reach() const {
    float sum = 0;
    for (const Storey& s : plan_.storeys) sum += s.jetty;
    return sum;
  }

 private:
  WallFrame front(float reach) const { return {{0, -0.5f * plan_.depth - reach, 0}, {1, 0, 0}}; }
  WallFrame back() const { return {{0, 0.5f * plan_.depth, 0}, {-1, 0, 0}}; }
  /// The side walls' u = 0 is the middle of the footprint.
  WallFrame right() const { return {{0.5f * plan_.width, 0, 0}, {0, 1, 0}}; }
  WallFrame left() const { return {{-0.5f * plan_.width, 0, 0}, {0, -1, 0}}; }

  void addFeature(const WallFrame& frame, const Feature& feature, const WallHole& hole, Finish finish) {
    const bool rich = finish != Finish::Plain;
    switch (feature.fill) {
      case Fill::Window:
      case Fill::Tall:
        addOpening(builder_, frame, hole, plan_.windowDepth, plan_.pane, plan_.frame);
        if (rich) {
          builder_.beginExternalGeometry(0.09f);
          addBar(builder_, frame, {hole.u0 - 0.1f, hole.u1 + 0.1f, hole.v0 - 0.1f, hole.v0}, 0.09f, plan_.frame,
                 kAbove | kBelow);
        }
        if (finish == Finish::Dressed) {
          builder_.beginExternalGeometry(0.05f);
          addBar(builder_, frame, {hole.u0 - 0.1f, hole.u1 + 0.1f, hole.v1, hole.v1 + 0.12f}, 0.05f, plan_.frame,
                 kBelow);
        }
        if (feature.fill == Fill::Tall && rich) {
          builder_.beginExternalGeometry(0.02f);
          addBar(builder_, frame, {feature.centre - 0.05f, feature.centre + 0.05f, hole.v0, hole.v1}, 0.02f,
                 plan_.frame, kEnds);
        }
        break;
      case Fill::Shuttered: {
        addOpening(builder_, frame, hole, plan_.windowDepth, plan_.pane, plan_.frame);
        if (!rich) break;
        builder_.beginExternalGeometry(0.05f);
        const float leaf = 0.5f * (hole.u1 - hole.u0);
        addBar(builder_, frame, {hole.u0 - leaf, hole.u0, hole.v0, hole.v1}, 0.05f, kShutter, kLeft | kAbove);
        addBar(builder_, frame, {hole.u1, hole.u1 + leaf, hole.v0, hole.v1}, 0.05f, kShutter, kRight | kAbove);
        builder_.beginExternalGeometry(0.08f);
        addBar(builder_, frame, {hole.u0, hole.u1, hole.v0 - 0.08f, hole.v0}, 0.08f, plan_.frame, kAbove | kBelow);
        break;
      }
      case Fill::Door:
        addOpening(builder_, frame, hole, kDoorDepth, plan_.door, plan_.frame, rich ? 0.07f : 0.0f);
        if (rich) {
          addSurround(builder_, frame, hole, 0.16f, 0.07f, plan_.frame, false);
          builder_.beginExternalGeometry(0.34f);
          addBar(builder_, frame, {hole.u0 - 0.15f, hole.u1 + 0.15f, -0.7f, hole.v0}, 0.34f, kRubble, kEnds | kAbove);
        }
        break;
      case Fill::Shop:
        addOpening(builder_, frame, hole, 0.2f, plan_.pane, plan_.frame, 0.05f);
        addSurround(builder_, frame, hole, 0.12f, 0.05f, plan_.frame, false);
        builder_.beginExternalGeometry(0.3f);  // the board on which wares lie
        addBar(builder_, frame, {hole.u0 - 0.05f, hole.u1 + 0.05f, hole.v0 - 0.07f, hole.v0}, 0.3f, kPlanks, kAll);
        break;
      case Fill::Gate:
        addOpening(builder_, frame, hole, kPassageDepth, plan_.door, plan_.frame, 0.08f);
        addSurround(builder_, frame, hole, 0.22f, 0.08f, plan_.frame, false);
        break;
      case Fill::Loading:
        addOpening(builder_, frame, hole, kDoorDepth, kPlanks, plan_.frame, 0.05f);
        addSurround(builder_, frame, hole, 0.12f, 0.05f, plan_.frame, true);
        break;
    }
  }

  /// Posts at the corners and beside the openings, rails above and below, braces in the outer panels.
  void addTimber(const WallFrame& frame, float width, float floor, float top, const std::vector<Feature>& features,
                 bool bressumer) {
    constexpr float kPost = 0.18f, kRail = 0.2f;
    const float half = 0.5f * width;
    builder_.beginExternalGeometry(bressumer ? 0.12f : 0.06f);
    const float sole = bressumer ? 0.28f : kRail;
    addBar(builder_, frame, {-half, half, floor, floor + sole}, bressumer ? 0.12f : 0.06f, kOak,
           bressumer ? kAbove | kBelow : kAbove);
    builder_.beginExternalGeometry(0.06f);
    addBar(builder_, frame, {-half, half, top - kRail, top}, 0.06f, kOak, kBelow);

    std::vector<float> posts{-half + 0.5f * kPost, half - 0.5f * kPost};
    for (const Feature& f : features) {
      const float side = 0.5f * (f.width + kPost);
      for (const float u : {f.centre - side, f.centre + side})
        if (std::abs(u) < half - kPost) posts.push_back(u);
    }
    std::sort(posts.begin(), posts.end());
    std::vector<float> apart;
    for (const float u : posts)
      if (apart.empty() || u - apart.back() > kPost) apart.push_back(u);
    builder_.beginExternalGeometry(0.045f);
    for (size_t i = 0; i < apart.size(); ++i) {
      const unsigned sides = i == 0 ? kRight : i + 1 == apart.size() ? kLeft : kEnds;
      addBar(builder_, frame, {apart[i] - 0.5f * kPost, apart[i] + 0.5f * kPost, floor + sole, top - kRail}, 0.045f,
             kOak, sides);
    }
    // A brace in each outer panel that has room, rising outward to its corner post.
    if (apart.size() < 3) return;
    const float foot = floor + sole, head = top - kRail - 0.3f;
    const auto hasRoom = [](float gap) { return gap > 0.6f && gap < 2.4f; };
    const bool left = hasRoom(apart[1] - apart[0]), right = hasRoom(apart.back() - apart[apart.size() - 2]);
    if (!left && !right) return;
    builder_.beginExternalGeometry(0.03f);
    if (left) addBrace(builder_, frame, {apart[1] - 0.05f, foot}, {apart[0] + 0.05f, head}, 0.13f, 0.03f, kOak);
    if (right)
      addBrace(builder_, frame, {apart[apart.size() - 2] + 0.05f, foot}, {apart.back() - 0.05f, head}, 0.13f, 0.03f,
               kOak);
  }

  /// A low strip of stone along the foot of a wall, between its doors.
  void addPlinth(const WallFrame& frame, float width, const std::vector<Feature>& features) {
    if (plan_.plinthHeight <= 0) return;
    std::vector<std::pair<float, float>> gaps;
    for (const Feature& f : features)
      if (f.sill < plan_.plinthHeight)
        gaps.emplace_back(f.centre - 0.5f * f.width - 0.22f, f.centre + 0.5f * f.width + 0.22f);
    std::sort(gaps.begin(), gaps.end());
    constexpr float kOut = 0.05f;
    builder_.beginExternalGeometry(kOut);
    float from = -0.5f * width;
    for (const auto& [start, end] : gaps) {
      if (start - from > 0.1f)
        addBar(builder_, frame, {from, start, -kFoundationDepth, plan_.plinthHeight}, kOut, plan_.plinth,
               kAbove | kRight);
      from = std::max(from, end);
    }
    if (0.5f * width - from > 0.1f)
      addBar(builder_, frame, {from, 0.5f * width, -kFoundationDepth, plan_.plinthHeight}, kOut, plan_.plinth,
             kAbove | kLeft);
  }

  void addStorey(const Storey& s, float bottom, float floor, float reach) {
    const float top = floor + s.height;
    const float w = plan_.width, d = plan_.depth;
    const bool ground = bottom < floor;
    builder_.beginLevel(bottom, top);

    const auto wall = [&](const WallFrame& frame, float u0, float u1, const std::vector<Feature>& features,
                          Finish finish) {
      std::vector<WallHole> holes;
      for (const Feature& f : features) holes.push_back(f.hole(floor));
      const WallBand band{bottom, top, u0, u1, u0, u1};
      builder_.beginPlane(PlaneKind::Wall, s.wall, frame.normal());
      addWall(builder_, frame, {&band, 1}, holes, s.wall);
      for (size_t i = 0; i < features.size(); ++i) addFeature(frame, features[i], holes[i], finish);
      const vec3 a = frame.at(u0, 0), b = frame.at(u1, 0);
      builder_.addOccluder({vec2(a), vec2(b), bottom, top});
    };

    const WallFrame f = front(reach);
    wall(f, -0.5f * w, 0.5f * w, s.front, s.timber ? Finish::Framed : Finish::Dressed);
    if (s.timber) addTimber(f, w, floor, top, s.front, s.jetty > 0);
    if (ground) addPlinth(f, w, s.front);
    if (ground && plan_.awning != kPaintCount) addAwning(f, s);
    if (plan_.quoins != kPaintCount) addQuoins(f, w, bottom, top);

    wall(back(), -0.5f * w, 0.5f * w, s.back, Finish::Plain);
    wall(right(), -0.5f * d - reach, 0.5f * d, s.side, Finish::Plain);
    wall(left(), -0.5f * d, 0.5f * d + reach, s.side, Finish::Plain);

    if (s.jetty > 0) {
      builder_.beginPlane(PlaneKind::Floor, kPlanks, {0, 0, -1});
      const float y1 = -0.5f * d - reach + s.jetty, y0 = y1 - s.jetty;
      addQuadFacing(builder_, {-0.5f * w, y0, floor}, {0.5f * w, y0, floor}, {0.5f * w, y1, floor},
                    {-0.5f * w, y1, floor}, {0, 0, -1}, kPlanks);
    }
  }

  void addAwning(const WallFrame& frame, const Storey& s) {
    for (const Feature& f : s.front) {
      if (f.fill != Fill::Shop) continue;
      const float u0 = f.centre - 0.5f * f.width - 0.15f, u1 = f.centre + 0.5f * f.width + 0.15f;
      const float high = f.head + 0.25f, low = f.head - 0.15f, out = 0.9f;
      const vec3 up = frame.normal() * 0.3f + vec3(0, 0, 1);
      builder_.beginExternalGeometry(out);
      addQuadFacing(builder_, frame.at(u0, low, out), frame.at(u1, low, out), frame.at(u1, high, 0.02f),
                    frame.at(u0, high, 0.02f), up, plan_.awning);
      addQuadFacing(builder_, frame.at(u0, low, out), frame.at(u1, low, out), frame.at(u1, high, 0.02f),
                    frame.at(u0, high, 0.02f), -up, plan_.awning);
    }
  }

  void addQuoins(const WallFrame& frame, float width, float bottom, float top) {
    builder_.beginExternalGeometry(0.03f);
    addBar(builder_, frame, {-0.5f * width, -0.5f * width + 0.3f, bottom, top}, 0.03f, plan_.quoins, kRight);
    addBar(builder_, frame, {0.5f * width - 0.3f, 0.5f * width, bottom, top}, 0.03f, plan_.quoins, kLeft);
  }

  void addGable(const WallFrame& frame, float u0, float u1, float eaves, const std::vector<Feature>& features,
                bool rich, bool stepped) {
    const float middle = 0.5f * (u0 + u1), rise = 0.5f * (u1 - u0) * plan_.slope;
    std::vector<WallHole> holes;
    for (Feature f : features) {
      f.centre += middle;
      holes.push_back(f.hole(eaves));
    }
    std::vector<WallBand> bands;
    if (stepped) {
      // Steps a little above the roof's top.
      const int steps = std::max(3, static_cast<int>(rise / 0.9f));
      const float up = rise / static_cast<float>(steps), half = 0.5f * (u1 - u0);
      const float above = 0.45f + plan_.thickness * std::sqrt(1 + plan_.slope * plan_.slope);
      float v = eaves;
      for (int i = 0; i <= steps; ++i) {
        const float inset = half * static_cast<float>(i) / static_cast<float>(steps + 1);
        const float next = eaves + up * static_cast<float>(i) + above;
        bands.push_back({v, next, u0 + inset, u1 - inset, u0 + inset, u1 - inset});
        v = next;
      }
    } else {
      bands.push_back({eaves, eaves + rise, u0, u1, middle, middle});
    }
    builder_.beginPlane(PlaneKind::Gable, plan_.gableWall, frame.normal());
    addWall(builder_, frame, bands, holes, plan_.gableWall);
    for (size_t i = 0; i < features.size(); ++i)
      addFeature(frame, features[i], holes[i],
                 !rich               ? Finish::Plain
                 : plan_.gableTimber ? Finish::Framed
                                     : Finish::Dressed);
    if (rich && plan_.gableTimber) {
      constexpr float kPost = 0.16f;
      builder_.beginExternalGeometry(0.06f);
      addBar(builder_, frame, {u0, u1, eaves, eaves + 0.2f}, 0.06f, kOak, kAll & ~static_cast<unsigned>(kEnds));
      builder_.beginExternalGeometry(0.045f);
      const float half = 0.5f * (u1 - u0);
      for (const float at : {-0.5f, 0.5f}) {
        const float height = (1 - std::abs(at)) * rise - 0.5f * kPost * plan_.slope;
        addBar(builder_, frame,
               {middle + at * half - 0.5f * kPost, middle + at * half + 0.5f * kPost, eaves + 0.2f, eaves + height},
               0.045f, kOak, kEnds);
      }
    }
    if (stepped) addStepBacks(frame, bands);
  }

  /// The steps stand free above the roof: their tops, ends and backs.
  void addStepBacks(const WallFrame& frame, const std::vector<WallBand>& bands) {
    constexpr float kThick = 0.3f;
    builder_.beginPlane(PlaneKind::Other, plan_.gableWall, {0, 0, 1}, false);
    for (size_t i = 0; i < bands.size(); ++i) {
      const WallBand& b = bands[i];
      const float nextLeft = i + 1 < bands.size() ? bands[i + 1].left0 : 0.5f * (b.left0 + b.right0);
      const float nextRight = i + 1 < bands.size() ? bands[i + 1].right0 : nextLeft;
      builder_.addBox(frame.origin, frame.u, -frame.normal(), {0, 0, 1}, {b.left0, 0, b.v0}, {nextLeft, kThick, b.v1},
                      plan_.gableWall, 1 | 8 | 32);
      builder_.addBox(frame.origin, frame.u, -frame.normal(), {0, 0, 1}, {nextRight, 0, b.v0}, {b.right0, kThick, b.v1},
                      plan_.gableWall, 2 | 8 | 32);
    }
  }

  void addRoof(float eaves, float reach) {
    const float w = plan_.width, d = plan_.depth;
    RoofShape r;
    r.slope = plan_.slope;
    r.overhang = plan_.eaves, r.verge = plan_.verge, r.thickness = plan_.thickness;
    r.covering = plan_.covering, r.edge = plan_.roofEdge;
    const float middle = -0.5f * reach;  // of the top storey, front to back
    r.centre = {0, middle, eaves};
    const bool gableToStreet = plan_.roof == RoofForm::GableToStreet || plan_.roof == RoofForm::SteppedGable;
    if (gableToStreet)
      r.ridge = {0, 1, 0}, r.halfLength = 0.5f * (d + reach), r.halfSpan = 0.5f * w;
    else
      r.ridge = {1, 0, 0}, r.halfLength = 0.5f * w, r.halfSpan = 0.5f * (d + reach);
    if (plan_.roof == RoofForm::Hip && r.halfSpan > r.halfLength) {
      r.ridge = {0, 1, 0};
      std::swap(r.halfSpan, r.halfLength);
    }
    builder_.beginLevel(eaves, eaves + r.rise() + r.thicknessUp());
    if (plan_.roof == RoofForm::Hip) {
      addHipRoof(builder_, r);
    } else {
      if (gableToStreet) {
        const bool stepped = plan_.roof == RoofForm::SteppedGable;
        addGable(front(reach), -0.5f * w, 0.5f * w, eaves, plan_.gable, true, stepped);
        addGable(back(), -0.5f * w, 0.5f * w, eaves, {}, false, false);
      } else {
        addGable(right(), -0.5f * d - reach, 0.5f * d, eaves, {}, false, false);
        addGable(left(), -0.5f * d, 0.5f * d + reach, eaves, {}, false, false);
      }
      addGableRoof(builder_, r);
    }
    const float ridge = eaves + r.rise() + r.thicknessUp();
    for (const vec2 c : plan_.chimneys) {
      // From below the roof, where the stack leaves it, to above the ridge.
      const float across = gableToStreet ? std::abs(c.x) : std::abs(c.y - middle);
      const float from = eaves + std::max(0.0f, r.rise() - (across + 0.5f) * plan_.slope) - 0.2f;
      addChimney(builder_, c, {0.42f, 0.36f}, from, ridge + plan_.chimneyRise, plan_.chimney);
    }
    if (plan_.dormer > 0 && !gableToStreet) addDormer(eaves, reach, r);
  }

  /// A window standing up out of the front slope, under a small gable roof of its own.
  void addDormer(float eaves, float reach, const RoofShape& roof) {
    const float half = 0.5f * plan_.dormer;
    // Its front stands half a metre behind the wall's face; its sill lies on the slope there.
    const float inset = 0.5f;
    const float face = -0.5f * plan_.depth - reach + inset;
    const float sill = eaves + inset * roof.slope;  // on the roof's underside
    const float height = 1.25f + roof.thicknessUp();
    const float head = sill + height;
    const float backAtHead = face + height / roof.slope;  // where the level of its eaves meets the slope
    const WallFrame front{{0, face, 0}, {1, 0, 0}};
    const WallBand band{sill, head, -half, half, -half, half};
    const WallHole hole{-half + 0.15f, half - 0.15f, sill + roof.thicknessUp() + 0.2f, head - 0.1f};
    builder_.beginPlane(PlaneKind::Wall, plan_.gableWall, front.normal());
    addWall(builder_, front, {&band, 1}, {&hole, 1}, plan_.gableWall);
    addOpening(builder_, front, hole, 0.1f, plan_.pane, plan_.frame);
    const float rise = half * 1.1f;
    builder_.beginPlane(PlaneKind::Gable, plan_.gableWall, front.normal());
    const WallBand gable{head, head + rise, -half, half, 0, 0};
    addWall(builder_, front, {&gable, 1}, {}, plan_.gableWall);
    for (const float side : {-1.0f, 1.0f}) {
      builder_.beginPlane(PlaneKind::Wall, plan_.gableWall, {side, 0, 0});
      addTriangleFacing(builder_, {side * half, face, sill}, {side * half, face, head}, {side * half, backAtHead, head},
                        {side, 0, 0}, plan_.gableWall);
    }
    // Its slopes run back until they meet the main roof's.
    const float over = 0.18f, drop = over * 1.1f, up = 0.12f;
    for (const float side : {-1.0f, 1.0f}) {
      const vec3 normal = glm::normalize(vec3(side * 1.1f, 0, 1));
      const float low = head - drop + up, high = head + rise + up;
      const auto meets = [&](float z) { return face + (z - sill) / roof.slope; };
      builder_.beginPlane(PlaneKind::Roof, plan_.covering, normal);
      const vec3 a{side * (half + over), face - 0.15f, low}, b{side * (half + over), meets(low), low};
      const vec3 c{0, meets(high), high}, e{0, face - 0.15f, high};
      addQuadFacing(builder_, a, b, c, e, normal, plan_.covering);
      builder_.beginPlane(PlaneKind::Other, plan_.roofEdge, {0, -1, 0}, false);
      addQuadFacing(builder_, {side * (half + over), face - 0.15f, low - up}, {0, face - 0.15f, high - up}, e, a,
                    {0, -1, 0}, plan_.roofEdge);
      addQuadFacing(builder_, {side * (half + over), face - 0.15f, low - up},
                    {side * (half + over), meets(low), low - up}, b, a, {side, 0, 0}, plan_.roofEdge);
      addQuadFacing(builder_, {side * (half + over), face - 0.15f, low - up}, {0, face - 0.15f, high - up},
                    {0, face + 0.02f, high - up}, {side * (half + over), face + 0.02f, low - up}, -normal,
                    plan_.roofEdge);
    }
  }

  const HousePlan& plan_;
  BuildingBuilder builder_;
};

// --- the kinds -------------------------------------------------------------------------------------------------------

constexpr MaterialId kPlasters[] = {kPlaster, kLimewash, kPlasterOchre, kLimewashGrey, kPlasterRose, kLimewash};

MaterialId plasterOf(int variant) {
  return kPlasters[static_cast<size_t>(variant) % std::size(kPlasters)];
}

HousePlan jettied(int variant, bool tall) {
  static constexpr float kWidths[] = {5.0f, 5.6f, 6.4f, 5.2f, 6.0f, 7.0f};
  static constexpr float kDepths[] = {10.5f, 11.5f, 10.0f, 12.0f, 9.5f, 11.0f};
  HousePlan p;
  p.kind = tall ? HouseKind::JettiedTall : HouseKind::Jettied;
  p.width = kWidths[variant], p.depth = kDepths[variant] - (tall ? 0.0f : 1.0f);
  p.roof = RoofForm::GableToStreet;
  p.slope = 1.35f;
  p.eaves = 0.22f, p.verge = 0.3f;
  p.covering = variant % 2 ? kTileBrown : kTile;
  p.gableWall = plasterOf(variant);
  p.gableTimber = true;
  p.door = variant % 3 == 1 ? kDoorGreen : kDoor;
  const float w = p.width;

  Storey ground;
  ground.height = 2.9f;
  ground.wall = variant % 3 == 2 ? MaterialId{kBrick} : p.gableWall;
  ground.timber = variant % 3 != 2;
  const float side = variant % 2 ? 1.0f : -1.0f;
  ground.front = {{Fill::Door, side * (0.5f * w - 1.0f), 1.05f, 0.02f, 2.1f}};
  if (variant % 2 == 0)
    ground.front.push_back({Fill::Shop, -side * 0.75f, 0.42f * w, 0.85f, 2.15f});
  else
    ground.front.push_back({Fill::Window, -side * 0.75f, 0.36f * w, 0.95f, 2.1f});
  ground.back = {{Fill::Door, 0.8f, 0.95f, 0.02f, 2.0f}};
  p.storeys.push_back(ground);

  Storey upper;
  upper.height = 2.6f;
  upper.wall = p.gableWall;
  upper.timber = true;
  upper.jetty = 0.45f;
  upper.front = {{Fill::Window, 0, 0.38f * w, 0.95f, 2.05f}};
  upper.back = {{Fill::Window, 0, 1.1f, 0.95f, 2.0f}};
  if (variant >= 3) upper.side = evenly(Fill::Window, 2, p.depth - 2, 0.95f, 0.95f, 1.95f);
  p.storeys.push_back(upper);
  if (tall) {
    upper.jetty = 0.35f;
    upper.side.clear();
    upper.height = 2.45f;
    upper.front = evenly(Fill::Window, 2, w - 1.0f, 1.1f, 0.9f, 1.95f);
    p.storeys.push_back(upper);
  }
  p.gable = {{Fill::Window, 0, 0.8f, 0.9f, 1.7f}};
  p.chimneys = {{-side * (0.5f * w - 1.2f), 0.18f * p.depth}};
  return p;
}

HousePlan timberRow(int variant) {
  static constexpr float kWidths[] = {5.2f, 6.0f, 6.8f, 7.6f, 5.6f, 6.4f, 8.4f};
  HousePlan p;
  p.kind = HouseKind::TimberRow;
  p.width = kWidths[variant], p.depth = 8.0f + 0.5f * static_cast<float>(variant % 3);
  p.slope = 1.1f;
  p.covering = variant % 3 == 1 ? kTileBrown : kTile;
  p.gableWall = plasterOf(variant + 1);
  p.door = variant % 2 ? kDoor : kDoorGreen;
  const float w = p.width;
  Storey ground;
  ground.height = 2.7f;
  ground.wall = variant % 2 ? MaterialId{kBrick} : p.gableWall;
  ground.timber = variant % 2 == 0;
  const float side = variant % 2 ? 1.0f : -1.0f;
  ground.front = {{Fill::Door, side * (0.5f * w - 0.95f), 1.0f, 0.02f, 2.05f},
                  {Fill::Window, -side * 0.8f, 0.3f * w, 0.95f, 2.05f}};
  ground.back = {{Fill::Door, 0.5f, 0.95f, 0.02f, 2.0f}};
  p.storeys.push_back(ground);
  Storey upper;
  upper.height = 2.45f;
  upper.wall = p.gableWall;
  upper.timber = true;
  upper.jetty = 0.4f;
  upper.front = evenly(Fill::Window, w > 7 ? 3 : 2, w, 1.0f, 0.95f, 1.95f);
  upper.back = {{Fill::Window, 0.3f, 1.1f, 0.9f, 1.9f}};
  if (variant >= 4) upper.side = evenly(Fill::Window, 2, p.depth - 1, 0.95f, 0.95f, 1.9f);
  p.storeys.push_back(upper);
  p.chimneys = {{-side * (0.5f * w - 0.6f), -0.2f}};
  if (variant % 3 == 2) p.dormer = 1.5f;
  return p;
}

HousePlan brickRow(int variant) {
  static constexpr float kWidths[] = {5.4f, 6.2f, 7.0f, 7.8f, 5.8f, 6.6f};
  HousePlan p;
  p.kind = HouseKind::BrickRow;
  p.width = kWidths[variant], p.depth = 9.0f + 0.5f * static_cast<float>(variant % 3);
  p.slope = 1.15f;
  p.covering = variant % 2 ? kSlate : kTile;
  p.gableWall = variant % 2 ? MaterialId{kBrick} : plasterOf(variant);
  const float w = p.width;
  const int bays = w > 6.5f ? 3 : 2;
  Storey ground;
  ground.height = 3.0f;
  ground.wall = variant % 2 ? kBrick : kBrickDark;
  const float side = variant % 2 ? -1.0f : 1.0f;
  ground.front = {{Fill::Door, side * (0.5f * w - 1.0f), 1.1f, 0.02f, 2.2f},
                  {variant % 3 == 0 ? Fill::Shop : Fill::Window, -side * 0.8f, 0.4f * w, 0.9f, 2.2f}};
  ground.back = {{Fill::Door, -0.8f, 1.0f, 0.02f, 2.1f}};
  p.storeys.push_back(ground);
  Storey middle;
  middle.height = 2.8f;
  middle.wall = variant % 2 ? MaterialId{kBrick} : p.gableWall;
  middle.timber = variant % 2 == 0;
  middle.jetty = middle.timber ? 0.4f : 0.0f;
  middle.front = evenly(Fill::Window, bays, w - 0.4f, 1.05f, 0.9f, 2.15f);
  middle.back = {{Fill::Window, 0, 1.1f, 0.9f, 2.0f}};
  if (variant >= 3) middle.side = evenly(Fill::Window, 2, p.depth - 1, 0.95f, 0.9f, 2.0f);
  p.storeys.push_back(middle);
  Storey top = middle;
  top.height = 2.4f;
  top.jetty = 0;
  top.front = evenly(Fill::Window, bays, w - 0.4f, 0.95f, 0.85f, 1.9f);
  p.storeys.push_back(top);
  p.chimneys = {{side * (0.5f * w - 0.6f), 0.3f}};
  p.awning = variant % 3 == 0 ? (variant ? kWoolStraw : kWoolRed) : kPaintCount;
  return p;
}

HousePlan hall(int variant) {
  HousePlan p;
  p.kind = HouseKind::Hall;
  p.width = 11.5f + 0.8f * static_cast<float>(variant), p.depth = 8.5f;
  p.slope = 1.2f, p.eaves = 0.45f, p.verge = 0.3f;
  p.gableWall = plasterOf(variant);
  p.covering = variant % 2 ? kThatch : kTileBrown;
  p.thickness = variant % 2 ? 0.32f : 0.16f;
  if (variant % 2) p.roofEdge = kThatch;
  const float w = p.width;
  Storey ground;
  ground.height = 4.2f;
  ground.wall = p.gableWall;
  ground.timber = true;
  ground.front = {{Fill::Tall, -0.28f * w, 1.7f, 0.9f, 3.3f},
                  {Fill::Tall, 0.02f * w, 1.5f, 0.9f, 3.3f},
                  {Fill::Door, 0.23f * w, 1.2f, 0.02f, 2.2f},
                  {Fill::Window, 0.4f * w, 1.1f, 1.0f, 2.1f}};
  ground.back = {{Fill::Door, -0.2f * w, 1.1f, 0.02f, 2.1f}, {Fill::Window, 0.2f * w, 1.3f, 1.0f, 2.4f}};
  ground.side = {{Fill::Window, 0, 1.1f, 1.0f, 2.2f}};
  p.storeys.push_back(ground);
  p.chimneys = {{0.13f * w, 0.3f}};
  p.chimney = kBrickDark;
  return p;
}

HousePlan merchant(int variant) {
  static constexpr float kWidths[] = {8.5f, 9.5f, 10.5f, 8.0f, 11.5f};
  HousePlan p;
  p.kind = HouseKind::Merchant;
  p.width = kWidths[variant], p.depth = 10.0f;
  p.roof = RoofForm::Hip;
  p.slope = 0.95f, p.eaves = 0.4f;
  p.covering = variant % 2 ? kTile : kSlate;
  p.roofEdge = kAshlar;
  p.plinth = kAshlar, p.frame = kAshlar;
  p.windowDepth = kThickWallWindowDepth;
  p.quoins = kAshlar;
  p.door = variant % 2 ? kDoorGreen : kDoor;
  const MaterialId wall = variant % 3 == 0 ? kAshlar : variant % 3 == 1 ? kRubble : kLimewash;
  const int bays = p.width > 9 ? 3 : 2;
  const float w = p.width;
  Storey s;
  s.wall = wall;
  s.height = 3.4f;
  s.front = evenly(Fill::Window, bays, w - 1.0f, 1.1f, 1.0f, 2.5f);
  s.front[static_cast<size_t>(bays / 2)] = {Fill::Door, s.front[static_cast<size_t>(bays / 2)].centre, 1.35f, 0.02f,
                                            2.5f};
  s.back = {{Fill::Door, -1.5f, 1.1f, 0.02f, 2.2f}};
  p.storeys.push_back(s);
  s.height = 3.1f;
  s.front = evenly(Fill::Window, bays, w - 1.0f, 1.15f, 0.8f, 2.4f);
  s.back = evenly(Fill::Window, 2, w - 2.0f, 1.0f, 0.9f, 2.2f);
  p.storeys.push_back(s);
  s.height = 2.5f;
  s.front = evenly(Fill::Window, bays, w - 1.0f, 1.0f, 0.8f, 1.9f);
  s.back.clear();
  p.storeys.push_back(s);
  p.chimneys = {{-0.5f * w + 2.2f, 0.5f}, {0.5f * w - 2.2f, 0.5f}};
  p.chimney = kAshlar;
  p.chimneyRise = 0.6f;
  return p;
}

HousePlan steppedGable(int variant) {
  static constexpr float kWidths[] = {5.6f, 6.2f, 6.8f, 7.4f};
  HousePlan p;
  p.kind = HouseKind::SteppedGable;
  p.width = kWidths[variant], p.depth = 12.0f;
  p.roof = RoofForm::SteppedGable;
  p.slope = 1.45f, p.eaves = 0.1f, p.verge = 0;
  p.covering = kTile, p.roofEdge = kBrick;
  p.frame = kAshlar;
  p.windowDepth = 0.16f;
  p.gableWall = variant % 2 ? kBrickDark : kBrick;
  p.plinth = kAshlar;
  const float w = p.width;
  Storey s;
  s.wall = p.gableWall;
  s.height = 3.2f;
  s.front = {{Fill::Door, -0.5f * w + 1.15f, 1.15f, 0.02f, 2.35f}, {Fill::Window, 0.9f, 0.42f * w, 0.9f, 2.35f}};
  s.back = {{Fill::Door, 0, 1.0f, 0.02f, 2.1f}};
  p.storeys.push_back(s);
  s.height = 2.9f;
  s.front = evenly(Fill::Window, 2, w - 0.6f, 1.15f, 0.8f, 2.2f);
  s.back = {{Fill::Window, 0, 1.1f, 0.9f, 2.1f}};
  if (variant >= 2) s.side = evenly(Fill::Window, 3, p.depth - 1, 0.9f, 0.8f, 2.0f);
  p.storeys.push_back(s);
  p.gable = {{Fill::Loading, 0, 1.2f, 0.5f, 2.0f}};
  p.chimneys = {{0.5f * w - 1.3f, 2.0f}};
  return p;
}

HousePlan cottage(int variant) {
  static constexpr float kWidths[] = {6.0f, 6.8f, 7.6f, 8.4f, 6.4f, 7.2f};
  HousePlan p;
  p.kind = HouseKind::Cottage;
  p.width = kWidths[variant], p.depth = 6.0f + 0.3f * static_cast<float>(variant % 3);
  p.slope = 1.25f, p.eaves = 0.5f, p.verge = 0.25f, p.thickness = 0.34f;
  p.covering = kThatch, p.roofEdge = kThatch;
  p.gableWall = plasterOf(variant + 1);
  p.door = variant % 2 ? kPlanks : kDoorGreen;
  const float w = p.width;
  Storey ground;
  ground.height = 2.35f;
  ground.wall = p.gableWall;
  ground.timber = variant % 3 == 0;
  const float side = variant % 2 ? 0.12f : -0.12f;
  ground.front = {{Fill::Door, side * w, 0.95f, 0.02f, 1.9f},
                  {variant % 3 ? Fill::Shuttered : Fill::Window, -0.33f * w, 0.8f, 0.85f, 1.7f},
                  {variant % 3 ? Fill::Shuttered : Fill::Window, 0.33f * w, 0.8f, 0.85f, 1.7f}};
  ground.back = {{Fill::Window, 0, 0.8f, 0.9f, 1.7f}};
  if (variant >= 3) ground.side = {{Fill::Window, 0.6f, 0.8f, 0.85f, 1.65f}};
  p.storeys.push_back(ground);
  p.chimneys = {{(variant % 2 ? 1.0f : -1.0f) * (0.5f * w - 0.6f), 0}};
  p.chimney = kRubble;
  if (variant % 2 == 0) p.dormer = 1.3f;
  return p;
}

HousePlan workshop(int variant) {
  static constexpr float kWidths[] = {6.0f, 7.0f, 8.0f, 6.5f, 7.5f};
  HousePlan p;
  p.kind = HouseKind::Workshop;
  p.width = kWidths[variant], p.depth = 9.5f;
  p.slope = 1.1f;
  p.covering = variant % 2 ? kTile : kTileBrown;
  p.gableWall = kFlint;
  p.quoins = kBrick;
  p.windowDepth = 0.18f;
  const float w = p.width;
  Storey ground;
  ground.height = 2.9f;
  ground.wall = variant % 2 ? kBrick : kFlint;
  ground.front = {{Fill::Shop, -0.16f * w, 0.45f * w, 0.8f, 2.2f}, {Fill::Door, 0.5f * w - 1.2f, 1.1f, 0.02f, 2.15f}};
  ground.back = {{Fill::Gate, 0, 2.2f, 0.02f, 2.4f}};
  p.storeys.push_back(ground);
  Storey upper;
  upper.height = 2.5f;
  upper.wall = kFlint;
  upper.front = evenly(Fill::Window, 2, w - 0.6f, 1.2f, 0.85f, 1.95f);
  upper.back = {{Fill::Window, 0, 1.2f, 0.9f, 1.9f}};
  if (variant >= 3) upper.side = evenly(Fill::Window, 2, p.depth - 1, 1.0f, 0.85f, 1.9f);
  p.storeys.push_back(upper);
  p.chimneys = {{-0.5f * w + 0.6f, 0.4f}};
  p.awning = variant % 2 ? kWoolStraw : kWoolRed;
  return p;
}

HousePlan inn(int variant) {
  HousePlan p;
  p.kind = HouseKind::Inn;
  p.width = 11.0f + static_cast<float>(variant), p.depth = 10.0f;
  p.slope = 1.1f, p.eaves = 0.4f;
  p.covering = variant % 2 ? kTileBrown : kTile;
  p.gableWall = plasterOf(variant);
  p.door = kPlanks;
  const float w = p.width;
  Storey ground;
  ground.height = 3.2f;
  ground.wall = variant % 2 ? kRubble : kBrick;
  ground.front = {{Fill::Gate, 0, 2.9f, 0.02f, 2.85f},
                  {Fill::Window, -0.33f * w, 1.9f, 0.95f, 2.2f},
                  {Fill::Window, 0.27f * w, 1.3f, 0.95f, 2.2f},
                  {Fill::Door, 0.42f * w, 1.1f, 0.02f, 2.15f}};
  ground.back = {{Fill::Gate, 0, 2.9f, 0.02f, 2.85f}};
  p.storeys.push_back(ground);
  Storey upper;
  upper.height = 2.7f;
  upper.wall = p.gableWall;
  upper.timber = true;
  upper.jetty = 0.5f;
  upper.front = evenly(Fill::Window, 4, w - 0.6f, 1.25f, 0.9f, 2.1f);
  upper.back = evenly(Fill::Window, 2, w, 1.2f, 0.9f, 2.0f);
  p.storeys.push_back(upper);
  p.chimneys = {{-0.5f * w + 0.7f, 0}, {0.5f * w - 0.7f, 0}};
  p.dormer = 1.8f;
  return p;
}

HousePlan warehouse(int variant) {
  HousePlan p;
  p.kind = HouseKind::Warehouse;
  p.width = 8.0f + 0.8f * static_cast<float>(variant), p.depth = 14.0f + static_cast<float>(variant);
  p.roof = RoofForm::GableToStreet;
  p.slope = 1.05f, p.eaves = 0.25f, p.verge = 0.25f;
  p.covering = kTile;
  p.gableWall = variant % 2 ? kPlanks : kBrick;
  p.door = kPlanks;
  p.frame = variant % 2 ? kTimber : kAshlar;
  const float w = p.width;
  Storey s;
  s.wall = variant % 2 ? kRubble : kBrick;
  s.height = 3.1f;
  s.front = {{Fill::Gate, 0, 2.4f, 0.02f, 2.6f},
             {Fill::Window, -0.36f * w, 0.8f, 1.4f, 2.2f},
             {Fill::Window, 0.36f * w, 0.8f, 1.4f, 2.2f}};
  s.back = {{Fill::Gate, 0, 2.4f, 0.02f, 2.6f}};
  p.storeys.push_back(s);
  s.wall = p.gableWall;
  s.height = 2.7f;
  s.front = {{Fill::Loading, 0, 1.5f, 0.35f, 2.2f},
             {Fill::Window, -0.33f * w, 0.8f, 0.9f, 1.7f},
             {Fill::Window, 0.33f * w, 0.8f, 0.9f, 1.7f}};
  s.back.clear();
  p.storeys.push_back(s);
  p.gable = {{Fill::Loading, 0, 1.4f, 0.3f, 1.95f}};
  return p;
}

HousePlan barn(int variant) {
  HousePlan p;
  p.kind = HouseKind::Barn;
  p.width = 12.0f + 2.0f * static_cast<float>(variant), p.depth = 8.0f;
  p.slope = 1.15f, p.eaves = 0.5f, p.verge = 0.25f, p.thickness = variant % 2 ? 0.34f : 0.16f;
  p.covering = variant % 2 ? kThatch : kTileBrown;
  p.roofEdge = variant % 2 ? kThatch : kTimber;
  p.gableWall = kPlanks;
  p.door = kPlanks;
  p.plinthHeight = 0.6f;
  Storey s;
  s.height = 3.6f;
  s.wall = kPlanks;
  s.front = {{Fill::Gate, 0, 3.2f, 0.02f, 3.1f}};
  s.back = s.front;
  p.storeys.push_back(s);
  return p;
}

HousePlan dovecote(int variant) {
  HousePlan p;
  p.kind = HouseKind::Dovecote;
  p.width = p.depth = 4.6f + 0.4f * static_cast<float>(variant);
  p.roof = RoofForm::Hip;
  p.slope = 1.3f, p.eaves = 0.3f;
  p.covering = variant % 2 ? kTile : kSlate;
  p.windowDepth = kThickWallWindowDepth;
  p.frame = variant % 2 ? kBrick : kAshlar;
  Storey s;
  s.height = 3.0f;
  s.wall = variant % 2 ? kFlint : kLimewash;
  s.front = {{Fill::Door, 0, 0.9f, 0.02f, 1.8f}};
  p.storeys.push_back(s);
  s.front = evenly(Fill::Window, 3, p.width - 0.8f, 0.4f, 1.4f, 1.9f);
  s.height = 2.6f;
  p.storeys.push_back(s);
  return p;
}

HousePlan almshouses(int variant) {
  HousePlan p;
  p.kind = HouseKind::Almshouses;
  const int units = 3 + variant;
  p.width = 4.4f * static_cast<float>(units), p.depth = 6.2f;
  p.slope = 1.2f, p.verge = 0.2f;
  p.covering = variant % 2 ? kTileBrown : kTile;
  p.gableWall = kBrick;
  p.windowDepth = 0.16f;
  Storey s;
  s.height = 2.6f;
  s.wall = kBrick;
  for (int i = 0; i < units; ++i) {
    const float middle = 4.4f * (static_cast<float>(i) + 0.5f) - 0.5f * p.width;
    s.front.push_back({Fill::Door, middle - 1.0f, 0.95f, 0.02f, 2.0f});
    s.front.push_back({Fill::Window, middle + 0.8f, 1.1f, 0.9f, 1.95f});
    if (i % 2 == 0) p.chimneys.push_back({middle + 2.2f < 0.5f * p.width ? middle + 2.2f : middle + 1.4f, 0.2f});
  }
  p.storeys.push_back(s);
  return p;
}

HousePlan towerHouse(int variant) {
  HousePlan p;
  p.kind = HouseKind::TowerHouse;
  p.width = 6.0f + 0.6f * static_cast<float>(variant), p.depth = 7.0f;
  p.roof = RoofForm::Hip;
  p.slope = 1.2f, p.eaves = 0.3f;
  p.covering = variant % 2 ? kSlate : kTile;
  p.windowDepth = kThickWallWindowDepth;
  p.frame = kAshlar, p.roofEdge = kAshlar, p.plinth = kAshlar;
  p.quoins = kAshlar;
  const float w = p.width;
  Storey s;
  s.wall = variant % 2 ? kFlint : kRubble;
  s.height = 3.4f;
  s.front = {{Fill::Door, -0.15f * w, 1.15f, 0.02f, 2.2f}, {Fill::Window, 0.3f * w, 0.5f, 1.4f, 2.3f}};
  p.storeys.push_back(s);
  s.height = 3.0f;
  s.front = {{Fill::Window, 0, 1.3f, 0.9f, 2.3f}};
  s.back = {{Fill::Window, 0, 0.9f, 0.9f, 2.0f}};
  s.side = {{Fill::Window, 0, 0.7f, 1.0f, 2.0f}};
  p.storeys.push_back(s);
  s.side.clear();
  s.back.clear();
  s.front = evenly(Fill::Window, 2, w - 1.4f, 0.8f, 0.9f, 2.2f);
  p.storeys.push_back(s);
  s.height = 2.6f;
  s.side = {{Fill::Window, 0, 0.7f, 0.9f, 1.8f}};
  p.storeys.push_back(s);
  return p;
}

HousePlan flintHouse(int variant) {
  static constexpr float kWidths[] = {7.0f, 8.0f, 9.0f, 7.5f, 8.5f, 9.5f};
  HousePlan p;
  p.kind = HouseKind::FlintHouse;
  p.width = kWidths[variant], p.depth = 7.0f + 0.4f * static_cast<float>(variant % 2);
  p.slope = 1.05f, p.verge = 0.2f;
  p.covering = variant % 3 == 2 ? kSlate : kTile;
  p.gableWall = kFlint;
  p.quoins = kBrick;
  p.windowDepth = 0.18f;
  p.door = variant % 2 ? kDoorGreen : kDoor;
  const float w = p.width;
  const int bays = w > 8.2f ? 3 : 2;
  Storey ground;
  ground.height = 2.7f;
  ground.wall = kFlint;
  ground.front = evenly(Fill::Shuttered, bays == 3 ? 2 : 1, bays == 3 ? w - 0.4f : 0, 0.95f, 0.85f, 2.0f);
  if (bays == 3)
    ground.front.push_back({Fill::Door, 0, 1.0f, 0.02f, 2.1f});
  else
    ground.front = {{Fill::Shuttered, 0.22f * w, 0.95f, 0.85f, 2.0f}, {Fill::Door, -0.25f * w, 1.0f, 0.02f, 2.1f}};
  ground.back = {{Fill::Door, 0, 0.95f, 0.02f, 2.0f}};
  p.storeys.push_back(ground);
  Storey upper;
  upper.height = 2.4f;
  upper.wall = kFlint;
  upper.front = evenly(Fill::Window, bays, w - 0.8f, 0.95f, 0.8f, 1.9f);
  upper.back = {{Fill::Window, 0, 1.0f, 0.85f, 1.85f}};
  upper.side = {{Fill::Window, 0, 0.8f, 0.85f, 1.8f}};
  p.storeys.push_back(upper);
  p.chimneys = {{(variant % 2 ? -1.0f : 1.0f) * (0.5f * w - 0.6f), 0}};
  return p;
}

struct KindRow {
  std::string_view name;
  int variants;
  HousePlan (*plan)(int);
};

constexpr KindRow kKinds[kHouseKinds] = {
    {"jettied-tall", 6, [](int v) { return jettied(v, true); }},
    {"jettied", 6, [](int v) { return jettied(v, false); }},
    {"timber-row", 7, timberRow},
    {"brick-row", 6, brickRow},
    {"hall", 4, hall},
    {"merchant", 5, merchant},
    {"stepped-gable", 4, steppedGable},
    {"cottage", 6, cottage},
    {"workshop", 5, workshop},
    {"inn", 3, inn},
    {"warehouse", 4, warehouse},
    {"barn", 3, barn},
    {"dovecote", 2, dovecote},
    {"almshouses", 3, almshouses},
    {"tower-house", 4, towerHouse},
    {"flint-house", 6, flintHouse},
};

}  // namespace

std::string_view nameOf(HouseKind kind) {
  return kKinds[static_cast<size_t>(kind)].name;
}

HouseCatalogue makeHouseCatalogue() {
  HouseCatalogue out;
  for (size_t k = 0; k < kHouseKinds; ++k) {
    for (int v = 0; v < kKinds[k].variants; ++v) {
      const HousePlan plan = kKinds[k].plan(v);
      assert(static_cast<size_t>(plan.kind) == k);
      HouseMaker maker(plan, std::string(kKinds[k].name) + "/" + std::to_string(v + 1));
      HouseVariant variant;
      variant.kind = plan.kind;
      variant.geometry = static_cast<uint32_t>(out.geometry.size());
      variant.width = plan.width, variant.depth = plan.depth;
      variant.frontReach = maker.reach();
      variant.sideWindows =
          std::any_of(plan.storeys.begin(), plan.storeys.end(), [](const Storey& st) { return !st.side.empty(); });
      const bool eavesAtSides = plan.roof == RoofForm::GableToStreet || plan.roof == RoofForm::Hip;
      variant.sideReach = eavesAtSides ? plan.eaves : plan.roof == RoofForm::SteppedGable ? plan.eaves : plan.verge;
      out.geometry.push_back(maker.make());
      out.byKind[k].push_back(static_cast<uint32_t>(out.variants.size()));
      out.variants.push_back(variant);
    }
    std::stable_sort(out.byKind[k].begin(), out.byKind[k].end(),
                     [&](uint32_t a, uint32_t b) { return out.variants[a].width > out.variants[b].width; });
  }
  return out;
}

}  // namespace vicus::assets::norvic
