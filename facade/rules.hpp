/// A style as its rules say it: what `parseRules` makes of a text and the derivation walks.
///
/// Based on: Krecklau, Born, Kobbelt 2013, §3 (rules ρ ⇒ ω(p₁, …, pₙ) over scopes); Müller et al. 2006, "Procedural
/// Modeling of Buildings" (operators on volumes, conditions, stochastic rules).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace vicus::facade {

constexpr uint32_t kNothing = 0xffffffffU;

/// Where something stands in the text; both from 1.
struct SourcePlace {
  uint32_t line = 1, column = 1;
};

/// What expressions can ask of the scope and the house. Lengths in metres.
enum class Variable : uint8_t {
  Width,        ///< `width` of the scope
  Height,       ///< `height` of the scope
  X,            ///< `x`: the scope's left edge from the wall's left end
  Y,            ///< `y`: its lower edge from the wall's foot
  Index,        ///< `index`: number of the scope in the split or repeat that made it, from 0
  Count,        ///< `count` of its siblings, with itself
  FacadeWidth,  ///< `facade.width` of the whole wall
  FacadeHeight,
  FacadeIndex,   ///< `facade.index` of the wall among those of its side, the longest first, from 0
  HouseHeight,   ///< `house.height` from the ground to the eaves
  HouseWidth,    ///< `house.width` of the longest front
  HouseArea,     ///< `house.area` of the footprint, m²
  HouseCorners,  ///< `house.corners` of the footprint
  HouseUse,      ///< `house.use`, text
  HouseMaterial,
  HouseRoof,
  HouseYear,  ///< 0 where it is not known
  Number
};

enum class ExprKind : uint8_t {
  Number,
  Text,
  Scope,      ///< a Variable, `index`
  Parameter,  ///< `index` in Style::parameters
  Choice,     ///< `index` in Style::choices
  Negate,
  Not,
  Add,
  Subtract,
  Multiply,
  Divide,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Equal,
  NotEqual,
  And,
  Or,
  If,
  Min,
  Max,
  Clamp,
  Floor,
  Ceil,
  Round,
  Abs,
  Random,  ///< uniform between two numbers, from the scope's seed
};

/// A node of an expression; children are earlier entries of Style::expressions.
struct Expr {
  ExprKind kind = ExprKind::Number;
  double number = 0;
  uint32_t index = 0;  ///< of a variable, a parameter, a choice or, for Text, of Style::texts
  uint32_t children[3] = {kNothing, kNothing, kNothing};
};

enum class Operator : uint8_t {
  // On scopes of a wall.
  SplitX,
  SplitY,
  RepeatX,
  RepeatY,
  Layer,
  SkipMask,
  SampleTexture,
  SetColor,
  AttachScope,
  AttachTexture,
  // On volumes.
  SplitZ,
  Extrude,
  Comp,
  Offset,
  Jetty,
  LeanTo,
  Tower,
  Turrets,
  Roof,
  Chimney,
  Dormer,
  Nothing,
  Count
};

/// How a split measures a piece. Absolute: metres. Floating: metres wished for, stretched where no relative piece takes
/// up the rest. Relative: a share of what the others leave.
enum class SizeKind : uint8_t { Absolute, Floating, Relative };

/// The faces of a volume that `Comp` tells apart.
enum class Face : uint8_t { Front, Side, Back, Party, Roof, Count };

enum class RoofKind : uint8_t { Gable, GableFront, Hip, HalfHip, Gambrel, Mansard, Shed, Pyramid, Flat, Dome, Count };

/// Shapes that AttachScope fits into a scope; shapes.hpp draws them.
enum class Shape : uint8_t {
  Panel,       ///< a flat picture before the wall
  Block,       ///< a box: lintels, quoins, beams
  Opening,     ///< a hole: reveal, pane at its back
  Cornice,     ///< three courses, each reaching farther out
  Pediment,    ///< a triangle over a window
  Pilaster,    ///< a shaft between base and capital
  Brace,       ///< a beam from the lower left to the upper right corner
  BraceBack,   ///< from the lower right to the upper left
  Awning,      ///< a slope over a shop
  Balcony,     ///< a slab with a railing
  Leaf,        ///< a cut-out card
  Steps,       ///< a stepped gable that stands before the roof and over it
  Bell,        ///< a bell gable
  Buttress,    ///< a pier in two stages with sloping tops
  Battlement,  ///< a parapet on a wall's top, with gaps: it stands over the scope
  Count
};

enum class Mask : uint8_t { Noise, Foot, Eaves, Checker, Count };

/// A texture with a colour that multiplies it.
struct Paint {
  std::string texture;
  glm::vec3 colour{1};  ///< linear

  bool operator==(const Paint&) const = default;
};

/// One rule and its share of a split, or the rule of a face.
struct Piece {
  SizeKind size = SizeKind::Absolute;
  Face face = Face::Front;
  uint32_t amount = kNothing;  ///< expression
  uint32_t rule = kNothing;
};

/// ω(p₁, …, pₙ). Which members an operator uses, its entry in `operatorSignatures` tells.
struct Operation {
  Operator kind = Operator::Nothing;
  SourcePlace place;
  std::vector<Piece> pieces;
  std::vector<uint32_t> rules;
  std::vector<uint32_t> numbers;  ///< expressions
  std::vector<uint32_t> paints;   ///< in Style::paints
  uint8_t what = 0;               ///< a Shape, a Mask or a RoofKind
  bool repeat = false;            ///< Rep, else Fit
};

/// One way that a rule may go.
struct Alternative {
  uint32_t condition = kNothing;  ///< expression; none: always
  uint32_t weight = kNothing;     ///< expression; none: taken at once where the condition holds
  Operation operation;
};

struct Rule {
  std::string name;  ///< empty: written in place of a name
  SourcePlace place;
  std::vector<Alternative> alternatives;
};

/// A number that whoever uses the style may set.
struct Parameter {
  std::string name, unit, meaning;
  double value = 0, least = 0, most = 0;  ///< metres, radians, or plain numbers
  SourcePlace place;
};

/// A number drawn or worked out once for each house.
struct Choice {
  std::string name;
  uint32_t expression = kNothing;
};

/// Invariant: every index refers to an entry; expressions refer to earlier ones only.
struct Style {
  std::string name, meaning;
  std::string file;
  std::vector<Parameter> parameters;
  std::vector<Choice> choices;
  std::vector<Rule> rules;
  std::vector<Expr> expressions;
  std::vector<std::string> texts;
  std::vector<Paint> paints;
  uint32_t house = kNothing;   ///< rule `House`, over the footprint
  uint32_t facade = kNothing;  ///< rule `Facade`, over a wall that comes with its own form
  uint32_t farPaint = kNothing, plainPaint = kNothing;
  uint32_t eavesPaint = kNothing;  ///< of what hangs over the walls, from below
  glm::dvec2 bay{2.6, 2.9};        ///< metres of wall that one repeat of the far picture shows
};

}  // namespace vicus::facade
