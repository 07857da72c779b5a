/// Small cities for tests.
#pragma once

#include <vector>

#include "city/city.hpp"

namespace vicus::test {

/// A house of the given size with walls and a flat roof, origin in the middle of its footprint.
inline city::BuildingGeometry house(float width, float depth, float height) {
  const float x = width / 2, y = depth / 2;
  const glm::vec3 corners[4] = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
  const glm::vec3 up(0, 0, height);
  const glm::vec3 outward[4] = {{0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  city::BuildingBuilder builder("house");
  builder.beginLevel(0, height);
  for (int k = 0; k < 4; ++k) {
    builder.beginPlane(city::PlaneKind::Wall, 0, outward[k]);
    const glm::vec3 a = corners[k], b = corners[(k + 1) % 4];
    builder.addQuad(a, b, b + up, a + up, 0);
  }
  builder.beginPlane(city::PlaneKind::Roof, 0, {0, 0, 1});
  builder.addQuad(corners[0] + up, corners[1] + up, corners[2] + up, corners[3] + up, 0);
  builder.setFootprint({{glm::vec2(-x, -y), glm::vec2(x, -y), glm::vec2(x, y), glm::vec2(-x, y)}});
  return builder.finish();
}

inline city::Material plaster() {
  city::Material material;
  material.name = "plaster";
  material.source = "builtin:plaster";
  return material;
}

/// Houses at the given places on level ground at `ground` metres, all of one type and turned by `heading`.
inline city::City cityOf(const std::vector<glm::dvec2>& places, double ground = 0, float heading = 0) {
  city::City city;
  city.name = "test";
  city.materials = {plaster()};
  city.buildingTypes = {house(8, 10, 6)};
  city::CityParts parts;
  for (const glm::dvec2& p : places) {
    city::Instance i;
    i.position = glm::dvec3(p, ground);
    i.heading = heading;
    i.seed = static_cast<uint32_t>(parts.buildings.size());
    parts.buildings.push_back(i);
  }
  city::finishCity(city, std::move(parts));
  return city;
}

/// A town of blocks: rows of terraced houses with streets of 6 m between the rows, and lanes across.
inline city::City gridTown(int columns = 12, int rows = 8, double ground = 0) {
  std::vector<glm::dvec2> places;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) places.emplace_back(column * 8.0 + (column / 4) * 5.0, row * 16.0);
  return cityOf(places, ground);
}

/// A height field of n × n samples, `spacing` metres apart, from (−half, −half), with heights from a function of x, y.
template <typename Height>
city::HeightField terrain(int n, double spacing, const Height& height) {
  city::HeightField field;
  field.size = glm::ivec2(n);
  field.spacing = glm::dvec2(spacing);
  field.origin = glm::dvec2(-0.5 * spacing * (n - 1));
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column)
      field.heights.push_back(
          static_cast<float>(height(field.origin.x + spacing * column, field.origin.y + spacing * row)));
  field.updateRange();
  return field;
}

/// The city on that terrain, finished anew.
inline void setTerrain(city::City& city, city::HeightField field) {
  city.terrain = std::move(field);
  city::CityParts parts{city.buildings.instances, city.trees.instances};
  city::finishCity(city, std::move(parts));
}

}  // namespace vicus::test
