#include "facade/derive_wall.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "facade/parse_rules.hpp"
#include "facade/wall_mesh.hpp"

namespace vicus::facade {
namespace {

Style styleOf(const std::string& text) {
  city::Diagnostics diagnostics;
  std::optional<Style> style = parseRules(text, "test.rules", diagnostics);
  for (const city::Diagnostic& d : diagnostics.messages) ADD_FAILURE() << city::describe(d);
  return style.value_or(Style{});
}

struct Result {
  WallDetail wall;
  Derivation made;
};

Result derive(const std::string& text, double width, double height, uint32_t seed = 1) {
  const Style style = styleOf(text);
  HouseFacts facts;
  facts.seed = seed;
  const StyledHouse house(style, facts, {});
  Result r;
  r.wall = deriveWall(house, style.facade, width, height, 0, seed, r.made);
  return r;
}

constexpr const char* kTerminals = "\nA => AttachScope(panel, 0.1, 30, 40)\nB => Nothing()\n";

TEST(DeriveWall, AbsoluteRelativeAndFloatingPieces) {
  // 10 m: 2 absolute, 3 floating kept because relative ones take the rest, 5 shared as 1 to 4.
  const Result r =
      derive(std::string("Facade => SplitX((Abs, 2, A), (Flt, 3, A), (Rel, 1, A), (Rel, 4, A))") + kTerminals, 10, 3);
  ASSERT_EQ(r.wall.attachments.size(), 4u);
  const double edges[] = {0, 2, 5, 6, 10};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(r.wall.attachments[i].rect.left, edges[i], 1e-12);
    EXPECT_NEAR(r.wall.attachments[i].rect.right, edges[i + 1], 1e-12);
  }
  // Without relative ones the floating pieces stretch.
  const Result stretched =
      derive(std::string("Facade => SplitY((Abs, 1, A), (Flt, 2, A), (Flt, 1, A))") + kTerminals, 5, 10);
  EXPECT_NEAR(stretched.wall.attachments[1].rect.height(), 6, 1e-12);
  EXPECT_NEAR(stretched.wall.attachments[2].rect.height(), 3, 1e-12);
}

TEST(DeriveWall, PiecesThatDoNotFitShrinkAlike) {
  const Result r = derive(std::string("Facade => SplitX((Abs, 6, A), (Abs, 2, A), (Rel, 1, A))") + kTerminals, 4, 3);
  ASSERT_EQ(r.wall.attachments.size(), 2u) << "the relative piece has nothing left";
  EXPECT_NEAR(r.wall.attachments[0].rect.width(), 3, 1e-12);
  EXPECT_NEAR(r.wall.attachments[1].rect.width(), 1, 1e-12);
  EXPECT_EQ(r.made.squeezed, 1u);
  EXPECT_EQ(r.made.empty, 1u);
}

TEST(DeriveWall, RepeatsFillTheScopeEvenly) {
  const Result r = derive(std::string("Facade => RepeatX(2.6, A)") + kTerminals, 10, 3);
  ASSERT_EQ(r.wall.attachments.size(), 4u);
  for (const Attachment& a : r.wall.attachments) EXPECT_NEAR(a.rect.width(), 2.5, 1e-12);
  EXPECT_EQ(r.wall.attachments.back().rect.right, 10);
}

TEST(DeriveWall, ThePapersWindowIsSplitAsItSays) {
  // Krecklau et al. 2013, §8, with their Rel as a share of what is left.
  const Result r = derive(R"(
Facade      => SplitY((Abs, 1, Apron), (Rel, 1, WindowMid), (Abs, 1, Pilaster))
WindowMid   => SplitX((Abs, .5, Column), (Rel, 1, WindowTile), (Abs, .5, Column))
WindowTile  => Layer(Interior, WindowFrame)
Interior    => SampleTexture(room, Fit, (0, 0, 1, 1))
WindowFrame => AttachScope(opening, -0.2, 30, 40)
Pilaster    => AttachScope(pediment, 0.3, 30, 40)
Apron       => AttachScope(block, 0.1, 30, 40)
Column      => AttachScope(pilaster, 0.2, 30, 40)
)",
                          3, 5);
  EXPECT_EQ(r.wall.fills.size(), 1u);
  ASSERT_EQ(r.wall.attachments.size(), 5u);
  const Attachment& window = r.wall.attachments[2];
  EXPECT_EQ(window.shape, Shape::Opening);
  EXPECT_NEAR(window.rect.left, 0.5, 1e-12);
  EXPECT_NEAR(window.rect.top, 4, 1e-12);
  EXPECT_EQ(window.near, 30);
  EXPECT_EQ(window.far, 40);
}

TEST(DeriveWall, ConditionsAndWeights) {
  const std::string text =
      std::string("Facade : width < 2 => A\nFacade @ 3 => RepeatX(1, A)\nFacade @ 1 => RepeatX(2, A)") + kTerminals;
  EXPECT_EQ(derive(text, 1.5, 3).wall.attachments.size(), 1u);
  int fine = 0;
  constexpr int kHouses = 4000;
  for (uint32_t seed = 0; seed < kHouses; ++seed) fine += derive(text, 8, 3, seed).wall.attachments.size() == 8;
  EXPECT_NEAR(fine, 0.75 * kHouses, 4 * std::sqrt(0.75 * 0.25 * kHouses)) << "within four standard deviations";
}

TEST(DeriveWall, AMaskLeavesOutOfTheLayerBelowIt) {
  // Krecklau et al. 2013, §7.2: wall, ivy, mask, from the lowest up.
  const auto leaves = [](const std::string& mask) {
    return derive(
        "Facade => Layer(Wall, Ivy, Mask)\nWall => SampleTexture(brick, Rep, (0,0,2,2))\n"
        "Ivy => AttachTexture(leaf, Rep, (0,0,1,1), 5, 10, leaves)\nMask => SkipMask(" +
            mask + ")",
        8, 6);
  };
  const size_t all = leaves("foot, Fit, (0,0,1,1), 0, 1").wall.attachments.size();
  const Result lower = leaves("foot, Fit, (0,0,1,1), 0.5, 1");
  EXPECT_GT(all, 400u);
  EXPECT_NEAR(static_cast<double>(lower.wall.attachments.size()), static_cast<double>(all) / 2,
              0.1 * static_cast<double>(all));
  for (const Attachment& a : lower.wall.attachments) EXPECT_LE((a.rect.bottom + a.rect.top) / 2, 3);
  EXPECT_EQ(lower.wall.fills.size(), 1u) << "the wall is two layers below and stays";
}

TEST(DeriveWall, SameSeedSameWallOtherSeedOtherWall) {
  const std::string text = std::string("Facade => RepeatX(1, C)\nC @ 1 => A\nC @ 1 => B") + kTerminals;
  const auto at = [&](uint32_t seed) {
    std::vector<double> lefts;
    for (const Attachment& a : derive(text, 30, 3, seed).wall.attachments) lefts.push_back(a.rect.left);
    return lefts;
  };
  EXPECT_EQ(at(5), at(5));
  EXPECT_NE(at(5), at(6));
}

TEST(DeriveWall, RulesThatCallThemselvesEnd) {
  const Result deep = derive("Facade => Layer(Facade, Facade)", 5, 5);
  EXPECT_LE(deep.made.scopes, kMostScopes);
  EXPECT_LE(deep.made.deepest, kDeepestRule);
  EXPECT_GT(deep.made.cutShort, 0u);
}

TEST(DeriveWall, VisiblePiecesCoverTheWallOnceButForItsOpenings) {
  const Result r = derive(R"(
Facade => SplitY((Abs, 3.2, Ground), (Flt, 2.8, Floor))
Ground => Layer(SampleTexture(ashlar, Rep, (0,0,2,2)), RepeatX(3, Door))
Door   => SplitX((Rel, 1, Nothing()), (Abs, 1, SplitY((Abs, 2.1, AttachScope(opening, -0.2, 30, 40)), (Rel, 1, Nothing()))), (Rel, 1, Nothing()))
Floor  => RepeatX(2.3, SplitX((Rel, 1, Wall), (Abs, 1, Window), (Rel, 1, Wall)))
Wall   => SampleTexture(plaster, Rep, (0,0,2,2))
Window => SplitY((Rel, 1, Wall), (Abs, 1.5, AttachScope(opening, -0.15, 30, 40)), (Rel, 1, Wall))
)",
                          11, 9);
  double openings = 0, covered = 0;
  for (const Attachment& a : r.wall.attachments) openings += a.rect.width() * a.rect.height();
  const std::vector<VisibleFill> pieces = visibleFills(r.wall, 11, 9, 0.7);
  for (const VisibleFill& p : pieces) {
    covered += p.rect.width() * p.rect.height();
    for (const VisibleFill& q : pieces) {
      if (&p == &q) continue;
      const double w = std::min(p.rect.right, q.rect.right) - std::max(p.rect.left, q.rect.left);
      const double h = std::min(p.rect.top, q.rect.top) - std::max(p.rect.bottom, q.rect.bottom);
      EXPECT_TRUE(w <= 1e-9 || h <= 1e-9);
    }
  }
  EXPECT_GT(openings, 10);
  EXPECT_NEAR(covered + openings, 11 * 9.7, 1e-9);
}

}  // namespace
}  // namespace vicus::facade
