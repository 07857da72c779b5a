#include "viewer/pictures.hpp"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>

namespace vicus::viewer {
namespace {

/// Writes the whole file; an empty text or the reason.
std::string writeWhole(const std::filesystem::path& path, const Picture& picture) {
  // The format is named, since the name that is written first does not end in .png.
  const auto out = OIIO::ImageOutput::create("png");
  if (!out) return "this OpenImageIO writes no PNG";
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  // Tuned on town views: level 3 takes a third of the default's time and a tenth more space.
  spec.attribute("png:compressionLevel", 3);
  if (!out->open(path.string(), spec)) return out->geterror();
  if (!out->write_image(OIIO::TypeDesc::UINT8, picture.rgb.data())) return out->geterror();
  if (!out->close()) return out->geterror();
  return {};
}

}  // namespace

std::string writePng(const std::filesystem::path& path, const Picture& picture) {
  const std::string name = path.string();
  const size_t bytes =
      3 * static_cast<size_t>(std::max(picture.width, 0)) * static_cast<size_t>(std::max(picture.height, 0));
  if (bytes == 0 || picture.rgb.size() != bytes)
    return name + ": not written, the picture has " + std::to_string(picture.rgb.size()) + " bytes where " +
           std::to_string(picture.width) + " × " + std::to_string(picture.height) + " pixels need " +
           std::to_string(bytes);
  std::error_code failed;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), failed);
  if (failed) return name + ": the folder cannot be made: " + failed.message();

  std::filesystem::path beside = path;
  beside += ".part";
  std::string problem = writeWhole(beside, picture);
  if (problem.empty()) {
    std::filesystem::rename(beside, path, failed);
    if (failed) problem = failed.message();
  }
  if (problem.empty()) return {};
  std::filesystem::remove(beside, failed);
  return name + ": cannot be written: " + problem;
}

std::optional<Picture> readPicture(const std::filesystem::path& path, std::string& error) {
  const auto in = OIIO::ImageInput::open(path.string());
  if (!in) {
    error = path.string() + ": cannot be read: " + OIIO::geterror();
    return std::nullopt;
  }
  const OIIO::ImageSpec& spec = in->spec();
  const int channels = spec.nchannels;
  const size_t pixels = static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height);
  std::vector<uint8_t> all(pixels * static_cast<size_t>(channels));
  if (!in->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, all.data())) {
    error = path.string() + ": cannot be read: " + in->geterror();
    return std::nullopt;
  }
  Picture out;
  out.width = spec.width, out.height = spec.height;
  out.rgb.resize(pixels * 3);
  for (size_t p = 0; p < pixels; ++p)
    for (size_t c = 0; c < 3; ++c)  // one channel is grey: used for all three
      out.rgb[3 * p + c] = all[p * static_cast<size_t>(channels) + (channels >= 3 ? c : 0)];
  return out;
}

PictureDifference compare(const Picture& a, const Picture& b, int tolerance) {
  PictureDifference out;
  if (a.width != b.width || a.height != b.height || a.rgb.size() != b.rgb.size()) {
    out.largest = 255, out.share = 1;
    out.differingPixels = std::max(a.rgb.size(), b.rgb.size()) / 3;
    return out;
  }
  const size_t pixels = a.rgb.size() / 3;
  for (size_t p = 0; p < pixels; ++p) {
    int largest = 0;
    for (size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a.rgb[3 * p + c] - b.rgb[3 * p + c]));
    out.largest = std::max(out.largest, largest);
    if (largest > tolerance) ++out.differingPixels;
  }
  if (pixels > 0) out.share = static_cast<double>(out.differingPixels) / static_cast<double>(pixels);
  return out;
}

}  // namespace vicus::viewer
