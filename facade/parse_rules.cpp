#include "facade/parse_rules.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>

#include "facade/lex_rules.hpp"

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
constexpr std::string_view kShapeNames[] = {"panel",    "block", "opening",    "cornice", "pediment",
                                            "pilaster", "brace", "brace_back", "awning",  "balcony",
                                            "leaf",     "steps", "bell"};
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

struct Function {
  std::string_view name;
  ExprKind kind;
  size_t arguments;
};
constexpr Function kFunctions[] = {
    {"if", ExprKind::If, 3},       {"min", ExprKind::Min, 2},     {"max", ExprKind::Max, 2},
    {"clamp", ExprKind::Clamp, 3}, {"floor", ExprKind::Floor, 1}, {"ceil", ExprKind::Ceil, 1},
    {"round", ExprKind::Round, 1}, {"abs", ExprKind::Abs, 1},     {"rand", ExprKind::Random, 2}};

struct Unit {
  std::string_view name;
  double factor;
};
constexpr Unit kUnits[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"deg", std::numbers::pi / 180}};

/// Expressions and rules in brackets nest at most so deep.
constexpr int kDeepest = 60;
/// Sums and products have at most so many terms.
constexpr int kDeepestSum = 400;
constexpr size_t kMostErrors = 20;

struct Mistake {};

class Parser {
 public:
  Parser(std::string_view text, const std::string& file, city::Diagnostics& diagnostics)
      : text_(text), diagnostics_(diagnostics), tokens_(lexRules(text)) {
    style_.file = file;
  }

  std::optional<Style> parse() {
    while (at().kind != TokenKind::End && errors_ < kMostErrors) {
      try {
        statement();
      } catch (const Mistake&) {
        recover();
      }
    }
    if (errors_ == 0) checkRules();
    if (style_.plainPaint == kNothing) style_.plainPaint = paint("plaster");
    if (style_.eavesPaint == kNothing) style_.eavesPaint = style_.plainPaint;
    if (errors_ > 0) return std::nullopt;
    return std::move(style_);
  }

 private:
  const Token& at() const { return tokens_[next_]; }
  Token take() {
    const Token token = at();
    if (token.kind != TokenKind::End) ++next_;
    return token;
  }
  bool isSign(std::string_view sign) const { return at().kind == TokenKind::Sign && at().text == sign; }
  bool isName(std::string_view name) const { return at().kind == TokenKind::Name && at().text == name; }
  bool takeSign(std::string_view sign) {
    if (!isSign(sign)) return false;
    take();
    return true;
  }

  void say(SourcePlace place, const std::string& message) {
    ++errors_;
    size_t begin = 0;
    for (uint32_t line = 1; line < place.line; ++line) begin = std::min(text_.find('\n', begin), text_.size() - 1) + 1;
    // Long lines are shown around the place; characters that would move the caret become blanks.
    std::string line;
    size_t caret = 0;
    for (uint32_t column = 1; begin < text_.size() && text_[begin] != '\n' && text_[begin] != '\r'; ++begin) {
      const auto c = static_cast<unsigned char>(text_[begin]);
      if ((c & 0xc0) == 0x80) {
        if (!line.empty()) line += text_[begin];
        continue;
      }
      if (column + 60 > place.column && column < place.column + 60) {
        if (column < place.column) ++caret;
        line += c < 0x20 || c == 0x7f ? ' ' : text_[begin];
      }
      ++column;
    }
    diagnostics_.error(style_.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column), "",
                       message + "\n  " + line + "\n  " + std::string(caret, ' ') + "^");
  }
  [[noreturn]] void fail(SourcePlace place, const std::string& message) {
    say(place, message);
    throw Mistake{};
  }
  [[noreturn]] void expected(const std::string& what) {
    if (at().kind == TokenKind::Broken) fail(at().place, std::string(at().text));
    const std::string found = at().kind == TokenKind::End    ? "the end"
                              : at().kind == TokenKind::Text ? "\"" + std::string(at().text) + "\""
                                                             : std::string(at().text);
    fail(at().place, "here belongs " + what + ", not " + found);
  }
  void need(std::string_view sign) {
    if (!takeSign(sign)) expected(std::string(sign));
  }
  std::string needName(const std::string& what) {
    if (at().kind != TokenKind::Name) expected(what);
    return std::string(take().text);
  }
  std::string needText(const std::string& what) {
    if (at().kind != TokenKind::Text && at().kind != TokenKind::Name) expected(what);
    return std::string(take().text);
  }

  /// Behind a mistake: on to the next line that begins at its first column.
  void recover() {
    const uint32_t line = at().place.line;
    while (at().kind != TokenKind::End && !(at().place.column == 1 && at().place.line > line)) take();
  }

  void statement() {
    if (isName("style")) return header();
    if (isName("param")) return parameter();
    if (isName("let")) return choice();
    if (isName("far")) return far();
    if (isName("plain")) return one(style_.plainPaint);
    if (isName("eaves")) return one(style_.eavesPaint);
    rule();
  }

  void header() {
    take();
    style_.name = needName("the style's name");
    if (at().kind == TokenKind::Text) style_.meaning = take().text;
  }

  void far() {
    take();
    style_.farPaint = paint(needText("the name of a texture"));
    style_.bay.x = needNumber(), style_.bay.y = needNumber();
    if (!(style_.bay.x >= 0.5 && style_.bay.y >= 0.5)) fail(tokens_[next_ - 1].place, "a bay has at least 0.5 m");
  }

  void one(uint32_t& out) {
    take();
    out = paint(needText("the name of a texture"));
  }

  /// A number with its unit, which may be negative.
  double needNumber(std::string* unit = nullptr) {
    const double sign = takeSign("-") ? -1 : 1;
    if (at().kind != TokenKind::Number) expected("a number");
    return sign * take().number * unitFactor(unit);
  }
  double unitFactor(std::string* unit = nullptr) {
    if (takeSign("%")) {
      if (unit) *unit = "%";
      return 0.01;
    }
    if (at().kind != TokenKind::Name) return 1;
    for (const Unit& u : kUnits)
      if (at().text == u.name) {
        if (unit) *unit = u.name;
        take();
        return u.factor;
      }
    return 1;
  }

  void freeName(const Token& token) {
    const std::string name(token.text);
    const bool isVariable =
        std::find(std::begin(kVariableNames), std::end(kVariableNames), token.text) != std::end(kVariableNames);
    const bool isFunction = std::any_of(std::begin(kFunctions), std::end(kFunctions),
                                        [&](const Function& f) { return f.name == token.text; });
    if (isVariable || isFunction || parameters_.contains(name) || choices_.contains(name))
      fail(token.place, name + " has a meaning already");
  }

  void parameter() {
    take();
    Parameter p;
    const Token name = at();
    p.name = needName("a parameter's name"), p.place = name.place;
    freeName(name);
    need("=");
    p.value = needNumber(&p.unit);
    need("(");
    p.least = needNumber();
    need("..");
    p.most = needNumber();
    need(")");
    if (at().kind == TokenKind::Text) p.meaning = take().text;
    // Least and most may leave the unit out: they have the value's.
    if (!(p.least <= p.value && p.value <= p.most)) {
      double factor = p.unit == "%" ? 0.01 : 1;
      for (const Unit& u : kUnits)
        if (u.name == p.unit) factor = u.factor;
      p.least *= factor, p.most *= factor;
      if (!(p.least <= p.value && p.value <= p.most))
        fail(p.place, "the value of " + p.name + " lies outside its range");
    }
    parameters_[p.name] = static_cast<uint32_t>(style_.parameters.size());
    style_.parameters.push_back(std::move(p));
  }

  void choice() {
    take();
    const Token name = at();
    needName("a name");
    freeName(name);
    need("=");
    const uint32_t value = expression();
    choices_[std::string(name.text)] = static_cast<uint32_t>(style_.choices.size());
    style_.choices.push_back({std::string(name.text), value});
  }

  uint32_t ruleNamed(const Token& name) {
    const auto [found, isNew] = ruleOf_.emplace(name.text, static_cast<uint32_t>(style_.rules.size()));
    if (isNew) style_.rules.push_back({std::string(name.text), name.place, {}});
    return found->second;
  }

  void rule() {
    const Token name = at();
    needName("a rule, or style, param, let, far, plain or eaves");
    Alternative way;
    if (takeSign(":")) way.condition = expression();
    if (takeSign("@")) way.weight = expression();
    need("=>");
    if (at().kind == TokenKind::Name && tokens_[next_ + 1].text != "(") {
      // Another rule's name alone: what that one does.
      way.operation.kind = Operator::Layer, way.operation.place = at().place;
      way.operation.rules.push_back(ruleNamed(take()));
    } else {
      way.operation = operation();
    }
    style_.rules[ruleNamed(name)].alternatives.push_back(std::move(way));
  }

  /// A rule's name, or an operator in its place.
  uint32_t ruleHere() {
    const Token token = at();
    if (token.kind != TokenKind::Name) expected("a rule");
    const bool isOperator = std::any_of(std::begin(kSignatures), std::end(kSignatures),
                                        [&](const OperatorSignature& s) { return s.name == token.text; });
    if (!isOperator) return ruleNamed(take());
    Operation inner = operation();
    style_.rules.push_back({"", token.place, {{kNothing, kNothing, std::move(inner)}}});
    return static_cast<uint32_t>(style_.rules.size() - 1);
  }

  Operation operation() {
    Deeper deeper(*this);
    Operation out;
    out.place = at().place;
    const std::string name = needName("an operator");
    const auto* signature = std::find_if(std::begin(kSignatures), std::end(kSignatures),
                                         [&](const OperatorSignature& s) { return s.name == name; });
    if (signature == std::end(kSignatures)) fail(out.place, "there is no operator " + name + nearest(name));
    out.kind = signature->kind;
    need("(");
    bool first = true;
    const auto comma = [&] {
      if (!first) need(",");
      first = false;
    };
    for (const Slot slot : signature->slots) readSlot(slot, out, comma);
    if (!takeSign(")")) expected(name + "'s closing )");
    if (out.kind == Operator::SetColor) {
      glm::vec3 colour;
      for (glm::length_t i = 0; i < 3; ++i) {
        const Expr& e = style_.expressions[out.numbers[static_cast<size_t>(i)]];
        if (e.kind != ExprKind::Number) fail(out.place, "SetColor takes three plain numbers");
        colour[i] = static_cast<float>(std::clamp(e.number, 0.0, 1.0));
      }
      out.paints.push_back(paint("", colour));
    }
    return out;
  }

  template <typename Comma>
  void readSlot(Slot slot, Operation& out, const Comma& comma) {
    switch (slot) {
      case Slot::Number:
        comma();
        out.numbers.push_back(expression());
        break;
      case Slot::Rule:
        comma();
        out.rules.push_back(ruleHere());
        break;
      case Slot::Rules:
        comma();
        out.rules.push_back(ruleHere());
        do {
          need(",");
          out.rules.push_back(ruleHere());
        } while (isSign(","));
        break;
      case Slot::Pieces:
        comma();
        do {
          need("(");
          Piece& piece = out.pieces.emplace_back();
          piece.size = static_cast<SizeKind>(oneOf(kSizeNames, "Abs, Flt or Rel"));
          need(",");
          const uint32_t amount = expression();
          need(",");
          const uint32_t rule = ruleHere();
          out.pieces.back().amount = amount, out.pieces.back().rule = rule;
          need(")");
        } while (takeSign(","));
        break;
      case Slot::Faces:
        comma();
        do {
          const auto face = static_cast<Face>(oneOf(kFaceNames, "front, side, back, party or roof"));
          need(":");
          Piece piece;
          piece.face = face, piece.rule = ruleHere();
          out.pieces.push_back(piece);
        } while (takeSign(","));
        break;
      case Slot::Texture:
        comma();
        out.paints.push_back(paint(needText("the name of a texture")));
        break;
      case Slot::Textures:
        for (int i = 0; i < 2 && takeSign(","); ++i) out.paints.push_back(paint(needText("the name of a texture")));
        break;
      case Slot::Shape:
        comma();
        out.what = oneOf(kShapeNames, "a shape");
        break;
      case Slot::Mask:
        comma();
        out.what = oneOf(kMaskNames, "a mask");
        break;
      case Slot::Form:
        comma();
        out.what = oneOf(kRoofNames, "the form of a roof");
        break;
      case Slot::Mapping:
        comma();
        if (!isName("Fit") && !isName("Rep")) expected("Fit or Rep");
        out.repeat = take().text == "Rep";
        break;
      case Slot::Box:
        comma();
        need("(");
        for (int i = 0; i < 4; ++i) {
          if (i > 0) need(",");
          out.numbers.push_back(expression());
        }
        need(")");
        break;
      case Slot::Colour:
        if (takeSign(",")) {
          glm::vec3 colour(1);
          need("(");
          for (glm::length_t i = 0; i < 3; ++i) {
            if (i > 0) need(",");
            colour[i] = static_cast<float>(std::clamp(needNumber(), 0.0, 4.0));
          }
          need(")");
          out.paints.back() = paint(style_.paints[out.paints.back()].texture, colour);
        }
        break;
    }
  }

  uint8_t oneOf(std::span<const std::string_view> names, const std::string& what) {
    if (at().kind == TokenKind::Name)
      for (size_t i = 0; i < names.size(); ++i)
        if (names[i] == at().text) {
          take();
          return static_cast<uint8_t>(i);
        }
    std::string all;
    for (const std::string_view name : names) all += (all.empty() ? "" : ", ") + std::string(name);
    expected(what + " (" + all + ")");
  }

  /// `texture#rrggbb` names a colour too.
  uint32_t paint(std::string texture, glm::vec3 colour = glm::vec3(1)) {
    if (const size_t mark = texture.find('#'); mark != std::string::npos) {
      uint32_t hex = 0;
      const char* const from = texture.data() + mark + 1;
      const char* const end = texture.data() + texture.size();
      if (const auto read = std::from_chars(from, end, hex, 16); end - from != 6 || read.ptr != end)
        fail(tokens_[next_ > 0 ? next_ - 1 : 0].place, "a colour is # and six hexadecimal digits");
      for (glm::length_t i = 0; i < 3; ++i) {
        const float v = static_cast<float>((hex >> (16 - 8 * i)) & 255) / 255;
        colour[i] *= v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
      }
      texture.resize(mark);
    }
    const Paint wanted{std::move(texture), colour};
    const auto found = std::find(style_.paints.begin(), style_.paints.end(), wanted);
    if (found != style_.paints.end()) return static_cast<uint32_t>(found - style_.paints.begin());
    style_.paints.push_back(wanted);
    return static_cast<uint32_t>(style_.paints.size() - 1);
  }

  // Expressions, loosest first: or, and, comparison, sum, product, sign.
  uint32_t expression() {
    Deeper deeper(*this);
    return operators(0);
  }

  struct Binary {
    std::string_view sign;
    ExprKind kind;
  };
  uint32_t operators(int level) {
    static constexpr Binary kLevels[][6] = {
        {{"or", ExprKind::Or}},
        {{"and", ExprKind::And}},
        {{"<=", ExprKind::LessEqual},
         {">=", ExprKind::GreaterEqual},
         {"<", ExprKind::Less},
         {">", ExprKind::Greater},
         {"==", ExprKind::Equal},
         {"!=", ExprKind::NotEqual}},
        {{"+", ExprKind::Add}, {"-", ExprKind::Subtract}},
        {{"*", ExprKind::Multiply}, {"/", ExprKind::Divide}},
    };
    if (level == static_cast<int>(std::size(kLevels))) return unary();
    uint32_t left = operators(level + 1);
    for (;;) {
      const Binary* found = nullptr;
      for (const Binary& b : kLevels[level])
        if (!b.sign.empty() && (isSign(b.sign) || isName(b.sign))) found = &b;
      if (!found) return left;
      take();
      const uint32_t right = operators(level + 1);
      left = add(found->kind, {left, right});
    }
  }

  uint32_t add(ExprKind kind, std::initializer_list<uint32_t> children) {
    Expr e;
    e.kind = kind;
    std::copy(children.begin(), children.end(), e.children);
    return add(e);
  }
  uint32_t add(const Expr& e) {
    int deepest = 0;
    for (const uint32_t child : e.children)
      if (child != kNothing) deepest = std::max(deepest, depthOf_[child]);
    if (deepest >= kDeepestSum) fail(at().place, "this expression is too long");
    depthOf_.push_back(deepest + 1);
    style_.expressions.push_back(e);
    return static_cast<uint32_t>(style_.expressions.size() - 1);
  }

  uint32_t unary() {
    Deeper deeper(*this);
    if (takeSign("-")) return add(ExprKind::Negate, {unary()});
    if (takeSign("!") || (isName("not") && (take(), true))) return add(ExprKind::Not, {unary()});
    if (takeSign("(")) {
      const uint32_t inner = expression();
      need(")");
      return inner;
    }
    Expr e;
    const Token token = at();
    if (token.kind == TokenKind::Number) {
      take();
      e.number = token.number * unitFactor();
      return add(e);
    }
    if (token.kind == TokenKind::Text) {
      take();
      e.kind = ExprKind::Text, e.index = static_cast<uint32_t>(style_.texts.size());
      style_.texts.emplace_back(token.text);
      return add(e);
    }
    if (token.kind != TokenKind::Name) expected("a number, a name or (");
    take();
    return isSign("(") ? call(token) : named(token);
  }

  uint32_t call(const Token& name) {
    for (const Function& f : kFunctions) {
      if (f.name != name.text) continue;
      Expr e;
      e.kind = f.kind;
      need("(");
      for (size_t i = 0; i < f.arguments; ++i) {
        if (i > 0) need(",");
        e.children[i] = expression();
      }
      need(")");
      return add(e);
    }
    fail(name.place, "there is no function " + std::string(name.text));
  }

  uint32_t named(const Token& name) {
    Expr e;
    const std::string text(name.text);
    for (size_t i = 0; i < std::size(kVariableNames); ++i)
      if (kVariableNames[i] == name.text) {
        e.kind = ExprKind::Scope, e.index = static_cast<uint32_t>(i);
        return add(e);
      }
    if (const auto p = parameters_.find(text); p != parameters_.end()) {
      e.kind = ExprKind::Parameter, e.index = p->second;
      return add(e);
    }
    if (const auto c = choices_.find(text); c != choices_.end()) {
      e.kind = ExprKind::Choice, e.index = c->second;
      return add(e);
    }
    fail(name.place, text + " is no variable, and no param or let above defines it");
  }

  static std::string nearest(std::string_view name) {
    const auto lower = [](std::string_view s) {
      std::string out(s);
      for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
      return out;
    };
    for (const OperatorSignature& s : kSignatures)
      if (lower(s.name) == lower(name) || lower(s.name).starts_with(lower(name)))
        return "; did you mean " + std::string(s.name) + "?";
    return "";
  }

  void checkRules() {
    for (const Rule& r : style_.rules)
      if (r.alternatives.empty() && errors_ < kMostErrors) say(r.place, "there is no rule " + r.name);
    const auto find = [&](const char* name) {
      const auto found = ruleOf_.find(name);
      return found == ruleOf_.end() ? kNothing : found->second;
    };
    style_.house = find("House"), style_.facade = find("Facade");
    if (errors_ == 0 && style_.house == kNothing && style_.facade == kNothing)
      say({}, "there is neither a rule House nor a rule Facade to begin with");
  }

  struct Deeper {
    explicit Deeper(Parser& p) : parser(p) {
      if (++parser.depth_ > kDeepest) {
        --parser.depth_;
        parser.fail(parser.at().place, "this is nested too deep");
      }
    }
    ~Deeper() { --parser.depth_; }
    Deeper(const Deeper&) = delete;
    Deeper& operator=(const Deeper&) = delete;
    Parser& parser;
  };

  std::string_view text_;
  city::Diagnostics& diagnostics_;
  std::vector<Token> tokens_;
  size_t next_ = 0;
  size_t errors_ = 0;
  int depth_ = 0;
  std::vector<int> depthOf_;  ///< of each expression
  Style style_;
  std::map<std::string, uint32_t, std::less<>> ruleOf_, parameters_, choices_;
};

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

std::optional<Style> parseRules(std::string_view text, const std::string& file, city::Diagnostics& diagnostics) {
  if (text.size() > kLongestRules) {
    diagnostics.error(file + ":1:1", "", "rules have at most 1 MB\n  \n  ^");
    return std::nullopt;
  }
  return Parser(text, file, diagnostics).parse();
}

}  // namespace vicus::facade
