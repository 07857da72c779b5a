#include "assets/import/gltf_faults.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <map>
#include <vector>

#include "assets/import/cityjson_geometry.hpp"
#include "assets/import/gltf.hpp"

namespace vicus::assets::gltf {

using cityjson::member;
using cityjson::textOf;

namespace {

constexpr uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a;  // "glTF", "JSON"

std::string number(uint64_t n) {
  return std::to_string(n);
}

/// Looks through a model's JSON. Each check sets the fault and says false; the first ends the search.
class Search {
 public:
  Search(const Json& json, std::optional<uint64_t> binary) : json_(json), binary_(binary) {}

  std::optional<Fault> run() {
    if (!json_.is_object()) return Fault{"/", "is no JSON object"};
    const bool sound = buffers() && views() && accessors() && meshes() && nodes() && skins() && animations();
    return sound ? std::nullopt : std::optional(fault_);
  }

 private:
  bool fail(std::string place, std::string what) {
    fault_ = {std::move(place), std::move(what)};
    return false;
  }

  size_t sizeOf(const char* list) const {
    const Json& all = member(json_, list);
    return all.is_array() ? all.size() : 0;
  }

  /// Calls check(element, place) for each of a list until one fails.
  template <typename Check>
  bool each(const Json& list, const std::string& place, const Check& check) {
    if (list.is_null()) return true;
    if (!list.is_array()) return fail(place, "is no list");
    for (size_t i = 0; i < list.size(); ++i)
      if (!check(list[i], place + "/" + number(i))) return false;
    return true;
  }

  /// Whether `value` names one of `list`; `required`: it may not be missing.
  bool names(const Json& value, const char* list, const std::string& place, bool required = true) {
    if (value.is_null()) return !required || fail(place, "is missing");
    const uint64_t n = countOf(value);
    if (n < sizeOf(list)) return true;
    return fail(place, "names number " + value.dump().substr(0, 20) + " of " + number(sizeOf(list)) + " " + list);
  }

  bool buffers() {
    return each(member(json_, "buffers"), "/buffers", [&](const Json& b, const std::string& place) {
      const uint64_t bytes = countOf(member(b, "byteLength"));
      if (bytes == UINT64_MAX) return fail(place + "/byteLength", "is no number of bytes");
      if (binary_ && place == "/buffers/0" && member(b, "uri").is_null() && bytes > *binary_)
        return fail(place, "wants " + number(bytes) + " bytes where the file holds " + number(*binary_));
      return true;
    });
  }

  bool views() {
    return each(member(json_, "bufferViews"), "/bufferViews", [&](const Json& v, const std::string& place) {
      if (!names(member(v, "buffer"), "buffers", place + "/buffer")) return false;
      const uint64_t all = countOf(member(member(json_, "buffers")[countOf(member(v, "buffer"))], "byteLength"), 0);
      const uint64_t begin = countOf(member(v, "byteOffset"), 0), bytes = countOf(member(v, "byteLength"), 0);
      if (begin > all || bytes > all - begin)
        return fail(place,
                    "reaches to byte " + number(begin) + " + " + number(bytes) + " of a buffer of " + number(all));
      return true;
    });
  }

  bool accessors() {
    static const std::map<std::string, uint64_t> kComponents = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                                {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    static const std::map<uint64_t, uint64_t> kWidths = {{5120, 1}, {5121, 1}, {5122, 2},
                                                         {5123, 2}, {5125, 4}, {5126, 4}};
    return each(member(json_, "accessors"), "/accessors", [&](const Json& a, const std::string& place) {
      const auto components = kComponents.find(textOf(member(a, "type")));
      if (components == kComponents.end()) return fail(place + "/type", "is unknown");
      const auto width = kWidths.find(countOf(member(a, "componentType"), 0));
      if (width == kWidths.end()) return fail(place + "/componentType", "is unknown");
      const uint64_t count = countOf(member(a, "count"), 0);
      if (count == 0) return fail(place + "/count", "is no number above 0");
      if (member(a, "bufferView").is_null()) return true;
      if (!names(member(a, "bufferView"), "bufferViews", place + "/bufferView")) return false;
      const Json& view = member(json_, "bufferViews")[countOf(member(a, "bufferView"))];
      const uint64_t element = components->second * width->second;
      const uint64_t stated = countOf(member(view, "byteStride"), 0), stride = stated > 0 ? stated : element;
      const uint64_t begin = countOf(member(a, "byteOffset"), 0), bytes = countOf(member(view, "byteLength"), 0);
      if (begin > bytes || element > bytes - begin || (count - 1) > (bytes - begin - element) / stride)
        return fail(place, "has " + number(count) + " elements that do not fit into the " + number(bytes) +
                               " bytes of its view");
      return true;
    });
  }

  bool meshes() {
    return each(member(json_, "meshes"), "/meshes", [&](const Json& mesh, const std::string& place) {
      return each(member(mesh, "primitives"), place + "/primitives", [&](const Json& p, const std::string& at) {
        if (!names(member(p, "indices"), "accessors", at + "/indices", false)) return false;
        if (!names(member(p, "material"), "materials", at + "/material", false)) return false;
        const Json& attributes = member(p, "attributes");
        if (!attributes.is_object()) return fail(at + "/attributes", "are missing");
        for (const auto& [name, accessor] : attributes.items())
          if (!names(accessor, "accessors", at + "/attributes/" + name)) return false;
        return true;
      });
    });
  }

  bool nodes() {
    // Nodes are a forest: each has one parent at most, and nobody is above himself.
    std::vector<size_t> parent(sizeOf("nodes"), SIZE_MAX);
    size_t i = 0;
    const bool sound = each(member(json_, "nodes"), "/nodes", [&](const Json& node, const std::string& place) {
      const size_t self = i++;
      if (!names(member(node, "mesh"), "meshes", place + "/mesh", false)) return false;
      if (!names(member(node, "skin"), "skins", place + "/skin", false)) return false;
      return each(member(node, "children"), place + "/children", [&](const Json& child, const std::string& at) {
        if (!names(child, "nodes", at)) return false;
        size_t& of = parent[countOf(child)];
        if (of != SIZE_MAX) return fail(at, "is a child of node " + number(of) + ", too");
        of = self;
        return true;
      });
    });
    if (!sound) return false;
    for (size_t k = 0; k < parent.size(); ++k) {
      size_t steps = 0;
      for (size_t at = parent[k]; at != SIZE_MAX; at = parent[at])
        if (++steps > parent.size()) return fail("/nodes/" + number(k), "is above itself");
    }
    return true;
  }

  bool skins() {
    return each(member(json_, "skins"), "/skins", [&](const Json& skin, const std::string& place) {
      const Json& joints = member(skin, "joints");
      if (!joints.is_array() || joints.empty()) return fail(place + "/joints", "are missing");
      if (!each(joints, place + "/joints", [&](const Json& j, const std::string& at) { return names(j, "nodes", at); }))
        return false;
      const Json& matrices = member(skin, "inverseBindMatrices");
      if (!names(matrices, "accessors", place + "/inverseBindMatrices", false)) return false;
      if (matrices.is_null()) return true;
      const uint64_t count = countOf(member(member(json_, "accessors")[countOf(matrices)], "count"), 0);
      return count >= joints.size() || fail(place + "/inverseBindMatrices", "are fewer than the joints");
    });
  }

  bool animations() {
    return each(member(json_, "animations"), "/animations", [&](const Json& animation, const std::string& place) {
      const Json& samplers = member(animation, "samplers");
      if (!each(samplers, place + "/samplers", [&](const Json& s, const std::string& at) {
            return names(member(s, "input"), "accessors", at + "/input") &&
                   names(member(s, "output"), "accessors", at + "/output");
          }))
        return false;
      return each(member(animation, "channels"), place + "/channels", [&](const Json& c, const std::string& at) {
        if (!samplers.is_array() || countOf(member(c, "sampler")) >= samplers.size())
          return fail(at + "/sampler", "names none of the samplers");
        return names(member(member(c, "target"), "node"), "nodes", at + "/target/node", false);
      });
    });
  }

  const Json& json_;
  std::optional<uint64_t> binary_;  ///< bytes of the binary chunk, where there can be one
  Fault fault_;
};

/// The first JSON syntax error.
std::optional<Fault> syntaxFault(std::string_view text, size_t offset) {
  try {
    const Json parsed = Json::parse(text);
    (void)parsed;
  } catch (const Json::parse_error& e) {
    return Fault{"byte " + number(offset + e.byte), "is no JSON"};
  } catch (const std::exception&) {
    return Fault{"byte " + number(offset), "is no JSON"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Fault> firstFault(std::string_view bytes) {
  if (bytes.empty()) return Fault{"byte 0", "the file is empty"};
  std::string_view text = bytes;
  std::optional<uint64_t> binary;
  size_t textAt = 0;
  if (wordAt(bytes, 0) == kMagic) {
    if (bytes.size() < 20) return Fault{"byte " + number(bytes.size()), "ends within its header"};
    if (wordAt(bytes, 4) != 2) return Fault{"byte 4", "is of version " + number(wordAt(bytes, 4)) + ", not 2"};
    if (wordAt(bytes, 8) > bytes.size())
      return Fault{"byte 8", "should have " + number(wordAt(bytes, 8)) + " bytes and has " + number(bytes.size())};
    const uint32_t length = wordAt(bytes, 12);
    if (wordAt(bytes, 16) != kJsonChunk) return Fault{"byte 16", "does not begin with a chunk of JSON"};
    if (length > bytes.size() - 20) return Fault{"byte 12", "has a first chunk that is longer than the file"};
    text = bytes.substr(20, length), textAt = 20, binary = 0;
    const size_t second = 20 + static_cast<size_t>(length);
    if (bytes.size() >= second + 8) {
      binary = wordAt(bytes, second);
      if (*binary > bytes.size() - second - 8)
        return Fault{"byte " + number(second), "has a second chunk that is longer than the file"};
    }
  }
  if (auto fault = syntaxFault(text, textAt)) return fault;
  const Json json = Json::parse(text, nullptr, false);
  return Search(json, binary).run();
}

std::optional<Fault> firstFaultIn(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (extension != ".gltf" && extension != ".glb") return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  return firstFault(std::string(std::istreambuf_iterator<char>(stream), {}));
}

}  // namespace vicus::assets::gltf
