#include "viewer/pictures.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdlib>
#include "viewer/whole_file.hpp"

namespace vicus::viewer {

std::vector<uint8_t> pngBytes(const Picture& picture, std::string& error, PictureNotes notes) {
  const size_t needed =
      3 * static_cast<size_t>(std::max(picture.width, 0)) * static_cast<size_t>(std::max(picture.height, 0));
  if (needed == 0 || picture.rgb.size() != needed) {
    error = "the picture has " + std::to_string(picture.rgb.size()) + " bytes where " + std::to_string(picture.width) +
            " × " + std::to_string(picture.height) + " pixels need " + std::to_string(needed);
    return {};
  }
  const auto out = OIIO::ImageOutput::create("png");
  if (!out) {
    error = "this OpenImageIO writes no PNG";
    return {};
  }
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  // Tuned on town views: level 3 takes a third of the default's time and a tenth more space.
  spec.attribute("png:compressionLevel", 3);
  for (const auto& [name, text] : notes)  // OpenImageIO has names of its own for two of them
    spec.attribute(name == "Title" ? "DocumentName" : name == "Description" ? "ImageDescription" : name, text);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  if (out->set_ioproxy(&memory) && out->open("picture.png", spec) &&
      out->write_image(OIIO::TypeDesc::UINT8, picture.rgb.data()) && out->close())
    return bytes;
  error = out->geterror();
  return {};
}

std::string writePng(const std::filesystem::path& path, const Picture& picture, PictureNotes notes) {
  std::string problem;
  const std::vector<uint8_t> bytes = pngBytes(picture, problem, notes);
  if (!problem.empty()) return path.string() + ": not written, " + problem;
  return writeWhole(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
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
