#include "assets/materials/image_file.hpp"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

namespace vicus::assets {
namespace {

Image grey() {
  return {8, 8, std::vector<uint8_t>(8 * 8 * 4, 128)};
}

/// Averages `factor` × `factor` texels into one, weighted by alpha; a rest at the far edges is left out.
Image reduced(const Image& in, int factor) {
  Image out{std::max(1, in.width / factor), std::max(1, in.height / factor), {}};
  out.rgba.resize(static_cast<size_t>(out.width) * static_cast<size_t>(out.height) * 4);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      uint64_t sum[3] = {}, alpha = 0, count = 0;
      for (int dy = 0; dy < factor && y * factor + dy < in.height; ++dy)
        for (int dx = 0; dx < factor && x * factor + dx < in.width; ++dx) {
          const uint8_t* t =
              in.rgba.data() + 4 * (static_cast<size_t>(y * factor + dy) * static_cast<size_t>(in.width) +
                                    static_cast<size_t>(x * factor + dx));
          for (int c = 0; c < 3; ++c) sum[c] += uint64_t{t[c]} * (t[3] + 1U);
          alpha += t[3];
          ++count;
        }
      uint8_t* o =
          out.rgba.data() + 4 * (static_cast<size_t>(y) * static_cast<size_t>(out.width) + static_cast<size_t>(x));
      for (int c = 0; c < 3; ++c) o[c] = static_cast<uint8_t>(sum[c] / (alpha + count));
      o[3] = static_cast<uint8_t>(alpha / count);
    }
  return out;
}

float encodeSrgb(float linear) {
  const float v = std::isfinite(linear) ? std::clamp(linear, 0.0F, 1.0F) : 0.0F;
  return v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1 / 2.4F) - 0.055F;
}

}  // namespace

Image readImageFile(const std::string& path, city::Diagnostics& diagnostics) {
  auto file = OIIO::ImageInput::open(path);
  if (!file) {
    diagnostics.error(path, "", "the picture cannot be read; grey is shown: " + OIIO::geterror());
    return grey();
  }
  const OIIO::ImageSpec& spec = file->spec();
  const auto width = static_cast<size_t>(spec.width), height = static_cast<size_t>(spec.height);
  const auto channels = static_cast<size_t>(spec.nchannels);
  if (width == 0 || height == 0 || channels == 0 || width * height > (size_t{1} << 28)) {
    diagnostics.error(
        path, "",
        "the picture has " + std::to_string(width) + " × " + std::to_string(height) + " texels; grey is shown");
    return grey();
  }
  // Float formats hold linear light; integer ones are taken as sRGB already.
  const bool linear = spec.format.is_floating_point();
  const bool cmyk = channels >= 4 && spec.get_string_attribute("jpeg:ColorSpace",
                                                               spec.get_string_attribute("tiff:ColorSpace")) == "CMYK";
  std::vector<uint8_t> bytes;
  std::vector<float> floats;
  bool read;
  if (linear) {
    floats.resize(width * height * channels);
    read = file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, floats.data());
  } else {
    bytes.resize(width * height * channels);
    read = file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, bytes.data());
  }
  if (!read) {
    diagnostics.error(path, "", "the picture is damaged; grey is shown: " + file->geterror());
    return grey();
  }
  Image image{spec.width, spec.height, std::vector<uint8_t>(width * height * 4)};
  const int alphaChannel =
      spec.alpha_channel >= 0 ? spec.alpha_channel : (channels == 2 ? 1 : (channels == 4 && !cmyk ? 3 : -1));
  for (size_t y = 0; y < height; ++y)
    for (size_t x = 0; x < width; ++x) {
      const size_t in = ((height - 1 - y) * width + x) * channels;
      uint8_t* out = image.rgba.data() + 4 * (y * width + x);
      const auto value = [&](size_t c, bool light) {
        if (!linear) return bytes[in + c];
        const float v = light ? encodeSrgb(floats[in + c]) : std::clamp(floats[in + c], 0.0F, 1.0F);
        return static_cast<uint8_t>(v * 255 + 0.5F);
      };
      if (cmyk) {
        for (size_t c = 0; c < 3; ++c)
          out[c] = static_cast<uint8_t>((255 - bytes[in + c]) * (255 - bytes[in + 3]) / 255);
        out[3] = 255;
        continue;
      }
      const bool colour = channels >= 3;
      for (size_t c = 0; c < 3; ++c) out[c] = value(colour ? c : 0, true);
      out[3] = alphaChannel >= 0 ? value(static_cast<size_t>(alphaChannel), false) : 255;
    }
  const int longest = std::max(image.width, image.height);
  if (longest > kLongestImageSide) return reduced(image, (longest + kLongestImageSide - 1) / kLongestImageSide);
  return image;
}

}  // namespace vicus::assets
