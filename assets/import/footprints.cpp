#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "assets/import/assembly.hpp"
#include "assets/import/columns.hpp"
#include "assets/import/parallel.hpp"

namespace vicus::assets {
namespace {

/// Where an edge lies, whichever way it runs.
uint64_t edgeKey(glm::dvec2 a, glm::dvec2 b) {
  if (b.x < a.x || (b.x == a.x && b.y < a.y)) std::swap(a, b);
  uint64_t h = 1469598103934665603ULL;
  for (const double v : {a.x, a.y, b.x, b.y}) {
    h ^= static_cast<uint64_t>(static_cast<int64_t>(v / kSnap));
    h *= 0x9e3779b97f4a7c15ULL;
    h ^= h >> 29;
  }
  return h;
}

/// An edge of one part of one building, and how high that stands: metres above the city's origin.
struct EdgeUse {
  uint64_t key;
  uint32_t building, part;
  double bottom, top;
};

/// Enters for each edge how high the building stands that shares it, in steps of 0.25 m, so that equal footprints in
/// equal surroundings remain equal.
void markNeighbours(std::vector<Extrusion>& extrusions, const std::vector<glm::dvec2>& middles,
                    const std::vector<double>& bases) {
  std::vector<std::vector<EdgeUse>> own(extrusions.size());
  parallelFor(extrusions.size(), 256, [&](size_t i) {
    for (uint32_t p = 0; p < extrusions[i].parts.size(); ++p) {
      const Extrusion::Part& part = extrusions[i].parts[p];
      for (const Ring& ring : part.polygon.rings)
        for (size_t k = 0; k < ring.size(); ++k)
          own[i].push_back({edgeKey(ring[k] + middles[i], ring[(k + 1) % ring.size()] + middles[i]),
                            static_cast<uint32_t>(i), p, bases[i] + part.bottom, bases[i] + part.height});
    }
  });
  std::vector<EdgeUse> all;
  for (const auto& list : own) all.insert(all.end(), list.begin(), list.end());
  const auto before = [](const EdgeUse& a, const EdgeUse& b) { return a.key < b.key; };
  std::sort(all.begin(), all.end(), before);
  parallelFor(extrusions.size(), 256, [&](size_t i) {
    size_t next = 0;
    for (uint32_t p = 0; p < extrusions[i].parts.size(); ++p) {
      Extrusion::Part& part = extrusions[i].parts[p];
      part.neighbours.clear();
      for (const Ring& ring : part.polygon.rings) {
        std::vector<double>& heights = part.neighbours.emplace_back();
        for (size_t k = 0; k < ring.size(); ++k) {
          const EdgeUse& self = own[i][next++];
          double top = -INFINITY;
          const auto range = std::equal_range(all.begin(), all.end(), self, before);
          for (auto use = range.first; use != range.second; ++use) {
            const bool same = use->building == self.building && use->part == self.part;
            // What hangs higher than this part begins leaves it open below.
            if (!same && use->bottom <= self.bottom + 0.5) top = std::max(top, use->top);
          }
          constexpr double kStep = 0.25;
          heights.push_back(std::isfinite(top) ? std::floor((top - bases[i]) / kStep) * kStep : top);
        }
      }
    }
  });
}

/// Cuts edges where corners of others lie on them, so that walls which touch along a part of their length know each
/// other there; `extrude` joins again what stays free.
void cutAtNeighbours(std::vector<Extrusion>& extrusions, const std::vector<glm::dvec2>& middles) {
  constexpr double kCell = 8, kOn = 0.01, kNearCorner = 0.05;
  const auto cellOf = [](double v) { return static_cast<int64_t>(std::floor(v / kCell)); };
  const auto key = [](int64_t x, int64_t y) {
    return static_cast<uint64_t>(x) * 0x9e3779b97f4a7c15ULL ^ static_cast<uint64_t>(y);
  };
  std::vector<std::pair<uint64_t, glm::dvec2>> corners;
  for (size_t i = 0; i < extrusions.size(); ++i)
    for (const Extrusion::Part& part : extrusions[i].parts)
      for (const Ring& ring : part.polygon.rings)
        for (const glm::dvec2& q : ring) {
          const glm::dvec2 p = q + middles[i];
          corners.emplace_back(key(cellOf(p.x), cellOf(p.y)), p);
        }
  const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::stable_sort(corners.begin(), corners.end(), before);
  parallelFor(extrusions.size(), 256, [&](size_t i) {
    std::vector<std::pair<double, glm::dvec2>> on;
    for (Extrusion::Part& part : extrusions[i].parts)
      for (Ring& ring : part.polygon.rings) {
        Ring cut;
        for (size_t k = 0; k < ring.size(); ++k) {
          const glm::dvec2 a = ring[k] + middles[i], b = ring[(k + 1) % ring.size()] + middles[i];
          const double length = glm::length(b - a);
          cut.push_back(ring[k]);
          constexpr double kLongest = 2000;
          if (!(length > 2 * kNearCorner && length < kLongest)) continue;
          const glm::dvec2 along = (b - a) / length, low = glm::min(a, b) - kOn, high = glm::max(a, b) + kOn;
          on.clear();
          for (int64_t y = cellOf(low.y); y <= cellOf(high.y); ++y)
            for (int64_t x = cellOf(low.x); x <= cellOf(high.x); ++x) {
              const auto range =
                  std::equal_range(corners.begin(), corners.end(), std::pair(key(x, y), glm::dvec2(0)), before);
              for (auto c = range.first; c != range.second; ++c) {
                const double t = glm::dot(c->second - a, along);
                const glm::dvec2 foot = a + along * t;
                if (t > kNearCorner && t < length - kNearCorner && glm::length(c->second - foot) <= kOn)
                  on.emplace_back(t, c->second);
              }
            }
          std::sort(on.begin(), on.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
          double last = -INFINITY;
          for (const auto& [t, p] : on)
            if (t - last > kNearCorner) cut.push_back(p - middles[i]), last = t;
        }
        ring = std::move(cut);
      }
  });
}

/// Everything that decides a geometry, as bytes: equal where the geometries are.
std::string keyOf(const Extrusion& e) {
  std::string key = e.use + '\n' + e.material + '\n' + e.roof + '\n';
  const auto add = [&key](const auto& value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    key.append(bytes, sizeof value);
  };
  add(e.foundation), add(e.seed), add(e.style), add(e.year);
  for (const Extrusion::Part& part : e.parts) {
    add(part.height), add(part.bottom), add(part.roof), add(part.roofHeight);
    add(part.polygon.rings.size());
    for (size_t r = 0; r < part.polygon.rings.size(); ++r) {
      add(part.polygon.rings[r].size());
      for (const glm::dvec2& p : part.polygon.rings[r]) add(p.x), add(p.y);
      for (const double height : part.neighbours[r]) add(height);
      if (r < part.ground.size())
        for (const glm::dvec2& ends : part.ground[r]) add(ends.x), add(ends.y);
    }
  }
  return key;
}

void cleanOne(Outline& o, glm::dvec3 origin) {
  if (o.footprint->parts.empty()) o.problem = "it has no outline";
  for (const FootprintPart& raw : o.footprint->parts) {
    if (raw.polygon.rings.empty() || raw.polygon.rings[0].empty()) {
      o.problem = "it has no outline";
      continue;
    }
    // Near the polygon's own first point numbers are exact; whole metres keep the snapping grid.
    const glm::dvec2 toLocal = -glm::dvec2(origin), base = glm::round(raw.polygon.rings[0][0] + toLocal);
    Polygon local = raw.polygon;
    for (Ring& ring : local.rings)
      for (glm::dvec2& q : ring) q = (q + toLocal) - base;
    CleanedPolygons c = cleanPolygon(local);
    o.repaired = o.repaired || c.repaired;
    if (c.polygons.empty()) o.problem = c.problem;
    for (Polygon& p : c.polygons) {
      for (Ring& ring : p.rings)
        for (glm::dvec2& q : ring) q += base;
      Extrusion::Part& part = o.parts.emplace_back();
      part.polygon = std::move(p);
      part.height = raw.height, part.bottom = std::max(0.0, raw.bottom), part.roof = raw.roof;
      part.roofHeight = raw.roofHeight;
      // Only the ridge is known: the eaves lie below it by the roof's own height, and nobody lives in a tent.
      if (!(raw.height > 0) && raw.top > 0) {
        constexpr double kLeastWall = 0.3;  // share of the height
        const double free = raw.top - part.bottom;
        if (!(part.roofHeight > 0))
          part.roofHeight = roofRise(part.polygon, raw.roof.value_or(facade::RoofKind::Gable), glm::radians(28.0));
        part.roofHeight = std::min(part.roofHeight, (1 - kLeastWall) * free);
        part.height = raw.top - part.roofHeight;
      }
    }
  }
}

void reportCleaning(const std::vector<Source>& sources, const std::vector<Outline>& outlines,
                    city::Diagnostics& diagnostics) {
  for (const Source& s : sources) {
    std::vector<std::string> repaired, partly;
    for (const Outline& o : outlines) {
      if (o.source != &s) continue;
      if (o.parts.empty()) {
        diagnostics.warn(s.file, o.footprint->id, "left out: " + o.problem);
        diagnostics.leftOut.push_back({"building " + o.footprint->id, 1, o.problem});
        continue;
      }
      if (o.repaired) repaired.push_back(o.footprint->id);
      if (!o.problem.empty()) partly.push_back(o.footprint->id + " (" + o.problem + ")");
    }
    if (!repaired.empty())
      diagnostics.warn(s.file, "",
                       counted(repaired.size(), "footprint crossed or touched itself and was repaired: ",
                               "footprints crossed or touched themselves and were repaired: ") +
                           list(repaired));
    if (!partly.empty())
      diagnostics.warn(s.file, "",
                       counted(partly.size(), "footprint lost a part: ", "footprints lost a part: ") + list(partly));
  }
}

glm::dvec2 middleOf(const Outline& o) {
  const Extrusion::Part* largest = &o.parts[0];
  for (const Extrusion::Part& p : o.parts)
    if (area(p.polygon) > area(largest->polygon)) largest = &p;
  return snapped(centroid(largest->polygon));
}

/// The terrain along all outlines of a building.
GroundUnder groundUnderAll(const city::HeightField& terrain, const Outline& o) {
  GroundUnder all;
  double sum = 0, areas = 0;
  for (const Extrusion::Part& p : o.parts) {
    if (p.bottom > 0) continue;
    const GroundUnder g = groundUnder(terrain, p.polygon.rings[0]);
    if (!g.known) continue;
    all.lowest = all.known ? std::min(all.lowest, g.lowest) : g.lowest;
    sum += g.mean * area(p.polygon), areas += area(p.polygon);
    all.known = true;
  }
  if (all.known) all.mean = sum / areas;
  if (!all.known && !o.parts.empty()) all = groundUnder(terrain, o.parts[0].polygon.rings[0]);
  return all;
}

/// The ground at the ends of each edge of a part that stands on it, above `base`; in steps of 0.25 m, so that equal
/// footprints on nearly level ground remain equal.
std::vector<std::vector<glm::dvec2>> groundAlong(const city::HeightField& terrain, const Polygon& polygon,
                                                 glm::dvec2 middle, double base) {
  constexpr double kStep = 0.25, kLevel = 0.05;
  std::vector<std::vector<glm::dvec2>> out;
  for (const Ring& ring : polygon.rings) {
    std::vector<double> at;
    for (const glm::dvec2& p : ring) {
      const std::optional<double> height = terrain.heightAt(p.x + middle.x, p.y + middle.y);
      at.push_back(height ? std::ceil((*height - base - kLevel) / kStep) * kStep + 0.0 : 0);
    }
    std::vector<glm::dvec2>& edges = out.emplace_back();
    for (size_t i = 0; i < ring.size(); ++i) edges.emplace_back(at[i], at[(i + 1) % ring.size()]);
  }
  return out;
}

/// The building's form in its own frame, whose origin lies at `middle` and at the height `base`.
Extrusion extrusionOf(Outline& o, glm::dvec2 middle, const std::optional<city::HeightField>& terrain, double& base) {
  Extrusion e;
  const uint32_t variant = seedOf(o.footprint->id) % 8;
  // Where it stands: the terrain along its outline, else what its source says.
  if (terrain) o.under = groundUnderAll(*terrain, o);
  const double stated = std::isfinite(o.ground) ? o.ground : 0;
  base = o.under.known ? o.under.mean : stated;
  base = std::nearbyint(base / kSnap) * kSnap;
  const double lowest = o.under.known ? o.under.lowest : base;
  // In steps of 0.25 m, so that equal footprints on nearly level ground remain equal.
  e.foundation = std::ceil(std::max(0.5, base - lowest + 0.3) * 4) / 4;
  const city::Attributes& attributes = o.footprint->attributes;
  e.seed = variant;
  e.material = attribute(attributes, {"material", "material.value", "building:material", "materiau"});
  e.use = attribute(attributes, {"use", "usage", "building", "function", "NATURE", "nature", "USAGE1"});
  e.roof = attribute(attributes, {"roof", "roof.value", "roof:shape", "roofType"});
  const std::string_view year =
      attribute(attributes, {"year", "start_date", "yearOfConstruction", "annee_construction"});
  e.year = numberIn(year) > 0 ? numberIn(year) : 0;
  e.parts = std::move(o.parts);
  const double height = o.footprint->height > 0 ? o.footprint->height : o.source->defaultHeight;
  for (Extrusion::Part& p : e.parts) {
    if (!(p.height > 0)) p.height = height;
    if (!(p.height > p.bottom + 0.1)) p.height = p.bottom + 0.1;
    for (Ring& ring : p.polygon.rings)
      for (glm::dvec2& q : ring) q -= middle;
  }
  return e;
}

}  // namespace

void footprintsFromFlatSolids(std::vector<Source>& sources, city::Diagnostics& diagnostics) {
  constexpr double kNoHeight = 0.1;
  for (Source& s : sources) {
    std::vector<std::string> flat;
    std::erase_if(s.buildings, [&](SurfaceBuilding& b) {
      double low = INFINITY, high = -INFINITY;
      for (const glm::dvec3& p : b.points)
        if (std::isfinite(p.z)) low = std::min(low, p.z), high = std::max(high, p.z);
      if (b.surfaces.empty() || !(high - low < kNoHeight)) return false;
      Footprint f;
      f.id = b.id, f.ground = std::isfinite(b.ground) ? b.ground : low;
      std::vector<std::string> names;
      for (const auto& [name, value] : b.attributes) names.push_back(name);
      for (const size_t i : columnsNamed(names, heightNames()))
        if (const double v = numberIn(b.attributes[i].second); v > 0 && !(f.height > 0)) f.height = v;
      // Bottom and top cover the same ground: one of them is enough, upright surfaces have no area.
      for (const Surface& surface : b.surfaces) {
        Polygon polygon;
        for (const auto& ring : surface.rings) {
          Ring& line = polygon.rings.emplace_back();
          for (const uint32_t i : ring) line.emplace_back(b.points[i]);
        }
        constexpr double kDegenerate = 1e-9;
        if (polygon.rings.empty() || std::abs(signedArea(polygon.rings[0])) < kDegenerate) continue;
        const bool again = std::any_of(f.parts.begin(), f.parts.end(), [&](const FootprintPart& part) {
          return glm::length(centroid(part.polygon) - centroid(polygon)) < kNoHeight;
        });
        if (!again) f.parts.emplace_back().polygon = std::move(polygon);
      }
      if (f.parts.empty()) return false;
      f.attributes = std::move(b.attributes);
      flat.push_back(b.id);
      s.footprints.push_back(std::move(f));
      return true;
    });
    if (!flat.empty())
      diagnostics.warn(
          s.file, "",
          counted(flat.size(), "solid has", "solids have") + " no height and became footprints: " + list(flat));
  }
}

std::vector<Outline> cleanFootprints(const std::vector<Source>& sources, glm::dvec3 origin,
                                     city::Diagnostics& diagnostics) {
  std::vector<Outline> outlines;
  for (const Source& s : sources)
    for (const Footprint& f : s.footprints) {
      Outline& o = outlines.emplace_back();
      o.footprint = &f, o.source = &s;
      o.ground = f.ground - origin.z;
    }
  parallelFor(outlines.size(), 64, [&](size_t i) { cleanOne(outlines[i], origin); });
  reportCleaning(sources, outlines, diagnostics);
  std::erase_if(outlines, [](const Outline& o) { return o.parts.empty(); });
  return outlines;
}

void addFootprints(Assembly& a, std::vector<Outline>& outlines) {
  std::vector<glm::dvec2> middles(outlines.size());
  std::vector<Extrusion> extrusions(outlines.size());
  std::vector<double> bases(outlines.size(), 0);
  std::vector<std::string> keys(outlines.size());
  parallelFor(outlines.size(), 64, [&](size_t i) {
    middles[i] = middleOf(outlines[i]);
    extrusions[i] = extrusionOf(outlines[i], middles[i], a.city.terrain, bases[i]);
  });
  for (size_t i = 0; i < outlines.size(); ++i) {
    const Style style = styleFor(extrusions[i].material, extrusions[i].seed);
    extrusions[i].style = a.styles.use(a, styled(style, outlines[i].source->styles, outlines[i].footprint->attributes));
  }
  cutAtNeighbours(extrusions, middles);
  markNeighbours(extrusions, middles, bases);
  parallelFor(outlines.size(), 64, [&](size_t i) {
    for (Extrusion::Part& p : extrusions[i].parts)
      if (a.city.terrain && !(p.bottom > 0)) p.ground = groundAlong(*a.city.terrain, p.polygon, middles[i], bases[i]);
    keys[i] = keyOf(extrusions[i]);
  });

  // One geometry for each distinct footprint.
  std::unordered_map<std::string_view, uint32_t> typeOf;
  std::vector<size_t> firstWith;
  std::vector<uint32_t> geometry(outlines.size());
  for (size_t i = 0; i < outlines.size(); ++i) {
    const auto [found, isNew] = typeOf.emplace(keys[i], static_cast<uint32_t>(firstWith.size()));
    if (isNew) firstWith.push_back(i);
    geometry[i] = found->second;
  }
  std::vector<city::BuildingGeometry> built(firstWith.size());
  std::vector<facade::Derivation> derived(firstWith.size());
  parallelFor(built.size(), 32, [&](size_t t) {
    const Extrusion& e = extrusions[firstWith[t]];
    built[t] = extrude(e, a.styles.list()[e.style], outlines[firstWith[t]].footprint->id, derived[t]);
  });
  facade::Derivation made;
  for (const facade::Derivation& d : derived) made += d;
  if (made.cutShort > 0)
    a.diagnostics.warn("styles", "",
                       "rules were not followed to their end " + std::to_string(made.cutShort) +
                           " times, because they called each other too often or too deep");

  std::vector<uint32_t> number(built.size(), city::kNone);
  for (size_t t = 0; t < built.size(); ++t) {
    if (built[t].fullDetail.count == 0) continue;
    number[t] = static_cast<uint32_t>(a.city.buildingTypes.size());
    a.city.buildingTypes.push_back(std::move(built[t]));
  }
  std::vector<std::string> withoutHeight;
  const Source* source = nullptr;
  std::vector<double> gaps;
  const auto finishFile = [&] {
    if (!source) return;
    if (!withoutHeight.empty())
      a.diagnostics.warn(source->file, "",
                         counted(withoutHeight.size(), "building has", "buildings have") + " no height and became " +
                             shortNumber(source->defaultHeight) + " m high: " + list(withoutHeight));
    reportGaps(source->file, std::move(gaps), "the buildings' ground altitudes", a.diagnostics);
    withoutHeight.clear();
    gaps = {};
  };
  for (size_t i = 0; i < outlines.size(); ++i) {
    const Outline& o = outlines[i];
    const Footprint& f = *o.footprint;
    if (source != o.source) finishFile();
    source = o.source;
    if (number[geometry[i]] == city::kNone) {
      a.diagnostics.warn(source->file, f.id, "left out: its style gives it no surfaces");
      a.diagnostics.leftOut.push_back({"building " + f.id, 1, "its style gives it no surfaces"});
      continue;
    }
    const bool partsKnow =
        std::all_of(f.parts.begin(), f.parts.end(), [](const FootprintPart& p) { return p.height > 0 || p.top > 0; });
    if (!(f.height > 0) && !partsKnow) withoutHeight.push_back(f.id);
    if (o.under.known && std::isfinite(o.ground)) gaps.push_back(std::abs(o.under.mean - o.ground));
    city::Instance instance;
    instance.position = {middles[i], bases[i]};
    instance.geometry = number[geometry[i]];
    instance.seed = seedOf(f.id);
    instance.attributes = static_cast<uint32_t>(a.city.attributes.size());
    a.city.attributes.push_back(f.attributes);
    a.parts.buildings.push_back(instance);
  }
  finishFile();
}

}  // namespace vicus::assets
