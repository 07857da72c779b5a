#include "app/options.hpp"

#include <charconv>
#include <cmath>

#include "city/view_state.hpp"

namespace vicus::app {
namespace {

template <typename Number>
std::optional<Number> parseNumber(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<glm::ivec2> parseSize(std::string_view text) {
  constexpr int kLargest = 16384;
  constexpr std::string_view kTimes = "×";
  size_t at = text.find('x'), length = 1;
  if (at == std::string_view::npos) at = text.find(kTimes), length = kTimes.size();
  if (at == std::string_view::npos) return std::nullopt;
  const auto width = parseNumber<int>(text.substr(0, at)), height = parseNumber<int>(text.substr(at + length));
  if (!width || !height || *width < 1 || *height < 1 || *width > kLargest || *height > kLargest) return std::nullopt;
  return glm::ivec2(*width, *height);
}

std::optional<std::vector<double>> parseNumbers(std::string_view text, size_t least, size_t most) {
  std::vector<double> out;
  for (;;) {
    const size_t comma = text.find(',');
    const auto value = parseNumber<double>(text.substr(0, comma));
    if (!value || !std::isfinite(*value)) return std::nullopt;
    out.push_back(*value);
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
  }
  if (out.size() < least || out.size() > most) return std::nullopt;
  return out;
}

std::optional<ViewOption> parseView(std::string_view text, std::string& error) {
  const auto numbers = parseNumbers(text, 5, 6);
  if (!numbers) {
    error = "--view takes x,y,z,heading,pitch or x,y,z,heading,pitch,fov, not '" + std::string(text) + "'";
    return std::nullopt;
  }
  ViewOption view;
  view.eye = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  view.heading = glm::radians((*numbers)[3]), view.pitch = glm::radians((*numbers)[4]);
  if (numbers->size() > 5) view.fov = glm::radians((*numbers)[5]);
  if (view.fov && !(*view.fov >= city::kSmallestFov && *view.fov <= city::kLargestFov)) {
    error = "--view: the field of view goes from 0.06 to 179 degrees, not '" + std::string(text) + "'";
    return std::nullopt;
  }
  return view;
}

}  // namespace vicus::app
