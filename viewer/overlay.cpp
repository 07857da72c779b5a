#include "viewer/overlay.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "plan/techniques.hpp"

namespace vicus::viewer {
namespace {

constexpr size_t kFramesShown = 240, kFramesOfStages = 30;
constexpr float kPanelWidth = 410;
constexpr double kLogarithmicFrom = 50;  ///< knobs whose ends differ by this factor get a logarithmic slider

const ImVec4 kSoft(0.72F, 0.72F, 0.70F, 1), kGood(0.55F, 0.85F, 0.60F, 1), kWarm(0.96F, 0.78F, 0.38F, 1);

ImU32 stageColour(size_t k) {
  constexpr std::array<ImU32, 8> kColours{IM_COL32(31, 111, 159, 255), IM_COL32(200, 112, 42, 255),
                                          IM_COL32(60, 138, 99, 255),  IM_COL32(165, 80, 143, 255),
                                          IM_COL32(143, 47, 34, 255),  IM_COL32(122, 116, 32, 255),
                                          IM_COL32(76, 91, 156, 255),  IM_COL32(95, 106, 112, 255)};
  return kColours[k % kColours.size()];
}

/// Text of a length that is known, without a copy.
void say(std::string_view text, const ImVec4& colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopStyleColor();
}

void sayCount(const char* name, double value, const char* of = "", double whole = 0) {
  ImGui::TableNextColumn();
  say(name, kSoft);
  ImGui::TableNextColumn();
  if (whole > 0)
    ImGui::Text("%.0f %s %.0f", value, of, whole);
  else
    ImGui::Text("%.0f%s", value, of);
}

void counts(const OverlayFacts& f) {
  if (!ImGui::CollapsingHeader("Counts", ImGuiTreeNodeFlags_DefaultOpen)) return;
  if (!ImGui::BeginTable("counts", 4, ImGuiTableFlags_SizingStretchProp)) return;
  const city::PlanCounts& c = f.record.counts;
  const scenegraph::DrawCounts& d = f.record.draw;
  const auto number = [](auto value) { return static_cast<double>(value); };
  sayCount("buildings", number(c.instancesDrawn), "of", number(c.instances));
  sayCount("hidden", number(c.instancesOccluded));
  sayCount("tiles", number(c.tilesDrawn), "of", number(c.tiles));
  sayCount("trees", number(c.treesDrawn));
  sayCount("triangles", number(d.triangles));
  sayCount("of terrain", number(d.terrainTriangles));
  sayCount("draw calls", number(d.drawCalls));
  sayCount("binds", number(d.textureBinds));
  sayCount("box tests", number(c.boxTests));
  sayCount("GPU memory", number(f.gpuBytes) / 1e6, " MB");
  ImGui::EndTable();
}

/// The technique's bound on how wrong the last plan's picture may be, as it says itself.
void errorBound(const plan::Technique& technique, bool on, const city::FramePlan& plan) {
  if (!on)
    say("off: no error", kSoft);
  else if (technique.geometricErrorPixels != nullptr)
    ImGui::Text("at most %.2f pixels", technique.geometricErrorPixels(plan));
  else if (technique.visibility)
    say("0: leaves out only what is unseen", kGood);
  else
    say("0: same picture", kGood);
}

void techniques(const OverlayFacts& f, std::optional<KnobChange>& change) {
  if (!ImGui::CollapsingHeader("Techniques and their error now", ImGuiTreeNodeFlags_DefaultOpen)) return;
  if (!ImGui::BeginTable("techniques", 2, ImGuiTableFlags_SizingStretchProp)) return;
  for (const plan::Technique& t : plan::techniques()) {
    if (t.switchKnob.empty() || !f.knobs.has(t.switchKnob)) continue;
    bool on = f.knobs.on(t.switchKnob);
    ImGui::TableNextColumn();
    if (ImGui::Checkbox(std::string(t.name).c_str(), &on)) change = {std::string(t.switchKnob), on ? 1.0 : 0.0};
    ImGui::TableNextColumn();
    const auto feature = std::ranges::find(f.features, t.name, &plan::FeatureReport::name);
    if (on && feature != f.features.end() && !feature->on)
      say("off: " + feature->why, kSoft);
    else
      errorBound(t, on, f.plan);
  }
  ImGui::EndTable();
}

/// One knob as a switch or a slider; what it means when pointed at. Sliders count when they are let go.
void knob(const city::Knob& k, const city::Knobs& knobs, double& dragged, std::optional<KnobChange>& change) {
  const std::string name(k.name);
  const double value = knobs[k.name];
  ImGui::PushID(name.c_str());
  if (k.isSwitch()) {
    bool on = value != 0;
    if (ImGui::Checkbox(name.c_str(), &on)) change = {name, on ? 1.0 : 0.0};
  } else {
    auto shown = static_cast<float>(std::isnan(dragged) ? value : dragged);
    const bool wide = k.min > 0 && k.max / k.min >= kLogarithmicFrom;
    ImGui::SetNextItemWidth(150);
    ImGui::SliderFloat(name.c_str(), &shown, static_cast<float>(k.min), static_cast<float>(k.max), "%.4g",
                       ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : 0));
    if (ImGui::IsItemActive()) dragged = static_cast<double>(shown);
    if (ImGui::IsItemDeactivatedAfterEdit()) change = {name, static_cast<double>(shown)};
    if (ImGui::IsItemDeactivated()) dragged = std::nan("");
  }
  if (ImGui::IsItemHovered()) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(320);
    ImGui::TextWrapped("%.*s", static_cast<int>(k.meaning.size()), k.meaning.data());
    ImGui::TextWrapped("Too small: %.*s", static_cast<int>(k.tooSmall.size()), k.tooSmall.data());
    ImGui::TextWrapped("Too large: %.*s", static_cast<int>(k.tooLarge.size()), k.tooLarge.data());
    ImGui::TextWrapped("Default %g %.*s", k.value, static_cast<int>(k.unit.size()), k.unit.data());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
  ImGui::PopID();
}

}  // namespace

struct Overlay::Impl {
  ImGuiContext* context = nullptr;
  std::array<float, kFramesShown> frames{};  ///< ms, a ring
  size_t next = 0, known = 0;
  struct Stage {
    std::string name;
    std::array<float, kFramesOfStages> ms{};
  };
  std::vector<Stage> stages;
  std::vector<double> dragged;  ///< for each knob: where its slider is held; NaN: nowhere

  void frameTimes(const FrameRecord& record) {
    std::vector<double> values(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(known));
    const Percentiles p = percentiles(values);
    ImGui::Text("%.1f ms", record.milliseconds);
    ImGui::SameLine();
    ImGui::TextColored(kSoft, "median %.1f, 95 %% under %.1f, longest %.1f", p.median, p.p95, p.max);
    if (record.gpuMilliseconds) ImGui::TextColored(kSoft, "on the graphics card %.1f ms", *record.gpuMilliseconds);
    const auto top = static_cast<float>(std::max(1.25 * p.p95, 1.0));
    const int first = known < kFramesShown ? 0 : static_cast<int>(next);
    ImGui::PlotLines("##frames", frames.data(), static_cast<int>(known), first, nullptr, 0, top,
                     ImVec2(kPanelWidth - 24, 58));
  }

  void stageBars() {
    if (!ImGui::CollapsingHeader("Stages", ImGuiTreeNodeFlags_DefaultOpen)) return;
    double sum = 0;
    std::vector<double> means;
    const size_t count = std::min(known, kFramesOfStages);
    for (const Stage& stage : stages) {
      double total = 0;
      for (const float ms : stage.ms) total += static_cast<double>(ms);
      means.push_back(count > 0 ? total / static_cast<double>(count) : 0);
      sum += means.back();
    }
    const float line = ImGui::GetTextLineHeight();
    const float left = 140, room = kPanelWidth - left - 90;
    for (size_t k = 0; k < stages.size(); ++k) {
      if (means[k] < 0.002 * sum) continue;  // nothing to see
      say(stages[k].name, kSoft);
      ImGui::SameLine(left);
      const ImVec2 at = ImGui::GetCursorScreenPos();
      const float length = static_cast<float>(means[k] / std::max(sum, 1e-9)) * room;
      ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(at.x, at.y + 2),
                                                ImVec2(at.x + std::max(length, 1.0F), at.y + line - 1), stageColour(k));
      ImGui::SetCursorPosX(left + length + 6);
      ImGui::Text("%.2f ms", means[k]);
    }
  }
};

Overlay::Overlay() : impl_(std::make_unique<Impl>()) {
  Impl& s = *impl_;
  s.context = ImGui::CreateContext();
  ImGui::SetCurrentContext(s.context);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 4, style.FrameRounding = 3, style.WindowBorderSize = 0;
  style.Colors[ImGuiCol_WindowBg] = ImVec4(0.09F, 0.10F, 0.11F, 0.86F);
  style.Colors[ImGuiCol_PlotLines] = kWarm;
  ImGui_ImplOpenGL3_Init("#version 430");
}

Overlay::~Overlay() {
  ImGui::SetCurrentContext(impl_->context);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(impl_->context);
}

void Overlay::note(const FrameRecord& record) {
  Impl& s = *impl_;
  s.frames[s.next] = static_cast<float>(record.milliseconds);
  const size_t slot = s.next % kFramesOfStages;
  s.next = (s.next + 1) % kFramesShown;
  s.known = std::min(s.known + 1, kFramesShown);
  for (Impl::Stage& stage : s.stages) stage.ms[slot] = 0;
  for (const StageSample& sample : record.stages) {
    auto known = std::ranges::find(s.stages, sample.name, &Impl::Stage::name);
    if (known == s.stages.end()) known = s.stages.insert(s.stages.end(), {std::string(sample.name), {}});
    known->ms[slot] += static_cast<float>(sample.milliseconds);
  }
}

std::optional<KnobChange> Overlay::draw(glm::ivec2 size, double dt, const OverlayInput& input,
                                        const OverlayFacts& facts) {
  Impl& s = *impl_;
  ImGui::SetCurrentContext(s.context);
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(static_cast<float>(size.x), static_cast<float>(size.y));
  io.DeltaTime = static_cast<float>(dt > 0 && std::isfinite(dt) ? dt : 1.0 / 60);
  io.MousePos = ImVec2(static_cast<float>(input.pointer.x), static_cast<float>(input.pointer.y));
  io.MouseDown[0] = input.pressed;
  io.MouseWheel = static_cast<float>(input.wheel);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();

  std::optional<KnobChange> change;
  s.dragged.resize(facts.knobs.declared().size(), std::nan(""));
  ImGui::SetNextWindowPos(ImVec2(10, 10), ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize(ImVec2(kPanelWidth, io.DisplaySize.y - 20), ImGuiCond_FirstUseEver);
  ImGui::Begin("Vicus", nullptr, ImGuiWindowFlags_NoCollapse);
  say(facts.scene, kWarm);
  say(facts.renderer, kSoft);
  if (facts.frozen) {
    say("Frozen plan", kWarm);
    ImGui::TextColored(ImVec4(0.45F, 0.62F, 1, 1), "blue: outside the picture");
    ImGui::SameLine();
    ImGui::TextColored(ImVec4(1, 0.45F, 0.35F, 1), "red: hidden");
    ImGui::SameLine();
    ImGui::TextColored(kWarm, "yellow: its edges");
    ImGui::TextColored(ImVec4(1, 0.6F, 0.25F, 1), "orange: walls that hide");
    ImGui::SameLine();
    ImGui::TextColored(ImVec4(0.95F, 0.4F, 0.9F, 1), "magenta: the cull map");
  }
  s.frameTimes(facts.record);
  s.stageBars();
  counts(facts);
  techniques(facts, change);
  if (ImGui::CollapsingHeader("All knobs", ImGuiTreeNodeFlags_DefaultOpen)) {
    size_t index = 0;
    for (const city::Knob& k : facts.knobs.declared()) knob(k, facts.knobs, s.dragged[index++], change);
  }
  if (ImGui::CollapsingHeader("What the scene has, and why"))
    for (const plan::FeatureReport& f : facts.features) {
      say(f.name, f.on ? kGood : kSoft);
      ImGui::SameLine(140);
      ImGui::TextWrapped("%s, %s", f.on ? "on" : "off", f.why.c_str());
    }
  ImGui::End();

  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  return change;
}

}  // namespace vicus::viewer
