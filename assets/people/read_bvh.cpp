#include "assets/people/read_bvh.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include "avatars/pose.hpp"

namespace vicus::assets::people {
namespace {

using glm::dquat;
using glm::dvec3;

constexpr size_t kMostJoints = 1000;
constexpr size_t kMostDepth = 200;

/// Words of a file with the lines that they stand in.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// The next word; empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && isSpace(text_[at_])) line_ += text_[at_++] == '\n';
    const size_t begin = at_;
    while (at_ < text_.size() && !isSpace(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  /// What is left of the line, without spaces about it.
  std::string_view restOfLine() {
    size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view rest = text_.substr(at_, end - at_);
    at_ = end;
    while (!rest.empty() && isSpace(rest.front())) rest.remove_prefix(1);
    while (!rest.empty() && isSpace(rest.back())) rest.remove_suffix(1);
    return rest;
  }
  std::string place() const { return "line " + std::to_string(line_); }

 private:
  static bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  std::string_view text_;
  size_t at_ = 0, line_ = 1;
};

std::optional<double> numberOf(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

enum class Channel : uint8_t { XPosition, YPosition, ZPosition, XRotation, YRotation, ZRotation };

std::optional<Channel> channelOf(std::string_view word) {
  constexpr std::string_view kNames[] = {"xposition", "yposition", "zposition", "xrotation", "yrotation", "zrotation"};
  std::string lower(word);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  for (size_t k = 0; k < std::size(kNames); ++k)
    if (lower == kNames[k]) return static_cast<Channel>(k);
  return std::nullopt;
}

struct FileJoint {
  std::string name;
  uint32_t parent = city::kNone;
  dvec3 offset{0};
  std::vector<Channel> channels;
};

/// The hierarchy in the file's own frame; false, with an error, where it is broken.
class Hierarchy {
 public:
  Hierarchy(Words& words, const std::string& file, city::Diagnostics& diagnostics)
      : words_(words), file_(file), diagnostics_(diagnostics) {}

  bool read() {
    if (words_.next() != "HIERARCHY") return fail("a BVH file begins with HIERARCHY");
    std::string_view word = words_.next();
    while (word == "ROOT") {
      if (!readTree()) return false;
      word = words_.next();
    }
    if (joints.empty()) return fail("HIERARCHY is followed by ROOT");
    if (word != "MOTION") return fail("expected MOTION, found '" + std::string(word.substr(0, 40)) + "'");
    return true;
  }

  std::vector<FileJoint> joints;

 private:
  bool fail(const std::string& message) {
    diagnostics_.error(file_, words_.place(), message);
    return false;
  }

  bool begin(std::string name, uint32_t parent) {
    if (joints.size() >= kMostJoints) return fail("more than " + std::to_string(kMostJoints) + " joints");
    // The brace may stand in the name's own line.
    const bool open = name.ends_with('{');
    if (open) name.pop_back();
    while (name.ends_with(' ') || name.ends_with('\t')) name.pop_back();
    if (!open && words_.next() != "{") return fail("expected { after the name of " + name);
    joints.push_back({std::move(name), parent, {}, {}});
    return true;
  }

  bool readOffset() {
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = words_.next();
      const auto value = numberOf(word);
      if (!value) return fail("OFFSET takes three numbers, found '" + std::string(word.substr(0, 40)) + "'");
      joints[open_.back()].offset[k] = *value;
    }
    return true;
  }

  bool readChannels() {
    const auto count = numberOf(words_.next());
    if (!count || *count < 0 || *count > 6 || *count != std::floor(*count))
      return fail("CHANNELS is followed by their number, 0 to 6");
    for (int k = 0; k < static_cast<int>(*count); ++k) {
      const std::string_view word = words_.next();
      const auto channel = channelOf(word);
      if (!channel) return fail("'" + std::string(word.substr(0, 40)) + "' is no channel");
      joints[open_.back()].channels.push_back(*channel);
    }
    return true;
  }

  bool readTree() {
    if (!begin(std::string(words_.restOfLine()), city::kNone)) return false;
    open_ = {static_cast<uint32_t>(joints.size() - 1)};
    while (!open_.empty()) {
      const std::string_view word = words_.next();
      if (word == "}") {
        open_.pop_back();
      } else if (word == "OFFSET") {
        if (!readOffset()) return false;
      } else if (word == "CHANNELS") {
        if (!readChannels()) return false;
      } else if (word == "JOINT" || word == "End") {
        std::string name(words_.restOfLine());
        if (word == "End") name = "EndSite_" + joints[open_.back()].name + (name.ends_with('{') ? "{" : "");
        if (open_.size() >= kMostDepth) return fail("joints nested too deep");
        if (!begin(std::move(name), open_.back())) return false;
        open_.push_back(static_cast<uint32_t>(joints.size() - 1));
      } else if (word.empty()) {
        return fail("the file ends within the hierarchy");
      } else {
        return fail("expected OFFSET, CHANNELS, JOINT, End or }, found '" + std::string(word.substr(0, 40)) + "'");
      }
    }
    return true;
  }

  Words& words_;
  const std::string& file_;
  city::Diagnostics& diagnostics_;
  std::vector<uint32_t> open_;
};

/// From the file's axes to ours.
struct Axes {
  bool zUp = false;
  dvec3 operator()(const dvec3& v) const { return zUp ? dvec3(-v.y, v.x, v.z) : dvec3(v.z, v.x, v.y); }
  dquat operator()(const dquat& q) const {
    const dvec3 v = (*this)(dvec3(q.x, q.y, q.z));
    return {q.w, v.x, v.y, v.z};
  }
};

/// The unit in which a skeleton of that extent is nearest to a person's height.
double unitFor(double extent) {
  constexpr double kUnits[] = {1, 0.3048, 0.0254, 0.01, 0.001, 0.0254 / 0.45};
  double best = 1, least = 1e300;
  for (const double unit : kUnits) {
    const double off = std::abs(std::log(extent * unit / 1.7));
    if (off < least) least = off, best = unit;
  }
  return best;
}

dquat turned(Channel channel, double degrees) {
  dvec3 axis(0);
  axis[static_cast<int>(channel) - static_cast<int>(Channel::XRotation)] = 1;
  return glm::angleAxis(glm::radians(degrees), axis);
}

}  // namespace

std::optional<Motion> parseBvh(std::string_view text, const std::string& file, const BvhOptions& options,
                               city::Diagnostics& diagnostics) {
  Words words(text);
  Hierarchy hierarchy(words, file, diagnostics);
  if (!hierarchy.read()) return std::nullopt;
  const std::vector<FileJoint>& joints = hierarchy.joints;

  // The frames' head.
  const auto fail = [&](const char* message) {
    diagnostics.error(file, words.place(), message);
    return std::nullopt;
  };
  if (words.next() != "Frames:") return fail("MOTION is followed by 'Frames:' and their number");
  const auto frames = numberOf(words.next());
  if (!frames || *frames < 0 || *frames != std::floor(*frames)) return fail("the number of frames is a whole number");
  if (words.next() != "Frame" || words.next() != "Time:") return fail("expected 'Frame Time:' and seconds");
  const auto time = numberOf(words.next());
  if (!time) return fail("'Frame Time:' is followed by seconds");
  Motion out;
  out.frameTime = *time;
  if (!(*time > 0)) {
    out.frameTime = 1.0 / 30;
    diagnostics.warn(file, words.place(), "a frame time that is not positive counts as 1/30 s");
  }

  // Axes and unit from the skeleton at rest.
  std::vector<dvec3> rest;
  dvec3 low(0), high(0);
  for (const FileJoint& j : joints) {
    rest.push_back(j.offset + (j.parent == city::kNone ? dvec3(0) : rest[j.parent]));
    low = glm::min(low, rest.back() - rest[0]), high = glm::max(high, rest.back() - rest[0]);
  }
  const dvec3 extent = high - low;
  Axes axes;
  axes.zUp = extent.z > 1.5 * extent.y;
  const double height = axes.zUp ? extent.z : extent.y;
  out.metresPerUnit = options.metresPerUnit > 0 ? options.metresPerUnit : height > 0 ? unitFor(height) : 1;
  for (const FileJoint& j : joints)
    out.skeleton.joints.push_back(
        {j.name, j.parent, {glm::quat(1, 0, 0, 0), glm::vec3(axes(j.offset) * out.metresPerUnit), glm::vec3(1)}});
  if (glm::length(joints[0].offset) == 0)  // it stands on the ground at rest
    out.skeleton.joints[0].rest.translation.z = static_cast<float>(-(axes.zUp ? low.z : low.y) * out.metresPerUnit);

  // The frames: a track for each joint that has channels.
  std::vector<uint32_t> trackOf(joints.size(), city::kNone);
  for (uint32_t j = 0; j < joints.size(); ++j) {
    if (joints[j].channels.empty()) continue;
    trackOf[j] = static_cast<uint32_t>(out.clip.tracks.size());
    out.clip.tracks.emplace_back().joint = j;
  }
  size_t read = 0;
  for (bool whole = true; whole && read < static_cast<size_t>(*frames); read += whole) {
    std::vector<city::JointTransform> frame(joints.size());
    std::vector<uint8_t> moves(joints.size(), 0);
    for (size_t j = 0; j < joints.size() && whole; ++j) {
      dvec3 position = joints[j].offset;
      dquat rotation(1, 0, 0, 0);
      for (const Channel channel : joints[j].channels) {
        const std::string_view word = words.next();
        const auto value = numberOf(word);
        if (!value) {
          diagnostics.warn(file, words.place(),
                           "frame " + std::to_string(read) + " of " + std::to_string(static_cast<size_t>(*frames)) +
                               (word.empty() ? " is missing" : " holds what is no number") +
                               ": the motion ends before it");
          whole = false;
          break;
        }
        if (channel <= Channel::ZPosition)
          position[static_cast<int>(channel)] = *value, moves[j] = 1;
        else
          rotation = rotation * turned(channel, *value);
      }
      frame[j].rotation = glm::quat(axes(rotation));
      frame[j].translation = glm::vec3(axes(position) * out.metresPerUnit);
    }
    if (!whole) break;
    const auto at = static_cast<float>(static_cast<double>(read) * out.frameTime);
    for (uint32_t j = 0; j < joints.size(); ++j) {
      if (trackOf[j] == city::kNone) continue;
      city::Track& track = out.clip.tracks[trackOf[j]];
      track.rotationTimes.push_back(at), track.rotations.push_back(frame[j].rotation);
      if (moves[j]) track.translationTimes.push_back(at), track.translations.push_back(frame[j].translation);
    }
  }
  if (read == 0) return fail("there is no whole frame");
  out.clip.name = file.substr(file.find_last_of('/') + 1);
  out.clip.duration = static_cast<double>(read - 1) * out.frameTime;
  out.clip.loops = false;
  return out;
}

std::optional<Motion> readBvh(const std::string& file, const BvhOptions& options, city::Diagnostics& diagnostics) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  if (!stream) {
    diagnostics.error(file, "", "cannot be read");
    return std::nullopt;
  }
  return parseBvh(std::move(text).str(), file, options, diagnostics);
}

}  // namespace vicus::assets::people
