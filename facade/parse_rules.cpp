#include "facade/parse_rules.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "facade/read_expression.hpp"
#include "facade/rule_reader.hpp"

namespace vicus::facade {
namespace {

constexpr size_t kMostErrors = 20;

class Parser {
 public:
  Parser(std::string_view text, const std::string& file, city::Diagnostics& diagnostics)
      : in_(text, file, diagnostics), expressions_(in_, style_, names_) {
    style_.file = file;
  }

  std::optional<Style> parse() {
    while (in_.at().kind != TokenKind::End && in_.mistakes() < kMostErrors) {
      try {
        statement();
      } catch (const RuleMistake&) {
        in_.recover();
      }
    }
    if (in_.mistakes() == 0) checkRules();
    if (style_.plainPaint == kNothing) style_.plainPaint = paint("plaster");
    if (style_.eavesPaint == kNothing) style_.eavesPaint = style_.plainPaint;
    if (in_.mistakes() > 0) return std::nullopt;
    return std::move(style_);
  }

 private:
  void statement() {
    if (in_.isName("style")) return header();
    if (in_.isName("param")) return parameter();
    if (in_.isName("let")) return choice();
    if (in_.isName("far")) return far();
    if (in_.isName("plain")) return one(style_.plainPaint);
    if (in_.isName("eaves")) return one(style_.eavesPaint);
    rule();
  }

  void header() {
    in_.take();
    style_.name = in_.needName("the style's name");
    if (in_.at().kind == TokenKind::Text) style_.meaning = in_.take().text;
  }

  void far() {
    in_.take();
    style_.farPaint = paint(in_.needText("the name of a texture"));
    style_.bay.x = in_.needNumber(), style_.bay.y = in_.needNumber();
    if (!(style_.bay.x >= 0.5 && style_.bay.y >= 0.5)) in_.fail(in_.last().place, "a bay has at least 0.5 m");
  }

  void one(uint32_t& out) {
    in_.take();
    out = paint(in_.needText("the name of a texture"));
  }

  void freeName(const Token& token) {
    const std::string name(token.text);
    const bool isVariable =
        std::find(variableNames().begin(), variableNames().end(), token.text) != variableNames().end();
    const bool isFunction = std::any_of(ruleFunctions().begin(), ruleFunctions().end(),
                                        [&](const RuleFunction& f) { return f.name == token.text; });
    if (isVariable || isFunction || names_.parameters.contains(name) || names_.choices.contains(name))
      in_.fail(token.place, name + " has a meaning already");
  }

  void parameter() {
    in_.take();
    Parameter p;
    const Token name = in_.at();
    p.name = in_.needName("a parameter's name"), p.place = name.place;
    freeName(name);
    in_.need("=");
    p.value = in_.needNumber(&p.unit);
    in_.need("(");
    p.least = in_.needNumber();
    in_.need("..");
    p.most = in_.needNumber();
    in_.need(")");
    if (in_.at().kind == TokenKind::Text) p.meaning = in_.take().text;
    // Least and most may leave the unit out: they have the value's.
    if (!(p.least <= p.value && p.value <= p.most)) {
      const double factor = unitFactorOf(p.unit);
      p.least *= factor, p.most *= factor;
      if (!(p.least <= p.value && p.value <= p.most))
        in_.fail(p.place, "the value of " + p.name + " lies outside its range");
    }
    names_.parameters[p.name] = static_cast<uint32_t>(style_.parameters.size());
    style_.parameters.push_back(std::move(p));
  }

  void choice() {
    in_.take();
    const Token name = in_.at();
    in_.needName("a name");
    freeName(name);
    in_.need("=");
    const uint32_t value = expressions_.expression();
    names_.choices[std::string(name.text)] = static_cast<uint32_t>(style_.choices.size());
    style_.choices.push_back({std::string(name.text), value});
  }

  uint32_t ruleNamed(const Token& name) {
    const auto [found, isNew] = names_.rules.emplace(name.text, static_cast<uint32_t>(style_.rules.size()));
    if (isNew) style_.rules.push_back({std::string(name.text), name.place, {}});
    return found->second;
  }

  void rule() {
    const Token name = in_.at();
    in_.needName("a rule, or style, param, let, far, plain or eaves");
    Alternative way;
    if (in_.takeSign(":")) way.condition = expressions_.expression();
    if (in_.takeSign("@")) way.weight = expressions_.expression();
    in_.need("=>");
    if (in_.at().kind == TokenKind::Name && in_.following().text != "(") {
      // Another rule's name alone: what that one does.
      way.operation.kind = Operator::Layer, way.operation.place = in_.at().place;
      way.operation.rules.push_back(ruleNamed(in_.take()));
    } else {
      way.operation = operation();
    }
    style_.rules[ruleNamed(name)].alternatives.push_back(std::move(way));
  }

  /// A rule's name, or an operator in its place.
  uint32_t ruleHere() {
    const Token token = in_.at();
    if (token.kind != TokenKind::Name) in_.expected("a rule");
    const bool isOperator = std::any_of(operatorSignatures().begin(), operatorSignatures().end(),
                                        [&](const OperatorSignature& s) { return s.name == token.text; });
    if (!isOperator) return ruleNamed(in_.take());
    Operation inner = operation();
    style_.rules.push_back({"", token.place, {{kNothing, kNothing, std::move(inner)}}});
    return static_cast<uint32_t>(style_.rules.size() - 1);
  }

  Operation operation() {
    RuleReader::Deeper deeper(in_);
    Operation out;
    out.place = in_.at().place;
    const std::string name = in_.needName("an operator");
    const auto signature = std::find_if(operatorSignatures().begin(), operatorSignatures().end(),
                                        [&](const OperatorSignature& s) { return s.name == name; });
    if (signature == operatorSignatures().end()) in_.fail(out.place, "there is no operator " + name + nearest(name));
    out.kind = signature->kind;
    in_.need("(");
    bool first = true;
    const auto comma = [&] {
      if (!first) in_.need(",");
      first = false;
    };
    for (const Slot slot : signature->slots) readSlot(slot, out, comma);
    if (!in_.takeSign(")")) in_.expected(name + "'s closing )");
    if (out.kind == Operator::SetColor) {
      glm::vec3 colour;
      for (glm::length_t i = 0; i < 3; ++i) {
        const Expr& e = style_.expressions[out.numbers[static_cast<size_t>(i)]];
        if (e.kind != ExprKind::Number) in_.fail(out.place, "SetColor takes three plain numbers");
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
        out.numbers.push_back(expressions_.expression());
        break;
      case Slot::Rule:
        comma();
        out.rules.push_back(ruleHere());
        break;
      case Slot::Rules:
        comma();
        out.rules.push_back(ruleHere());
        do {
          in_.need(",");
          out.rules.push_back(ruleHere());
        } while (in_.isSign(","));
        break;
      case Slot::Pieces:
        comma();
        do {
          in_.need("(");
          Piece& piece = out.pieces.emplace_back();
          piece.size = static_cast<SizeKind>(in_.oneOf(sizeNames(), "Abs, Flt or Rel"));
          in_.need(",");
          const uint32_t amount = expressions_.expression();
          in_.need(",");
          const uint32_t rule = ruleHere();
          out.pieces.back().amount = amount, out.pieces.back().rule = rule;
          in_.need(")");
        } while (in_.takeSign(","));
        break;
      case Slot::Faces:
        comma();
        do {
          const auto face = static_cast<Face>(in_.oneOf(faceNames(), "front, side, back, party or roof"));
          in_.need(":");
          Piece piece;
          piece.face = face, piece.rule = ruleHere();
          out.pieces.push_back(piece);
        } while (in_.takeSign(","));
        break;
      case Slot::Texture:
        comma();
        out.paints.push_back(paint(in_.needText("the name of a texture")));
        break;
      case Slot::Textures:
        for (int i = 0; i < 2 && in_.takeSign(","); ++i)
          out.paints.push_back(paint(in_.needText("the name of a texture")));
        break;
      case Slot::Shape:
        comma();
        out.what = in_.oneOf(shapeNames(), "a shape");
        break;
      case Slot::Mask:
        comma();
        out.what = in_.oneOf(maskNames(), "a mask");
        break;
      case Slot::Form:
        comma();
        out.what = in_.oneOf(roofNames(), "the form of a roof");
        break;
      case Slot::Mapping:
        comma();
        if (!in_.isName("Fit") && !in_.isName("Rep")) in_.expected("Fit or Rep");
        out.repeat = in_.take().text == "Rep";
        break;
      case Slot::Box:
        comma();
        in_.need("(");
        for (int i = 0; i < 4; ++i) {
          if (i > 0) in_.need(",");
          out.numbers.push_back(expressions_.expression());
        }
        in_.need(")");
        break;
      case Slot::Colour:
        if (in_.takeSign(",")) {
          glm::vec3 colour(1);
          in_.need("(");
          for (glm::length_t i = 0; i < 3; ++i) {
            if (i > 0) in_.need(",");
            colour[i] = static_cast<float>(std::clamp(in_.needNumber(), 0.0, 4.0));
          }
          in_.need(")");
          out.paints.back() = paint(style_.paints[out.paints.back()].texture, colour);
        }
        break;
    }
  }

  /// `texture#rrggbb` names a colour too.
  uint32_t paint(std::string texture, glm::vec3 colour = glm::vec3(1)) {
    if (const size_t mark = texture.find('#'); mark != std::string::npos) {
      uint32_t hex = 0;
      const char* const from = texture.data() + mark + 1;
      const char* const end = texture.data() + texture.size();
      if (const auto read = std::from_chars(from, end, hex, 16); end - from != 6 || read.ptr != end)
        in_.fail(in_.last().place, "a colour is # and six hexadecimal digits");
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

  static std::string nearest(std::string_view name) {
    const auto lower = [](std::string_view s) {
      std::string out(s);
      for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
      return out;
    };
    for (const OperatorSignature& s : operatorSignatures())
      if (lower(s.name) == lower(name) || lower(s.name).starts_with(lower(name)))
        return "; did you mean " + std::string(s.name) + "?";
    return "";
  }

  void checkRules() {
    for (const Rule& r : style_.rules)
      if (r.alternatives.empty() && in_.mistakes() < kMostErrors) in_.say(r.place, "there is no rule " + r.name);
    const auto find = [&](const char* name) {
      const auto found = names_.rules.find(name);
      return found == names_.rules.end() ? kNothing : found->second;
    };
    style_.house = find("House"), style_.facade = find("Facade");
    if (in_.mistakes() == 0 && style_.house == kNothing && style_.facade == kNothing)
      in_.say({}, "there is neither a rule House nor a rule Facade to begin with");
  }

  RuleReader in_;
  Style style_;
  RuleNames names_;
  ExpressionReader expressions_;
};

}  // namespace

std::optional<Style> parseRules(std::string_view text, const std::string& file, city::Diagnostics& diagnostics) {
  if (text.size() > kLongestRules) {
    diagnostics.error(file + ":1:1", "", "rules have at most 1 MB\n  \n  ^");
    return std::nullopt;
  }
  return Parser(text, file, diagnostics).parse();
}

}  // namespace vicus::facade
