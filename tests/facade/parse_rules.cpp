#include "facade/parse_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "facade/derive_wall.hpp"

namespace vicus::facade {
namespace {

using testing::HasSubstr;

/// What the parser says of a text that it must refuse.
std::string refused(const std::string& text) {
  city::Diagnostics diagnostics;
  EXPECT_FALSE(parseRules(text, "town.rules", diagnostics)) << text;
  std::string out;
  for (const city::Diagnostic& d : diagnostics.messages) out += city::describe(d) + "\n";
  return out;
}

Style accepted(const std::string& text) {
  city::Diagnostics diagnostics;
  std::optional<Style> style = parseRules(text, "town.rules", diagnostics);
  for (const city::Diagnostic& d : diagnostics.messages) ADD_FAILURE() << city::describe(d);
  return style.value_or(Style{});
}

double valueOf(const std::string& expression) {
  const Style style = accepted("let x1 = " + expression + "\nFacade => Nothing()");
  const StyledHouse house(style, {}, {});
  return house.choices.empty() ? NAN : house.choices[0];
}

TEST(Rules, AMistakeIsToldWithLineColumnAndCaret) {
  EXPECT_EQ(refused("# a style\nFacade => SplitZX((Abs, 1, A))\n"),
            "town.rules:2:11: there is no operator SplitZX\n"
            "  Facade => SplitZX((Abs, 1, A))\n"
            "            ^\n");
}

TEST(Rules, TheCaretStandsUnderThePlaceAlsoBehindAccents) {
  EXPECT_THAT(refused("param é = 3"), HasSubstr("town.rules:1:7: "));
  const std::string said = refused("Facade => SampleTexture(\"plâtre\", Rip, (0,0,1,1))");
  EXPECT_THAT(said, HasSubstr("town.rules:1:35: here belongs Fit or Rep, not Rip"));
  EXPECT_THAT(said, HasSubstr("\n                                    ^"));
}

TEST(Rules, EachMistakeInItsOwnRuleIsTold) {
  const std::string said = refused("A => SplitX((Abs, 1 B))\nB => RepeatX(1)\nFacade => Layer(A, C)\n");
  EXPECT_THAT(said, HasSubstr("town.rules:1:21: here belongs ,, not B"));
  EXPECT_THAT(said, HasSubstr("town.rules:2:15: here belongs ,, not )"));
}

TEST(Rules, SaysWhatIsMissing) {
  EXPECT_THAT(refused("Facade => RepeatX(1, Window)"), HasSubstr("1:22: there is no rule Window"));
  EXPECT_THAT(refused("Wall => Nothing()"), HasSubstr("neither a rule House nor a rule Facade"));
  EXPECT_THAT(refused("Facade => RepeatX(storey, A)\nA => Nothing()"), HasSubstr("storey is no variable"));
  EXPECT_THAT(refused("Facade => splitx((Abs, 1, A))"), HasSubstr("did you mean SplitX?"));
  EXPECT_THAT(refused("param h = 3 m (4 .. 5)\nFacade => Nothing()"),
              HasSubstr("the value of h lies outside its range"));
  EXPECT_THAT(refused("let width = 3\nFacade => Nothing()"), HasSubstr("width has a meaning already"));
  EXPECT_THAT(refused("Facade => SampleTexture(\"a, Fit, (0,0,1,1))"), HasSubstr("does not end on its line"));
  EXPECT_THAT(refused("let a = 1e999\nFacade => Nothing()"), HasSubstr("too large"));
  EXPECT_THAT(refused("let a = foo(1)\nFacade => Nothing()"), HasSubstr("there is no function foo"));
}

TEST(Rules, DeepNestingAndLongSumsAreRefused) {
  EXPECT_THAT(refused("let a = " + std::string(5000, '(') + "1"), HasSubstr("nested too deep"));
  std::string sum = "1";
  for (int i = 0; i < 5000; ++i) sum += "+1";
  EXPECT_THAT(refused("let a = " + sum), HasSubstr("too long"));
  std::string layers;
  for (int i = 0; i < 5000; ++i) layers += "RepeatX(1,";
  EXPECT_THAT(refused("Facade => " + layers), HasSubstr("nested too deep"));
  EXPECT_THAT(refused(std::string(kLongestRules + 1, ' ')), HasSubstr("at most 1 MB"));
}

TEST(Rules, AtMostTwentyMistakesAreTold) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "A =>\n";
  city::Diagnostics diagnostics;
  EXPECT_FALSE(parseRules(text, "many.rules", diagnostics));
  EXPECT_EQ(diagnostics.messages.size(), 20u);
}

TEST(Rules, Arithmetic) {
  EXPECT_DOUBLE_EQ(valueOf("1 + 2 * 3 - 4 / 2"), 5);
  EXPECT_DOUBLE_EQ(valueOf("-(2 + 3) * 2"), -10);
  EXPECT_DOUBLE_EQ(valueOf("35 cm + 5 mm"), 0.355);
  EXPECT_DOUBLE_EQ(valueOf("180 deg"), 3.14159265358979323846);
  EXPECT_DOUBLE_EQ(valueOf("25 %"), 0.25);
  EXPECT_DOUBLE_EQ(valueOf("1 < 2 and 2 <= 2 and not (3 > 4) and 1 != 2"), 1);
  EXPECT_DOUBLE_EQ(valueOf("if(1 > 2 or 3 >= 4, 10, 20)"), 20);
  EXPECT_DOUBLE_EQ(valueOf("max(min(3, 5), clamp(7, 0, 4))"), 4);
  EXPECT_DOUBLE_EQ(valueOf("floor(2.7) + ceil(2.1) + round(2.5) + abs(-1)"), 9);
  EXPECT_DOUBLE_EQ(valueOf("1 / 0"), 0) << "what is not finite becomes 0";
  EXPECT_DOUBLE_EQ(valueOf("\"Stone\" == \"stone\""), 1);
}

TEST(Rules, ParametersKeepTheirRange) {
  const Style style = accepted("param h = 3 m (2 .. 4) \"storey\"\nparam p = 30 deg (10 .. 60)\nFacade => Nothing()");
  ASSERT_EQ(style.parameters.size(), 2u);
  EXPECT_EQ(style.parameters[0].unit, "m");
  EXPECT_EQ(style.parameters[0].meaning, "storey");
  EXPECT_NEAR(style.parameters[1].most, 60 * 3.14159265 / 180, 1e-6);
  const double wishes[] = {100, 0};
  const StyledHouse house(style, {}, wishes);
  EXPECT_DOUBLE_EQ(house.parameters[0], 4);
  EXPECT_DOUBLE_EQ(house.parameters[1], style.parameters[1].least);
}

TEST(Rules, EqualPaintsAreOne) {
  const Style style = accepted(
      "Facade => Layer(SampleTexture(brick, Rep, (0,0,2,2)), SampleTexture(brick, Fit, (0,0,1,1)), "
      "SampleTexture(brick, Fit, (0,0,1,1), (0.5, 0.5, 0.5)), SetColor(1, 0, 0))");
  EXPECT_EQ(style.paints.size(), 4u) << "brick, its tint, red, and the plaster of what no rule paints";
}

TEST(Rules, EveryOperatorHasASentence) {
  for (const OperatorSignature& s : operatorSignatures()) {
    EXPECT_FALSE(s.meaning.empty());
    EXPECT_EQ(&s - operatorSignatures().data(), static_cast<std::ptrdiff_t>(s.kind)) << s.name;
  }
}

}  // namespace
}  // namespace vicus::facade
