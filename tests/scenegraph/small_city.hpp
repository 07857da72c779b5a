/// A city of a few houses over hilly ground, made by hand for tests.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "assets/materials/materials.hpp"
#include "city/building_geometry.hpp"
#include "city/city.hpp"
#include "city/frame_plan.hpp"
#include "city/random.hpp"

namespace vicus::tests {

/// Materials of the small city, by number.
enum SmallCityMaterial : city::MaterialId { kPlaster, kTiles, kGlass, kOak, kLeaves, kStone };

inline std::vector<city::Material> smallCityMaterials() {
  std::vector<city::Material> out;
  for (const char* name : {"plaster", "roof-tile", "glass", "oak", "leaves", "flint"})
    out.push_back(assets::builtinMaterial(name));
  return out;
}

/// A gabled house, `width` along x and `depth` along y, with two windows and a door in its south wall.
inline city::BuildingGeometry gabledHouse(std::string name, float width, float depth, float eaves, float ridge) {
  city::BuildingBuilder b(std::move(name));
  const float w = width / 2, d = depth / 2;
  const float sill = 1.2f, head = 2.2f;
  b.beginLevel(0, eaves);
  // The south wall: strips about a door and two windows, which are set back.
  b.beginPlane(city::PlaneKind::Wall, kPlaster, {0, -1, 0});
  struct Opening {
    float x0, x1, z0, z1;
    city::MaterialId material;
  };
  const Opening openings[] = {{-w + 0.8f, -w + 1.8f, sill, head, kGlass},
                              {-0.5f, 0.5f, 0, 2.1f, kOak},
                              {w - 1.8f, w - 0.8f, sill, head, kGlass}};
  const auto wall = [&](float x0, float x1, float z0, float z1) {
    b.addQuad({x0, -d, z0}, {x1, -d, z0}, {x1, -d, z1}, {x0, -d, z1}, kPlaster, {x0, z0});
  };
  float x = -w;
  for (const Opening& o : openings) {
    wall(x, o.x0, 0, eaves);
    if (o.z0 > 0) wall(o.x0, o.x1, 0, o.z0);
    wall(o.x0, o.x1, o.z1, eaves);
    x = o.x1;
  }
  wall(x, w, 0, eaves);
  b.beginFlat();
  wall(-w, w, 0, eaves);
  for (const Opening& o : openings) {
    constexpr float kDepth = 0.12f;
    b.beginExternalOpening(kDepth);
    const float y = -d + kDepth;
    b.addQuad({o.x0, y, o.z0}, {o.x1, y, o.z0}, {o.x1, y, o.z1}, {o.x0, y, o.z1}, o.material);
    b.addQuad({o.x0, -d, o.z0}, {o.x0, y, o.z0}, {o.x0, y, o.z1}, {o.x0, -d, o.z1}, kOak);
    b.addQuad({o.x1, y, o.z0}, {o.x1, -d, o.z0}, {o.x1, -d, o.z1}, {o.x1, y, o.z1}, kOak);
    b.addQuad({o.x0, y, o.z1}, {o.x1, y, o.z1}, {o.x1, -d, o.z1}, {o.x0, -d, o.z1}, kOak);
    b.beginExternalGeometry(0.08f);
    b.addBox({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {o.x0 - 0.1f, -d - 0.08f, o.z1},
             {o.x1 + 0.1f, -d, o.z1 + 0.15f}, kOak);
  }
  b.beginPlane(city::PlaneKind::Wall, kPlaster, {0, 1, 0});
  b.addQuad({w, d, 0}, {-w, d, 0}, {-w, d, eaves}, {w, d, eaves}, kPlaster);
  for (const float side : {-1.0f, 1.0f}) {
    b.beginPlane(city::PlaneKind::Gable, kPlaster, {side, 0, 0});
    const glm::vec3 corners[] = {{side * w, -side * d, 0},
                                 {side * w, side * d, 0},
                                 {side * w, side * d, eaves},
                                 {side * w, 0, ridge},
                                 {side * w, -side * d, eaves}};
    b.addConvex(corners, {0, side, 0}, {0, 0, 1}, kPlaster);
  }
  b.beginLevel(eaves, ridge);
  for (const float side : {-1.0f, 1.0f}) {
    const float over = 0.3f, drop = over * (ridge - eaves) / d;
    b.beginPlane(city::PlaneKind::Roof, kTiles, glm::normalize(glm::vec3(0, side * (ridge - eaves), d)));
    b.addQuad({-side * (w + over), side * (d + over), eaves - drop}, {side * -(w + over), 0, ridge},
              {side * (w + over), 0, ridge}, {side * (w + over), side * (d + over), eaves - drop}, kTiles);
  }
  b.addOccluder({{-w, -d}, {w, -d}, 0, eaves});
  b.setFootprint({{{-w, -d}, {w, -d}, {w, d}, {-w, d}}});
  return b.finish();
}

/// Two crossed cards of leaves and a trunk.
inline city::MeshGeometry smallTree() {
  city::BuildingBuilder b("tree");
  b.beginPlane(city::PlaneKind::Other, kOak, {0, 0, 1}, false);
  b.addBox({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-0.2f, -0.2f, 0}, {0.2f, 0.2f, 3}, kOak, 0xf);
  for (const glm::vec3 x : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)})
    b.addQuad({-2.5f * x + glm::vec3(0, 0, 2), 2.5f * x + glm::vec3(0, 0, 2), 2.5f * x + glm::vec3(0, 0, 7),
               -2.5f * x + glm::vec3(0, 0, 7)},
              {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, kLeaves);
  city::BuildingGeometry g = b.finish();
  return {"tree", {std::move(g.vertices), std::move(g.indices)}, g.bounds};
}

struct SmallCityOptions {
  bool terrain = true, trees = true, monument = true, water = true;
  int housesOfASide = 6;  ///< houses stand on a square grid 20 m apart
  glm::dvec3 shift{0};    ///< added to every position
};

/// Height of the small city's ground above its base.
inline float smallCityHeight(double x, double y) {
  return static_cast<float>(3 * std::sin(x / 40) + 2 * std::cos(y / 55));
}

inline city::City smallCity(const SmallCityOptions& options = {}) {
  city::City city;
  city.name = "small";
  city.materials = smallCityMaterials();
  city.buildingTypes.push_back(gabledHouse("cottage", 7, 5, 2.6f, 5));
  city.buildingTypes.push_back(gabledHouse("house", 9, 6, 5, 8.5f));
  const double half = 10.0 * options.housesOfASide;
  const glm::dvec3 shift = options.shift;
  if (options.terrain) {
    city::HeightField field;
    field.size = {65, 65};
    field.spacing = glm::dvec2(4 * half / 64);
    field.origin = glm::dvec2(shift) - 2 * half;
    for (int r = 0; r < field.size.y; ++r)
      for (int c = 0; c < field.size.x; ++c) {
        const glm::dvec2 p = field.origin + field.spacing * glm::dvec2(c, r) - glm::dvec2(shift);
        field.heights.push_back(smallCityHeight(p.x, p.y) + static_cast<float>(shift.z));
      }
    field.updateRange();
    city.terrain = std::move(field);
  }
  const auto ground = [&](double x, double y) {
    return city.terrain ? city.terrain->heightAt(x, y).value_or(shift.z) : shift.z;
  };
  city::CityParts parts;
  city::Random random(5);
  for (int row = 0; row < options.housesOfASide; ++row)
    for (int column = 0; column < options.housesOfASide; ++column) {
      city::Instance house;
      house.position = shift + glm::dvec3(20 * column + 10 - half, 20 * row + 10 - half, 0);
      house.position.z = ground(house.position.x, house.position.y) - 0.3;
      house.heading = static_cast<float>(0.2 * random.uniform(-1, 1));
      house.geometry = random.below(2);
      house.seed = random.bits();
      parts.buildings.push_back(house);
      if (!options.trees) continue;
      city::Instance tree = house;
      tree.position += glm::dvec3(7, 7, 0);
      tree.position.z = ground(tree.position.x, tree.position.y);
      tree.geometry = 0;
      parts.trees.push_back(tree);
    }
  if (options.trees) city.treeTypes.push_back(smallTree());
  if (options.monument) {
    city::BuildingBuilder b("tower");
    b.addBox({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-4, -4, -1}, {4, 4, 25}, kStone);
    city::BuildingGeometry g = b.finish();
    city.meshes.push_back({"tower", {std::move(g.vertices), std::move(g.indices)}, g.bounds});
    city::Monument tower;
    tower.name = "Tower", tower.heading = 0.5f;
    tower.position = shift + glm::dvec3(1.5 * half, 0, 0);
    tower.position.z = ground(tower.position.x, tower.position.y);
    city.monuments.push_back(tower);
  }
  if (options.water) {
    city::WaterBody pond;
    pond.name = "pond", pond.level = shift.z - 2.5;
    const glm::dvec2 c = glm::dvec2(shift) + glm::dvec2(-1.4 * half, 0);
    pond.points = {c + glm::dvec2(-30, -40), c + glm::dvec2(30, -40), c + glm::dvec2(30, 40), c + glm::dvec2(-30, 40)};
    pond.indices = {0, 1, 2, 0, 2, 3};
    city.water.push_back(std::move(pond));
  }
  city::finishCity(city, std::move(parts));
  return city;
}

/// A plan that draws all.
inline city::FramePlan everything(const city::City& city, const city::ViewState& view) {
  city::FramePlan plan;
  plan.view = view;
  if (!city.buildings.empty()) plan.buildings.drawn = {{0, static_cast<uint32_t>(city.buildings.size())}};
  if (!city.trees.empty()) plan.trees.drawn = {{0, static_cast<uint32_t>(city.trees.size())}};
  plan.buildings.drawnCount = city.buildings.size();
  plan.trees.drawnCount = city.trees.size();
  for (uint32_t i = 0; i < city.monuments.size(); ++i) plan.monuments.push_back(i);
  for (uint32_t t = 0; t < city.tiles.size(); ++t)
    if (!city.tiles[t].bounds.empty()) plan.tiles.push_back(t);
  return plan;
}

}  // namespace vicus::tests
