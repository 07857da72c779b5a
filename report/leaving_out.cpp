#include "report/leaving_out.hpp"

#include <algorithm>

namespace vicus::report {
namespace {

/// Metres below everything else, so that the part changes no picture.
constexpr double kBelow = 2;

/// What the part has to lie under: the city's extent, or a kilometre where it has none.
city::Aabb groundOf(const city::City& city) {
  return city.extent.empty() ? city::Aabb{{-500, -500, 0}, {500, 500, 1}} : city.extent;
}

city::HeightField flatField(const city::Aabb& ground) {
  constexpr int kSamples = 257;
  city::HeightField field;
  field.size = glm::ivec2(kSamples);
  field.origin = glm::dvec2(ground.min);
  field.spacing = glm::max(glm::dvec2(ground.max - ground.min), glm::dvec2(1)) / static_cast<double>(kSamples - 1);
  field.heights.assign(static_cast<size_t>(kSamples) * kSamples, static_cast<float>(ground.min.z - kBelow));
  field.updateRange();
  return field;
}

city::WaterBody levelWater(const city::Aabb& ground) {
  city::WaterBody body;
  body.name = "forced";
  body.level = ground.min.z - kBelow;
  const glm::dvec2 a(ground.min), b(ground.max);
  body.points = {a, {b.x, a.y}, b, {a.x, b.y}};
  body.indices = {0, 1, 2, 0, 2, 3};
  return body;
}

/// A cube of a metre.
city::BuildingGeometry smallHouse(city::MaterialId material) {
  city::BuildingBuilder builder("forced");
  builder.beginLevel(0, 1);
  builder.beginPlane(city::PlaneKind::Wall, material, {0, -1, 0});
  builder.addBox({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-0.5F, -0.5F, 0}, {0.5F, 0.5F, 1}, material);
  return builder.finish();
}

city::MaterialId anyMaterial(city::City& city) {
  if (city.materials.empty()) {
    city::Material material;
    material.name = "forced", material.source = "builtin:plaster";
    city.materials.push_back(material);
  }
  return 0;
}

city::MeshGeometry smallMesh(city::MaterialId material) {
  city::BuildingGeometry house = smallHouse(material);
  city::MeshGeometry geometry;
  geometry.name = "forced";
  geometry.mesh = {std::move(house.vertices), std::move(house.indices)};
  geometry.bounds = house.bounds;
  return geometry;
}

/// Somebody of one joint and one triangle.
city::People somebody(const glm::dvec3& place) {
  city::People people;
  city::Character& body = people.characters.emplace_back();
  body.name = "forced";
  body.skeleton.joints.push_back({"hips", city::kNone, {}});
  body.jointFromSkin.emplace_back(1);
  body.dresses.emplace_back();
  for (city::AvatarMesh& mesh : body.levels) {
    mesh.vertices.resize(3);
    mesh.vertices[1].position = {0, 0.3F, 0}, mesh.vertices[2].position = {0, 0, 1.7F};
    mesh.indices = {0, 1, 2};
  }
  body.bounds = {{-0.1F, -0.1F, 0}, {0.1F, 0.4F, 1.8F}};
  people.placed.emplace_back().position = place;
  people.count = 1;
  return people;
}

}  // namespace

std::optional<city::City> withPart(const city::City& city, std::string_view part) {
  const bool lacks = (part == "terrain" && !(city.terrain && !city.terrain->empty())) ||
                     (part == "water" && city.water.empty()) || (part == "trees" && city.trees.empty()) ||
                     (part == "monuments" && city.monuments.empty()) ||
                     (part == "buildings" && city.buildings.empty()) || (part == "avatars" && city.people.empty());
  if (!lacks) return std::nullopt;
  city::City forced = city;
  const city::Aabb ground = groundOf(city);
  city::CityParts parts{forced.buildings.instances, forced.trees.instances};
  city::Instance instance;
  instance.position = {ground.centre().x, ground.centre().y, ground.min.z - kBelow};

  if (part == "terrain") forced.terrain = flatField(ground);
  if (part == "avatars") forced.people = somebody(instance.position);
  if (part == "water") forced.water = {levelWater(ground)};
  if (part == "trees") {
    instance.geometry = static_cast<uint32_t>(forced.treeTypes.size());
    forced.treeTypes.push_back(smallMesh(anyMaterial(forced)));
    parts.trees.push_back(instance);
  }
  if (part == "buildings") {
    instance.geometry = static_cast<uint32_t>(forced.buildingTypes.size());
    forced.buildingTypes.push_back(smallHouse(anyMaterial(forced)));
    parts.buildings.push_back(instance);
  }
  if (part == "monuments") {
    city::Monument monument;
    monument.name = "forced";
    monument.mesh = static_cast<uint32_t>(forced.meshes.size());
    monument.position = instance.position;
    forced.meshes.push_back(smallMesh(anyMaterial(forced)));
    forced.monuments.push_back(monument);
  }
  city::finishCity(forced, std::move(parts));
  return forced;
}

}  // namespace vicus::report
