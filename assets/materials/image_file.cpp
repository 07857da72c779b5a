#include "assets/materials/image_file.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>

namespace vicus::assets {
namespace {

/// A header that asks for more than this is taken for damage.
constexpr int64_t kMostTexels = int64_t{1} << 31;

Image grey() {
  Image image{8, 8, std::vector<uint8_t>(8 * 8 * 4, 128)};
  for (size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  return image;
}

double linearFromSrgb(double s) {
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

uint8_t srgbFromLinear(double linear) {
  const double v = std::clamp(linear, 0.0, 1.0);
  return static_cast<uint8_t>(std::lround((v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055) * 255));
}

const std::array<float, 256>& linearOfByte() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (size_t i = 0; i < t.size(); ++i) t[i] = static_cast<float>(linearFromSrgb(static_cast<double>(i) / 255));
    return t;
  }();
  return table;
}

/// OpenImageIO's words in one line.
std::string oneLine(std::string words) {
  while (!words.empty() && words.back() == '\n') words.pop_back();
  std::replace(words.begin(), words.end(), '\n', ' ');
  return words;
}

/// True where a JPEG lacks its end marker (FF D9) in its last 64 KiB. The library fills the rest of such a picture with
/// grey and says nothing. Compressed data never holds the marker.
bool jpegEndsEarly(const std::string& path) {
  constexpr std::streamoff kTail = 64 * 1024;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  if (size <= 0) return false;
  file.seekg(std::max(std::streamoff{0}, size - kTail));
  const std::string tail((std::istreambuf_iterator<char>(file)), {});
  return tail.find("\xff\xd9") == std::string::npos;
}

/// How a file's channels become red, green, blue and alpha.
struct Layout {
  size_t channels = 0;
  std::array<size_t, 3> colour{};
  int alpha = -1;  ///< channel, −1 for none
  bool premultiplied = false;
};

Layout layoutOf(const OIIO::ImageSpec& spec) {
  Layout layout;
  layout.channels = static_cast<size_t>(spec.nchannels);
  if (layout.channels >= 3) layout.colour = {0, 1, 2};
  layout.alpha = spec.alpha_channel;
  if (layout.alpha < 0 && layout.channels == 2) layout.alpha = 1;
  // Only alpha that the file declares can be multiplied in.
  layout.premultiplied = spec.alpha_channel >= 0 && spec.get_int_attribute("oiio:UnassociatedAlpha") == 0;
  return layout;
}

/// Reads rows `begin` up to `end` of channels as T; false where the file is damaged.
template <class T>
bool readRows(OIIO::ImageInput& file, const OIIO::ImageSpec& spec, int begin, int end, std::vector<T>& rows) {
  const OIIO::TypeDesc type = OIIO::BaseTypeFromC<T>::value;
  rows.resize(static_cast<size_t>(end - begin) * static_cast<size_t>(spec.width) * static_cast<size_t>(spec.nchannels));
  if (spec.tile_width == 0)
    return file.read_scanlines(0, 0, spec.y + begin, spec.y + end, spec.z, 0, spec.nchannels, type, rows.data());
  return file.read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + begin, spec.y + end, spec.z, spec.z + 1, 0,
                         spec.nchannels, type, rows.data());
}

/// Straight colour and alpha of one texel.
std::array<uint8_t, 4> texelOf(const uint8_t* in, const Layout& layout) {
  std::array<uint8_t, 4> out{in[layout.colour[0]], in[layout.colour[1]], in[layout.colour[2]], 255};
  if (layout.alpha < 0) return out;
  out[3] = in[layout.alpha];
  if (layout.premultiplied && out[3] != 0)
    for (size_t c = 0; c < 3; ++c) out[c] = static_cast<uint8_t>(std::min(255, (out[c] * 255 + out[3] / 2) / out[3]));
  return out;
}

std::array<uint8_t, 4> texelOf(const float* in, const Layout& layout) {
  const auto finite = [](float v) { return std::isfinite(v) ? static_cast<double>(v) : 0.0; };
  const double alpha = layout.alpha < 0 ? 1.0 : std::clamp(finite(in[layout.alpha]), 0.0, 1.0);
  const double scale = layout.premultiplied && alpha > 0 ? 1 / alpha : 1;
  std::array<uint8_t, 4> out{};
  for (size_t c = 0; c < 3; ++c) out[c] = srgbFromLinear(finite(in[layout.colour[c]]) * scale);
  out[3] = static_cast<uint8_t>(std::lround(alpha * 255));
  return out;
}

/// Reads the file strip by strip, so that a huge picture never lies in memory whole, and averages `factor` × `factor`
/// texels into one, weighted by alpha. Rows come from the top, the image starts at the bottom.
template <class T>
bool readReduced(OIIO::ImageInput& file, const OIIO::ImageSpec& spec, int factor, Image& image) {
  const Layout layout = layoutOf(spec);
  const auto width = static_cast<size_t>(spec.width);
  const int tile = std::max(1, spec.tile_height);
  const int strip = tile * std::max(1, 64 / tile);
  const std::array<float, 256>& linear = linearOfByte();
  struct Sum {
    std::array<float, 3> colour{};
    float weight = 0, alpha = 0, count = 0;
  };
  std::vector<Sum> sums(factor > 1 ? static_cast<size_t>(image.width) : 0);
  std::vector<T> rows;
  for (int begin = 0; begin < spec.height; begin += strip) {
    const int end = std::min(begin + strip, spec.height);
    if (!readRows(file, spec, begin, end, rows)) return false;
    for (int y = begin; y < end; ++y) {
      const T* in = rows.data() + static_cast<size_t>(y - begin) * width * layout.channels;
      const int row = y / factor;
      if (row >= image.height) return true;  // a rest narrower than one texel
      uint8_t* out =
          image.rgba.data() + 4 * static_cast<size_t>(image.height - 1 - row) * static_cast<size_t>(image.width);
      if (factor == 1) {
        for (size_t x = 0; x < width; ++x) {
          const std::array<uint8_t, 4> t = texelOf(in + x * layout.channels, layout);
          std::copy(t.begin(), t.end(), out + 4 * x);
        }
        continue;
      }
      for (size_t x = 0; x < std::min(width, sums.size() * static_cast<size_t>(factor)); ++x) {
        const std::array<uint8_t, 4> t = texelOf(in + x * layout.channels, layout);
        Sum& sum = sums[x / static_cast<size_t>(factor)];
        // Where all is transparent the colours still count a little, so that none is lost.
        const float weight = static_cast<float>(t[3]) + 1.0F / 256;
        for (size_t c = 0; c < 3; ++c) sum.colour[c] += weight * linear[t[c]];
        sum.weight += weight, sum.alpha += static_cast<float>(t[3]), sum.count += 1;
      }
      if (y % factor != factor - 1 && y + 1 != spec.height) continue;
      for (Sum& sum : sums) {
        for (size_t c = 0; c < 3; ++c) *out++ = srgbFromLinear(sum.colour[c] / sum.weight);
        *out++ = static_cast<uint8_t>(std::lround(sum.alpha / sum.count));
        sum = {};
      }
    }
  }
  return true;
}

}  // namespace

namespace {

/// "FILE#bytes=OFFSET+LENGTH" taken apart; nothing for an ordinary path.
struct Slice {
  std::string file;
  uint64_t offset = 0, length = 0;
};
std::optional<Slice> sliceOf(const std::string& path) {
  constexpr std::string_view kMark = "#bytes=";
  const size_t mark = path.rfind(kMark);
  if (mark == std::string::npos) return std::nullopt;
  Slice slice{path.substr(0, mark), 0, 0};
  const char *at = path.data() + mark + kMark.size(), *end = path.data() + path.size();
  const auto offset = std::from_chars(at, end, slice.offset);
  if (offset.ec != std::errc() || offset.ptr == end || *offset.ptr != '+') return std::nullopt;
  const auto length = std::from_chars(offset.ptr + 1, end, slice.length);
  if (length.ec != std::errc() || length.ptr != end) return std::nullopt;
  return slice;
}

/// The slice's bytes; fewer where the file has become shorter.
std::vector<char> bytesOf(const Slice& slice) {
  std::ifstream stream(slice.file, std::ios::binary | std::ios::ate);
  const auto size = static_cast<uint64_t>(std::max<std::streamoff>(stream.tellg(), 0));
  std::vector<char> bytes(slice.offset < size ? std::min(slice.length, size - slice.offset) : 0);
  stream.seekg(static_cast<std::streamoff>(slice.offset));
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

}  // namespace

Image readImageFile(const std::string& path, city::Diagnostics& diagnostics) {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  const std::optional<Slice> slice = sliceOf(path);
  const std::vector<char> bytes = slice ? bytesOf(*slice) : std::vector<char>();
  // Readers of bytes are found by a name's ending: PNG begins with a byte that no other format does.
  const char* kind = bytes.size() > 1 && bytes[0] == '\x89' ? "slice.png" : "slice.jpg";
  OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size());
  // PNG's reader takes the bytes from the hints alone where there are any.
  OIIO::Filesystem::IOProxy* reader = &memory;
  if (slice) hints.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &reader);
  const auto file = slice ? OIIO::ImageInput::open(kind, &hints, &memory) : OIIO::ImageInput::open(path, &hints);
  if (!file) {
    diagnostics.error(path, "", "the picture cannot be read; grey is shown: " + oneLine(OIIO::geterror()));
    return grey();
  }
  const OIIO::ImageSpec spec = file->spec();
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || int64_t{spec.width} * spec.height > kMostTexels) {
    diagnostics.error(path, "",
                      "the picture says it has " + std::to_string(spec.width) + " × " + std::to_string(spec.height) +
                          " texels; grey is shown");
    return grey();
  }
  const int factor = (std::max(spec.width, spec.height) + kLongestImageSide - 1) / kLongestImageSide;
  Image image{std::max(1, spec.width / factor), std::max(1, spec.height / factor), {}};
  image.rgba.resize(static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * 4);
  // Float formats hold linear light; integers are sRGB already.
  const bool read = spec.format.is_floating_point() ? readReduced<float>(*file, spec, factor, image)
                                                    : readReduced<uint8_t>(*file, spec, factor, image);
  if (!read) {
    diagnostics.error(path, "", "the picture is damaged; grey is shown: " + oneLine(file->geterror()));
    return grey();
  }
  if (!slice && file->format_name() == std::string_view("jpeg") && jpegEndsEarly(path))
    diagnostics.warn(path, "", "the picture ends early; what is missing of it is grey");
  return image;
}

}  // namespace vicus::assets
