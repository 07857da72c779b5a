#include "walk_sweep.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "assets/load_city.hpp"
#include "viewer/navigator.hpp"
#include "viewer/tours.hpp"
#include "walking/surroundings.hpp"

namespace vicus::test {
namespace {

using glm::dvec2;
using glm::dvec3;

/// A monument's triangle in the city.
struct Triangle {
  dvec3 a, b, c;
};

std::vector<Triangle> trianglesOf(const city::City& city) {
  std::vector<Triangle> out;
  for (const city::Monument& m : city.monuments) {
    const city::TriangleMesh& mesh = city.meshes[m.mesh].mesh;
    const double cosine = std::cos(static_cast<double>(m.heading)), sine = std::sin(static_cast<double>(m.heading));
    const auto at = [&](size_t k) {
      const dvec3 p(mesh.vertices[mesh.indices[k]].position);
      return m.position + dvec3(cosine * p.x - sine * p.y, sine * p.x + cosine * p.y, p.z);
    };
    for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) out.push_back({at(t), at(t + 1), at(t + 2)});
  }
  return out;
}

/// Nearest point of a triangle (Ericson 2005, §5.1.5).
dvec3 nearestOn(const Triangle& t, dvec3 p) {
  const dvec3 ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return t.a;
  const dvec3 bp = p - t.b;
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return t.b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return t.a + d1 / (d1 - d3) * ab;
  const dvec3 cp = p - t.c;
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return t.c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return t.a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return t.b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t.c - t.b);
  const double sum = va + vb + vc;
  return sum > 0 ? t.a + vb / sum * ab + vc / sum * ac : t.a;
}

/// Height of the triangle over a point of the plan, where it covers it; from barycentric coordinates.
std::optional<double> heightOver(const Triangle& t, dvec2 p) {
  const dvec2 a(t.a), u = dvec2(t.b) - a, v = dvec2(t.c) - a, w = p - a;
  const double det = u.x * v.y - u.y * v.x;
  if (std::abs(det) < 1e-12) return std::nullopt;
  const double s = (w.x * v.y - w.y * v.x) / det, r = (u.x * w.y - u.y * w.x) / det;
  if (s < -1e-9 || r < -1e-9 || s + r > 1 + 1e-9) return std::nullopt;
  return t.a.z + s * (t.b.z - t.a.z) + r * (t.c.z - t.a.z);
}

void check(const city::City& city, const std::vector<Triangle>& triangles, const viewer::Navigator& n,
           SweepResult& result) {
  const dvec3 eye = n.pose.eye;
  if (!std::isfinite(eye.x + eye.y + eye.z + n.pose.heading + n.pose.pitch + n.velocity.x + n.velocity.y)) {
    ++result.notFinite;
    return;
  }
  constexpr double kSlack = 0.002;  // metres
  const dvec2 at(eye);
  const double wall = walking::kRadius - walking::clearance(city, at, walking::kRadius);
  result.worstWall = std::max(result.worstWall, wall);
  if (wall > kSlack) ++result.insideWalls;

  const double feet = n.standing->feet;
  double ground = walking::dryGroundAt(city, at);
  const double dry = ground;
  bool inside = false;
  for (const Triangle& t : triangles) {
    const dvec2 low = glm::min(glm::min(dvec2(t.a), dvec2(t.b)), dvec2(t.c)) - 0.4;
    const dvec2 high = glm::max(glm::max(dvec2(t.a), dvec2(t.b)), dvec2(t.c)) + 0.4;
    if (at.x < low.x || at.y < low.y || at.x > high.x || at.y > high.y) continue;
    const dvec3 across = glm::cross(t.b - t.a, t.c - t.a);
    const auto over = heightOver(t, at);
    if (over && std::abs(across.z) > 0.64 * glm::length(across) && *over < feet + walking::kStep + 0.01)
      ground = std::max(ground, *over);
    for (const double z : {0.45, 0.7, 0.99, 1.4, 1.79})
      if (glm::distance(nearestOn(t, dvec3(at, feet + z)), dvec3(at, feet + z)) <
          (z > walking::kLegs ? walking::kRadius : walking::kLegRadius) - kSlack) {
        // Near the body's lower edge a sphere reaches below it; only what lies in the body's height counts.
        const dvec3 nearest = nearestOn(t, dvec3(at, feet + z));
        if (nearest.z > feet + walking::kStep + 0.01 && nearest.z < feet + walking::kTall - 0.001 &&
            (nearest.z > feet + walking::kLegs || glm::distance(dvec2(nearest), at) < walking::kLegRadius - kSlack))
          inside = true;
      }
  }
  if (inside) ++result.insideMonuments, result.lastInside = dvec3(at, feet);
  if (ground > dry + 0.05) ++result.onMonuments;
  if (std::abs(ground - feet) > 0.01 || std::abs(eye.z - feet - walking::kEyeHeight) > walking::kStep + 0.01)
    ++result.offGround;
}

}  // namespace

SweepResult sweepOnFoot(const city::City& city, size_t steps, uint32_t seed) {
  const std::vector<Triangle> triangles = trianglesOf(city);
  std::vector<Triangle> near;
  dvec2 nearTo(std::numeric_limits<double>::infinity());
  city::Random random(seed);
  SweepResult result;
  viewer::Navigator n;
  viewer::Input input;
  for (size_t k = 0; k < steps; ++k) {
    if (k % 500 == 0) n = {}, n.pose = viewer::randomStreetView(city, random), n.manners.reducedMotion = k % 1000 == 0;
    if (k % 7 == 0) {
      input.forward = random.uniform() < 0.8, input.back = !input.forward && random.uniform() < 0.5;
      input.left = random.uniform() < 0.2, input.right = random.uniform() < 0.2, input.fast = random.uniform() < 0.6;
      input.stick = {random.uniform(-1, 1) * (random.uniform() < 0.2), 0};
    }
    input.mouse = {random.uniform() < 0.3 ? random.uniform(-500, 500) : 0.0, random.uniform(-30, 30)};
    if (random.uniform() < 0.001) input.mouse.x = std::nan("");
    input.takeBack = k % 97 == 96;
    const double dt = 0.001 * std::exp(random.uniform(0, std::log(2000.0)));  // 1 ms to 2 s
    const dvec2 before(n.pose.eye);
    viewer::step(n, input, dt, city);
    if (k % 500 != 0 && !input.takeBack) result.walked += glm::distance(before, dvec2(n.pose.eye));
    if (n.glide) n.pose = n.glide->to, n.shownEye = n.pose.eye, n.glide.reset();
    if (input.takeBack && (n.mode != viewer::Mode::Walk || !n.standing || !n.ground->stands(*n.standing)))
      ++result.notBack;
    ++result.steps;
    if (!n.standing) {
      ++result.offGround;
      continue;
    }
    if (glm::distance(dvec2(n.pose.eye), nearTo) > 20) {
      nearTo = dvec2(n.pose.eye);
      near.clear();
      for (const Triangle& t : triangles) {
        const dvec2 low = glm::min(glm::min(dvec2(t.a), dvec2(t.b)), dvec2(t.c)) - 22.0;
        const dvec2 high = glm::max(glm::max(dvec2(t.a), dvec2(t.b)), dvec2(t.c)) + 22.0;
        if (nearTo.x > low.x && nearTo.y > low.y && nearTo.x < high.x && nearTo.y < high.y) near.push_back(t);
      }
    }
    check(city, near, n, result);
  }
  return result;
}

namespace {

void expectClean(const std::string& name, size_t steps) {
  std::string input = name;
  if (name.find('/') != std::string::npos) {
    const char* data = std::getenv("VICUS_DATA");
    input = (std::filesystem::path(data ? data : "../shared/data") / name).string();
    if (!std::filesystem::exists(input)) GTEST_SKIP() << "no " << name << " at hand";
  }
  const assets::LoadResult loaded = assets::loadCity(std::vector<std::string>{input}, {});
  ASSERT_TRUE(loaded.city) << name;
  const SweepResult result = sweepOnFoot(*loaded.city, steps, 5);
  std::printf("%s: %zu steps, %.0f m walked, %zu on monuments; %.4f m deepest in a wall's reach\n", name.c_str(),
              result.steps, result.walked, result.onMonuments, result.worstWall);
  EXPECT_EQ(result.steps, steps);
  EXPECT_EQ(result.notFinite, 0u);
  EXPECT_EQ(result.insideWalls, 0u);
  EXPECT_EQ(result.insideMonuments, 0u) << "the last one at " << result.lastInside.x << ", " << result.lastInside.y
                                        << ", " << result.lastInside.z;
  EXPECT_EQ(result.offGround, 0u);
  EXPECT_EQ(result.notBack, 0u);
  EXPECT_GT(result.walked, 0.02 * static_cast<double>(steps)) << "the walker mostly stood still";
}

constexpr const char* kCities[] = {"norvic", "perigueux/bdnb_perigeux8.shp", "lyon/buildings_lyon1.geojson",
                                   "denhaag/DenHaag_01.city.json"};

class WalkSweep : public testing::TestWithParam<const char*> {};
TEST_P(WalkSweep, NeverInAWallUnderTheGroundOrAboveIt) {
  expectClean(GetParam(), 1500);
}
INSTANTIATE_TEST_SUITE_P(Quick, WalkSweep, testing::ValuesIn(kCities));

class DISABLED_WalkSweepInFull : public testing::TestWithParam<const char*> {};
TEST_P(DISABLED_WalkSweepInFull, HundredThousandSteps) {
  expectClean(GetParam(), 100'000);
}
INSTANTIATE_TEST_SUITE_P(Long, DISABLED_WalkSweepInFull, testing::ValuesIn(kCities));

/// Walks after the tour's keys; how far the visitor ends from each at most.
TEST(WalkStreet, TheStreetTourOfNorvicCanBeWalkedOverTheBridgeToo) {
  const assets::LoadResult loaded = assets::loadCity(std::vector<std::string>{"norvic"}, {});
  ASSERT_TRUE(loaded.city);
  const std::vector<city::Tour> tours = viewer::makeTours(*loaded.city);
  const city::Tour& street = *viewer::findTour(tours, "street");
  viewer::Navigator n;
  n.manners.reducedMotion = true;
  n.pose = viewer::poseAt(street, street.keys.front().time);
  viewer::step(n, {}, 0, *loaded.city);
  double farthest = 0, highest = 0;
  for (const city::Tour::Key& key : street.keys) {
    n.goal = dvec2(key.position);
    for (int k = 0; k < 200 && n.goal; ++k) viewer::step(n, {}, 1 / 20.0, *loaded.city);
    const double apart = glm::distance(dvec2(n.pose.eye), dvec2(key.position));
    ASSERT_LT(apart, 2) << "at " << key.position.x << ", " << key.position.y << " after " << key.time << " s";
    farthest = std::max(farthest, std::abs(n.pose.eye.z - key.position.z));
    highest = std::max(highest, n.standing->feet - walking::groundAt(*loaded.city, n.standing->at));
  }
  EXPECT_LT(farthest, 0.5) << "the eye is where the tour's is";
  EXPECT_GT(highest, 2) << "the deck of the bridge is well over the water";
}

}  // namespace
}  // namespace vicus::test
