#include "assets/import/cityjson_objects.hpp"

#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "assets/import/columns.hpp"

namespace vicus::assets::cityjson {

Role roleOf(const std::string& type) {
  static const std::map<std::string, Role> kRoles = {{"Building", Role::Building},
                                                     {"BuildingPart", Role::Part},
                                                     {"BuildingInstallation", Role::Part},
                                                     {"BuildingConstructiveElement", Role::Part},
                                                     {"OtherConstruction", Role::Building},
                                                     {"GenericCityObject", Role::Building},
                                                     {"Bridge", Role::Building},
                                                     {"BridgePart", Role::Part},
                                                     {"BridgeInstallation", Role::Part},
                                                     {"BridgeConstructionElement", Role::Part},
                                                     {"BridgeConstructiveElement", Role::Part},
                                                     {"Tunnel", Role::Building},
                                                     {"TunnelPart", Role::Part},
                                                     {"TunnelInstallation", Role::Part},
                                                     {"TunnelConstructiveElement", Role::Part},
                                                     {"TINRelief", Role::Terrain},
                                                     {"WaterBody", Role::Water},
                                                     {"Waterway", Role::Water},
                                                     {"Road", Role::Cover},
                                                     {"Railway", Role::Cover},
                                                     {"TransportSquare", Role::Cover},
                                                     {"TransportationSquare", Role::Cover},
                                                     {"PlantCover", Role::Cover},
                                                     {"LandUse", Role::Cover},
                                                     {"SolitaryVegetationObject", Role::Tree}};
  static const std::set<std::string> kOthers = {
      "BridgeRoom",   "BridgeFurniture", "BuildingFurniture", "BuildingRoom",    "BuildingStorey",
      "BuildingUnit", "CityFurniture",   "CityObjectGroup",   "TunnelFurniture", "TunnelHollowSpace"};
  const auto found = kRoles.find(type);
  if (found != kRoles.end()) return found->second;
  return kOthers.contains(type) ? Role::LeftOut : Role::Unknown;
}

city::Ground coverOf(const std::string& type) {
  if (type == "PlantCover") return city::Ground::Garden;
  if (type == "LandUse") return city::Ground::Grass;
  if (type == "Railway") return city::Ground::Earth;
  return type == "Road" ? city::Ground::Street : city::Ground::Paving;
}

void flatten(const Json& value, const std::string& name, int depth, city::Attributes& out) {
  constexpr int kDeepest = 8;
  if (value.is_object() && depth < kDeepest) {
    for (const auto& [key, inner] : value.items())
      flatten(inner, name.empty() ? key : name + "." + key, depth + 1, out);
  } else if (value.is_array() && depth < kDeepest) {
    for (size_t i = 0; i < value.size(); ++i)
      flatten(value[i], value.size() == 1 ? name : name + "." + std::to_string(i), depth + 1, out);
  } else if (value.is_string()) {
    out.emplace_back(name, value.get<std::string>());
  } else if (value.is_primitive() && !value.is_null()) {
    out.emplace_back(name, value.dump());
  }
}

double firstNumberNamed(const city::Attributes& attributes, std::span<const std::string_view> names, double above) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : attributes)
    keys.push_back(key.ends_with(".value") ? key.substr(0, key.size() - 6) : key);
  for (const size_t i : columnsNamed(keys, names))
    if (const double v = numberIn(attributes[i].second); v > above) return v;
  return kUnknown;
}

double heightIn(const city::Attributes& attributes, const std::string& column) {
  if (!column.empty()) {
    const std::string_view name[] = {column};
    for (const auto& [key, value] : attributes)
      if (key == name[0] || key == column + ".value") return numberIn(value);
  }
  const double height = firstNumberNamed(attributes, heightNames(), 0);
  if (height > 0) return height;
  const double storeys = firstNumberNamed(attributes, storeyNames(), 0);
  static constexpr std::string_view kStorey[] = {"floorheight", "storeyheight"};
  const double storey = firstNumberNamed(attributes, kStorey, 0);
  return storeys * (storey > 0 ? storey : kStoreyHeight);
}

void append(Source& whole, Source&& part) {
  const auto base = static_cast<uint32_t>(whole.materials.size());
  // Most features have no appearance of their own: then all share the header's.
  const bool same = part.materials == whole.materials;
  if (!same) {
    for (SurfaceBuilding& b : part.buildings)
      for (Surface& s : b.surfaces)
        if (s.material != kNoMaterial) s.material += base;
    whole.materials.insert(whole.materials.end(), part.materials.begin(), part.materials.end());
  }
  const auto move = [](auto& to, auto& from) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  };
  move(whole.buildings, part.buildings);
  move(whole.footprints, part.footprints);
  move(whole.surroundings.water, part.surroundings.water);
  move(whole.surroundings.cover, part.surroundings.cover);
  move(whole.surroundings.trees, part.surroundings.trees);
  const auto firstPoint = static_cast<uint32_t>(whole.tin.points.size());
  move(whole.tin.points, part.tin.points);
  for (const glm::uvec3& t : part.tin.triangles) whole.tin.triangles.push_back(t + firstPoint);
}

}  // namespace vicus::assets::cityjson
