#include "report/picture_bytes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace vicus::report {

viewer::Picture reduced(const viewer::Picture& picture, int width) {
  if (picture.width <= width || width < 1) return picture;
  const int factor = (picture.width + width - 1) / width;  // whole pixels, so that every one counts the same
  viewer::Picture out{picture.width / factor, std::max(1, picture.height / factor), {}};
  out.rgb.resize(static_cast<size_t>(out.width) * static_cast<size_t>(out.height) * 3);

  std::array<float, 256> linear;
  for (size_t i = 0; i < linear.size(); ++i) {
    const float s = static_cast<float>(i) / 255;
    linear[i] = s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F);
  }
  const int rows = std::min(factor, picture.height);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (size_t c = 0; c < 3; ++c) {
        float sum = 0;
        for (int dy = 0; dy < rows; ++dy)
          for (int dx = 0; dx < factor; ++dx)
            sum += linear[picture.rgb[3 * (static_cast<size_t>(y * factor + dy) * static_cast<size_t>(picture.width) +
                                           static_cast<size_t>(x * factor + dx)) +
                                      c]];
        const float mean = sum / static_cast<float>(rows * factor);
        const float s = mean <= 0.0031308F ? 12.92F * mean : 1.055F * std::pow(mean, 1 / 2.4F) - 0.055F;
        out.rgb[3 * (static_cast<size_t>(y) * static_cast<size_t>(out.width) + static_cast<size_t>(x)) + c] =
            static_cast<uint8_t>(std::lround(s * 255));
      }
  return out;
}

std::string base64(const std::vector<uint8_t>& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) group = group << 8U | (k < count ? bytes[i + k] : 0U);
    for (size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

}  // namespace vicus::report
