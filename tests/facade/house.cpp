#include "facade/house.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "city/random.hpp"
#include "facade/outline.hpp"
#include "facade/parse_rules.hpp"
#include "facade/tower.hpp"

namespace vicus::facade {
namespace {

using city::BuildingGeometry;
using city::PlaneKind;
using glm::dvec2;
using glm::dvec3;

Style styleOf(const std::string& text) {
  city::Diagnostics diagnostics;
  std::optional<Style> style = parseRules(text, "test.rules", diagnostics);
  for (const city::Diagnostic& d : diagnostics.messages) ADD_FAILURE() << city::describe(d);
  return style.value_or(Style{});
}

BuildingGeometry build(const Style& style, const Lot& lot, Derivation* made = nullptr) {
  StyleInUse use;
  use.style = &style;
  use.looks.resize(style.paints.size());
  for (size_t i = 0; i < use.looks.size(); ++i) use.looks[i].material = static_cast<city::MaterialId>(i);
  city::BuildingBuilder builder("house");
  Derivation own;
  addHouse(builder, use, lot, made ? *made : own);
  return builder.finish();
}

double areaOf(const BuildingGeometry& g, city::Range range) {
  double area = 0;
  for (uint32_t i = range.first; i + 2 < range.end(); i += 3) {
    const dvec3 a(g.vertices[g.indices[i]].position), b(g.vertices[g.indices[i + 1]].position),
        c(g.vertices[g.indices[i + 2]].position);
    area += glm::length(glm::cross(b - a, c - a)) / 2;
  }
  return area;
}

double areaOf(const BuildingGeometry& g, PlaneKind kind) {
  double area = 0;
  for (const city::Plane& plane : g.planes)
    if (plane.kind == kind) area += areaOf(g, plane.cut);
  return area;
}

/// Volume inside the cut surfaces and openings over z = floor, m³.
double volumeOf(const BuildingGeometry& g, double floor) {
  double volume = 0;
  const auto add = [&](city::Range range) {
    for (uint32_t i = range.first; i + 2 < range.end(); i += 3) {
      dvec3 p[3];
      for (uint32_t k = 0; k < 3; ++k) p[k] = dvec3(g.vertices[g.indices[i + k]].position) - dvec3(0, 0, floor);
      volume += glm::dot(p[0], glm::cross(p[1], p[2])) / 6;
    }
  };
  for (const city::Plane& plane : g.planes) {
    add(plane.cut);
    for (uint32_t i = plane.externalOpenings.first; i < plane.externalOpenings.end(); ++i)
      add(g.externalOpenings[i].indices);
  }
  return volume;
}

constexpr const char* kPlain = R"(
plain plaster
House => Extrude(house.height, Comp(side: Wall, roof: Roof(FORM, 30 deg, 0, tile, Wall)))
Wall => SampleTexture(plaster, Rep, (0, 0, 2, 2))
)";

std::string plainWith(const std::string& form) {
  std::string text = kPlain;
  text.replace(text.find("FORM"), 4, form);
  return text;
}

Lot lotOf(const Ring& ring, double height) {
  Lot lot;
  lot.rings = {ring};
  lot.facts.height = height;
  return lot;
}

TEST(House, AGableHouseIsABoxAndAPrism) {
  const BuildingGeometry g = build(styleOf(plainWith("gable")), lotOf({{0, 0}, {12, 0}, {12, 8}, {0, 8}}, 6));
  const double rise = 4 * std::tan(glm::radians(30.0));
  EXPECT_NEAR(areaOf(g, PlaneKind::Wall), 40 * 6, 1e-3);
  EXPECT_NEAR(areaOf(g, PlaneKind::Gable), 2 * 8 * rise / 2, 1e-3);
  EXPECT_NEAR(areaOf(g, PlaneKind::Roof), 2 * 12 * 4 / std::cos(glm::radians(30.0)), 1e-3);
  EXPECT_NEAR(volumeOf(g, 0), 12 * 8 * 6 + 12 * 8 * rise / 2, 1e-2);
}

TEST(House, EveryRoofCoversItsPlanOnce) {
  for (const char* form :
       {"gable", "gable_front", "hip", "half_hip", "gambrel", "mansard", "shed", "pyramid", "flat", "dome"})
    for (const Ring& ring :
         {Ring{{0, 0}, {12, 0}, {12, 8}, {0, 8}}, Ring{{0, 0}, {20, 0}, {20, 8}, {8, 8}, {8, 20}, {0, 20}}}) {
      const BuildingGeometry g = build(styleOf(plainWith(form)), lotOf(ring, 6));
      double plan = 0, expected = 0;
      for (const city::Plane& plane : g.planes)
        if (plane.kind == PlaneKind::Roof)
          for (uint32_t i = plane.cut.first; i + 2 < plane.cut.end(); i += 3) {
            const dvec3 a(g.vertices[g.indices[i]].position), b(g.vertices[g.indices[i + 1]].position),
                c(g.vertices[g.indices[i + 2]].position);
            const double z = glm::cross(b - a, c - a).z / 2;
            EXPECT_GT(z, 0) << form;
            plan += z;
          }
      for (size_t i = 0; i < ring.size(); ++i) {
        const dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
        expected += (a.x * b.y - a.y * b.x) / 2;
      }
      EXPECT_NEAR(plan, expected, 1e-3 * expected) << form;
    }
}

TEST(House, OpeningsGoInAndTheWallIsWhatIsLeft) {
  const Style style = styleOf(R"(
plain plaster
far "facade-plaster" 2.6 m 2.9 m
House => Extrude(house.height, Comp(front: Front, side: Wall, roof: Roof(flat, 0, 0, tile, Wall)))
Front => Layer(Wall, RepeatX(3, SplitX((Rel, 1, Nothing()), (Abs, 1, SplitY((Abs, 1, Nothing()), (Abs, 1.5, Window))), (Rel, 1, Nothing()))))
Wall => SampleTexture(plaster, Rep, (0, 0, 2, 2))
Window => AttachScope(opening, -0.2, 30, 40, glass, ashlar)
)");
  const BuildingGeometry g = build(style, lotOf({{0, 0}, {12, 0}, {12, 8}, {0, 8}}, 6));
  ASSERT_EQ(g.externalOpenings.size(), 4u);
  for (const city::ExternalOpening& o : g.externalOpenings) {
    EXPECT_FLOAT_EQ(o.depth, 0.2f);
    EXPECT_NEAR(areaOf(g, o.indices), 1.5 + 2 * 0.2 * 2.5, 1e-4);
  }
  EXPECT_NEAR(areaOf(g, PlaneKind::Wall), 40 * 6 - 4 * 1.5, 1e-3);
  // Recesses take their volume out of the house.
  EXPECT_NEAR(volumeOf(g, 0), 12 * 8 * 6 - 4 * 1.5 * 0.2, 1e-2);
  // Flat, the front is one picture over the whole wall.
  EXPECT_NEAR(areaOf(g, g.planes[0].flat), 12 * 6, 1e-3);
  EXPECT_EQ(g.planes[1].flat, g.planes[1].cut);
}

TEST(House, APartyWallStartsAtTheNeighboursHeightAndHasNoWindows) {
  const Style style = styleOf(R"(
plain plaster
House => Extrude(house.height, Comp(front: Windows, side: Windows, back: Windows, party: Wall, roof: Roof(flat, 0, 0, tile, Wall)))
Wall => SampleTexture(plaster, Rep, (0, 0, 2, 2))
Windows => Layer(Wall, RepeatX(2, AttachScope(panel, 0.02, 30, 40)))
)");
  Lot lot = lotOf({{0, 0}, {12, 0}, {12, 8}, {0, 8}}, 9);
  lot.neighbours = {{-INFINITY, 5, NAN, 9}};
  const BuildingGeometry g = build(style, lot);
  int walls = 0;
  for (const city::Plane& p : g.planes) {
    if (p.kind != PlaneKind::Wall) continue;
    ++walls;
    if (std::abs(p.normal.x) < 0.5f) continue;
    EXPECT_EQ(p.externalGeometry.count, 0u);
    EXPECT_NEAR(areaOf(g, p.cut), 8 * (9 - 5 + 0.3), 1e-3) << "from a hand's breadth under the neighbour's eaves";
  }
  EXPECT_EQ(walls, 3) << "where the neighbour is as high there is nothing to see";
  for (const city::OccluderLine& o : g.occluders)
    if (o.a.x == o.b.x) {
      EXPECT_NEAR(o.bottom, 4.7, 1e-5) << "what is not drawn hides nothing";
    }
}

TEST(House, AJettyHangsOverTheFrontAlone) {
  const Style style = styleOf(R"(
plain plaster
House => Extrude(house.height, SplitZ((Abs, 3, Comp(side: Wall)), (Rel, 1, Jetty(0.5, Comp(side: Wall, roof: Roof(flat, 0, 0, tile, Wall))))))
Wall => SampleTexture(plaster, Rep, (0, 0, 2, 2))
)");
  const BuildingGeometry g = build(style, lotOf({{0, 0}, {12, 0}, {12, 8}, {0, 8}}, 6));
  EXPECT_NEAR(g.bounds.min.y, -0.5, 1e-5);
  EXPECT_NEAR(g.bounds.max.y, 8, 1e-5);
  EXPECT_NEAR(volumeOf(g, 0), 12 * 8 * 6 + 12 * 0.5 * 3, 1e-2);
}

TEST(House, ChimneysDormersAndEavesStandOutOfTheRoof) {
  const Style style = styleOf(R"(
plain plaster
House => Extrude(house.height, Comp(side: Wall, roof: Layer(Roof(gable, 45 deg, 0.4, tile, Wall), Chimney(0.8, 0.5, 1.2, brick), Dormer(1.2, 1.3, 4, tile, Wall))))
Wall => SampleTexture(plaster, Rep, (0, 0, 2, 2))
)");
  const BuildingGeometry g = build(style, lotOf({{0, 0}, {14, 0}, {14, 8}, {0, 8}}, 6));
  EXPECT_NEAR(g.bounds.max.z, 6 + 4 + 1.2, 1e-3);
  EXPECT_NEAR(g.bounds.min.y, -0.4, 1e-4);
  EXPECT_EQ(g.externalGeometry.size(), 2u + 1u + 3u) << "two eaves, a stack, three dormers";
  EXPECT_NEAR(volumeOf(g, 0), 14 * 8 * 6 + 14 * 8 * 4 / 2, 1e-2) << "and what they stand on is whole";
}

TEST(House, ALeanToRunsAllRoundAndLeavesNoGap) {
  const Style style = styleOf(R"(
plain plaster
House => Extrude(house.height, SplitZ((Rel, 1, Comp(side: Wall)), (Rel, 1, LeanTo(2, 1, tile, Comp(side: Wall, roof: Roof(flat, 0, 0, tile, Wall))))))
Wall => SampleTexture(plaster, Rep, (0, 0, 2, 2))
)");
  Lot lot = lotOf({{0, 0}, {12, 0}, {12, 8}, {0, 8}}, 8);
  // Below 4 m the whole, over it a frustum 1 m high, then a box of 8 × 4 m.
  const double frustum = (12 * 8 + 8 * 4 + 4 * 10 * 6) / 6.0;
  EXPECT_NEAR(volumeOf(build(style, lot), 0), 12 * 8 * 4 + frustum + 8 * 4 * 3, 1e-2);
  // Where a neighbour stands the wall goes straight up: 2 m more on that side.
  lot.neighbours = {{-INFINITY, 3, -INFINITY, -INFINITY}};
  const BuildingGeometry terraced = build(style, lot);
  EXPECT_NEAR(terraced.bounds.max.x, 12, 1e-5);
  double plan = 0;
  for (const city::Plane& plane : terraced.planes)
    if (plane.kind == PlaneKind::Roof) plan += areaOf(terraced, plane.cut) * static_cast<double>(plane.normal.z);
  EXPECT_NEAR(plan, 12 * 8, 1e-3);
  // Without room the walls stay where they are.
  EXPECT_NEAR(volumeOf(build(style, lotOf({{0, 0}, {12, 0}, {12, 3.5}, {0, 3.5}}, 8)), 0), 12 * 3.5 * 8, 1e-2);
}

TEST(House, TowersAreHousesOfTheirOwn) {
  const Style style = styleOf(R"(
plain plaster
House => Layer(Extrude(house.height, Comp(side: Wall)), Tower(4, 20, Comp(side: Wall, roof: Roof(pyramid, 70 deg, 0, tile, Wall))))
Wall => SampleTexture(plaster, Rep, (0, 0, 2, 2))
)");
  const BuildingGeometry g = build(style, lotOf({{0, 0}, {20, 0}, {20, 8}, {0, 8}}, 6));
  EXPECT_NEAR(g.bounds.min.x, -0.5, 1e-5) << "before the western end";
  const double spire = 2 * std::tan(glm::radians(70.0));
  EXPECT_NEAR(g.bounds.max.z, 20 + spire, 1e-3);
  EXPECT_NEAR(volumeOf(g, 0), 20 * 8 * 6 + 16 * 20 + 16 * spire / 3, 1e-2);
  EXPECT_FALSE(endTower({{0, 0}, {20, 0}, {20, 0.5}, {0, 0.5}}, 4)) << "no room for one";
  const std::vector<uint8_t> free(4, 0), party{0, 1, 0, 0};
  const Ring square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  EXPECT_EQ(cornerTurrets(square, free, 2).size(), 4u);
  EXPECT_EQ(cornerTurrets(square, party, 2).size(), 2u);
  EXPECT_TRUE(cornerTurrets(square, free, 8).empty());
}

TEST(House, OnASlopeWindowsStandOnTheGround) {
  const Style style = styleOf(R"(
plain plaster
House => Extrude(house.height, Comp(side: Front, roof: Roof(flat, 0, 0, tile, Wall)))
Front => Layer(Wall, RepeatX(2, Window))
Wall => SampleTexture(plaster, Rep, (0, 0, 2, 2))
Window => SplitY((Abs, 1, AttachScope(opening, -0.2, 30, 40, glass, ashlar)), (Rel, 1, Nothing()))
)");
  Lot lot = lotOf({{0, 0}, {12, 0}, {12, 8}, {0, 8}}, 6);
  lot.foundation = 3;
  // It rises from -1.5 m in the west to 1.5 m in the east.
  lot.ground = {{{-1.5, 1.5}, {1.5, 1.5}, {1.5, -1.5}, {-1.5, -1.5}}};
  const BuildingGeometry g = build(style, lot);
  EXPECT_NEAR(volumeOf(g, -3), 12 * 8 * 9 - 0.2 * 2 * (12 + 8) * 1, 1e-2) << "closed but for what windows take";
  ASSERT_EQ(g.externalOpenings.size(), 20u);
  double most = 0;
  for (const city::ExternalOpening& o : g.externalOpenings) {
    double low = INFINITY, x = 0;
    for (uint32_t i = o.indices.first; i < o.indices.end(); ++i) {
      const glm::vec3 p = g.vertices[g.indices[i]].position;
      low = std::min(low, static_cast<double>(p.z)), x = static_cast<double>(p.x);
    }
    const double ground = -1.5 + 3 * x / 12;
    EXPECT_GT(low, ground - 0.2) << "at x " << x;
    most = std::max(most, low - ground);
  }
  EXPECT_LT(most, 1.1) << "nothing hangs far above the ground";
  // Ground over the eaves leaves a wall without windows, not one turned upside down.
  lot.ground = {{{9, 9}, {9, 9}, {9, 9}, {9, 9}}};
  EXPECT_NEAR(volumeOf(build(style, lot), -3), 12 * 8 * 9, 12);
}

TEST(House, TheEndOfARowLooksAtTheStreet) {
  Lot lot = lotOf({{0, 0}, {6, 0}, {6, 14}, {0, 14}}, 6);
  EXPECT_EQ(facesOf(lot)[0][1], Face::Front) << "free all round: its longest side";
  lot.neighbours = {{-INFINITY, -INFINITY, -INFINITY, 5}};
  EXPECT_EQ(facesOf(lot)[0][0], Face::Front);
  EXPECT_EQ(facesOf(lot)[0][1], Face::Side);
}

TEST(House, SameLotSameHouse) {
  const Style style = styleOf(plainWith("hip"));
  const Lot lot = lotOf({{0, 0}, {12, 0}, {13, 8}, {0, 8}}, 6);
  EXPECT_EQ(build(style, lot).vertices, build(style, lot).vertices);
}

}  // namespace
}  // namespace vicus::facade
