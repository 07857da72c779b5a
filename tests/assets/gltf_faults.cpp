/// What is wrong with a glTF file, and where.
#include "assets/import/gltf_faults.hpp"

#include <gtest/gtest.h>

#include <string>

namespace vicus::assets::gltf {
namespace {

std::string word(uint32_t n) {
  std::string out;
  for (int k = 0; k < 4; ++k) out.push_back(static_cast<char>(n >> (8 * k) & 0xffU));
  return out;
}

std::string binary(std::string json, const std::string& bin) {
  while (json.size() % 4 != 0) json.push_back(' ');
  const std::string rest = word(static_cast<uint32_t>(json.size())) + "JSON" + json +
                           word(static_cast<uint32_t>(bin.size())) + std::string("BIN\0", 4) + bin;
  return "glTF" + word(2) + word(static_cast<uint32_t>(12 + rest.size())) + rest;
}

/// Two joints, one of them a child; three vertices; one clip.
constexpr const char* kModel = R"({"asset":{"version":"2.0"},
  "buffers":[{"byteLength":128}],
  "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":0,"byteLength":128}],
  "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
               {"bufferView":1,"componentType":5126,"count":2,"type":"MAT4"},
               {"bufferView":0,"componentType":5126,"count":2,"type":"SCALAR"}],
  "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
  "nodes":[{"mesh":0,"skin":0,"children":[1]},{"children":[2]},{}],
  "skins":[{"joints":[1,2],"inverseBindMatrices":1}],
  "animations":[{"samplers":[{"input":2,"output":0}],"channels":[{"sampler":0,"target":{"node":1,"path":"scale"}}]}]})";

std::string changed(const std::string& from, const std::string& to) {
  std::string out = kModel;
  const size_t at = out.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return out.replace(at, from.size(), to);
}

std::string placeOf(const std::string& bytes) {
  const auto fault = firstFault(bytes);
  return fault ? fault->place : "none";
}

TEST(GltfFaults, NoneInASoundModel) {
  EXPECT_EQ(placeOf(kModel), "none");
  EXPECT_EQ(placeOf(binary(kModel, std::string(128, '\0'))), "none");
}

TEST(GltfFaults, OfTheBinaryAreNamedByTheirByte) {
  const std::string whole = binary(kModel, std::string(128, '\0'));
  EXPECT_EQ(placeOf(""), "byte 0");
  EXPECT_EQ(placeOf(whole.substr(0, 15)), "byte 15");
  EXPECT_EQ(placeOf(whole.substr(0, 200)), "byte 8");
  EXPECT_EQ(placeOf("glTF" + word(1) + whole.substr(8)), "byte 4");
  EXPECT_EQ(placeOf(whole.substr(0, 12) + word(0x7fffffff) + whole.substr(16)), "byte 12");
  EXPECT_EQ(placeOf(whole.substr(0, 16) + "NOSJ" + whole.substr(20)), "byte 16");
  EXPECT_EQ(placeOf(binary(kModel, std::string(64, '\0'))), "/buffers/0");
  EXPECT_EQ(placeOf(R"({"asset":)"), "byte 10");
}

TEST(GltfFaults, OfTheModelAreNamedByTheirPointer) {
  const std::pair<std::pair<const char*, const char*>, const char*> cases[] = {
      {{R"("byteLength":128}],)", R"("byteLength":-1}],)"}, "/buffers/0/byteLength"},
      {{R"({"buffer":0,"byteLength":36})", R"({"buffer":7,"byteLength":36})"}, "/bufferViews/0/buffer"},
      {{R"("byteOffset":0,"byteLength":128)", R"("byteOffset":1,"byteLength":128)"}, "/bufferViews/1"},
      {{R"("count":3)", R"("count":4)"}, "/accessors/0"},
      {{R"("count":3)", R"("count":18446744073709551615)"}, "/accessors/0"},
      {{R"("MAT4")", R"("MAT5")"}, "/accessors/1/type"},
      {{R"("componentType":5126,"count":2,"type":"SCALAR")", R"("componentType":1,"count":2,"type":"SCALAR")"},
       "/accessors/2/componentType"},
      {{R"("POSITION":0)", R"("POSITION":9)"}, "/meshes/0/primitives/0/attributes/POSITION"},
      {{R"("mesh":0)", R"("mesh":1)"}, "/nodes/0/mesh"},
      {{R"("children":[2])", R"("children":[3])"}, "/nodes/1/children/0"},
      {{R"({"children":[2]},{})", R"({"children":[2]},{"children":[1]})"}, "/nodes/2/children/0"},
      {{R"("children":[1])", R"("children":[])"}, "none"},
      {{R"({"mesh":0,"skin":0,"children":[1]},{"children":[2]},{})",
        R"({"mesh":0,"skin":0},{"children":[2]},{"children":[1]})"},
       "/nodes/1"},
      {{R"("joints":[1,2])", R"("joints":[1,8])"}, "/skins/0/joints/1"},
      {{R"("joints":[1,2])", R"("joints":[1,2,0])"}, "/skins/0/inverseBindMatrices"},
      {{R"("input":2)", R"("input":20)"}, "/animations/0/samplers/0/input"},
      {{R"("sampler":0)", R"("sampler":1)"}, "/animations/0/channels/0/sampler"},
      {{R"("node":1)", R"("node":"x")"}, "/animations/0/channels/0/target/node"}};
  for (const auto& [change, place] : cases)
    EXPECT_EQ(placeOf(changed(change.first, change.second)), place) << change.second;
}

}  // namespace
}  // namespace vicus::assets::gltf
