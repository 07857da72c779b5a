#include "facade/house.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "city/random.hpp"
#include "facade/outline.hpp"
#include "facade/roof_mesh.hpp"
#include "facade/tower.hpp"

namespace vicus::facade {
namespace {

using city::BuildingBuilder;
using city::hash32;
using city::PlaneKind;
using glm::dvec2;
using glm::dvec3;

double cross(dvec2 a, dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

double areaOf(const Ring& ring) {
  double sum = 0;
  for (size_t i = 0; i < ring.size(); ++i) sum += cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
  return sum / 2;
}

double neighbourAt(const Lot& lot, size_t r, size_t e) {
  if (r >= lot.neighbours.size() || e >= lot.neighbours[r].size()) return -INFINITY;
  return std::isnan(lot.neighbours[r][e]) ? -INFINITY : lot.neighbours[r][e];
}

/// Ground at the ends of an edge.
dvec2 groundAt(const Lot& lot, size_t r, size_t e) {
  if (r >= lot.ground.size() || e >= lot.ground[r].size()) return dvec2(lot.bottom);
  const dvec2 g = lot.ground[r][e];
  return std::isfinite(g.x + g.y) ? g : dvec2(lot.bottom);
}

bool isParty(const Lot& lot, size_t r, size_t e) {
  return neighbourAt(lot, r, e) > lot.bottom;
}

/// A prism that rules work on: the lot's rings, perhaps moved, from `bottom` to `top`.
struct Volume {
  std::vector<Ring> rings;
  double bottom = 0, top = 0;
  double below = 0;  ///< metres that its walls reach below `bottom`
  bool highest = true;
};

/// Party walls start so far below the neighbour's eaves that no gap shows: metres.
constexpr double kPartyOverlap = 0.3;

/// So much of a wall stands over the ground for its rules, however high that rises: metres.
constexpr double kLeastOverGround = 0.5;
/// Walls along which the ground falls farther are cut into pieces, but for short ones: metres.
constexpr double kFallOfAWall = 0.6, kShortestPiece = 4;

class Builder {
 public:
  Builder(BuildingBuilder& builder, const StyleInUse& use, const Lot& lot, const HouseFacts& facts, Derivation& made)
      : builder_(builder),
        use_(use),
        style_(*use.style),
        lot_(lot),
        facts_(facts),
        house_(*use.style, facts, use.parameters),
        surrounding_(house_.surrounding),
        made_(made),
        faces_(facesOf(lot)) {
    double area = 0, around = 0;
    for (const Ring& ring : lot.rings) {
      area += areaOf(ring);
      for (size_t i = 0; i < ring.size(); ++i) around += glm::length(ring[(i + 1) % ring.size()] - ring[i]);
    }
    // Openings may not come out at the back of a sliver.
    thickness_ = around > 0 ? std::min(0.5, 0.5 * area / around) : 0;
    numberWalls();
  }

  void apply(uint32_t rule, const Volume& volume, uint32_t index, uint32_t count, uint32_t seed, uint32_t depth) {
    if (depth > kDeepestRule || made_.scopes >= kMostScopes) {
      ++made_.cutShort;
      return;
    }
    ++made_.scopes;
    made_.deepest = std::max(made_.deepest, depth);
    surrounding_[Variable::Width].number =
        house_.surrounding.variables[static_cast<size_t>(Variable::HouseWidth)].number;
    surrounding_[Variable::Height].number = volume.top - volume.bottom;
    surrounding_[Variable::Index].number = index;
    surrounding_[Variable::Count].number = count;
    surrounding_.seed = seed;
    if (const Operation* o = chosenOperation(style_, rule, surrounding_)) run(*o, volume, index, seed, depth);
  }

 private:
  double number(const Operation& o, size_t i) const { return numberOf(style_, o.numbers[i], surrounding_); }

  void run(const Operation& o, const Volume& volume, uint32_t index, uint32_t seed, uint32_t depth) {
    switch (o.kind) {
      case Operator::Extrude: {
        Volume raised = volume;
        raised.top = raised.bottom + std::clamp(number(o, 0), 0.0, 1e4);
        if (!(raised.top - raised.bottom > kSmallestScope))
          ++made_.empty;
        else
          apply(o.rules[0], raised, index, 1, hash32(seed, 1), depth + 1);
        break;
      }
      case Operator::SplitZ:
        split(o, volume, seed, depth);
        break;
      case Operator::Offset:
      case Operator::Jetty:
        offset(o, volume, index, seed, depth);
        break;
      case Operator::LeanTo:
        leanTo(o, volume, index, seed, depth);
        break;
      case Operator::Tower:
      case Operator::Turrets:
        towers(o, volume, seed, depth);
        break;
      case Operator::Comp:
        faces(o, volume, index, seed, depth);
        break;
      case Operator::Layer:
        for (uint32_t i = 0; i < o.rules.size(); ++i)
          apply(o.rules[i], volume, i, static_cast<uint32_t>(o.rules.size()), hash32(seed, i + 1), depth + 1);
        break;
      case Operator::Roof:
        roof(o, volume, seed);
        break;
      case Operator::Chimney:
        if (roof_)
          addChimney(builder_, *roof_, {number(o, 0), number(o, 1), number(o, 2)}, use_.looks[o.paints[0]], seed);
        break;
      case Operator::Dormer:
        dormers(o, seed);
        break;
      default:  // operators on walls mean nothing on a volume
        break;
    }
  }

  void split(const Operation& o, const Volume& volume, uint32_t seed, uint32_t depth) {
    const std::vector<double> sizes = splitSizes(style_, o, volume.top - volume.bottom, surrounding_, made_.squeezed);
    double from = volume.bottom;
    for (uint32_t i = 0; i < sizes.size(); ++i) {
      Volume part = volume;
      part.bottom = from, part.top = i + 1 == sizes.size() ? volume.top : from + sizes[i];
      part.below = i == 0 ? volume.below : 0, part.highest = volume.highest && i + 1 == sizes.size();
      from = part.top;
      if (part.top - part.bottom > kSmallestScope)
        apply(o.pieces[i].rule, part, i, static_cast<uint32_t>(sizes.size()), hash32(seed, i + 1), depth + 1);
      else
        ++made_.empty;
    }
  }

  /// The volume with its free walls (or only fronts) moved along their normals; nothing where that would make its
  /// outline cross itself.
  std::optional<Volume> movedOut(const Volume& volume, double distance, bool onlyFronts) const {
    Volume moved = volume;
    for (size_t r = 0; r < volume.rings.size(); ++r) {
      const Ring& ring = volume.rings[r];
      const size_t n = ring.size();
      std::vector<double> by(n, 0);
      for (size_t e = 0; e < n; ++e)
        if (!isParty(lot_, r, e) && (!onlyFronts || (r == 0 && faces_[r][e] == Face::Front))) by[e] = distance;
      for (size_t i = 0; i < n; ++i) moved.rings[r][i] = movedCorner(ring, by, i);
      for (size_t i = 0; i < n; ++i) {
        const dvec2 a = ring[i], b = ring[(i + 1) % n], c = moved.rings[r][(i + 1) % n], d = moved.rings[r][i];
        // Neither may the wall turn round nor the strip between it and its old place twist.
        const bool twisted = cross(b - a, c - a) * cross(c - a, d - a) < 0;
        if (twisted || !(glm::dot(b - a, c - d) > 0.05 * glm::dot(b - a, b - a))) return std::nullopt;
      }
    }
    if (!isSimple(moved.rings)) return std::nullopt;
    // A court may not have grown past the walls around it.
    for (size_t r = 1; r < moved.rings.size(); ++r)
      if (!isInside(moved.rings[0], moved.rings[r][0])) return std::nullopt;
    return moved;
  }

  /// Where the walls cannot move the volume stays as it is.
  void offset(const Operation& o, const Volume& volume, uint32_t index, uint32_t seed, uint32_t depth) {
    const std::optional<Volume> moved =
        movedOut(volume, std::clamp(number(o, 0), -20.0, 5.0), o.kind == Operator::Jetty);
    if (moved) {
      addRim(volume, *moved, moved->bottom);
      if (!moved->highest) addRim(*moved, volume, moved->top);
    }
    apply(o.rules[0], moved.value_or(volume), index, 1, hash32(seed, 1), depth + 1);
  }

  /// The free walls stand back behind a slope, the volume begins over it. Where there is no room it stays as it is.
  void leanTo(const Operation& o, const Volume& volume, uint32_t index, uint32_t seed, uint32_t depth) {
    const double distance = std::clamp(number(o, 0), 0.0, 20.0), rise = std::clamp(number(o, 1), 0.0, 20.0);
    std::optional<Volume> moved;
    if (distance > 0.05 && volume.top - volume.bottom > rise + 0.1) moved = movedOut(volume, -distance, false);
    if (!moved) return apply(o.rules[0], volume, index, 1, hash32(seed, 1), depth + 1);
    const PaintLook& covering = use_.looks[o.paints[0]];
    const PaintLook& plain = use_.looks[style_.plainPaint];
    moved->bottom += rise, moved->below = 0;
    builder_.beginLevel(static_cast<float>(volume.bottom), static_cast<float>(moved->bottom));
    for (size_t r = 0; r < volume.rings.size(); ++r)
      for (size_t e = 0; e < volume.rings[r].size(); ++e) {
        const size_t k = (e + 1) % volume.rings[r].size();
        const dvec3 a(volume.rings[r][e], volume.bottom), b(volume.rings[r][k], volume.bottom),
            c(moved->rings[r][k], moved->bottom), d(moved->rings[r][e], moved->bottom);
        const dvec3 normal = glm::cross(b - a, c - a) + glm::cross(c - a, d - a);
        if (!(glm::length(normal) > 1e-9)) continue;
        // What stands at a neighbour stays upright.
        const bool upright = isParty(lot_, r, e);
        const PaintLook& look = upright ? plain : covering;
        builder_.beginPlane(upright ? PlaneKind::Wall : PlaneKind::Roof, look.material,
                            glm::vec3(glm::normalize(normal)));
        const dvec3 along = glm::normalize(b - a), up = glm::normalize(glm::cross(normal, along));
        std::vector<glm::vec3> corners;
        for (const dvec3& p : {a, b, c, d})
          if (corners.empty() || (glm::vec3(p) != corners.back() && glm::vec3(p) != corners.front()))
            corners.emplace_back(p);
        builder_.addConvex(corners, glm::vec3(along), glm::vec3(up), look.material);
      }
    if (!moved->highest) addRim(*moved, volume, moved->top);
    apply(o.rules[0], *moved, index, 1, hash32(seed, 1), depth + 1);
  }

  /// Each tower is a house of its own by the same choices; its underside closes it.
  void towers(const Operation& o, const Volume& volume, uint32_t seed, uint32_t depth) {
    const double size = std::clamp(number(o, 0), 0.0, 100.0), height = std::clamp(number(o, 1), 0.0, 500.0);
    if (!(height > kSmallestScope)) return;
    std::vector<Ring> rings;
    if (o.kind == Operator::Tower) {
      if (std::optional<Ring> ring = endTower(volume.rings[0], size)) rings.push_back(std::move(*ring));
    } else if (size >= 0.5) {
      std::vector<uint8_t> party;
      for (size_t e = 0; e < volume.rings[0].size(); ++e) party.push_back(isParty(lot_, 0, e) ? 1 : 0);
      rings = cornerTurrets(volume.rings[0], party, size);
    }
    for (uint32_t i = 0; i < rings.size(); ++i) {
      Lot lot;
      lot.rings = {rings[i]};
      lot.bottom = lot_.bottom, lot.foundation = lot_.foundation;
      HouseFacts facts = facts_;
      facts.height = height, facts.width = glm::length(rings[i][1] - rings[i][0]);
      facts.area = facts.width * facts.width, facts.corners = 4;
      Builder tower(builder_, use_, lot, facts, made_);
      Volume body;
      body.rings = lot.rings, body.bottom = lot.bottom, body.top = lot.bottom + height, body.below = lot.foundation;
      tower.apply(o.rules[0], body, i, static_cast<uint32_t>(rings.size()), hash32(seed, i + 1), depth + 1);
      const PaintLook& look = use_.looks[style_.plainPaint];
      builder_.beginPlane(PlaneKind::Floor, look.material, {0, 0, -1}, false);
      std::array<glm::vec3, 4> corners;
      for (size_t k = 0; k < 4; ++k) corners[k] = glm::vec3(dvec3(rings[i][3 - k], lot.bottom - lot.foundation));
      builder_.addConvex(corners, {1, 0, 0}, {0, -1, 0}, look.material);
    }
  }

  /// The level strips between two outlines of one house: what the upper one hangs over, or stands back from.
  void addRim(const Volume& lower, const Volume& upper, double z) {
    const PaintLook& look = use_.looks[style_.plainPaint];
    for (size_t r = 0; r < lower.rings.size(); ++r)
      for (size_t i = 0; i < lower.rings[r].size(); ++i) {
        const size_t k = (i + 1) % lower.rings[r].size();
        const dvec2 a = lower.rings[r][i], b = lower.rings[r][k], c = upper.rings[r][k], d = upper.rings[r][i];
        const double area = cross(b - a, c - a) + cross(c - a, d - a);
        if (!(std::abs(area) > 1e-6)) continue;
        // Inward (to the left of the edge): a ledge that looks up; outward: an underside.
        builder_.beginPlane(PlaneKind::Floor, look.material, {0, 0, area > 0 ? 1 : -1}, false);
        const auto at = [&](dvec2 p) { return glm::vec3(dvec3(p, z)); };
        const std::array<glm::vec3, 4> corners{at(a), at(b), at(c), at(d)};
        builder_.addConvex(corners, {1, 0, 0}, {0, 1, 0}, look.material);
      }
  }

  void faces(const Operation& o, const Volume& volume, uint32_t index, uint32_t seed, uint32_t depth) {
    std::array<uint32_t, static_cast<size_t>(Face::Count)> ruleOf;
    ruleOf.fill(kNothing);
    for (const Piece& piece : o.pieces) ruleOf[static_cast<size_t>(piece.face)] = piece.rule;
    const auto ruleFor = [&](Face face) {
      // What is not named looks like the side, a party wall like nothing.
      const uint32_t own = ruleOf[static_cast<size_t>(face)];
      return own != kNothing || face == Face::Party ? own : ruleOf[static_cast<size_t>(Face::Side)];
    };
    builder_.beginLevel(static_cast<float>(volume.bottom - volume.below), static_cast<float>(volume.top));
    for (size_t r = 0; r < volume.rings.size(); ++r)
      for (size_t e = 0; e < volume.rings[r].size(); ++e) {
        const bool party = isParty(lot_, r, e);
        const Face face = party ? Face::Party : faces_[r][e];
        wall(volume, r, e, ruleFor(face), face,
             hash32(hash32(seed, static_cast<uint32_t>(r)), static_cast<uint32_t>(e) + 7));
      }
    if (const uint32_t top = ruleOf[static_cast<size_t>(Face::Roof)]; top != kNothing)
      apply(top, volume, index, 1, hash32(seed, 3), depth + 1);
    else if (volume.highest)
      addFlatRoof(builder_, volume.rings, volume.top, 0, use_.looks[style_.plainPaint], use_.looks[style_.plainPaint]);
  }

  void wall(const Volume& volume, size_t r, size_t e, uint32_t rule, Face face, uint32_t seed) {
    const Ring& ring = volume.rings[r];
    const dvec2 a = ring[e], b = ring[(e + 1) % ring.size()];
    const double length = glm::length(b - a);
    if (!(length > 0)) return;
    double foot = volume.bottom, below = volume.below;
    if (face == Face::Party) {
      const double start = neighbourAt(lot_, r, e) - kPartyOverlap;
      if (start > foot - below) below = std::max(0.0, foot - start), foot = std::max(foot, start);
      if (!(volume.top - foot > kPartyOverlap + 0.05)) return;
    }
    const double lowest = foot - below;
    builder_.addOccluder({glm::vec2(a), glm::vec2(b), static_cast<float>(lowest), static_cast<float>(volume.top)});
    // On a slope the ground floor stands on the ground: a wall is cut where that falls, like a row of houses that
    // climbs, and each piece stands on the highest ground along it. No window sinks, no door hangs far above.
    dvec2 ground(foot);
    if (face != Face::Party && (volume.below > 0 || std::max(groundAt(lot_, r, e).x, groundAt(lot_, r, e).y) > foot))
      ground = groundAt(lot_, r, e);
    const double fall = std::abs(ground.y - ground.x);
    const auto pieces = static_cast<uint32_t>(
        std::clamp(std::min(std::ceil(fall / kFallOfAWall), std::floor(length / kShortestPiece)), 1.0, 200.0));
    for (uint32_t i = 0; i < pieces; ++i) {
      const double from = static_cast<double>(i) / pieces, to = static_cast<double>(i + 1) / pieces;
      const double highest = std::max(glm::mix(ground.x, ground.y, from), glm::mix(ground.x, ground.y, to));
      const double stand = std::clamp(highest, lowest, std::max(lowest, volume.top - kLeastOverGround));
      WallFrame frame;
      frame.origin = dvec3(glm::mix(a, b, from), stand), frame.along = dvec3((b - a) / length, 0);
      frame.width = length * (to - from), frame.height = volume.top - stand, frame.below = stand - lowest;
      frame.thickness = thickness_;
      wallPiece(frame, rule, wallNumber_[r][e], i == 0 ? seed : hash32(seed, i));
    }
  }

  void wallPiece(const WallFrame& frame, uint32_t rule, uint32_t number, uint32_t seed) {
    WallDetail detail;
    if (rule != kNothing) detail = deriveWall(house_, rule, frame.width, frame.height, number, seed, made_);
    const PaintLook& plain = use_.looks[style_.plainPaint];
    const PaintLook& base = detail.fills.empty() ? plain : use_.looks[detail.fills[0].paint];
    builder_.beginPlane(PlaneKind::Wall, base.material, glm::vec3(frame.normal()));
    addWallDetail(builder_, frame, detail, use_.looks, style_.plainPaint);
    addFar(frame, detail, detail.fills.empty() ? style_.plainPaint : detail.fills[0].paint);
  }

  /// The wall as one picture, for far away: the style's bay in the colour of paint `base`, repeated where the wall has
  /// openings or pictures of them.
  void addFar(const WallFrame& frame, const WallDetail& detail, uint32_t base) {
    if (detail.attachments.empty() || style_.farPaint == kNothing) return;
    const PaintLook& look = use_.looks[style_.farPaint];
    const auto whole = [](double length, double size) {
      return static_cast<float>(std::max(1.0, std::round(std::min(length, 1e5) / size)));
    };
    const glm::vec2 repeats =
        glm::vec2(whole(frame.width, style_.bay.x), whole(frame.height, style_.bay.y)) * look.metresPerRepeat;
    builder_.beginFlat();
    builder_.addQuad(
        {frame.at(0, 0), frame.at(frame.width, 0), frame.at(frame.width, frame.height), frame.at(0, frame.height)},
        {{0, 0}, {repeats.x, 0}, repeats, {0, repeats.y}}, use_.farOf.empty() ? look.material : use_.farOf[base]);
    if (frame.below > 0)
      builder_.addQuad(frame.at(0, -frame.below), frame.at(frame.width, -frame.below), frame.at(frame.width, 0),
                       frame.at(0, 0), use_.looks[style_.plainPaint].material);
  }

  void roof(const Operation& o, const Volume& volume, uint32_t seed) {
    RoofRequest request;
    request.form = lot_.roof.value_or(static_cast<RoofKind>(o.what));
    request.pitch = std::clamp(number(o, 0), 0.0, 1.5);
    request.rise = lot_.roofRise > 0 ? lot_.roofRise : 0;
    const double overhang = std::clamp(number(o, 1), 0.0, 3.0);
    std::vector<std::vector<uint8_t>> party;
    for (size_t r = 0; r < volume.rings.size(); ++r) {
      std::vector<uint8_t>& edges = party.emplace_back();
      for (size_t e = 0; e < volume.rings[r].size(); ++e) edges.push_back(isParty(lot_, r, e) ? 1 : 0);
    }
    roof_ = BuiltRoof{roofOver(volume.rings, party, request), volume.top, {}};
    const PaintLook& covering = use_.looks[o.paints[0]];
    if (roof_->shape.surfaces.empty()) {
      builder_.beginLevel(static_cast<float>(volume.top), static_cast<float>(volume.top));
      addFlatRoof(builder_, volume.rings, volume.top, overhang, covering, use_.looks[style_.plainPaint]);
      return;
    }
    builder_.beginLevel(static_cast<float>(volume.top), static_cast<float>(volume.top + roof_->shape.height));
    for (const RoofSurface& surface : roof_->shape.surfaces) {
      if (!surface.gable) {
        addRoofSlope(builder_, surface, volume.top, covering, roof_->slopes);
        continue;
      }
      const Ring& ring = volume.rings[surface.ring];
      const dvec2 a = ring[surface.edge], b = ring[(surface.edge + 1) % ring.size()];
      WallFrame frame;
      frame.origin = dvec3(a, volume.top), frame.along = dvec3(glm::normalize(b - a), 0);
      frame.width = glm::length(b - a), frame.thickness = thickness_;
      for (const dvec3& p : surface.polygon) frame.height = std::max(frame.height, p.z);
      WallDetail detail;
      if (!isParty(lot_, surface.ring, surface.edge))
        detail = deriveWall(house_, o.rules[0], frame.width, frame.height, wallNumber_[surface.ring][surface.edge],
                            hash32(seed, surface.edge + 11), made_);
      addGable(builder_, surface, frame, detail, use_.looks, style_.plainPaint);
    }
    addEaves(builder_, volume.rings, party, *roof_, overhang, covering, use_.looks[style_.eavesPaint]);
  }

  void dormers(const Operation& o, uint32_t seed) {
    if (!roof_) return;
    const DormerSize size{number(o, 0), number(o, 1), number(o, 2)};
    for (const PlacedDormer& d : dormerPlaces(*roof_, faces_, size)) {
      const WallDetail detail = deriveWall(house_, o.rules[0], size.width, size.height, 0, seed, made_);
      addDormer(builder_, d, size, detail, use_.looks, use_.looks[o.paints[0]], style_.plainPaint);
    }
  }

  /// Numbers the walls of each side, the longest first.
  void numberWalls() {
    struct Wall {
      double length;
      size_t ring, edge;
    };
    std::vector<Wall> walls[static_cast<size_t>(Face::Count)];
    for (size_t r = 0; r < lot_.rings.size(); ++r) {
      const Ring& ring = lot_.rings[r];
      wallNumber_.emplace_back(ring.size(), 0);
      for (size_t e = 0; e < ring.size(); ++e)
        walls[static_cast<size_t>(isParty(lot_, r, e) ? Face::Party : faces_[r][e])].push_back(
            {glm::length(ring[(e + 1) % ring.size()] - ring[e]), r, e});
    }
    for (auto& side : walls) {
      std::stable_sort(side.begin(), side.end(), [](const Wall& a, const Wall& b) { return a.length > b.length; });
      for (uint32_t i = 0; i < side.size(); ++i) wallNumber_[side[i].ring][side[i].edge] = i;
    }
  }

  BuildingBuilder& builder_;
  const StyleInUse& use_;
  const Style& style_;
  const Lot& lot_;
  const HouseFacts facts_;
  StyledHouse house_;
  Surrounding surrounding_;
  Derivation& made_;
  std::vector<std::vector<Face>> faces_;
  std::vector<std::vector<uint32_t>> wallNumber_;
  std::optional<BuiltRoof> roof_;
  double thickness_ = 0.5;
};

}  // namespace

/// How much a wall counts beside a party wall when the front is looked for: terraces are up to three times as deep as a
/// house is wide.
constexpr double kFrontInRow = 3;

std::vector<std::vector<Face>> facesOf(const Lot& lot) {
  std::vector<std::vector<Face>> faces;
  dvec2 front(0, -1);
  double longest = -INFINITY;
  for (size_t e = 0; !lot.rings.empty() && e < lot.rings[0].size(); ++e) {
    const dvec2 d = lot.rings[0][(e + 1) % lot.rings[0].size()] - lot.rings[0][e];
    // Even where neighbours stand all round there is a side that was meant as the front. The end house of a row looks
    // at the street with the others: its front adjoins a party wall, its long free flank does not.
    const size_t n = lot.rings[0].size();
    const bool inRow = isParty(lot, 0, (e + n - 1) % n) || isParty(lot, 0, (e + 1) % n);
    const double length = glm::length(d) * (inRow ? kFrontInRow : 1) - (isParty(lot, 0, e) ? 1e6 : 0);
    if (glm::length(d) > 0 && length > longest) longest = length, front = dvec2(d.y, -d.x) / glm::length(d);
  }
  for (size_t r = 0; r < lot.rings.size(); ++r) {
    std::vector<Face>& ring = faces.emplace_back();
    for (size_t e = 0; e < lot.rings[r].size(); ++e) {
      const dvec2 d = lot.rings[r][(e + 1) % lot.rings[r].size()] - lot.rings[r][e];
      const double length = glm::length(d), same = length > 0 ? glm::dot(dvec2(d.y, -d.x) / length, front) : 0;
      ring.push_back(r > 0 ? Face::Back : same > 0.5 ? Face::Front : same < -0.5 ? Face::Back : Face::Side);
    }
  }
  return faces;
}

void addHouse(BuildingBuilder& builder, const StyleInUse& use, const Lot& lot, Derivation& made) {
  if (lot.rings.empty() || lot.rings[0].size() < 3 || use.style->house == kNothing) return;
  HouseFacts facts = lot.facts;
  facts.area = 0, facts.corners = 0, facts.width = 0;
  for (const Ring& ring : lot.rings) facts.area += areaOf(ring), facts.corners += static_cast<double>(ring.size());
  const std::vector<std::vector<Face>> faces = facesOf(lot);
  for (size_t e = 0; e < lot.rings[0].size(); ++e)
    if (faces[0][e] == Face::Front)
      facts.width = std::max(facts.width, glm::length(lot.rings[0][(e + 1) % lot.rings[0].size()] - lot.rings[0][e]));
  Builder house(builder, use, lot, facts, made);
  Volume ground;
  ground.rings = lot.rings, ground.bottom = ground.top = lot.bottom, ground.below = lot.foundation;
  house.apply(use.style->house, ground, 0, 1, facts.seed, 1);
}

}  // namespace vicus::facade
