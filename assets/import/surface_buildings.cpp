#include <algorithm>
#include <cmath>

#include "assets/import/assembly.hpp"
#include "assets/import/parallel.hpp"
#include "assets/import/surfaces.hpp"

namespace vicus::assets {
namespace {

/// May a picture of this format be transparent in places?
bool mayBeTransparent(const SourceMaterial& m) {
  if (m.image.empty()) return false;
  std::string lower = m.image;
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return !(lower.ends_with(".jpg") || lower.ends_with(".jpeg"));
}

}  // namespace

void addSurfaceBuildings(Assembly& a, const std::vector<Source>& sources) {
  for (const Source& s : sources) {
    const size_t count = s.buildings.size();
    if (count == 0) continue;
    const std::vector<city::MaterialId> materials = addMaterials(a, s);
    std::vector<uint8_t> mayHaveHoles;
    for (const SourceMaterial& m : s.materials) mayHaveHoles.push_back(mayBeTransparent(m) ? 1 : 0);
    std::vector<Style> styles(count);
    std::vector<size_t> rules(count);
    for (size_t i = 0; i < count; ++i) {
      const city::Attributes& attributes = s.buildings[i].attributes;
      const std::string_view material = attribute(attributes, {"material", "material.value"});
      // The cities that come as surfaces alone are mostly of brick; beside footprints a building looks like those.
      const Style usual =
          s.footprints.empty() ? brickStyleFor(material) : styleFor(material, seedOf(s.buildings[i].id) % 8);
      styles[i] = styled(usual, s.styles, attributes);
      rules[i] = a.styles.use(a, styles[i]);
    }
    std::vector<std::optional<city::BuildingGeometry>> built(count);
    std::vector<SurfaceReport> reports(count);
    std::vector<glm::dvec3> positions(count);
    parallelFor(count, 16, [&](size_t i) {
      SurfaceBuilding local = s.buildings[i];
      city::Aabb box;
      for (glm::dvec3& p : local.points) {
        p = snapped(p - a.city.origin);
        if (std::isfinite(p.x + p.y + p.z)) box.extend(p);
      }
      if (box.empty()) return;
      // On the ground within the footprint, as far as it is known.
      glm::dvec3 position(glm::round(glm::dvec2(box.centre())), box.min.z);
      for (glm::dvec3& p : local.points) p -= position;
      positions[i] = position;
      SurfaceOptions options;
      options.style = styles[i], options.rules = &a.styles.list()[rules[i]];
      options.facts.seed = seedOf(s.buildings[i].id), options.facts.height = box.size().z;
      options.materials = materials, options.mayHaveHoles = mayHaveHoles;
      if (a.city.terrain)
        options.groundAt = [&](glm::dvec2 p) {
          const auto h = a.city.terrain->heightAt(p.x + position.x, p.y + position.y);
          return h ? *h - position.z : kUnknown;
        };
      built[i] = buildFromSurfaces(local, s.buildings[i].id, options, reports[i]);
    });

    std::vector<std::string> turned, repaired, bent, closed, open, lost;
    double highest = 0, deepest = 0;
    std::string highestId, deepestId;
    for (size_t i = 0; i < count; ++i) {
      const SurfaceBuilding& b = s.buildings[i];
      const SurfaceReport& r = reports[i];
      if (!built[i]) {
        a.diagnostics.warn(s.file, b.id, "left out: none of its surfaces can be drawn");
        a.diagnostics.leftOut.push_back({"building " + b.id, 1, "none of its surfaces can be drawn"});
        continue;
      }
      if (r.turned > 0) turned.push_back(b.id);
      if (r.repaired > 0) repaired.push_back(b.id);
      if (r.bent > 0) bent.push_back(b.id);
      if (r.closed > 0) closed.push_back(b.id);
      if (r.open > 0) open.push_back(b.id);
      if (r.leftOut > 0) lost.push_back(b.id + " (" + std::to_string(r.leftOut) + ")");
      if (r.floating > highest) highest = r.floating, highestId = b.id;
      if (-r.floating > deepest) deepest = -r.floating, deepestId = b.id;
      city::Instance instance;
      instance.position = positions[i];
      instance.geometry = static_cast<uint32_t>(a.city.buildingTypes.size());
      instance.seed = seedOf(b.id);
      instance.attributes = static_cast<uint32_t>(a.city.attributes.size());
      a.city.buildingTypes.push_back(std::move(*built[i]));
      a.city.attributes.push_back(b.attributes);
      a.parts.buildings.push_back(instance);
    }
    if (!turned.empty())
      a.diagnostics.warn(s.file, "",
                         counted(turned.size(), "building has", "buildings have") +
                             " surfaces wound the wrong way round, which were turned: " + list(turned));
    if (!repaired.empty())
      a.diagnostics.warn(s.file, "",
                         counted(repaired.size(), "building has", "buildings have") +
                             " surfaces that cross or touch themselves, which were repaired: " + list(repaired));
    if (!bent.empty())
      a.diagnostics.warn(s.file, "",
                         counted(bent.size(), "building has", "buildings have") +
                             " surfaces that are not flat to 2 cm, which were cut into triangles: " + list(bent));
    if (!closed.empty())
      a.diagnostics.warn(s.file, "",
                         counted(closed.size(), "solid was", "solids were") +
                             " not closed; what was missing was filled in: " + list(closed));
    if (!open.empty())
      a.diagnostics.warn(s.file, "",
                         counted(open.size(), "solid is", "solids are") +
                             " not closed and stayed so, because too much is missing: " + list(open));
    if (!lost.empty())
      a.diagnostics.warn(s.file, "",
                         counted(lost.size(), "building has", "buildings have") +
                             " surfaces without area, which are not drawn: " + list(lost));
    if (highest > 0.05)
      a.diagnostics.warn(s.file, highestId,
                         "hangs " + metres(highest) +
                             " above the terrain, the most of all; walls that end above it were "
                             "lengthened");
    if (deepest > 0.05)
      a.diagnostics.warn(s.file, deepestId, "reaches " + metres(deepest) + " into the terrain, the most of all");
  }
}

}  // namespace vicus::assets
