/// The words of the language of rules: operators, names, functions, units.
#pragma once

#include <span>
#include <string_view>

#include "facade/rules.hpp"

namespace vicus::facade {

/// One parameter of an operator. In brackets how the text writes it.
enum class Slot : uint8_t {
  Number,    ///< an expression
  Pieces,    ///< one or more (Abs|Flt|Rel, expression, rule)
  Faces,     ///< one or more face: rule
  Rule,      ///< a rule's name, or an operator in its place
  Rules,     ///< two or more of them
  Texture,   ///< a texture's name
  Textures,  ///< none to two textures
  Shape,
  Mask,
  Form,     ///< of a roof
  Mapping,  ///< Fit or Rep
  Box,      ///< (left, bottom, right, top)
  Colour,   ///< (red, green, blue), or nothing
};

struct OperatorSignature {
  Operator kind;
  std::string_view name;
  std::span<const Slot> slots;
  std::string_view meaning;  ///< one sentence
};

/// All operators in the order of `Operator`.
std::span<const OperatorSignature> operatorSignatures();
/// Names of faces, roof forms, shapes and masks in the order of their enumerations.
std::span<const std::string_view> faceNames();
std::span<const std::string_view> roofNames();
std::span<const std::string_view> shapeNames();
std::span<const std::string_view> maskNames();

/// Abs, Flt and Rel, and the names of variables, in the order of SizeKind and Variable.
std::span<const std::string_view> sizeNames();
std::span<const std::string_view> variableNames();

struct RuleFunction {
  std::string_view name;
  ExprKind kind;
  size_t arguments;
};
std::span<const RuleFunction> ruleFunctions();

/// What a number is multiplied by that has the unit behind it; in the rules' own units (metres, radians, shares).
struct RuleUnit {
  std::string_view name;
  double factor;
};
std::span<const RuleUnit> ruleUnits();
/// Factor of a unit; 1 where there is none of that name.
double unitFactorOf(std::string_view unit);

}  // namespace vicus::facade
