#include "facade/rule_words.hpp"

#include <algorithm>
#include <numbers>

namespace vicus::facade {
namespace {

constexpr Slot kPieces[] = {Slot::Pieces};
constexpr Slot kNumberRule[] = {Slot::Number, Slot::Rule};
constexpr Slot kRules[] = {Slot::Rules};
constexpr Slot kMask[] = {Slot::Mask, Slot::Mapping, Slot::Box, Slot::Number, Slot::Number};
constexpr Slot kSample[] = {Slot::Texture, Slot::Mapping, Slot::Box, Slot::Colour};
constexpr Slot kColour[] = {Slot::Number, Slot::Number, Slot::Number};
constexpr Slot kAttachScope[] = {Slot::Shape, Slot::Number, Slot::Number, Slot::Number, Slot::Textures};
constexpr Slot kAttachTexture[] = {Slot::Shape, Slot::Mapping, Slot::Box, Slot::Number, Slot::Number, Slot::Textures};
constexpr Slot kFaces[] = {Slot::Faces};
constexpr Slot kRoof[] = {Slot::Form, Slot::Number, Slot::Number, Slot::Texture, Slot::Rule};
constexpr Slot kLeanTo[] = {Slot::Number, Slot::Number, Slot::Texture, Slot::Rule};
constexpr Slot kTower[] = {Slot::Number, Slot::Number, Slot::Rule};
constexpr Slot kChimney[] = {Slot::Number, Slot::Number, Slot::Number, Slot::Texture};
constexpr Slot kDormer[] = {Slot::Number, Slot::Number, Slot::Number, Slot::Texture, Slot::Rule};

constexpr OperatorSignature kSignatures[] = {
    {Operator::SplitX, "SplitX", kPieces, "Cuts a scope into pieces from left to right."},
    {Operator::SplitY, "SplitY", kPieces, "Cuts a scope into pieces from its foot up."},
    {Operator::RepeatX, "RepeatX", kNumberRule, "Fills the width with equal scopes about as wide as the number."},
    {Operator::RepeatY, "RepeatY", kNumberRule, "Fills the height with equal scopes about as high as the number."},
    {Operator::Layer, "Layer", kRules, "Lays several rules over one scope, the last on top."},
    {Operator::SkipMask, "SkipMask", kMask,
     "Leaves out of the layer below what lies where the mask is outside the two numbers."},
    {Operator::SampleTexture, "SampleTexture", kSample, "Paints the scope with a texture, fitted or repeated."},
    {Operator::SetColor, "SetColor", kColour, "Paints the scope with one colour."},
    {Operator::AttachScope, "AttachScope", kAttachScope,
     "Fits a shape into the scope: depth (negative goes into the wall), near and far distance, textures."},
    {Operator::AttachTexture, "AttachTexture", kAttachTexture, "Scatters sixteen shapes over each tile of the scope."},
    {Operator::SplitZ, "SplitZ", kPieces, "Cuts a volume into volumes that stand on each other."},
    {Operator::Extrude, "Extrude", kNumberRule, "Raises a footprint to a volume so many metres high."},
    {Operator::Comp, "Comp", kFaces, "Gives each face of a volume the rule of its kind."},
    {Operator::Offset, "Offset", kNumberRule, "Moves the free walls of a volume outward by so many metres, or inward."},
    {Operator::Jetty, "Jetty", kNumberRule, "Moves the front of a volume outward; its underside shows."},
    {Operator::LeanTo, "LeanTo", kLeanTo,
     "Draws the free walls of a volume in behind a sloping roof: metres inward, metres up, covering."},
    {Operator::Tower, "Tower", kTower,
     "Stands a square tower before an end of the volume: width, height over the ground, rule of its volume."},
    {Operator::Turrets, "Turrets", kTower, "Stands a square turret on each free right-angled corner, likewise."},
    {Operator::Roof, "Roof", kRoof, "Covers a volume: form, pitch, overhang, covering, rule of its gables."},
    {Operator::Chimney, "Chimney", kChimney,
     "Puts a stack beside the roof's highest point: width, depth, height over "
     "it, texture."},
    {Operator::Dormer, "Dormer", kDormer,
     "Puts windows with roofs of their own on slopes over fronts: width, height, spacing, covering, rule of its face."},
    {Operator::Nothing, "Nothing", {}, "Leaves the scope as it is."},
};
static_assert(std::size(kSignatures) == static_cast<size_t>(Operator::Count));

constexpr std::string_view kFaceNames[] = {"front", "side", "back", "party", "roof"};
static_assert(std::size(kFaceNames) == static_cast<size_t>(Face::Count));
constexpr std::string_view kRoofNames[] = {"gable",   "gable_front", "hip",     "half_hip", "gambrel",
                                           "mansard", "shed",        "pyramid", "flat",     "dome"};
static_assert(std::size(kRoofNames) == static_cast<size_t>(RoofKind::Count));
constexpr std::string_view kShapeNames[] = {"panel",    "block", "opening",    "cornice",  "pediment",
                                            "pilaster", "brace", "brace_back", "awning",   "balcony",
                                            "leaf",     "steps", "bell",       "buttress", "battlement"};
static_assert(std::size(kShapeNames) == static_cast<size_t>(Shape::Count));
constexpr std::string_view kMaskNames[] = {"noise", "foot", "eaves", "checker"};
static_assert(std::size(kMaskNames) == static_cast<size_t>(Mask::Count));
constexpr std::string_view kSizeNames[] = {"Abs", "Flt", "Rel"};

constexpr std::string_view kVariableNames[] = {"width",
                                               "height",
                                               "x",
                                               "y",
                                               "index",
                                               "count",
                                               "facade.width",
                                               "facade.height",
                                               "facade.index",
                                               "house.height",
                                               "house.width",
                                               "house.area",
                                               "house.corners",
                                               "house.use",
                                               "house.material",
                                               "house.roof",
                                               "house.year"};
static_assert(std::size(kVariableNames) == static_cast<size_t>(Variable::Number));

constexpr RuleFunction kFunctions[] = {
    {"if", ExprKind::If, 3},       {"min", ExprKind::Min, 2},     {"max", ExprKind::Max, 2},
    {"clamp", ExprKind::Clamp, 3}, {"floor", ExprKind::Floor, 1}, {"ceil", ExprKind::Ceil, 1},
    {"round", ExprKind::Round, 1}, {"abs", ExprKind::Abs, 1},     {"rand", ExprKind::Random, 2}};

constexpr RuleUnit kUnits[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"deg", std::numbers::pi / 180}, {"%", 0.01}};

}  // namespace

std::span<const OperatorSignature> operatorSignatures() {
  return kSignatures;
}
std::span<const std::string_view> faceNames() {
  return kFaceNames;
}
std::span<const std::string_view> roofNames() {
  return kRoofNames;
}
std::span<const std::string_view> shapeNames() {
  return kShapeNames;
}
std::span<const std::string_view> maskNames() {
  return kMaskNames;
}
std::span<const std::string_view> sizeNames() {
  return kSizeNames;
}
std::span<const std::string_view> variableNames() {
  return kVariableNames;
}
std::span<const RuleFunction> ruleFunctions() {
  return kFunctions;
}
std::span<const RuleUnit> ruleUnits() {
  return kUnits;
}

double unitFactorOf(std::string_view unit) {
  for (const RuleUnit& u : kUnits)
    if (u.name == unit) return u.factor;
  return 1;
}

}  // namespace vicus::facade
