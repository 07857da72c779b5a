// libFuzzer's entry point for rules of styles: whatever can be parsed is also derived.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "facade/house.hpp"
#include "facade/parse_rules.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace vicus;
  city::Diagnostics diagnostics;
  const auto style = facade::parseRules({reinterpret_cast<const char*>(data), size}, "fuzz.rules", diagnostics);
  // Every refusal names its place and shows it.
  if (!style && diagnostics.messages.empty()) std::abort();
  for (const city::Diagnostic& d : diagnostics.messages)
    if (!d.file.starts_with("fuzz.rules:") || !d.message.ends_with("^")) std::abort();
  if (!style) return 0;
  facade::StyleInUse use;
  use.style = &*style;
  use.looks.resize(style->paints.size() + 1);
  facade::Lot lot;
  lot.rings = {{{0, 0}, {9, 0}, {9, 6}, {4, 7}, {0, 6}}};
  lot.facts.height = 7, lot.facts.seed = 3;
  city::BuildingBuilder builder("fuzz");
  facade::Derivation made;
  facade::addHouse(builder, use, lot, made);
  if (made.scopes > facade::kMostScopes || made.deepest > facade::kDeepestRule) std::abort();
  for (const city::Vertex& v : builder.finish().vertices)
    if (!(v.position.x + v.position.y + v.position.z < 1e9f)) std::abort();
  return 0;
}
