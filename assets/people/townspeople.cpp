#include "assets/people/townspeople.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <string>
#include <tuple>

#include "assets/people/body_builder.hpp"
#include "assets/people/joints.hpp"
#include "avatars/pose.hpp"
#include "city/random.hpp"

namespace vicus::assets::people {
namespace {

using city::Dress;
using glm::vec2;
using glm::vec3;

enum Part : uint8_t { Skin, Hair, Upper, Lower, Linen, Shoes, Hat, Carried };
enum class Headwear : uint8_t { None, Coif, Hood, Straw, Veil, Cap };
enum class Load : uint8_t { None, Basket, OnHead };

/// What makes one character differ from another. Heights in metres over the ground at 1.70 m.
struct Figure {
  const char* name;
  float hem;   ///< of the upper garment
  bool skirt;  ///< wide below the waist, hides the legs
  bool woman;
  Headwear head;
  bool apron;
  Load load;
  float size = 1;   ///< of the body
  float girth = 1;  ///< of its trunk
};

constexpr Figure kMedieval[] = {
    {"townsman", 0.50F, false, false, Headwear::Coif, false, Load::None},
    {"merchant", 0.16F, true, false, Headwear::Cap, false, Load::None, 1.02F, 1.18F},
    {"labourer", 0.60F, false, false, Headwear::Straw, false, Load::None},
    {"monk", 0.09F, true, false, Headwear::Hood, false, Load::None, 1, 1.08F},
    {"housewife", 0.08F, true, true, Headwear::Veil, true, Load::None, 0.95F},
    {"maid", 0.10F, true, true, Headwear::None, false, Load::None, 0.94F, 0.94F},
    {"market woman", 0.09F, true, true, Headwear::Veil, true, Load::Basket, 0.95F, 1.05F},
    {"carrier", 0.58F, false, false, Headwear::Coif, false, Load::OnHead},
    {"child", 0.55F, false, false, Headwear::None, false, Load::None, 0.70F, 1.05F},
};
constexpr Figure kModern[] = {
    {"man", 0.86F, false, false, Headwear::None, false, Load::None},
    {"man with a cap", 0.84F, false, false, Headwear::Cap, false, Load::None, 1.03F, 1.12F},
    {"woman", 0.86F, false, true, Headwear::None, false, Load::None, 0.95F},
    {"woman in a skirt", 0.45F, true, true, Headwear::None, false, Load::None, 0.94F, 0.95F},
    {"child", 0.84F, false, false, Headwear::None, false, Load::None, 0.70F, 1.05F},
};

/// Weights of a garment that hangs from the hips over both legs: lower down and farther out more of the nearer leg.
bool holdHem(const vec3& p, float most, std::array<uint8_t, 4>& joints, std::array<uint8_t, 4>& weights) {
  if (p.z > 0.93F) return false;
  const float low = std::clamp((0.93F - p.z) / 0.3F, 0.0F, 1.0F);
  const float legs = most * low, left = std::clamp(0.5F + p.y / 0.20F, 0.0F, 1.0F);
  const auto l = static_cast<uint8_t>(std::lround(255 * legs * left)),
             r = static_cast<uint8_t>(std::lround(255 * legs * (1 - left)));
  joints = {Hips, LeftUpperLeg, RightUpperLeg, 0};
  weights = {static_cast<uint8_t>(255 - l - r), l, r, 0};
  // The vertex shader stops at the first weight of nothing.
  if (l == 0) std::swap(weights[1], weights[2]), std::swap(joints[1], joints[2]);
  return true;
}

/// A tunic's hem goes with the thighs; a gown's, far below them, would swing too far.
bool holdTunic(const vec3& p, std::array<uint8_t, 4>& joints, std::array<uint8_t, 4>& weights) {
  return holdHem(p, 0.86F, joints, weights);
}
bool holdGown(const vec3& p, std::array<uint8_t, 4>& joints, std::array<uint8_t, 4>& weights) {
  return holdHem(p, 0.42F, joints, weights);
}

void addTrunk(BodyBuilder& b, const Figure& f) {
  const float g = f.girth, bust = f.woman ? 1.06F : 1.0F, waist = f.woman ? 0.90F : 1.0F;
  std::vector<Ring> rings;
  const auto ring = [&](float z, float rx, float ry, Hold hold, float shade = 1, float x = 0) {
    rings.push_back({{x, 0, z}, vec2(rx, ry) * g, hold, z < 0.97F && !f.skirt && f.hem > 0.8F ? Lower : Upper, shade});
  };
  const Hold hips{Hips, Hips, 0};
  if (f.hem < 0.8F) {
    const float flare = f.skirt ? 1.0F : 0.75F;
    const float hemX = f.skirt ? 0.27F : 0.215F, hemY = f.skirt ? 0.285F : 0.238F;
    ring(f.hem, hemX * 0.96F, hemY * 0.96F, hips, 0.45F);
    ring(f.hem + 0.01F, hemX, hemY, hips, 0.8F);
    if (f.skirt) ring(0.5F * (f.hem + 0.9F), 0.205F * flare, 0.235F * flare, hips, 0.9F);
    ring(0.80F, 0.168F, 0.20F, hips, 0.95F);
  } else {
    ring(f.hem - 0.06F, 0.10F, 0.15F, hips, 0.7F);
    ring(f.hem, 0.125F, 0.17F, hips, 0.85F);
  }
  ring(0.93F, 0.128F, 0.172F, hips);
  ring(1.03F, 0.112F * waist, 0.148F * waist, {Hips, Spine, 0.6F}, 0.75F);  // the belt
  ring(1.06F, 0.114F * waist, 0.150F * waist, {Hips, Spine, 0.9F});
  ring(1.20F, 0.128F * bust, 0.168F, {Spine, Chest, 0.7F}, 1, f.woman ? 0.015F : 0);
  ring(1.33F, 0.122F * bust, 0.182F, {Chest, Chest, 0}, 1, f.woman ? 0.012F : 0);
  ring(1.43F, 0.088F, 0.165F, {Chest, Chest, 0}, 1, -0.01F);
  ring(1.475F, 0.062F, 0.085F, {Chest, Neck, 0.3F}, 0.9F, -0.01F);
  b.addTube(rings, {1, 0, 0}, {0, 1, 0}, 10, f.hem < 0.8F ? f.skirt ? holdGown : holdTunic : nullptr);
  if (!f.apron) return;
  // A cloth in front, from the waist down.
  std::vector<Ring> cloth;
  for (const auto& [z, x, y] : {std::tuple{0.22F, 0.262F, 0.15F}, std::tuple{0.55F, 0.205F, 0.13F},
                                std::tuple{0.80F, 0.152F, 0.115F}, std::tuple{1.02F, 0.108F, 0.09F}})
    cloth.push_back({{x * g, 0, z}, {0.018F, y * g}, hips, Linen, z < 0.3F ? 0.85F : 1.0F});
  b.addTube(cloth, {1, 0, 0}, {0, 1, 0}, 6, holdGown);
}

void addLimbs(BodyBuilder& b, const Figure& f) {
  for (const float side : {1.0F, -1.0F}) {
    const uint32_t arm = side > 0 ? LeftUpperArm : RightUpperArm, leg = side > 0 ? LeftUpperLeg : RightUpperLeg;
    const auto at = [&](float x, float y, float z) { return vec3(x, side * y, z); };
    const float wide = f.skirt || f.woman ? 1.25F : 1.0F;  // sleeves
    const Ring sleeve[] = {{at(0, 0.213F, 0.885F), vec2(0.036F, 0.036F) * wide, {arm + 1, arm + 2, 0.3F}, Upper, 0.55F},
                           {at(0, 0.214F, 0.91F), vec2(0.037F, 0.037F) * wide, {arm + 1, arm + 1, 0}, Upper, 0.9F},
                           {at(0, 0.217F, 1.06F), {0.045F, 0.043F}, {arm + 1, arm + 1, 0}, Upper},
                           {at(0, 0.220F, 1.14F), {0.048F, 0.046F}, {arm, arm + 1, 0.5F}, Upper},
                           {at(0, 0.212F, 1.24F), {0.054F, 0.050F}, {arm, arm, 0}, Upper},
                           {at(-0.005F, 0.192F, 1.37F), {0.066F, 0.058F}, {Chest, arm, 0.75F}, Upper},
                           {at(-0.01F, 0.158F, 1.43F), {0.060F, 0.045F}, {Chest, arm, 0.25F}, Upper},
                           {at(-0.01F, 0.120F, 1.452F), {0.045F, 0.03F}, {Chest, Chest, 0}, Upper}};
    b.addTube(sleeve, {1, 0, 0}, {0, 1, 0}, 7);
    const Ring hand[] = {{at(0.012F, 0.213F, 0.755F), {0.020F, 0.010F}, {arm + 2, arm + 2, 0}, Skin, 0.9F},
                         {at(0.008F, 0.213F, 0.80F), {0.042F, 0.017F}, {arm + 2, arm + 2, 0}, Skin},
                         {at(0, 0.213F, 0.855F), {0.036F, 0.020F}, {arm + 2, arm + 2, 0}, Skin},
                         {at(0, 0.213F, 0.90F), {0.027F, 0.024F}, {arm + 1, arm + 2, 0.5F}, Skin}};
    b.addTube(hand, {1, 0, 0}, {0, 1, 0}, 6);

    const float slack = f.hem > 0.8F && !f.skirt ? 1.3F : 1.0F;  // trousers hang, hose do not
    std::vector<Ring> hose = {
        {at(-0.005F, 0.09F, 0.065F), vec2(0.042F, 0.038F) * slack, {leg + 1, leg + 2, 0.6F}, Lower, 0.7F},
        {at(-0.005F, 0.09F, 0.13F), vec2(0.042F, 0.038F) * slack, {leg + 1, leg + 1, 0}, Lower},
        {at(-0.015F, 0.092F, 0.34F), vec2(0.060F, 0.054F) * std::sqrt(slack), {leg + 1, leg + 1, 0}, Lower},
        {at(0.004F, 0.09F, 0.48F), vec2(0.062F, 0.058F), {leg, leg + 1, 0.5F}, Lower}};
    if (!f.skirt) {
      hose.push_back({at(0.004F, 0.09F, 0.58F), {0.070F, 0.066F}, {leg, leg, 0}, Lower});
      hose.push_back({at(0, 0.09F, 0.75F), {0.086F, 0.080F}, {leg, leg, 0}, Lower});
      hose.push_back({at(0, 0.085F, 0.90F), {0.095F, 0.085F}, {Hips, leg, 0.5F}, Lower});
    }
    b.addTube(hose, {1, 0, 0}, {0, 1, 0}, 7);
    // The shoe lies along x: its rings are upright, v up, u to the right so that u × v points ahead.
    const auto sole = [&](float x, float up, float half, Hold hold) {
      return Ring{at(x, 0.09F, up), {half, up - 0.002F}, hold, Shoes, 1};
    };
    const Ring shoe[] = {
        sole(-0.065F, 0.035F, 0.024F, {leg + 2, leg + 2, 0}),  sole(-0.03F, 0.048F, 0.040F, {leg + 2, leg + 2, 0}),
        sole(0.03F, 0.052F, 0.043F, {leg + 2, leg + 2, 0}),    sole(0.10F, 0.034F, 0.047F, {leg + 2, leg + 3, 0.2F}),
        sole(0.15F, 0.025F, 0.044F, {leg + 2, leg + 3, 0.9F}), sole(0.205F, 0.015F, 0.020F, {leg + 3, leg + 3, 0})};
    b.addTube(shoe, {0, 1, 0}, {0, 0, 1}, 6);
  }
}

void addHead(BodyBuilder& b, const Figure& f) {
  const Ring neck[] = {{{-0.012F, 0, 1.43F}, {0.058F, 0.058F}, {Chest, Neck, 0.3F}, Skin, 0.8F},
                       {{-0.006F, 0, 1.49F}, {0.052F, 0.052F}, {Neck, Neck, 0}, Skin, 0.85F},
                       {{0.006F, 0, 1.58F}, {0.050F, 0.050F}, {Neck, Head, 0.7F}, Skin, 0.75F}};
  b.addTube(neck, {1, 0, 0}, {0, 1, 0}, 7);
  b.addEllipsoid({0.018F, 0, 1.635F}, {0.092F, 0.074F, 0.112F}, Head, 10, 8, [](const vec3&) { return Skin; });
  b.addEllipsoid(
      {0.108F, 0, 1.625F}, {0.016F, 0.012F, 0.022F}, Head, 5, 4, [](const vec3&) { return Skin; }, 0.92F);
  const auto all = [](Part part) { return [part](const vec3&) -> uint8_t { return part; }; };
  const bool covered = f.head == Headwear::Coif || f.head == Headwear::Veil || f.head == Headwear::Hood;
  if (!covered) {
    b.addEllipsoid({-0.008F, 0, 1.665F}, {0.095F, 0.084F, 0.100F}, Head, 9, 7, all(Hair));
    if (f.woman) b.addEllipsoid({-0.075F, 0, 1.585F}, {0.045F, 0.055F, 0.085F}, Head, 7, 6, all(Hair), 0.9F);
  }
  switch (f.head) {
    case Headwear::Coif:
      b.addEllipsoid({-0.008F, 0, 1.660F}, {0.098F, 0.087F, 0.105F}, Head, 9, 7, all(Linen));
      break;
    case Headwear::Veil: {
      b.addEllipsoid({-0.014F, 0, 1.655F}, {0.102F, 0.094F, 0.112F}, Head, 9, 7, all(Linen));
      const Ring cloth[] = {{{-0.045F, 0, 1.36F}, {0.085F, 0.150F}, {Chest, Neck, 0.4F}, Linen, 0.75F},
                            {{-0.040F, 0, 1.45F}, {0.080F, 0.118F}, {Chest, Neck, 0.6F}, Linen, 0.95F},
                            {{-0.022F, 0, 1.58F}, {0.090F, 0.092F}, {Head, Head, 0}, Linen, 0.95F},
                            {{-0.015F, 0, 1.67F}, {0.098F, 0.092F}, {Head, Head, 0}, Linen, 1}};
      b.addTube(cloth, {1, 0, 0}, {0, 1, 0}, 9);
      break;
    }
    case Headwear::Hood: {
      b.addEllipsoid({-0.022F, 0, 1.660F}, {0.112F, 0.100F, 0.125F}, Head, 9, 7, all(Hat));
      const Ring cape[] = {{{-0.005F, 0, 1.33F}, {0.150F, 0.235F}, {Chest, Chest, 0}, Hat, 0.6F},
                           {{-0.005F, 0, 1.345F}, {0.152F, 0.235F}, {Chest, Chest, 0}, Hat, 0.9F},
                           {{-0.012F, 0, 1.44F}, {0.108F, 0.175F}, {Chest, Chest, 0}, Hat, 1},
                           {{-0.018F, 0, 1.52F}, {0.082F, 0.092F}, {Chest, Neck, 0.7F}, Hat, 0.9F},
                           {{-0.024F, 0, 1.62F}, {0.092F, 0.092F}, {Neck, Head, 0.9F}, Hat, 0.95F}};
      b.addTube(cape, {1, 0, 0}, {0, 1, 0}, 9);
      break;
    }
    case Headwear::Straw: {
      const Ring hat[] = {{{0.0F, 0, 1.690F}, {0.205F, 0.195F}, {Head, Head, 0}, Hat, 0.6F},
                          {{0.0F, 0, 1.703F}, {0.207F, 0.197F}, {Head, Head, 0}, Hat, 1},
                          {{0.0F, 0, 1.722F}, {0.110F, 0.100F}, {Head, Head, 0}, Hat, 0.9F},
                          {{-0.004F, 0, 1.790F}, {0.085F, 0.078F}, {Head, Head, 0}, Hat, 1},
                          {{-0.004F, 0, 1.812F}, {0.050F, 0.046F}, {Head, Head, 0}, Hat, 1}};
      b.addTube(hat, {1, 0, 0}, {0, 1, 0}, 10);
      break;
    }
    case Headwear::Cap: {
      const Ring cap[] = {{{0.002F, 0, 1.690F}, {0.100F, 0.090F}, {Head, Head, 0}, Hat, 0.7F},
                          {{0.0F, 0, 1.725F}, {0.116F, 0.106F}, {Head, Head, 0}, Hat, 0.9F},
                          {{-0.012F, 0, 1.770F}, {0.112F, 0.102F}, {Head, Head, 0}, Hat, 1},
                          {{-0.016F, 0, 1.790F}, {0.070F, 0.064F}, {Head, Head, 0}, Hat, 1}};
      b.addTube(cap, {1, 0, 0}, {0, 1, 0}, 9);
      break;
    }
    case Headwear::None:
      break;
  }
}

void addLoad(BodyBuilder& b, const Figure& f) {
  if (f.load == Load::None) return;
  const bool onHead = f.load == Load::OnHead;
  const uint32_t joint = onHead ? Head : Chest;
  const vec3 at = onHead ? vec3(0, 0, 1.755F) : vec3(0.315F, 0, 0.955F);
  const Hold hold{joint, joint, 0};
  const Ring basket[] = {{at, {0.115F, 0.125F}, hold, Carried, 0.6F},
                         {at + vec3(0, 0, 0.09F), {0.155F, 0.17F}, hold, Carried, 0.9F},
                         {at + vec3(0, 0, 0.15F), {0.165F, 0.18F}, hold, Carried, 1},
                         {at + vec3(0, 0, 0.15F), {0.145F, 0.16F}, hold, Carried, 0.5F}};
  b.addTube(basket, {1, 0, 0}, {0, 1, 0}, 10);
  // A cloth over what is in it.
  b.addEllipsoid(at + vec3(0, 0, 0.145F), {0.140F, 0.155F, 0.055F}, joint, 9, 4, [](const vec3&) { return Linen; });
}

/// Colours of cloth that dyers had: linear.
struct Cloth {
  const char* name;
  vec3 colour;
};
constexpr Cloth kDyes[] = {{"undyed wool", {0.36F, 0.31F, 0.23F}}, {"russet", {0.20F, 0.095F, 0.045F}},
                           {"grey", {0.17F, 0.165F, 0.15F}},       {"madder", {0.32F, 0.055F, 0.032F}},
                           {"woad", {0.050F, 0.095F, 0.19F}},      {"weld", {0.42F, 0.30F, 0.065F}},
                           {"green", {0.070F, 0.125F, 0.050F}},    {"walnut", {0.085F, 0.050F, 0.027F}},
                           {"light woad", {0.15F, 0.22F, 0.31F}},  {"pale madder", {0.42F, 0.19F, 0.13F}}};
constexpr vec3 kSkins[] = {{0.55F, 0.32F, 0.22F}, {0.47F, 0.26F, 0.17F}, {0.60F, 0.38F, 0.28F}, {0.36F, 0.19F, 0.11F}};
constexpr vec3 kHairs[] = {
    {0.035F, 0.018F, 0.010F}, {0.10F, 0.050F, 0.022F}, {0.27F, 0.16F, 0.065F}, {0.18F, 0.17F, 0.16F}};
constexpr vec3 kModernTops[] = {{0.55F, 0.55F, 0.54F}, {0.04F, 0.055F, 0.10F}, {0.35F, 0.045F, 0.045F},
                                {0.03F, 0.03F, 0.03F}, {0.20F, 0.30F, 0.42F},  {0.12F, 0.19F, 0.10F}};
constexpr vec3 kModernBottoms[] = {{0.035F, 0.055F, 0.11F}, {0.025F, 0.025F, 0.028F}, {0.26F, 0.21F, 0.14F}};

std::vector<Dress> dressesOf(const Figure& f, Period period, uint32_t seed) {
  constexpr size_t kDresses = 6;
  std::vector<Dress> out;
  for (uint32_t k = 0; k < kDresses; ++k) {
    city::Random random(city::hash32(seed, k));
    const auto pick = [&](const auto& list) { return list[random.below(static_cast<uint32_t>(std::size(list)))]; };
    Dress d;
    d[Skin] = pick(kSkins), d[Hair] = pick(kHairs);
    if (period == Period::Medieval) {
      d[Upper] = pick(kDyes).colour, d[Lower] = pick(kDyes).colour;
      d[Hat] = f.head == Headwear::Straw ? vec3(0.46F, 0.34F, 0.13F) : pick(kDyes).colour;
      d[Shoes] = vec3(0.060F, 0.036F, 0.020F) * static_cast<float>(random.uniform(0.6, 1.4));
      if (std::string_view(f.name) == "monk")
        d[Upper] = d[Hat] = k % 2 == 0 ? vec3(0.032F, 0.028F, 0.026F) : vec3(0.33F, 0.30F, 0.25F);
    } else {
      d[Upper] = pick(kModernTops), d[Lower] = pick(kModernBottoms), d[Hat] = pick(kModernTops);
      d[Shoes] = pick(kModernBottoms);
    }
    d[Linen] = vec3(0.60F, 0.57F, 0.49F) * static_cast<float>(random.uniform(0.8, 1.1));
    d[Carried] = vec3(0.22F, 0.13F, 0.055F);
    out.push_back(d);
  }
  return out;
}

city::Character makeCharacter(const Figure& f, Period period, uint32_t seed) {
  city::Character c;
  c.name = f.name;
  c.skeleton = townSkeleton();
  BodyBuilder body;
  addTrunk(body, f), addLimbs(body, f), addHead(body, f), addLoad(body, f);
  city::AvatarMesh mesh = body.finish();
  for (size_t role = 0; role < city::kRoles; ++role) c.clips[role] = makeClip(static_cast<city::Role>(role));
  if (f.load == Load::OnHead) c.clips[static_cast<size_t>(city::Role::Carry)] = makeClip(city::Role::Walk);
  c.carries = f.load != Load::None;
  if (f.load == Load::Basket)  // its hands are never free
    for (const city::Role role : {city::Role::Idle, city::Role::Talk}) {
      city::Pose arms;
      const city::Clip& carry = c.clips[static_cast<size_t>(city::Role::Carry)];
      avatars::samplePose(c.skeleton, carry, 0, arms);
      std::erase_if(c.clips[static_cast<size_t>(role)].tracks,
                    [](const city::Track& t) { return t.joint >= LeftUpperArm && t.joint < LeftUpperLeg; });
      for (uint32_t j = LeftUpperArm; j < LeftUpperLeg; ++j) {
        city::Track& t = c.clips[static_cast<size_t>(role)].tracks.emplace_back();
        t.joint = j, t.rotationTimes = {0}, t.rotations = {arms[j].rotation};
      }
    }

  // To its size; a child's head stays large.
  for (city::Joint& j : c.skeleton.joints) j.rest.translation *= f.size;
  for (city::AvatarVertex& v : mesh.vertices) {
    if (f.size < 0.8F && v.position.z > 1.5F) {
      const vec3 chin(0, 0, 1.5F);
      v.position = chin + 1.22F * (v.position - chin);
    }
    v.position *= f.size;
  }
  for (city::Clip& clip : c.clips) {
    clip.stride *= static_cast<double>(f.size);
    for (city::Track& t : clip.tracks)
      for (vec3& at : t.translations) at *= f.size;
  }
  for (const glm::mat4& m : avatars::characterFromJoints(c.skeleton, avatars::restPose(c.skeleton)))
    c.jointFromSkin.push_back(glm::inverse(m));
  c.levels = levelsOf(std::move(mesh));
  c.dresses = dressesOf(f, period, seed);
  c.bounds = avatars::boundsInClips(c);
  return c;
}

}  // namespace

const city::Skeleton& townSkeleton() {
  static const city::Skeleton skeleton = [] {
    city::Skeleton s;
    const auto add = [&](std::string name, uint32_t parent, vec3 at) {
      s.joints.push_back({std::move(name), parent, {glm::quat(1, 0, 0, 0), at, vec3(1)}});
    };
    add("Hips", city::kNone, {0, 0, 0.94F});
    add("Spine", 0, {0, 0, 0.12F});
    add("Chest", 1, {0, 0, 0.20F});
    add("Neck", 2, {-0.01F, 0, 0.22F});
    add("Head", 3, {0.012F, 0, 0.09F});
    for (const float side : {1.0F, -1.0F}) {
      const std::string word = side > 0 ? "Left" : "Right";
      const auto arm = static_cast<uint32_t>(s.joints.size());
      add(word + "UpperArm", 2, {-0.005F, side * 0.19F, 0.145F});
      add(word + "LowerArm", arm, {0.005F, side * 0.03F, -0.265F});
      add(word + "Hand", arm + 1, {0, -side * 0.007F, -0.25F});
    }
    for (const float side : {1.0F, -1.0F}) {
      const std::string word = side > 0 ? "Left" : "Right";
      const auto leg = static_cast<uint32_t>(s.joints.size());
      add(word + "UpperLeg", 0, {0, side * 0.09F, -0.03F});
      add(word + "LowerLeg", leg, {0, 0, -0.43F});
      add(word + "Foot", leg + 1, {0, 0, -0.40F});
      add(word + "Toe", leg + 2, {0.13F, 0, -0.05F});
    }
    return s;
  }();
  return skeleton;
}

std::vector<city::Character> makeTownspeople(Period period) {
  std::vector<city::Character> out;
  uint32_t seed = 77;
  const auto add = [&](std::span<const Figure> figures) {
    for (const Figure& f : figures) out.push_back(makeCharacter(f, period, seed++));
  };
  if (period == Period::Medieval)
    add(kMedieval);
  else
    add(kModern);
  return out;
}

}  // namespace vicus::assets::people
