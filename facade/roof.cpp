/// Based on: Laycock and Day 2003, "Automatically Generating Roof Models from Building Footprints" (a skeleton's
/// distances give the heights; other profiles over the same distances give mansards, gambrels and domes).
#include "facade/roof.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "facade/hip_roof.hpp"
#include "facade/triangulate.hpp"

namespace vicus::facade {
namespace {

/// Metres that a roof of this pitch rises at most, where shallow ones rise to `shallow`.
double highestFor(double pitch, double shallow) {
  return pitch >= kSteepPitch ? std::max(kHighestSteepRoof, shallow) : shallow;
}

using glm::dvec2;
using glm::dvec3;

double cross(dvec2 a, dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// Height over distance from the eaves: straight between its points, the first at (0, 0).
using Profile = std::vector<dvec2>;

double heightAt(const Profile& profile, double distance) {
  for (size_t i = 1; i < profile.size(); ++i)
    if (distance <= profile[i].x || i + 1 == profile.size()) {
      const dvec2 a = profile[i - 1], b = profile[i];
      return a.y + (b.y - a.y) * (b.x > a.x ? (distance - a.x) / (b.x - a.x) : 0);
    }
  return 0;
}

Profile profileOf(RoofKind form, double tangent, double reach) {
  Profile p{{0, 0}};
  if (form == RoofKind::Mansard || form == RoofKind::Gambrel) {
    const double knee = form == RoofKind::Mansard ? std::min(1.3, 0.4 * reach) : 0.4 * reach;
    const double steep = form == RoofKind::Mansard ? 2.6 : 1.6;
    p.emplace_back(knee, knee * steep);
    p.emplace_back(reach, p.back().y + (reach - knee) * std::min(tangent, 0.7));
  } else if (form == RoofKind::Dome) {
    constexpr int kBands = 5;
    for (int i = 1; i <= kBands; ++i) {
      const double angle = std::numbers::pi / 2 * i / kBands;
      p.emplace_back(reach * (1 - std::cos(angle)), reach * tangent * std::sin(angle));
    }
  } else {
    p.emplace_back(reach, reach * tangent);
  }
  return p;
}

/// The part of a polygon whose z lies between two heights.
std::vector<dvec3> band(const std::vector<dvec3>& polygon, double low, double high) {
  const auto clip = [](const std::vector<dvec3>& in, double at, double sign) {
    std::vector<dvec3> out;
    for (size_t i = 0; i < in.size(); ++i) {
      const dvec3 &a = in[i], &b = in[(i + 1) % in.size()];
      const double da = sign * (a.z - at), db = sign * (b.z - at);
      if (da >= 0) out.push_back(a);
      if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
        dvec3 p = a + (b - a) * (da / (da - db));
        p.z = at;
        out.push_back(p);
      }
    }
    return out;
  };
  return clip(clip(polygon, low, 1), high, -1);
}

bool isConvex(const Ring& ring) {
  for (size_t i = 0; i < ring.size(); ++i) {
    const dvec2 a = ring[i], b = ring[(i + 1) % ring.size()], c = ring[(i + 2) % ring.size()];
    if (!(cross(b - a, c - b) > 0)) return false;
  }
  return ring.size() >= 3;
}

/// Slopes by the profile over the distances that `pieces` hold as heights.
void raise(const std::vector<RoofPiece>& pieces, const Profile& profile, RoofShape& roof) {
  for (const RoofPiece& piece : pieces) {
    const auto lift = [&](std::vector<dvec3> polygon) {
      for (dvec3& p : polygon) {
        p.z = heightAt(profile, p.z);
        roof.height = std::max(roof.height, p.z);
      }
      if (polygon.size() >= 3) roof.surfaces.push_back({piece.ring, piece.edge, piece.gable, std::move(polygon)});
    };
    if (profile.size() == 2) {
      lift(piece.polygon);
    } else if (piece.gable) {
      // One face whose rim bends where the slopes do.
      std::vector<dvec3> rim;
      for (size_t i = 0; i < piece.polygon.size(); ++i) {
        const dvec3 &a = piece.polygon[i], &b = piece.polygon[(i + 1) % piece.polygon.size()];
        rim.push_back(a);
        std::vector<double> knees;
        for (size_t k = 1; k + 1 < profile.size(); ++k)
          if ((profile[k].x - a.z) * (profile[k].x - b.z) < 0) knees.push_back((profile[k].x - a.z) / (b.z - a.z));
        std::sort(knees.begin(), knees.end());
        for (const double t : knees) rim.push_back(a + (b - a) * t);
      }
      lift(std::move(rim));
    } else {
      // Bands of a face that is not convex may fall apart: its triangles' bands do not.
      Ring plan;
      for (const dvec3& p : piece.polygon) plan.emplace_back(p);
      std::vector<std::vector<dvec3>> parts{piece.polygon};
      if (!isConvex(plan)) {
        parts.clear();
        const std::vector<uint32_t> triangles = triangulate({&plan, 1});
        for (size_t t = 0; t + 2 < triangles.size(); t += 3)
          parts.push_back(
              {piece.polygon[triangles[t]], piece.polygon[triangles[t + 1]], piece.polygon[triangles[t + 2]]});
      }
      for (const auto& part : parts)
        for (size_t k = 1; k < profile.size(); ++k) lift(band(part, profile[k - 1].x, profile[k].x));
    }
  }
}

/// Two slopes that meet over the middle of two opposite edges, which become gables.
///
///      3 ────────── 2
///      │ ╲          │        ridge from the middle of 3–0 to the middle of 1–2
///    m ├──────────── n       where 1–2 and 3–0 become gables
///      │            │
///      0 ────────── 1
RoofShape gableOverFour(const Ring& ring, const std::vector<uint8_t>& party, const RoofRequest& request) {
  const auto length = [&](size_t i) { return glm::length(ring[(i + 1) % 4] - ring[i]); };
  const int against02 = party.empty() ? 0 : party[0] + party[2], against13 = party.empty() ? 0 : party[1] + party[3];
  // Ridges of a terrace run along the street; of a house that shows its gable, away from it.
  bool along0 = against02 != against13 ? against13 > against02 : length(0) + length(2) >= length(1) + length(3);
  if (request.form == RoofKind::GableFront) along0 = against02 != against13 ? against02 > against13 : along0;
  const uint32_t s = along0 ? 0 : 1;
  const auto corner = [&](uint32_t i) { return ring[(s + i) % 4]; };
  const dvec2 n = (corner(1) + corner(2)) / 2.0, m = (corner(3) + corner(0)) / 2.0;
  const double width = (length((s + 1) % 4) + length((s + 3) % 4)) / 2;
  RoofShape roof;
  roof.built = request.form;
  roof.height = request.rise > 0
                    ? request.rise
                    : std::min(highestFor(request.pitch, 1.6 * kHighestRoof), width / 2 * std::tan(request.pitch));
  if (request.form == RoofKind::Gable && !(request.rise > 0))
    roof.height = std::min(roof.height, highestFor(request.pitch, kHighestRoof));
  // Half-hips cut the gables' tips off: the ridge ends that far inside.
  const bool cutTips = request.form == RoofKind::HalfHip;
  constexpr double kTip = 0.4;
  const double inside = cutTips ? std::min(0.35, kTip * width / 2 / std::max(1e-9, glm::length(n - m))) : 0;
  const dvec3 ridgeN(n + (m - n) * inside, roof.height), ridgeM(m + (n - m) * inside, roof.height);
  const auto flat = [&](uint32_t i) { return dvec3(corner(i), 0); };
  const auto rake = [&](uint32_t i, dvec2 top) { return flat(i) + (dvec3(top, roof.height) - flat(i)) * (1 - kTip); };
  const auto side = [&](uint32_t edge, dvec2 overA, dvec2 overB, dvec3 ridgeA, dvec3 ridgeB) {
    const uint32_t e = (s + edge) % 4;
    std::vector<dvec3> slope{flat(edge), flat(edge + 1)};
    if (cutTips) slope.push_back(rake(edge + 1, overB));
    slope.push_back(ridgeB), slope.push_back(ridgeA);
    if (cutTips) slope.push_back(rake(edge, overA));
    // Flat where eave and ridge are parallel, else a fan from the eave's start.
    const dvec2 eave = glm::normalize(dvec2(slope[1] - slope[0])), top = glm::normalize(dvec2(ridgeB - ridgeA));
    if (std::abs(cross(eave, top)) < 1e-3) {
      roof.surfaces.push_back({0, e, false, slope});
    } else {
      for (size_t i = 1; i + 1 < slope.size(); ++i)
        roof.surfaces.push_back({0, e, false, {slope[0], slope[i], slope[i + 1]}});
    }
  };
  side(0, m, n, ridgeM, ridgeN);
  side(2, n, m, ridgeN, ridgeM);
  const auto end = [&](uint32_t edge, dvec2 top, dvec3 ridge) {
    const uint32_t e = (s + edge) % 4;
    if (!cutTips) {
      roof.surfaces.push_back({0, e, true, {flat(edge), flat(edge + 1), dvec3(top, roof.height)}});
      return;
    }
    const dvec3 left = rake(edge, top), right = rake(edge + 1, top);
    roof.surfaces.push_back({0, e, true, {flat(edge), flat(edge + 1), right, left}});
    roof.surfaces.push_back({0, e, false, {left, right, ridge}});
  };
  end(1, n, ridgeN);
  end(3, m, ridgeM);
  return roof;
}

/// One slope that falls to the longest edge; the walls under its other sides reach up to it.
RoofShape shedOverFour(const Ring& ring, const RoofRequest& request) {
  const auto length = [&](size_t i) { return glm::length(ring[(i + 1) % 4] - ring[i]); };
  const uint32_t s = length(0) + length(2) >= length(1) + length(3) ? 0 : 1;
  const auto low = [&](uint32_t i) { return dvec3(ring[(s + i) % 4], 0); };
  RoofShape roof;
  roof.built = RoofKind::Shed;
  const double depth = (length((s + 1) % 4) + length((s + 3) % 4)) / 2;
  roof.height = request.rise > 0 ? request.rise : std::min(kHighestRoof, depth * std::tan(request.pitch / 2));
  const auto high = [&](uint32_t i) { return dvec3(ring[(s + i) % 4], roof.height); };
  roof.surfaces.push_back({0, s % 4, false, {low(0), low(1), high(2)}});
  roof.surfaces.push_back({0, s % 4, false, {low(0), high(2), high(3)}});
  roof.surfaces.push_back({0, (s + 1) % 4, true, {low(1), low(2), high(2)}});
  roof.surfaces.push_back({0, (s + 2) % 4, true, {low(2), low(3), high(3), high(2)}});
  roof.surfaces.push_back({0, (s + 3) % 4, true, {low(3), low(0), high(3)}});
  return roof;
}

/// Slopes from every eave of a convex outline to one point over its middle; the steepest has the pitch asked for.
RoofShape pyramidOver(const Ring& ring, const RoofRequest& request) {
  dvec2 middle(0);
  double area = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const dvec2 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    middle += (a + b) * (cross(a, b) / 6), area += cross(a, b) / 2;
  }
  middle = ring[0] + middle / area;
  double run = INFINITY;
  for (size_t i = 0; i < ring.size(); ++i) {
    const dvec2 d = glm::normalize(ring[(i + 1) % ring.size()] - ring[i]);
    run = std::min(run, std::abs(cross(d, middle - ring[i])));
  }
  RoofShape roof;
  roof.built = RoofKind::Pyramid;
  roof.height = request.rise > 0
                    ? request.rise
                    : std::min(request.pitch >= kSpirePitch ? kHighestSpire : highestFor(request.pitch, kHighestRoof),
                               run * std::tan(request.pitch));
  for (uint32_t i = 0; i < ring.size(); ++i)
    roof.surfaces.push_back(
        {0, i, false, {dvec3(ring[i], 0), dvec3(ring[(i + 1) % ring.size()], 0), dvec3(middle, roof.height)}});
  return roof;
}

}  // namespace

bool isNearlyRectangular(std::span<const Ring> rings) {
  if (rings.size() != 1 || rings[0].size() != 4 || !isConvex(rings[0])) return false;
  for (size_t i = 0; i < 4; ++i) {
    const dvec2 a = rings[0][(i + 1) % 4] - rings[0][i], b = rings[0][(i + 2) % 4] - rings[0][(i + 1) % 4];
    if (std::abs(glm::dot(a, b)) > 0.5 * glm::length(a) * glm::length(b)) return false;
  }
  return true;
}

RoofShape roofOver(std::span<const Ring> rings, std::span<const std::vector<uint8_t>> party,
                   const RoofRequest& request) {
  if (rings.empty() || rings[0].size() < 3 || request.form == RoofKind::Flat) return {};
  const bool four = isNearlyRectangular(rings);
  const bool twoSlopes =
      request.form == RoofKind::Gable || request.form == RoofKind::GableFront || request.form == RoofKind::HalfHip;
  if (four && twoSlopes) return gableOverFour(rings[0], party.empty() ? std::vector<uint8_t>() : party[0], request);
  if (four && request.form == RoofKind::Shed) return shedOverFour(rings[0], request);
  if (request.form == RoofKind::Pyramid && rings.size() == 1 && isConvex(rings[0]))
    return pyramidOver(rings[0], request);

  // Gables: where neighbours stand; and of a house that shows gables, wherever the skeleton has a hip that can be one.
  std::vector<std::vector<uint8_t>> gables;
  const bool all = twoSlopes || request.form == RoofKind::Gambrel;
  for (size_t r = 0; r < rings.size(); ++r) {
    gables.emplace_back(rings[r].size(), static_cast<uint8_t>(request.form == RoofKind::GableFront || (all && four)));
    if (r < party.size())
      for (size_t e = 0; e < std::min(rings[r].size(), party[r].size()); ++e)
        if (party[r][e]) gables[r][e] = 1;
  }
  const auto distances = hipRoof(rings, gables, 1, INFINITY);
  if (!distances || !(distances->reach > 0) || distances->reach > kWidestSlope) return {};
  RoofShape roof;
  roof.built =
      twoSlopes || request.form == RoofKind::Shed || request.form == RoofKind::Pyramid ? RoofKind::Hip : request.form;
  const bool steep = roof.built != RoofKind::Hip;
  Profile profile = profileOf(roof.built, std::tan(request.pitch), distances->reach);
  const double top = profile.back().y, most = steep ? kHighestSteepRoof : highestFor(request.pitch, kHighestRoof);
  const double scale = request.rise > 0 ? request.rise / top : std::min(1.0, most / top);
  for (dvec2& p : profile) p.y *= scale;
  raise(distances->pieces, profile, roof);
  return roof;
}

}  // namespace vicus::facade
