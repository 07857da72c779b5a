#include "assets/materials/image_file.hpp"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "city/random.hpp"

namespace vicus::assets {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A folder for one test's files, removed with it.
class MaterialsImageFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("vicus-image-file-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) +
               "-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Writes values (row 0 at the top) of the type that T is; `change` may set attributes.
  template <class T>
  std::string write(const std::string& name, int width, int height, int channels, const std::vector<T>& values,
                    const std::function<void(OIIO::ImageSpec&)>& change = {}) {
    OIIO::ImageSpec spec(width, height, channels, OIIO::BaseTypeFromC<T>::value);
    if (change) change(spec);
    const auto out = OIIO::ImageOutput::create(path(name));
    EXPECT_TRUE(out && out->open(path(name), spec)) << OIIO::geterror();
    EXPECT_TRUE(out->write_image(spec.format, values.data())) << out->geterror();
    out->close();
    return path(name);
  }

  Image read(const std::string& file) {
    diagnostics_ = {};
    return readImageFile(file, diagnostics_);
  }

  void expectGreyAndError(const Image& image, const std::string& file, const std::string& message) {
    ASSERT_EQ(diagnostics_.messages.size(), 1U) << file;
    EXPECT_EQ(diagnostics_.messages[0].severity, city::Severity::Error);
    EXPECT_THAT(describe(diagnostics_.messages[0]), testing::StartsWith(file + ": "));
    EXPECT_THAT(diagnostics_.messages[0].message, HasSubstr(message));
    EXPECT_THAT(diagnostics_.messages[0].message, HasSubstr("grey is shown"));
    ASSERT_EQ(image.rgba.size(), static_cast<size_t>(image.width * image.height * 4));
    ASSERT_GT(image.width, 0);
    for (size_t i = 0; i < image.rgba.size(); ++i) EXPECT_EQ(image.rgba[i], i % 4 == 3 ? 255 : 128);
  }

  city::Diagnostics diagnostics_;
  fs::path folder_;
};

fs::path sharedData() {
  const char* folder = std::getenv("VICUS_DATA");
  return folder ? fs::path(folder) : fs::path("../shared/data");
}

TEST_F(MaterialsImageFile, RowZeroIsTheBottom) {
  const Image image = read(write<uint8_t>("a.png", 1, 2, 3, {255, 0, 0, 0, 0, 255}));
  EXPECT_TRUE(diagnostics_.messages.empty());
  EXPECT_THAT(image.rgba, testing::ElementsAre(0, 0, 255, 255, 255, 0, 0, 255));
}

TEST_F(MaterialsImageFile, GreyBecomesThreeEqualChannels) {
  EXPECT_THAT(read(write<uint8_t>("a.png", 1, 1, 1, {77})).rgba, testing::ElementsAre(77, 77, 77, 255));
}

TEST_F(MaterialsImageFile, GreyWithAlphaKeepsIt) {
  const auto straight = [](OIIO::ImageSpec& spec) {
    spec.alpha_channel = 1;
    spec.attribute("oiio:UnassociatedAlpha", 1);
  };
  EXPECT_THAT(read(write<uint8_t>("a.png", 1, 1, 2, {77, 40}, straight)).rgba, testing::ElementsAre(77, 77, 77, 40));
}

TEST_F(MaterialsImageFile, AlphaStaysStraight) {
  const auto straight = [](OIIO::ImageSpec& spec) {
    spec.alpha_channel = 3;
    spec.attribute("oiio:UnassociatedAlpha", 1);
  };
  EXPECT_THAT(read(write<uint8_t>("a.png", 2, 1, 4, {200, 100, 50, 128, 90, 80, 70, 0}, straight)).rgba,
              testing::ElementsAre(200, 100, 50, 128, 90, 80, 70, 0));
}

TEST_F(MaterialsImageFile, MultipliedAlphaIsDividedOut) {
  const auto multiplied = [](OIIO::ImageSpec& spec) { spec.alpha_channel = 3; };
  const Image image = read(write<float>("a.exr", 1, 1, 4, {0.25F, 0.1F, 0.0F, 0.5F}, multiplied));
  // 0.25 / 0.5 = 0.5 linear is 188 in sRGB, 0.2 is 124.
  EXPECT_THAT(image.rgba, testing::ElementsAre(188, 124, 0, 128));
}

TEST_F(MaterialsImageFile, SixteenBitsAreCutToEight) {
  EXPECT_THAT(read(write<uint16_t>("a.png", 1, 1, 3, {65535, 32896, 0})).rgba, testing::ElementsAre(255, 128, 0, 255));
}

TEST_F(MaterialsImageFile, FloatIsLinearLight) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  EXPECT_THAT(read(write<float>("a.exr", 2, 1, 3, {0.5F, 2.0F, -1.0F, nan, inf, 1.0F})).rgba,
              testing::ElementsAre(188, 255, 0, 255, 0, 0, 255, 255));
}

TEST_F(MaterialsImageFile, MoreThanFourChannelsLoseTheRest) {
  const auto extra = [](OIIO::ImageSpec& spec) {
    spec.alpha_channel = -1;
    spec.channelnames = {"R", "G", "B", "near infrared", "height"};
  };
  EXPECT_THAT(read(write<uint8_t>("a.tif", 1, 1, 5, {10, 20, 30, 40, 50}, extra)).rgba,
              testing::ElementsAre(10, 20, 30, 255));
}

TEST_F(MaterialsImageFile, TiledFilesReadAsOthersDo) {
  std::vector<uint8_t> values;
  for (int i = 0; i < 100 * 70 * 3; ++i) values.push_back(static_cast<uint8_t>(i * 7 + i / 300));
  const Image plain = read(write<uint8_t>("plain.tif", 100, 70, 3, values));
  const Image tiled = read(write<uint8_t>("tiled.tif", 100, 70, 3, values,
                                          [](OIIO::ImageSpec& spec) { spec.tile_width = spec.tile_height = 32; }));
  EXPECT_TRUE(diagnostics_.messages.empty());
  EXPECT_EQ(plain.width, 100);
  EXPECT_EQ(plain.rgba, tiled.rgba);
}

TEST_F(MaterialsImageFile, LargePicturesAreAveragedInLinearLight) {
  // Columns black and white by turns: half the light is 188, not 128.
  const int width = 4096, height = 6;
  std::vector<uint8_t> values;
  for (int i = 0; i < width * height; ++i) values.insert(values.end(), 3, i % 2 ? 255 : 0);
  const Image image = read(write<uint8_t>("a.png", width, height, 3, values));
  EXPECT_EQ(image.width, 2048);
  EXPECT_EQ(image.height, 3);
  for (size_t i = 0; i < image.rgba.size(); ++i) EXPECT_EQ(image.rgba[i], i % 4 == 3 ? 255 : 188);
}

TEST_F(MaterialsImageFile, LongThinPicturesKeepATexel) {
  for (const auto& [width, height] : {std::pair(1, 9000), std::pair(9000, 1), std::pair(9001, 3)}) {
    const Image image =
        read(write<uint8_t>("a.png", width, height, 1, std::vector<uint8_t>(static_cast<size_t>(width * height), 60)));
    EXPECT_TRUE(diagnostics_.messages.empty());
    EXPECT_LE(std::max(image.width, image.height), kLongestImageSide);
    EXPECT_GE(std::min(image.width, image.height), 1);
    for (size_t i = 0; i < image.rgba.size(); i += 4) EXPECT_EQ(image.rgba[i], 60);
  }
}

TEST_F(MaterialsImageFile, TransparentColoursDoNotDarkenTheReducedEdge) {
  const int width = 4096;
  std::vector<uint8_t> values;
  for (int i = 0; i < width * 2; ++i)
    for (const int v : i % 2 ? std::array{0, 0, 0, 0} : std::array{200, 150, 100, 255})
      values.push_back(static_cast<uint8_t>(v));
  const Image image = read(write<uint8_t>("a.png", width, 2, 4, values, [](OIIO::ImageSpec& spec) {
    spec.alpha_channel = 3;
    spec.attribute("oiio:UnassociatedAlpha", 1);
  }));
  EXPECT_THAT(std::vector<int>(image.rgba.begin(), image.rgba.begin() + 4), testing::ElementsAre(200, 150, 100, 128));
}

TEST_F(MaterialsImageFile, MissingFileIsNamed) {
  const Image image = read(path("not-there.png"));
  expectGreyAndError(image, path("not-there.png"), "cannot be read");
}

TEST_F(MaterialsImageFile, ManyMissingFilesAreNamedInOrder) {
  std::vector<city::Material> materials(20);
  for (size_t i = 0; i < materials.size(); ++i) materials[i].source = path("no-such-" + std::to_string(i) + ".png");
  EXPECT_EQ(materialImages(materials, diagnostics_).size(), 20U);
  ASSERT_EQ(diagnostics_.messages.size(), 20U);
  for (size_t i = 0; i < 20; ++i) EXPECT_EQ(diagnostics_.messages[i].file, materials[i].source);
}

TEST_F(MaterialsImageFile, EmptyPathFolderEmptyFileAndTextAreErrors) {
  expectGreyAndError(read(""), "", "cannot be read");
  expectGreyAndError(read(folder_.string()), folder_.string(), "cannot be read");
  std::ofstream(path("empty.png"));
  expectGreyAndError(read(path("empty.png")), path("empty.png"), "");
  std::ofstream(path("text.jpg")) << "this is not a picture";
  expectGreyAndError(read(path("text.jpg")), path("text.jpg"), "");
}

TEST_F(MaterialsImageFile, AbsurdHeaderIsRefusedWithoutTakingTheMemory) {
  // A valid 1 × 1 Targa header made to say 65 535 × 65 535.
  const std::vector<uint8_t> header{0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 24, 0, 1, 2, 3};
  std::ofstream(path("huge.tga"), std::ios::binary)
      .write(reinterpret_cast<const char*>(header.data()), static_cast<std::streamsize>(header.size()));
  expectGreyAndError(read(path("huge.tga")), path("huge.tga"), "");
}

TEST_F(MaterialsImageFile, TruncatedRealPicturesAreErrors) {
  const fs::path real = sharedData() / "textures/surfaces/cobblestone_diffuse.png";
  if (!fs::exists(real)) GTEST_SKIP() << "no test pictures at " << real;
  std::ifstream in(real, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  for (const double share : {0.0005, 0.05, 0.5, 0.95}) {
    const std::string file = path("cut-" + std::to_string(share) + ".png");
    std::ofstream(file, std::ios::binary)
        << bytes.substr(0, static_cast<size_t>(static_cast<double>(bytes.size()) * share));
    expectGreyAndError(read(file), file, "");
  }
}

TEST_F(MaterialsImageFile, AJpegThatEndsEarlyKeepsItsTopAndSaysSo) {
  std::vector<uint8_t> values;
  for (int i = 0; i < 256 * 256 * 3; ++i)
    values.push_back(static_cast<uint8_t>(city::hash32(static_cast<uint32_t>(i)) >> 24));
  const Image whole = read(write<uint8_t>("whole.jpg", 256, 256, 3, values));
  EXPECT_TRUE(diagnostics_.messages.empty());
  std::ifstream in(path("whole.jpg"), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  std::ofstream(path("cut.jpg"), std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  const Image cut = read(path("cut.jpg"));
  ASSERT_EQ(diagnostics_.messages.size(), 1U);
  EXPECT_EQ(describe(diagnostics_.messages[0]),
            path("cut.jpg") + ": the picture ends early; what is missing of it is grey");
  EXPECT_FALSE(diagnostics_.hasErrors());
  const std::ptrdiff_t row = 256 * 4;
  EXPECT_TRUE(std::equal(cut.rgba.end() - 64 * row, cut.rgba.end(), whole.rgba.end() - 64 * row));
}

TEST_F(MaterialsImageFile, MessagesAreOneLine) {
  std::ofstream(path("empty.png"));
  read(path("empty.png"));
  ASSERT_EQ(diagnostics_.messages.size(), 1U);
  EXPECT_THAT(diagnostics_.messages[0].message, testing::Not(HasSubstr("\n")));
}

TEST_F(MaterialsImageFile, RealPicturesRead) {
  const fs::path folder = sharedData() / "textures";
  if (!fs::exists(folder)) GTEST_SKIP() << "no test pictures at " << folder;
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".png" || entry.path().stem().string().find("diffuse") == std::string::npos)
      continue;
    const Image image = read(entry.path().string());
    EXPECT_TRUE(diagnostics_.messages.empty()) << entry.path();
    EXPECT_GE(image.width, 64) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 8);
}

TEST_F(MaterialsImageFile, MalformedPicturesNeverCrash) {
  const fs::path folder = sharedData() / "malformed";
  if (!fs::exists(folder)) GTEST_SKIP() << "no malformed files at " << folder;
  for (const char* broken : {"gltf_validator/test/base/data/image/invalid_image_data.jpg",
                             "gltf_validator/test/base/data/image/unrecognized_format.png",
                             "gltf_validator/test/base/data/image/png_eos.png", "rasterio/corrupt.tif"}) {
    const Image image = read((folder / broken).string());
    EXPECT_TRUE(diagnostics_.hasErrors()) << broken;
    EXPECT_FALSE(image.rgba.empty()) << broken;
  }
  read((folder / "rasterio/float_nan.tif").string());
  EXPECT_FALSE(diagnostics_.hasErrors());
}

}  // namespace
}  // namespace vicus::assets
