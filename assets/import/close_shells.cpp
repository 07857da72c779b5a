// Based on: Liepa 2003, "Filling holes in meshes", §3 (the triangles of least dihedral angle and area over a loop that
// is not flat), as CGAL's Polygon_mesh_processing has it.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "assets/import/polygon.hpp"
#include "assets/import/shells.hpp"

namespace vicus::assets {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Loop = std::vector<uint32_t>;
using Points = std::vector<glm::dvec3>;

constexpr double kFlat = 0.05;        ///< metres off their mean plane that the points of a flat hole may lie
constexpr double kNarrowest = 0.01;   ///< metres: narrower holes are slits between points that do not quite meet
constexpr double kMostMissing = 0.9;  ///< as a share of the area that is there
constexpr size_t kMostEdges = 100;    ///< of a hole: the search for its triangles takes the cube of them

/// Loops of edges that only one face of a shell has, each run the way that a face over the hole would be wound; those
/// of holes in a face are openings, which somebody meant. Ends that lead nowhere are counted in `broken`.
std::vector<Loop> openLoops(const std::vector<Face>& faces, const std::vector<size_t>& shell, size_t& broken) {
  std::map<std::pair<uint32_t, uint32_t>, int> uses;
  std::set<std::pair<uint32_t, uint32_t>> openings;
  for (const size_t f : shell)
    for (size_t r = 0; r < faces[f].rings.size(); ++r) {
      const auto& ring = faces[f].rings[r];
      for (size_t i = 0; i < ring.size(); ++i) {
        const std::pair edge(ring[i], ring[(i + 1) % ring.size()]);
        ++uses[edge];
        if (r > 0) openings.insert(edge);
      }
    }
  std::multimap<uint32_t, uint32_t> next;
  for (const auto& [edge, count] : uses) {
    if (openings.contains(edge)) continue;
    const auto back = uses.find({edge.second, edge.first});
    for (int k = back == uses.end() ? 0 : back->second; k < count; ++k) next.emplace(edge.second, edge.first);
  }
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop path{next.begin()->first};
    while (true) {
      const auto step = next.find(path.back());
      if (step == next.end()) {
        ++broken;
        break;
      }
      const uint32_t to = step->second;
      next.erase(step);
      // Where the path meets itself a loop is complete, and the rest goes on from there.
      const auto met = std::find(path.begin(), path.end(), to);
      if (met == path.end()) {
        path.push_back(to);
        continue;
      }
      loops.emplace_back(met, path.end());
      path.erase(met + 1, path.end());
      if (path.size() == 1) break;
    }
  }
  return loops;
}

/// A flat or bent hole: its outline, and the loops within it that run the other way.
struct Hole {
  std::vector<Loop> rings;
  glm::dvec3 areaVector{0};
  glm::dvec3 middle{0};
  bool flat = false;
};

Hole holeOf(const Loop& loop, const Points& points) {
  Hole hole;
  hole.rings = {loop}, hole.areaVector = newell(points, loop);
  for (const uint32_t i : loop) hole.middle += points[i] / static_cast<double>(loop.size());
  const double area = glm::length(hole.areaVector);
  if (!(area > 0)) return hole;
  const glm::dvec3 normal = hole.areaVector / area;
  hole.flat = std::all_of(loop.begin(), loop.end(),
                          [&](uint32_t i) { return std::abs(glm::dot(points[i] - hole.middle, normal)) <= kFlat; });
  return hole;
}

bool isSlit(const Hole& hole, const Points& points) {
  const Loop& loop = hole.rings[0];
  double length = 0;
  for (size_t i = 0; i < loop.size(); ++i) length += glm::length(points[loop[(i + 1) % loop.size()]] - points[loop[i]]);
  return loop.size() < 3 || 2 * glm::length(hole.areaVector) <= kNarrowest * length;
}

/// Does the loop lie within the hole's outline, in one plane with it and wound against it, as about a courtyard?
bool isWithin(const Hole& inner, const Hole& outer, const Points& points) {
  if (!inner.flat || !outer.flat || glm::dot(inner.areaVector, outer.areaVector) >= 0) return false;
  if (glm::length(inner.areaVector) >= glm::length(outer.areaVector)) return false;
  const glm::dvec3 normal = glm::normalize(outer.areaVector);
  if (std::abs(glm::dot(inner.middle - outer.middle, normal)) > kFlat) return false;
  const glm::dvec3 u =
      glm::normalize(glm::cross(std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0), normal));
  const glm::dvec3 v = glm::cross(normal, u), p = points[inner.rings[0][0]];
  bool inside = false;
  const Loop& loop = outer.rings[0];
  for (size_t i = 0; i < loop.size(); ++i) {
    const glm::dvec3 a = points[loop[i]] - p, b = points[loop[(i + 1) % loop.size()]] - p;
    const double ay = glm::dot(a, v), by = glm::dot(b, v);
    if ((ay > 0) == (by > 0)) continue;
    const double x = glm::dot(a, u) - ay * (glm::dot(b, u) - glm::dot(a, u)) / (by - ay);
    if (x > 0) inside = !inside;
  }
  return inside;
}

/// The triangles of least bend and area over a loop; empty where there are none.
std::vector<Loop> trianglesOver(const Loop& loop, const Points& points) {
  std::vector<Kernel::Point_3> line;
  for (const uint32_t i : loop) line.emplace_back(points[i].x, points[i].y, points[i].z);
  std::vector<CGAL::Triple<int, int, int>> found;
  try {
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(line, std::back_inserter(found));
  } catch (const std::exception&) {
    return {};  // a precondition of the library that these points do not meet
  }
  std::vector<Loop> out;
  for (const auto& t : found)
    out.push_back(
        {loop[static_cast<size_t>(t.first)], loop[static_cast<size_t>(t.second)], loop[static_cast<size_t>(t.third)]});
  return out;
}

Face faceOver(std::vector<Loop> rings, uint32_t shell, const Points& points) {
  Face face;
  face.shell = shell, face.solid = true;
  face.rings = std::move(rings);
  for (const auto& ring : face.rings) face.areaVector += newell(points, ring);
  const double area = glm::length(face.areaVector);
  if (area > 0) face.normal = face.areaVector / area;
  return face;
}

}  // namespace

bool closeShells(std::vector<Face>& faces, const Points& points, SurfaceReport& report) {
  bool any = false;
  std::map<uint32_t, std::vector<size_t>> shells;
  for (size_t f = 0; f < faces.size(); ++f)
    if (faces[f].solid) shells[faces[f].shell].push_back(f);
  for (const auto& [number, shell] : shells) {
    size_t open = 0;
    std::vector<Hole> holes;
    for (const Loop& loop : openLoops(faces, shell, open))
      if (Hole hole = holeOf(loop, points); !isSlit(hole, points)) holes.push_back(std::move(hole));
    if (holes.empty()) continue;
    // The largest first: what lies within one is a ring of it.
    std::sort(holes.begin(), holes.end(),
              [](const Hole& a, const Hole& b) { return glm::length(a.areaVector) > glm::length(b.areaVector); });
    std::vector<Hole> whole;
    for (const Hole& hole : holes) {
      const auto about =
          std::find_if(whole.begin(), whole.end(), [&](const Hole& h) { return isWithin(hole, h, points); });
      if (about == whole.end())
        whole.push_back(hole);
      else
        about->rings.push_back(hole.rings[0]);
    }

    std::vector<Face> added;
    double area = 0, missing = 0;
    for (const size_t f : shell) area += glm::length(faces[f].areaVector);
    for (const Hole& hole : whole) {
      const size_t before = added.size();
      if (hole.flat)
        added.push_back(faceOver(hole.rings, number, points));
      else if (hole.rings[0].size() <= kMostEdges)
        for (Loop& triangle : trianglesOver(hole.rings[0], points))
          added.push_back(faceOver({std::move(triangle)}, number, points));
      if (added.size() == before) ++open;
    }
    for (const Face& f : added) missing += glm::length(f.areaVector);
    if (missing > kMostMissing * area) {
      report.open += static_cast<uint32_t>(whole.size());
      continue;
    }
    report.open += static_cast<uint32_t>(open);
    if (added.empty()) continue;
    report.closed += static_cast<uint32_t>(whole.size() - std::min(open, whole.size()));
    for (const size_t f : shell) faces[f].bothSides = false;
    for (Face& f : added) faces.push_back(std::move(f));
    any = true;
  }
  return any;
}

}  // namespace vicus::assets
