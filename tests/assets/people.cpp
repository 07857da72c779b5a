/// People made by code, motions and characters from files.
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>

#include "assets/people/populate.hpp"
#include "assets/people/read_bvh.hpp"
#include "assets/people/read_character.hpp"
#include "assets/people/townspeople.hpp"
#include "avatars/cycle.hpp"
#include "avatars/lod.hpp"
#include "avatars/pose.hpp"
#include "avatars/resample.hpp"
#include "avatars/retarget.hpp"

namespace vicus::assets::people {
namespace {

namespace fs = std::filesystem;
using glm::mat4;
using glm::vec3;
using ::testing::HasSubstr;

std::string dataFolder() {
  const char* named = std::getenv("VICUS_DATA");
  return named ? named : "../shared/data";
}

std::string said(const city::Diagnostics& d) {
  std::string out;
  for (const city::Diagnostic& m : d.messages) out += city::describe(m) + "\n";
  return out;
}

constexpr const char* kBvh =
    "HIERARCHY\nROOT Hips\n{\n OFFSET 0 0 0\n CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
    " JOINT LeftUpLeg\n {\n  OFFSET 10 -5 0\n  CHANNELS 3 Xrotation Zrotation Yrotation\n"
    "  End Site\n  {\n   OFFSET 0 -90 0\n  }\n }\n JOINT Head {\n  OFFSET 0 75 0\n  CHANNELS 1 Yrotation\n }\n}\n"
    "MOTION\nFrames: 2\nFrame Time: 0.04\n"
    "0 95 0 0 0 0 0 0 0 0\n0 95 20 0 0 90 90 0 0 45\n";

TEST(Bvh, OrdersUnitsAndAxes) {
  city::Diagnostics d;
  const auto motion = parseBvh(kBvh, "a.bvh", {}, d);
  ASSERT_TRUE(motion) << said(d);
  EXPECT_TRUE(d.messages.empty()) << said(d);
  EXPECT_EQ(motion->metresPerUnit, 0.01) << "170 units from toe to head are centimetres";
  EXPECT_NEAR(motion->clip.duration, 0.04, 1e-9);
  city::Pose pose;
  avatars::samplePose(motion->skeleton, motion->clip, 1, pose);
  const auto at = avatars::characterFromJoints(motion->skeleton, pose);
  // 20 along the file's z is ahead; a quarter about the file's y turns the left (+y) back to ... where the leg's joint
  // then lies; and the leg, a quarter about its own x, points ahead of the turned hips.
  EXPECT_LT(glm::distance(vec3(at[0][3]), vec3(0.2F, 0, 0.95F)), 1e-5F);
  EXPECT_LT(glm::distance(vec3(at[1][3]), vec3(0.1F, 0, 0.90F)), 1e-5F) << at[1][3].x << " " << at[1][3].y;
  EXPECT_LT(glm::distance(vec3(at[2][3] - at[1][3]), vec3(0, -0.9F, 0)), 1e-5F) << at[2][3].x << " " << at[2][3].y;
}

TEST(Bvh, FrameTimesOfAllKinds) {
  for (const char* time : {"1000", "0.0001", ".0083333", "1e-4"}) {
    std::string text = kBvh;
    text.replace(text.find("0.04"), 4, time);
    city::Diagnostics d;
    const auto motion = parseBvh(text, "a.bvh", {}, d);
    ASSERT_TRUE(motion) << said(d);
    EXPECT_NEAR(motion->frameTime, std::stod(time), 1e-12);
  }
}

TEST(Bvh, WhatIsBrokenIsNamedWithItsLine) {
  const auto broken = [](const char* what, const char* with) {
    std::string text = kBvh;
    text.replace(text.find(what), std::string(what).size(), with);
    city::Diagnostics d;
    const bool read = parseBvh(text, "a.bvh", {}, d).has_value();
    return (read ? "read; " : "") + said(d);
  };
  EXPECT_THAT(broken("HIERARCHY", "HIERARCHIE"), HasSubstr("a.bvh: line 1: a BVH file begins with HIERARCHY"));
  EXPECT_THAT(broken("OFFSET 10 -5", "OFFSET 10 x"), HasSubstr("a.bvh: line 8: OFFSET takes three numbers, found 'x'"));
  EXPECT_THAT(broken("Zrotation Xrotation", "Zrotation Qrotation"), HasSubstr("line 5: 'Qrotation' is no channel"));
  EXPECT_THAT(broken("CHANNELS 3", "CHANNELS 99"), HasSubstr("line 9: CHANNELS is followed by their number"));
  EXPECT_THAT(broken("Frames: 2", "Frames: two"), HasSubstr("line 21: the number of frames is a whole number"));
  EXPECT_THAT(broken("MOTION", ""), HasSubstr("expected MOTION, found 'Frames:'"));
  EXPECT_THAT(broken("0.04", "0"), HasSubstr("read; a.bvh: line 22: a frame time that is not positive"));
  EXPECT_THAT(broken("Frames: 2", "Frames: 900"), HasSubstr("read; a.bvh: line 25: frame 2 of 900 is missing"));
  EXPECT_THAT(broken("0 95 20", "0 nan 20"), HasSubstr("read; a.bvh: line 24: frame 1 of 2 holds what is no number"));
  for (size_t cut = 0; cut < std::string(kBvh).size(); cut += 3) {
    city::Diagnostics d;
    if (!parseBvh(std::string(kBvh).substr(0, cut), "a.bvh", {}, d)) {
      EXPECT_TRUE(d.hasErrors()) << cut;
    }
  }
  city::Diagnostics d;
  EXPECT_FALSE(readBvh("no/such.bvh", {}, d));
  EXPECT_THAT(said(d), HasSubstr("no/such.bvh: cannot be read"));
}

// ---- poses against an independent evaluation -----------------------------------------------------------------------

/// World matrices of assimp's own nodes, animated by its keys and its own interpolation.
class AssimpPoses {
 public:
  explicit AssimpPoses(const std::string& file) : scene_(importer_.ReadFile(file, 0)) {}
  const aiScene* scene() const { return scene_; }

  std::map<std::string, aiMatrix4x4> at(const aiAnimation& animation, double seconds) const {
    const double ticks = seconds * (animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : 25);
    std::map<std::string, aiMatrix4x4> local, world;
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
      const aiNodeAnim& n = *animation.mChannels[c];
      local[n.mNodeName.C_Str()] = aiMatrix4x4(valueAt(n.mScalingKeys, n.mNumScalingKeys, ticks),
                                               valueAt(n.mRotationKeys, n.mNumRotationKeys, ticks),
                                               valueAt(n.mPositionKeys, n.mNumPositionKeys, ticks));
    }
    visit(*scene_->mRootNode, aiMatrix4x4(), local, world);
    return world;
  }

 private:
  template <typename Key>
  static decltype(Key::mValue) valueAt(const Key* keys, unsigned count, double ticks) {
    unsigned k = 0;
    while (k + 1 < count && keys[k + 1].mTime <= ticks) ++k;
    if (k + 1 >= count || ticks <= keys[k].mTime) return keys[k].mValue;
    auto value = keys[k].mValue;
    const double f = (ticks - keys[k].mTime) / (keys[k + 1].mTime - keys[k].mTime);
    Assimp::Interpolator<decltype(value)>()(value, keys[k].mValue, keys[k + 1].mValue, static_cast<ai_real>(f));
    return value;
  }
  static void visit(const aiNode& node, const aiMatrix4x4& parent, const std::map<std::string, aiMatrix4x4>& local,
                    std::map<std::string, aiMatrix4x4>& world) {
    const auto own = local.find(node.mName.C_Str());
    const aiMatrix4x4 here = parent * (own == local.end() ? node.mTransformation : own->second);
    world.try_emplace(node.mName.C_Str(), here);
    for (unsigned c = 0; c < node.mNumChildren; ++c) visit(*node.mChildren[c], here, local, world);
  }

  Assimp::Importer importer_;
  const aiScene* scene_;
};

/// From the file's axes (y up, z ahead) to ours.
vec3 ours(const aiMatrix4x4& m, double unit) {
  return vec3(m.c4, m.a4, m.b4) * static_cast<float>(unit);
}

TEST(Poses, OfMotionCaptureEqualAssimps) {
  double largest = 0;
  size_t compared = 0;
  for (const char* name : {"131_01", "131_02", "131_03"}) {
    const std::string file = dataFolder() + "/mocap/" + name + ".bvh";
    if (!fs::exists(file)) GTEST_SKIP() << "no motion capture at " << file;
    city::Diagnostics d;
    const auto motion = readBvh(file, {}, d);
    ASSERT_TRUE(motion) << said(d);
    EXPECT_NEAR(motion->metresPerUnit, 0.0254 / 0.45, 1e-9) << "CMU's unit";
    const AssimpPoses assimp(file);
    ASSERT_TRUE(assimp.scene());
    ASSERT_EQ(assimp.scene()->mNumAnimations, 1U);
    const aiAnimation& animation = *assimp.scene()->mAnimations[0];
    for (const size_t frame : {size_t{0}, size_t{1}, size_t{333}, size_t{700}, size_t{990}}) {
      const double seconds = static_cast<double>(frame) * motion->frameTime;
      city::Pose pose;
      avatars::samplePose(motion->skeleton, motion->clip, seconds, pose);
      const auto at = avatars::characterFromJoints(motion->skeleton, pose);
      // The same frame, whatever assimp calls its time.
      const auto theirs = assimp.at(
          animation, static_cast<double>(frame) / (animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : 25));
      for (size_t j = 0; j < at.size(); ++j) {
        const auto it = theirs.find(motion->skeleton.joints[j].name);
        if (it == theirs.end()) continue;
        ++compared;
        largest = std::max(largest,
                           static_cast<double>(glm::distance(vec3(at[j][3]), ours(it->second, motion->metresPerUnit))));
      }
    }
  }
  EXPECT_GT(compared, 400U);
  EXPECT_LT(largest, 1e-4);
  RecordProperty("largest", std::to_string(largest));
}

TEST(Poses, OfCharactersEqualAssimps) {
  for (const char* name : {"kaykit_Knight", "kaykit_Rogue_Hooded", "Fox"}) {
    const std::string file = dataFolder() + "/characters/" + name + ".glb";
    if (!fs::exists(file)) GTEST_SKIP() << "no characters at " << file;
    city::Diagnostics d;
    const auto read = readCharacter(file, d);
    ASSERT_TRUE(read) << said(d);
    const AssimpPoses assimp(file);
    ASSERT_TRUE(assimp.scene());
    ASSERT_EQ(assimp.scene()->mNumAnimations, read->clips.size());
    const auto unit = static_cast<double>(read->body.skeleton.joints[0].rest.scale.x);
    double largest = 0;
    size_t compared = 0;
    for (size_t c = 0; c < read->clips.size(); c += 5) {
      city::Clip clip = read->clips[c];
      clip.loops = false;
      for (const double part : {0.0, 0.21, 0.5, 0.83, 1.0}) {
        city::Pose pose;
        avatars::samplePose(read->body.skeleton, clip, part * clip.duration, pose);
        const auto at = avatars::characterFromJoints(read->body.skeleton, pose);
        const auto theirs = assimp.at(*assimp.scene()->mAnimations[c], part * clip.duration);
        for (size_t j = 1; j < at.size(); ++j) {
          const auto it = theirs.find(read->body.skeleton.joints[j].name);
          if (it == theirs.end()) continue;
          ++compared;
          largest = std::max(largest, static_cast<double>(glm::distance(vec3(at[j][3]), ours(it->second, unit))));
        }
      }
    }
    EXPECT_GT(compared, 100U) << name;
    EXPECT_LT(largest, 1e-4) << name;
  }
}

TEST(Characters, HaveARoleForEachAndStandOnTheGround) {
  for (const char* name : {"kaykit_Knight", "kaykit_Rogue_Hooded", "Fox"}) {
    const std::string file = dataFolder() + "/characters/" + name + ".glb";
    if (!fs::exists(file)) GTEST_SKIP() << "no characters at " << file;
    city::Diagnostics d;
    const auto read = readCharacter(file, d);
    ASSERT_TRUE(read) << said(d);
    const city::Character& body = read->body;
    EXPECT_THAT(body.clips[0].name, HasSubstr("Walk")) << name;
    // Their pictures lie inside the files: not everything is of one grey.
    EXPECT_TRUE(d.messages.empty()) << said(d);
    std::set<std::array<uint8_t, 4>> colours;
    for (const city::AvatarVertex& v : body.levels[0].vertices) colours.insert(v.colour);
    EXPECT_GT(colours.size(), 4U) << name;
    const auto isSkin = [](const std::array<uint8_t, 4>& c) {  // 242, 168, 126 in the Rogue's picture
      return std::abs(c[0] - 241) < 4 && std::abs(c[1] - 161) < 4 && std::abs(c[2] - 117) < 4;
    };
    if (std::string(name) == "kaykit_Rogue_Hooded") {
      EXPECT_TRUE(std::ranges::any_of(colours, isSkin)) << "the right way up";
    }
    for (const city::Clip& clip : body.clips) EXPECT_GT(clip.duration, 0.2) << name;
    EXPECT_GT(body.clips[0].stride, 0.2) << name;
    EXPECT_LT(body.clips[0].stride, 3) << name;
    EXPECT_NEAR(body.bounds.min.z, 0, 0.12) << name << " floats or sinks";
    EXPECT_GT(body.bounds.max.z, 0.3) << name;
    EXPECT_LT(body.bounds.max.z, 3) << name;
    EXPECT_LT(body.levels[2].indices.size(), body.levels[0].indices.size() / 2) << name;
    // At rest and posed alike: a vertex is not torn from its neighbours.
    city::Pose pose;
    std::vector<std::array<glm::vec4, 3>> matrices;
    avatars::samplePose(body.skeleton, body.clips[0], 0.3, pose);
    avatars::addSkinMatrices(body, pose, matrices);
    float longest = 0;
    for (size_t i = 0; i + 1 < body.levels[0].indices.size(); ++i) {
      if (i % 3 == 2) continue;
      const auto& a = body.levels[0].vertices[body.levels[0].indices[i]];
      const auto& b = body.levels[0].vertices[body.levels[0].indices[i + 1]];
      longest = std::max(longest, glm::distance(avatars::skinned(a, matrices), avatars::skinned(b, matrices)) -
                                      glm::distance(a.position, b.position));
    }
    EXPECT_LT(longest, 0.35F) << name;
  }
}

TEST(Characters, DamagedFilesAreNamed) {
  const std::string whole = dataFolder() + "/characters/Fox.glb";
  city::Diagnostics none;
  EXPECT_FALSE(readCharacter("no/such.glb", none));
  EXPECT_THAT(said(none), HasSubstr("no/such.glb: cannot be read"));
  if (!fs::exists(whole)) GTEST_SKIP() << "no characters at " << whole;
  std::ifstream in(whole, std::ios::binary);
  std::stringstream bytes;
  bytes << in.rdbuf();
  const std::string file = testing::TempDir() + "/cut.glb";
  std::ofstream(file, std::ios::binary) << bytes.str().substr(0, 40'000);
  city::Diagnostics d;
  EXPECT_FALSE(readCharacter(file, d));
  EXPECT_TRUE(d.hasErrors());
  EXPECT_THAT(said(d), HasSubstr("cut.glb: byte 8: could not be read: should have 162852 bytes and has 40000"));
  fs::remove(file);
}

/// Seconds into a clip at which 0.4 of its keys are past: a moment that does not depend on the clip's pace.
double momentIn(const city::Clip& clip) {
  const std::vector<float>* most = nullptr;
  for (const city::Track& t : clip.tracks)
    if (!most || t.rotationTimes.size() > most->size()) most = &t.rotationTimes;
  return most && !most->empty() ? static_cast<double>((*most)[most->size() * 2 / 5]) : 0;
}

/// Joints by their names, in metres: at rest, or at that moment of a clip.
std::map<std::string, vec3> jointsAt(const CharacterFile& c, const city::Clip* clip) {
  city::Pose pose = avatars::restPose(c.body.skeleton);
  if (clip) avatars::samplePose(c.body.skeleton, *clip, momentIn(*clip), pose);
  const auto at = avatars::characterFromJoints(c.body.skeleton, pose);
  std::map<std::string, vec3> out;
  for (size_t j = 1; j < at.size(); ++j) out.try_emplace(c.body.skeleton.joints[j].name, vec3(at[j][3]));
  return out;
}

city::Aabbf skinnedBounds(const CharacterFile& c, const city::Clip* clip) {
  city::Pose pose = avatars::restPose(c.body.skeleton);
  std::vector<std::array<glm::vec4, 3>> matrices;
  if (clip) avatars::samplePose(c.body.skeleton, *clip, momentIn(*clip), pose);
  avatars::addSkinMatrices(c.body, pose, matrices);
  city::Aabbf box;
  for (const city::AvatarVertex& v : c.body.levels[0].vertices) box.extend(avatars::skinned(v, matrices));
  return box;
}

TEST(Characters, OfOtherFormatsAreTheSame) {
  // A character written as COLLADA and as FBX by assimp: the same body in the same poses. Its COLLADA writer loses
  // clips, so that one is compared at rest; its FBX writer changes turns between
  // keys: its clip is compared by what the body fills.
  const std::string whole = dataFolder() + "/characters/kaykit_Knight.glb";
  if (!fs::exists(whole)) GTEST_SKIP() << "no characters at " << whole;
  city::Diagnostics d;
  const auto expected = readCharacter(whole, d);
  ASSERT_TRUE(expected) << said(d);
  Assimp::Importer importer;
  ASSERT_TRUE(importer.ReadFile(whole, aiProcess_Triangulate));
  const std::unique_ptr<aiScene> scene(importer.GetOrphanedScene());
  const unsigned clips = scene->mNumAnimations;
  const std::string walk = expected->body.clips[0].name;
  const auto walking = std::find_if(scene->mAnimations, scene->mAnimations + clips,
                                    [&](const aiAnimation* a) { return walk == a->mName.C_Str(); });
  ASSERT_NE(walking, scene->mAnimations + clips);
  std::swap(*walking, scene->mAnimations[0]);
  for (const auto& [format, ending] : {std::pair("collada", "dae"), std::pair("fbxa", "fbx")}) {
    const std::string file = testing::TempDir() + "/vicus-knight." + ending;
    const unsigned textures = scene->mNumTextures;
    const bool moves = std::string(ending) == "fbx";
    scene->mNumAnimations = moves ? 1 : 0;
    scene->mNumTextures = moves ? 0 : textures;  // its FBX reader breaks down over what its writer makes of them
    Assimp::Exporter exporter;
    const aiReturn written = exporter.Export(scene.get(), format, file);
    scene->mNumAnimations = clips, scene->mNumTextures = textures;
    ASSERT_EQ(written, aiReturn_SUCCESS) << exporter.GetErrorString();
    city::Diagnostics other;
    const auto read = readCharacter(file, other);
    fs::remove(file);
    ASSERT_TRUE(read) << ending << ": " << said(other);
    EXPECT_EQ(read->body.levels[0].indices.size(), expected->body.levels[0].indices.size()) << ending;
    ASSERT_EQ(read->clips.size(), moves ? 1U : 0U) << ending;
    const city::Clip* his = moves ? &read->clips[0] : nullptr;
    const city::Clip* mine = moves ? &expected->body.clips[0] : nullptr;
    float largest = 0;
    size_t compared = 0;
    const auto theirs = jointsAt(*read, nullptr);
    for (const auto& [name, at] : jointsAt(*expected, nullptr))
      if (const auto it = theirs.find(name); it != theirs.end())
        ++compared, largest = std::max(largest, glm::distance(at, it->second));
    const float bound = moves ? 0.03F : 1e-3F;
    EXPECT_GT(compared, 20U) << ending;
    EXPECT_LT(largest, 1e-3F) << ending;
    const city::Aabbf is = skinnedBounds(*read, his), wanted = skinnedBounds(*expected, mine);
    EXPECT_LT(glm::distance(is.min, wanted.min), bound) << ending;
    EXPECT_LT(glm::distance(is.max, wanted.max), bound) << ending;
  }
}

TEST(Characters, ColladasClipsMoveTheirJoints) {
  // A post of two joints, 1.8 m high; the upper one nods by a quarter turn about z in a second.
  const std::string file = testing::TempDir() + "/vicus-post.dae";
  const auto source = [](const std::string& id, int count, int stride, const std::string& numbers) {
    const char* params = stride == 3    ? "<param name='X' type='float'/><param name='Y' type='float'/>"
                                          "<param name='Z' type='float'/>"
                         : stride == 16 ? "<param type='float4x4'/>"
                                        : "<param type='float'/>";
    return "<source id='" + id + "'><float_array id='" + id + "-a' count='" + std::to_string(count * stride) + "'>" +
           numbers + "</float_array><technique_common><accessor source='#" + id + "-a' count='" +
           std::to_string(count) + "' stride='" + std::to_string(stride) + "'>" + params +
           "</accessor></technique_common></source>";
  };
  const std::string unit = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
  std::ofstream(file)
      << "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>"
         "<asset><unit meter='1'/><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id='post'><mesh>"
      << source("p", 4, 3, "0 0 0 0.3 0 0 0.3 1.8 0 0 1.8 0")
      << "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices><triangles count='2'>"
         "<input semantic='VERTEX' source='#v' offset='0'/><p>0 1 2 0 2 3</p></triangles></mesh></geometry>"
         "</library_geometries><library_controllers><controller id='skin'><skin source='#post'><bind_shape_matrix>" +
             unit +
             "</bind_shape_matrix><source id='j'>"
             "<Name_array id='j-a' count='2'>low high</Name_array><technique_common><accessor source='#j-a' count='2'>"
             "<param type='Name'/></accessor></technique_common></source>"
      << source("b", 2, 16, unit + " 1 0 0 0 0 1 0 -0.9 0 0 1 0 0 0 0 1") << source("w", 1, 1, "1")
      << "<joints><input semantic='JOINT' source='#j'/><input semantic='INV_BIND_MATRIX' source='#b'/></joints>"
         "<vertex_weights count='4'><input semantic='JOINT' source='#j' offset='0'/>"
         "<input semantic='WEIGHT' source='#w' offset='1'/><vcount>1 1 1 1</vcount><v>0 0 0 0 1 0 1 0</v>"
         "</vertex_weights></skin></controller></library_controllers><library_animations><animation>"
      << source("t", 2, 1, "0 1")
      << source("r", 2, 16, "1 0 0 0 0 1 0 0.9 0 0 1 0 0 0 0 1 0 -1 0 0 1 0 0 0.9 0 0 1 0 0 0 0 1")
      << "<source id='i'><Name_array id='i-a' count='2'>LINEAR LINEAR</Name_array><technique_common>"
         "<accessor source='#i-a' count='2'><param type='Name'/></accessor></technique_common></source>"
         "<sampler id='s'><input semantic='INPUT' source='#t'/><input semantic='OUTPUT' source='#r'/>"
         "<input semantic='INTERPOLATION' source='#i'/></sampler><channel source='#s' target='high/transform'/>"
         "</animation></library_animations><library_visual_scenes><visual_scene id='scene'>"
         "<node id='low' sid='low' name='low' type='JOINT'><node id='high' sid='high' name='high' type='JOINT'>"
         "<matrix sid='transform'>1 0 0 0 0 1 0 0.9 0 0 1 0 0 0 0 1</matrix></node></node>"
         "<node id='body'><instance_controller url='#skin'><skeleton>#low</skeleton></instance_controller></node>"
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#scene'/></scene></COLLADA>";
  city::Diagnostics d;
  const auto read = readCharacter(file, d);
  fs::remove(file);
  ASSERT_TRUE(read) << said(d);
  ASSERT_EQ(read->clips.size(), 1U);
  EXPECT_NEAR(read->clips[0].duration, 1, 1e-3);
  // Our axes: x ahead (their z), y left (their x), z up. Nodded by 90° the top points to their −x.
  city::Clip clip = read->clips[0];
  clip.loops = false;
  city::Pose pose;
  std::vector<std::array<glm::vec4, 3>> matrices;
  avatars::samplePose(read->body.skeleton, clip, clip.duration, pose);
  avatars::addSkinMatrices(read->body, pose, matrices);
  city::Aabbf box;
  for (const city::AvatarVertex& v : read->body.levels[0].vertices) box.extend(avatars::skinned(v, matrices));
  EXPECT_NEAR(box.min.y, -0.9, 1e-3);
  EXPECT_NEAR(box.max.z, 1.2, 1e-3) << "0.9 and the post's width";
}

// ---- people made by code -------------------------------------------------------------------------------------------

TEST(Townspeople, WalkWithoutSlidingOrFloating) {
  for (const city::Role role : {city::Role::Walk, city::Role::Carry}) {
    const city::Clip clip = makeClip(role);
    const avatars::FootContact contact = avatars::footContact(townSkeleton(), clip);
    EXPECT_LT(contact.slip, 0.060) << "metres a step";
    EXPECT_LT(contact.highest, 0.03);
    EXPECT_LT(contact.lowest, 0.03);
    EXPECT_NEAR(avatars::strideOf(townSkeleton(), clip), clip.stride, 0.05 * clip.stride);
  }
  for (const city::Role role : {city::Role::Idle, city::Role::Talk}) {
    const avatars::FootContact contact = avatars::footContact(townSkeleton(), makeClip(role));
    EXPECT_LT(contact.slip, 0.01);
    EXPECT_LT(contact.highest, 0.01);
  }
}

TEST(Townspeople, AreWholeAndTheSameEachTime) {
  for (const Period period : {Period::Medieval, Period::Modern}) {
    const auto people = makeTownspeople(period), again = makeTownspeople(period);
    EXPECT_GE(people.size(), 5U);
    for (size_t k = 0; k < people.size(); ++k) {
      const city::Character& c = people[k];
      EXPECT_EQ(c.levels[0].vertices, again[k].levels[0].vertices) << c.name;
      EXPECT_GT(c.levels[0].indices.size() / 3, 400U) << c.name;
      EXPECT_LT(c.levels[0].indices.size() / 3, 2000U) << c.name;
      EXPECT_LT(c.levels[1].indices.size(), c.levels[0].indices.size() * 3 / 4) << c.name;
      EXPECT_LT(c.levels[2].indices.size(), c.levels[1].indices.size()) << c.name;
      EXPECT_NEAR(c.bounds.min.z, 0, 0.06) << c.name;
      EXPECT_GE(c.dresses.size(), 4U);
      for (const city::AvatarVertex& v : c.levels[0].vertices) {
        ASSERT_EQ(v.weights[0] + v.weights[1] + v.weights[2] + v.weights[3], 255) << c.name;
        ASSERT_LT(v.colour[3], city::kDressParts);
        for (size_t j = 0; j < 4; ++j) ASSERT_LT(v.joints[j], c.skeleton.joints.size());
      }
      const avatars::LevelErrors errors = avatars::levelErrorsOf(c);
      EXPECT_LT(errors.metres[1], 0.08) << c.name;
      EXPECT_LT(errors.metres[2], 0.15) << c.name;
      EXPECT_LT(errors.fastest, 6) << c.name;
    }
  }
}

TEST(Townspeople, WalkLikeTheMotionCapture) {
  for (const char* name : {"131_01", "131_02"}) {
    const std::string file = dataFolder() + "/mocap/" + name + ".bvh";
    if (!fs::exists(file)) GTEST_SKIP() << "no motion capture at " << file;
    city::Diagnostics d;
    const auto motion = readBvh(file, {}, d);
    ASSERT_TRUE(motion) << said(d);
    for (city::Character c : makeTownspeople(Period::Medieval)) {
      ASSERT_TRUE(useMotion(c, motion->skeleton, motion->clip, file, d)) << said(d);
      const city::Clip& walk = c.clips[0];
      EXPECT_GT(walk.stride, 0.1) << c.name << ": 131_02 shuffles at a third of a metre a second";
      EXPECT_LT(walk.stride, 2.2) << c.name;
      const avatars::FootContact contact = avatars::footContact(c.skeleton, walk);
      EXPECT_LT(contact.slip, 0.15) << c.name << " " << name;
      EXPECT_LT(contact.highest, 0.08) << c.name << " " << name;
      EXPECT_LT(contact.lowest, 0.05) << c.name << " " << name;
    }
  }
}

}  // namespace
}  // namespace vicus::assets::people
