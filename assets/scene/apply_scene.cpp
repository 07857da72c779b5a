#include "assets/scene/apply_scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assets/import/projection.hpp"
#include "assets/people/populate.hpp"
#include "assets/people/read_bvh.hpp"
#include "assets/people/read_character.hpp"
#include "assets/people/townspeople.hpp"
#include "light/sun_position.hpp"

namespace vicus::assets {
namespace {

/// The position of a place in the city; nothing where it cannot be brought there.
std::optional<glm::dvec3> localOf(const ScenePlace& place, const city::City& city, const std::string& sceneCrs,
                                  const std::string& cityCrs, glm::dvec3 shift) {
  glm::dvec2 p[] = {place.position};
  const std::string from = place.degrees ? crsFromText("EPSG:4326") : sceneCrs;
  if (!from.empty() && !cityCrs.empty()) {
    const auto failed = transform(from, cityCrs, p);
    if (!failed || *failed > 0) return std::nullopt;
  } else if (place.degrees) {
    return std::nullopt;
  }
  p[0] += glm::dvec2(shift) - glm::dvec2(city.origin);
  double z = place.altitude ? *place.altitude + shift.z - city.origin.z : place.aboveGround;
  if (!place.altitude && city.terrain) z += city.terrain->heightAt(p[0].x, p[0].y).value_or(0);
  return glm::dvec3(p[0], z);
}

/// The scene's angles of the sun, else its date in its place, else as the city has it.
void applyLight(city::City& city, const SceneEnvironment& from, glm::dvec3 shift) {
  city::Environment& out = city.environment;
  if (from.sunAzimuth) out.sunAzimuth = *from.sunAzimuth;
  if (from.sunElevation) out.sunElevation = *from.sunElevation;
  if (from.hazeDistance) out.hazeDistance = *from.hazeDistance;
  if (!from.days) return;
  const light::Place place = from.lonlat ? light::Place{from.lonlat->y, from.lonlat->x} : placeOf(city, shift);
  const double utc =
      from.utcOffset ? *from.days - *from.utcOffset / 24 : light::utcOfSolarTime(*from.days, place.longitude);
  if (const auto sun = light::sunAt(utc, place.latitude, place.longitude))
    out.sunAzimuth = sun->azimuth, out.sunElevation = sun->elevation;
}

/// Who walks in the city: characters of files, else people made by code, in the walks of the motions.
void addPeople(city::City& city, const SceneDescription& scene, city::Diagnostics& diagnostics) {
  const SceneAvatars& wanted = scene.avatars;
  people::Population population;
  population.seed = wanted.seed;
  population.count = wanted.count;
  if (wanted.count == 0)
    population.count = static_cast<uint32_t>(
        std::min(100'000.0, std::round(wanted.density * static_cast<double>(city.buildings.size()) / 100)));
  if (!wanted.on || population.count == 0) return;
  for (const std::string& file : wanted.characters)
    if (auto read = people::readCharacter(file, diagnostics)) population.characters.push_back(std::move(read->body));
  if (population.characters.empty())
    population.characters =
        people::makeTownspeople(wanted.dress == "modern" ? people::Period::Modern : people::Period::Medieval);
  std::vector<people::Motion> motions;
  for (const std::string& file : wanted.motions)
    if (auto motion = people::readBvh(file, {}, diagnostics)) motions.push_back(std::move(*motion));
  for (size_t k = 0; k < population.characters.size() && !motions.empty(); ++k) {
    const size_t which = k % motions.size();
    people::useMotion(population.characters[k], motions[which].skeleton, motions[which].clip, motions[which].clip.name,
                      diagnostics);
  }
  people::populate(city, std::move(population), scene.file, diagnostics);
}

}  // namespace

light::Place placeOf(const city::City& city, glm::dvec3 shift) {
  const std::string crs = city.crs.empty() ? std::string() : crsFromText(city.crs);
  if (crs.empty() || city.extent.empty()) return light::kNorwich;
  glm::dvec2 p[] = {glm::dvec2(city.extent.centre()) + glm::dvec2(city.origin) - glm::dvec2(shift)};
  const auto failed = transform(crs, crsFromText("EPSG:4326"), p);
  if (!failed || *failed > 0 || !(std::abs(p[0].y) <= 90)) return light::kNorwich;
  return {glm::radians(p[0].y), glm::radians(p[0].x)};
}

void applyScene(city::City& city, const SceneDescription& scene, glm::dvec3 shift, city::Diagnostics& diagnostics) {
  const std::string sceneCrs = scene.crs.empty() ? std::string() : crsFromText(scene.crs),
                    cityCrs = crsFromText(city.crs);
  for (const SceneTour& tour : scene.tours) {
    city::Tour& out = city.tours.emplace_back();
    out.name = tour.name, out.jumps = tour.jumps;
    for (const SceneKey& key : tour.keys) {
      const auto position = localOf(key.place, city, sceneCrs, cityCrs, shift);
      if (!position) {
        diagnostics.error(scene.file, tour.name, "its place cannot be brought into the city's CRS " + city.crs);
        continue;
      }
      out.keys.push_back({key.time, *position, key.heading, key.pitch});
    }
    if (out.keys.empty()) city.tours.pop_back();
  }
  applyLight(city, scene.environment, shift);
  addPeople(city, scene, diagnostics);
}

}  // namespace vicus::assets
