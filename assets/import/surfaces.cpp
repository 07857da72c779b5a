#include "assets/import/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "assets/import/face_mesh.hpp"
#include "assets/import/face_occluder.hpp"
#include "assets/import/polygon.hpp"
#include "assets/import/shells.hpp"

namespace vicus::assets {
namespace {

using city::PlaneKind;

/// Walls lean at most this far (|normal.z|): 17°.
constexpr double kWallSlope = 0.3;
/// Walls whose feet hang higher than this above the ground stand on something else: metres.
constexpr double kLongestSkirt = 2.5;
constexpr double kSkirtDepth = 0.3;

SurfaceKind kindFrom(const Face& face, const std::vector<glm::dvec3>& points, double lowest) {
  if (face.kind != SurfaceKind::Unknown) return face.kind;
  if (std::abs(face.normal.z) <= kWallSlope) return SurfaceKind::Wall;
  if (face.normal.z > 0 || face.bothSides) return SurfaceKind::Roof;
  double highest = -INFINITY;
  for (const uint32_t i : face.rings[0]) highest = std::max(highest, points[i].z);
  return highest < lowest + 0.5 ? SurfaceKind::Ground : SurfaceKind::Other;
}

/// Extent of a face along its axes, from the geometry's origin.
struct Span {
  double left = INFINITY, right = -INFINITY, bottom = INFINITY, top = -INFINITY;
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

Span spanOf(const Face& face, const Axes& axes, const std::vector<glm::dvec3>& points) {
  Span s;
  for (const uint32_t i : face.rings[0]) {
    const double u = glm::dot(points[i], axes.u);
    s.left = std::min(s.left, u), s.right = std::max(s.right, u);
    s.bottom = std::min(s.bottom, points[i].z), s.top = std::max(s.top, points[i].z);
  }
  return s;
}

/// Puts faces into a BuildingBuilder.
class SurfaceBuilder {
 public:
  SurfaceBuilder(city::BuildingBuilder& builder, const std::vector<glm::dvec3>& points, const SurfaceOptions& options,
                 SurfaceReport& report, double lowest)
      : builder_(builder), points_(points), options_(options), report_(report), lowest_(lowest) {
    if (options.rules && options.rules->style->facade != facade::kNothing)
      house_.emplace(*options.rules->style, options.facts, options.rules->parameters);
  }

  void add(const Face& face);
  bool any() const { return any_; }
  /// Mean gap between the building's feet and the ground; 0 where the ground is not known.
  double floating() const { return gaps_ > 0 ? gapSum_ / gaps_ : 0; }

 private:
  double facadeFoot(const Face& face, const Span& span) const;
  facade::WallDetail detailOf(const Face& face, const Axes& axes, const facade::WallFrame& frame);
  void addSkirt(const Face& face, const Axes& axes, bool wallHides);

  city::BuildingBuilder& builder_;
  const std::vector<glm::dvec3>& points_;
  const SurfaceOptions& options_;
  SurfaceReport& report_;
  double lowest_;
  std::optional<facade::StyledHouse> house_;
  facade::Derivation made_;
  uint32_t walls_ = 0;
  bool hasFlat_ = false;                                 ///< the wall being added has a surface for far away
  city::MaterialId wallMaterial_ = id(Finish::Plaster);  ///< of the wall being added
  bool any_ = false;
  double gapSum_ = 0;
  int gaps_ = 0;
};

void SurfaceBuilder::add(const Face& face) {
  const Axes axes = axesOf(face, points_);
  const FaceMesh mesh = meshOf(face, axes, points_, report_);
  if (mesh.triangles.empty()) {
    ++report_.leftOut;
    return;
  }
  any_ = true;
  const Span span = spanOf(face, axes, points_);
  const double area = glm::length(face.areaVector);
  PlaneKind plane = PlaneKind::Other;
  Finish finish = options_.style.plain;
  int bays = 0;
  switch (face.kind) {
    case SurfaceKind::Wall: {
      plane = PlaneKind::Wall;
      // Windows only on upright walls that fill the rectangle around them.
      const bool rectangle = std::abs(face.normal.z) < 0.1 && area > 0.97 * span.width() * span.height();
      if (rectangle && span.height() >= kSmallestFacadeHeight) bays = baysIn(span.width());
      if (face.material != kNoMaterial) bays = 0;
      if (bays > 0) finish = options_.style.facade;
      break;
    }
    case SurfaceKind::Roof:
      plane = PlaneKind::Roof;
      finish = face.normal.z > 0.98 ? Finish::Concrete : options_.style.roof;  // flatter than 11°
      break;
    case SurfaceKind::Window:
      finish = Finish::Glass;
      break;
    case SurfaceKind::Door:
      finish = Finish::Door;
      break;
    default:
      break;
  }
  const bool painted = face.material < options_.materials.size();
  const bool byRules = face.kind == SurfaceKind::Wall && face.material == kNoMaterial && house_ &&
                       std::abs(face.normal.z) < 0.1 && !face.bothSides && span.height() >= kSmallestFacadeHeight;
  const double foot = bays > 0 || byRules ? facadeFoot(face, span) : span.bottom, storeys = storeysIn(span.top - foot);
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> uvs, farUvs;
  facade::WallFrame frame;
  facade::WallDetail detail;
  city::MaterialId material = painted ? options_.materials[face.material] : id(finish);
  city::MaterialId farMaterial = 0;
  if (byRules) {
    const glm::dvec3& p = points_[face.rings[0][0]];
    frame.origin = p + axes.u * (span.left - glm::dot(p, axes.u)), frame.origin.z = foot;
    frame.along = axes.u, frame.width = span.width(), frame.height = span.top - foot;
    detail = detailOf(face, axes, frame);
    const facade::Style& rules = *options_.rules->style;
    const uint32_t base = detail.fills.empty() ? rules.plainPaint : detail.fills[0].paint;
    material = options_.rules->looks[base].material;
    if (rules.farPaint != facade::kNothing)
      farMaterial =
          options_.rules->farOf.empty() ? options_.rules->looks[rules.farPaint].material : options_.rules->farOf[base];
  }
  hasFlat_ = false;
  wallMaterial_ = byRules ? material : id(options_.style.plain);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec3& p = mesh.positions[i];
    positions.emplace_back(p);
    if (painted && !mesh.uvs.empty()) {
      uvs.push_back(mesh.uvs[i]);
      continue;
    }
    const double u = glm::dot(p, axes.u), v = glm::dot(p, axes.v);
    const glm::vec2 inBays((u - span.left) / span.width() * std::max(bays, 1),
                           (p.z - foot) / (span.top - foot) * storeys);
    farUvs.push_back(inBays);
    uvs.push_back(bays > 0 && !byRules ? inBays : glm::vec2(u, plane == PlaneKind::Wall ? p.z : v));
  }
  const bool opening = face.kind == SurfaceKind::Window || face.kind == SurfaceKind::Door;
  const bool seeThrough = opening || (painted && options_.mayHaveHoles[face.material] != 0);
  builder_.beginPlane(plane, material, glm::vec3(face.normal), !seeThrough);
  builder_.addTriangles(positions, uvs, mesh.triangles, glm::vec3(face.normal), material);
  if (byRules && !detail.attachments.empty()) {
    for (const facade::Attachment& a : detail.attachments)
      facade::addShape(builder_, frame, a, options_.rules->looks, options_.rules->style->plainPaint);
    if (bays > 0 && options_.rules->style->farPaint != facade::kNothing) {
      hasFlat_ = true;
      builder_.beginFlat();
      builder_.addTriangles(positions, farUvs, mesh.triangles, glm::vec3(face.normal), farMaterial);
    }
    builder_.beginCut();
  }
  if (face.bothSides) {
    std::vector<uint32_t> back(mesh.triangles);
    for (size_t t = 0; t + 2 < back.size(); t += 3) std::swap(back[t + 1], back[t + 2]);
    builder_.addTriangles(positions, uvs, back, glm::vec3(-face.normal), material);
  }
  if (face.kind == SurfaceKind::Wall) {
    // A picture may have holes, through which one sees.
    const bool holes = painted && options_.mayHaveHoles[face.material] != 0;
    const auto line = holes ? std::nullopt : occluderOf(face, axes, points_);
    if (line) builder_.addOccluder(*line);
    if (options_.groundAt) addSkirt(face, axes, line.has_value());
  }
}

/// What the rules make of a wall: the shapes that lie within its outline. Holes are not cut into walls that come with
/// their own form, so openings become pictures.
facade::WallDetail SurfaceBuilder::detailOf(const Face& face, const Axes& axes, const facade::WallFrame& frame) {
  // Which wall looks at a street is not known: every one that stands on the ground may have the door.
  const bool onTheGround = frame.origin.z < lowest_ + kLongestSkirt;
  facade::WallDetail detail = facade::deriveWall(*house_, options_.rules->style->facade, frame.width, frame.height,
                                                 onTheGround ? 0 : 5, options_.facts.seed + walls_++, made_);
  std::vector<Ring> outline;
  for (const auto& ring : face.rings) {
    Ring& line = outline.emplace_back();
    for (const uint32_t i : ring)
      line.emplace_back(glm::dot(points_[i] - frame.origin, axes.u), points_[i].z - frame.origin.z);
  }
  std::erase_if(detail.attachments, [&](const facade::Attachment& a) {
    constexpr double kEdge = 0.01;  // shapes may touch the wall's edges
    const double left = a.rect.left + kEdge, bottom = a.rect.bottom + kEdge, right = a.rect.right - kEdge,
                 top = a.rect.top - kEdge;
    for (const glm::dvec2 corner : {glm::dvec2(left, bottom), {right, bottom}, {right, top}, {left, top}})
      for (size_t r = 0; r < outline.size(); ++r)
        if (insideRing(outline[r], corner) != (r == 0)) return true;
    for (const Ring& ring : outline)
      for (const glm::dvec2& p : ring)
        if (p.x > left && p.x < right && p.y > bottom && p.y < top) return true;
    return false;
  });
  for (facade::Attachment& a : detail.attachments)
    if (a.shape == facade::Shape::Opening) a.shape = facade::Shape::Panel, a.depth = 0.02;
  return detail;
}

/// Where the lowest storey of a wall begins: at its foot, or where the ground stands higher against it, there, so that
/// no window sinks. Where the ground slopes along the wall it may stand against the lowest storey up to below its
/// sills. At least one storey of the wall is left.
double SurfaceBuilder::facadeFoot(const Face& face, const Span& span) const {
  if (!options_.groundAt) return span.bottom;
  constexpr double kBelowSill = 0.6;  // metres; sills lie 0.85 m above the floor
  double lowest = INFINITY, highest = span.bottom;
  const auto& ring = face.rings[0];
  for (size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec3 a = points_[ring[i]], b = points_[ring[(i + 1) % ring.size()]];
    for (const glm::dvec3& p : {a, (a + b) / 2.0})
      if (const double h = options_.groundAt(glm::dvec2(p)); std::isfinite(h))
        lowest = std::min(lowest, h), highest = std::max(highest, h);
  }
  const double foot = std::max({span.bottom, std::min(lowest, highest), highest - kBelowSill});
  return std::min(foot, std::max(span.bottom, span.top - kSmallestFacadeHeight));
}

/// Lengthens a wall's foot to below the ground, in the wall's own plane. Under a wall that hides what is behind it, the
/// added piece does too: up to the higher of its two upper corners, above the lower of which the wall itself begins.
void SurfaceBuilder::addSkirt(const Face& face, const Axes& axes, bool wallHides) {
  const auto& ring = face.rings[0];
  double foot = INFINITY;
  for (const uint32_t i : ring) foot = std::min(foot, points_[i].z);
  for (size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec3 a = points_[ring[i]], b = points_[ring[(i + 1) % ring.size()]];
    constexpr double kLevel = 0.05;
    if (glm::dot(b - a, axes.u) <= 0 || a.z > foot + kLevel || b.z > foot + kLevel) continue;
    const glm::dvec3 middle = (a + b) / 2.0;
    double ground = INFINITY;
    for (const glm::dvec3& p : {a, middle, b}) {
      const double h = options_.groundAt(glm::dvec2(p));
      if (std::isfinite(h)) ground = std::min(ground, h);
    }
    if (!std::isfinite(ground)) continue;
    const double gap = foot - ground;
    const bool onTheGround = foot < lowest_ + kSkirtDepth;
    if (onTheGround) gapSum_ += gap, ++gaps_;
    if (gap < -kSkirtDepth || (gap > kLongestSkirt && !onTheGround)) continue;
    const double bottom = ground - kSkirtDepth;
    const auto lowered = [&](const glm::dvec3& p) { return glm::vec3(glm::dvec3(glm::dvec2(p), bottom)); };
    builder_.addQuad(lowered(a), lowered(b), glm::vec3(b), glm::vec3(a), wallMaterial_);
    if (hasFlat_) {
      builder_.beginFlat();
      builder_.addQuad(lowered(a), lowered(b), glm::vec3(b), glm::vec3(a), wallMaterial_);
      builder_.beginCut();
    }
    if (face.bothSides) builder_.addQuad(lowered(b), lowered(a), glm::vec3(a), glm::vec3(b), wallMaterial_);
    if (wallHides)
      builder_.addOccluder(
          {glm::vec2(a), glm::vec2(b), static_cast<float>(bottom), static_cast<float>(std::max(a.z, b.z))});
  }
}

std::vector<std::vector<glm::vec2>> footprintOf(const std::vector<Face>& faces, const std::vector<glm::dvec3>& points) {
  std::vector<std::vector<glm::vec2>> out;
  for (const SurfaceKind kind : {SurfaceKind::Ground, SurfaceKind::Roof}) {
    for (const Face& f : faces) {
      if (f.kind != kind || std::abs(f.normal.z) < kWallSlope) continue;
      for (size_t r = 0; r < f.rings.size(); ++r) {
        Ring ring;
        for (const uint32_t i : f.rings[r]) ring.emplace_back(points[i]);
        if ((signedArea(ring) > 0) != (r == 0)) std::reverse(ring.begin(), ring.end());
        auto& line = out.emplace_back();
        for (const glm::dvec2& q : ring) line.emplace_back(q);
      }
    }
    if (!out.empty()) break;
  }
  return out;
}

}  // namespace

std::optional<city::BuildingGeometry> buildFromSurfaces(const SurfaceBuilding& building, std::string name,
                                                        const SurfaceOptions& options, SurfaceReport& report) {
  std::vector<glm::dvec3> points;
  std::vector<Face> faces = facesOf(building, points, report);
  if (faces.empty()) return std::nullopt;
  windOutward(faces, points, report);
  if (closeShells(faces, points, report)) windOutward(faces, points, report);
  double lowest = INFINITY, highest = -INFINITY, eaves = -INFINITY;
  for (const Face& f : faces)
    for (const uint32_t i : f.rings[0])
      lowest = std::min(lowest, points[i].z), highest = std::max(highest, points[i].z);
  for (Face& f : faces) f.kind = kindFrom(f, points, lowest);

  city::BuildingBuilder builder(std::move(name));
  SurfaceBuilder surfaces(builder, points, options, report, lowest);
  for (const Face& f : faces)
    if (f.kind == SurfaceKind::Wall)
      for (const uint32_t i : f.rings[0]) eaves = std::max(eaves, points[i].z);
  builder.beginLevel(static_cast<float>(lowest), static_cast<float>(std::isfinite(eaves) ? eaves : highest));
  for (const Face& f : faces)
    if (f.kind != SurfaceKind::Roof && f.kind != SurfaceKind::Ground) surfaces.add(f);
  double roofFoot = highest;
  for (const Face& f : faces)
    if (f.kind == SurfaceKind::Roof)
      for (const uint32_t i : f.rings[0]) roofFoot = std::min(roofFoot, points[i].z);
  builder.beginLevel(static_cast<float>(roofFoot), static_cast<float>(highest));
  for (const Face& f : faces)
    if (f.kind == SurfaceKind::Roof) surfaces.add(f);
  if (!surfaces.any()) return std::nullopt;
  report.floating = surfaces.floating();
  builder.setFootprint(footprintOf(faces, points));
  return builder.finish();
}

}  // namespace vicus::assets
