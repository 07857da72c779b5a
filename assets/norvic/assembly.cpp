#include "assets/norvic/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "assets/norvic/trees.hpp"
#include "light/sun_position.hpp"

namespace vicus::assets::norvic {

using glm::dvec2;
using glm::dvec3;

city::Instance standHouse(const Plot& plot, const HouseCatalogue& houses, const city::HeightField& terrain) {
  const HouseVariant& v = houses.variants[plot.variant];
  const double c = std::cos(static_cast<double>(plot.heading)), s = std::sin(static_cast<double>(plot.heading));
  const dvec2 along(c, s), into(-s, c);
  const dvec2 front = plot.position - into * (0.5 * static_cast<double>(v.depth));
  // The highest ground along the front: no door is sunk, a step covers what is lower.
  double height = -1e9;
  for (const double at : {-0.5, -0.25, 0.0, 0.25, 0.5}) {
    const dvec2 p = front + along * (at * static_cast<double>(v.width));
    height = std::max(height, terrain.heightAt(p.x, p.y).value_or(0));
  }
  city::Instance out;
  out.position = dvec3(plot.position, height);
  out.heading = plot.heading;
  out.geometry = v.geometry;
  out.seed = plot.seed;
  return out;
}

city::Instance standTree(const TreeSpot& tree, const city::HeightField& terrain) {
  city::Instance out;
  out.position = dvec3(tree.position, terrain.heightAt(tree.position.x, tree.position.y).value_or(0));
  out.heading = static_cast<float>(tree.seed % 6283U) * 0.001f;
  out.geometry = treeType(static_cast<TreeKind>(tree.kind), tree.seed / 6283U);
  out.seed = tree.seed;
  return out;
}

void setSummerAfternoon(city::Environment& environment) {
  const double utc = light::utcOfSolarTime(light::daysOf(1390, 8, 24) + 14.5 / 24, light::kNorwich.longitude);
  if (const auto sun = light::sunAt(utc, light::kNorwich.latitude, light::kNorwich.longitude))
    environment.sunAzimuth = sun->azimuth, environment.sunElevation = sun->elevation;
}

city::StreetGraph joinStreets(std::span<const QuarterPlan> quarters, const Landscape& land,
                              const city::HeightField& terrain) {
  city::StreetGraph graph;
  const auto addNode = [&](dvec2 p) {
    graph.nodes.push_back({dvec3(p, terrain.heightAt(p.x, p.y).value_or(0))});
    return static_cast<uint32_t>(graph.nodes.size() - 1);
  };
  std::map<uint32_t, uint32_t> exits;  // key → node
  for (const QuarterPlan& q : quarters) {
    std::vector<uint32_t> nodeOf(q.nodes.size(), city::kNone);
    for (const auto& [key, node] : q.exitNodes) {
      const auto [it, fresh] = exits.try_emplace(key, 0);
      if (fresh) it->second = addNode(q.nodes[node]);
      nodeOf[node] = it->second;
    }
    for (const StreetLine& line : q.streets) {
      const bool bridge = line.style.kind == city::StreetKind::Bridge;
      const std::vector<dvec2> points = bridge ? resample(line.points, 5) : line.points;
      for (const uint32_t end : {line.from, line.to})
        if (nodeOf[end] == city::kNone) nodeOf[end] = addNode(q.nodes[end]);
      uint32_t before = nodeOf[line.from];
      for (size_t i = 1; i < points.size(); ++i) {
        const uint32_t node = i + 1 < points.size() ? addNode(points[i]) : nodeOf[line.to];
        // A bridge's nodes stand on its deck, which ends at the ground's height.
        if (bridge)
          for (const uint32_t n : {before, node})
            graph.nodes[n].position.z = deckHeight(land, land.riverDistance(dvec2(graph.nodes[n].position)));
        if (node == before) continue;
        graph.edges.push_back(
            {before, node, static_cast<float>(line.style.width), line.style.kind, q.names[line.style.name]});
        before = node;
      }
    }
  }
  return graph;
}

}  // namespace vicus::assets::norvic
