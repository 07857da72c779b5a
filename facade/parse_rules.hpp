/// Reads the text of a style (`*.rules`); docs/rules.md describes the language.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "city/diagnostics.hpp"
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

/// Texts longer than this are refused: bytes.
constexpr size_t kLongestRules = 1 << 20;

/// The style; nothing where the text has errors. Each error's file is `file:line:column`, its message ends with the
/// line and a caret under the place. At most 20 are told.
std::optional<Style> parseRules(std::string_view text, const std::string& file, city::Diagnostics& diagnostics);

}  // namespace vicus::facade
