#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "assets/cache/blob_cache.hpp"
#include "assets/cache/hash.hpp"
#include "city/random.hpp"
#include "import_files.hpp"

namespace vicus::assets {
namespace {

using testing::HasSubstr;

/// Half of it can be packed.
std::string content(size_t size, char seed) {
  city::Random random(5);
  std::string out(1, seed);
  while (out.size() < size) out.push_back(static_cast<char>(random.below(16)));
  return out;
}

TEST(BlobCache, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "deep" / "er" / "scene.sqlite";
  city::Diagnostics d;
  const std::string large = content(3'000'000, 1);
  {
    BlobCache cache(file, d);
    EXPECT_FALSE(cache.read("city", "11", "v1"));
    cache.write("city", "11", "v1", large);
    cache.write("blockmap", "22", "v1", "");
    EXPECT_EQ(cache.read("city", "11", "v1"), large);
  }
  BlobCache again(file, d);
  EXPECT_EQ(again.read("city", "11", "v1"), large);
  EXPECT_EQ(again.read("blockmap", "22", "v1"), "");
  EXPECT_TRUE(d.messages.empty()) << messagesOf(d);
}

TEST(BlobCache, OtherDataOrAnotherVersionIsMadeAnewWithAWarning) {
  const TemporaryFolder folder;
  city::Diagnostics d;
  BlobCache cache(folder.path() / "scene.sqlite", d);
  cache.write("city", "11", "v1", "old");
  EXPECT_FALSE(cache.read("city", "12", "v1"));
  EXPECT_FALSE(cache.read("city", "11", "v2"));
  ASSERT_EQ(d.messages.size(), 2u);
  EXPECT_THAT(d.messages[0].message, HasSubstr("from other data or by another version"));
  EXPECT_EQ(d.messages[0].severity, city::Severity::Warning);
  // The newer one takes its place.
  cache.write("city", "12", "v1", "new");
  EXPECT_EQ(cache.read("city", "12", "v1"), "new");
  EXPECT_FALSE(cache.read("city", "11", "v1"));
}

TEST(BlobCache, AFileThatIsNoCacheIsReplaced) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("scene.sqlite", "this is no database, whatever its name says " + content(5000, 2));
  city::Diagnostics d;
  BlobCache cache(file, d);
  EXPECT_FALSE(cache.read("city", "11", "v1"));
  cache.write("city", "11", "v1", "good");
  EXPECT_EQ(cache.read("city", "11", "v1"), "good");
  EXPECT_THAT(messagesOf(d), HasSubstr("the cache is damaged"));
}

/// Bytes flipped anywhere in the file: either the right bytes or none, never wrong ones.
TEST(BlobCache, DamageIsNoticed) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "scene.sqlite";
  const std::string good = content(200'000, 3);
  city::Diagnostics ignored;
  { BlobCache(file, ignored).write("city", "11", "v1", good); }
  std::ifstream stream(file, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  int noticed = 0;
  for (size_t at = 50; at < whole.size(); at += whole.size() / 40) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    const std::string copy = folder.write("damaged.sqlite", damaged);
    city::Diagnostics d;
    const auto bytes = BlobCache(copy, d).read("city", "11", "v1");
    EXPECT_TRUE(!bytes || *bytes == good) << "byte " << at;
    noticed += !bytes;
  }
  EXPECT_GT(noticed, 10);
}

TEST(BlobCache, ATruncatedFileIsReplacedOrGivesNothing) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "scene.sqlite";
  city::Diagnostics ignored;
  { BlobCache(file, ignored).write("city", "11", "v1", content(200'000, 4)); }
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  city::Diagnostics d;
  {
    BlobCache cache(file, d);
    EXPECT_FALSE(cache.read("city", "11", "v1"));
  }
  EXPECT_FALSE(d.messages.empty());
}

TEST(BlobCache, AFolderThatCannotBeWrittenIsOnlyAWarning) {
  const TemporaryFolder folder;
  const std::string notAFolder = folder.write("plain", "file");
  city::Diagnostics d;
  BlobCache cache(std::filesystem::path(notAFolder) / "scene.sqlite", d);
  cache.write("city", "11", "v1", "x");
  EXPECT_FALSE(cache.read("city", "11", "v1"));
  EXPECT_FALSE(d.hasErrors());
  EXPECT_THAT(messagesOf(d), HasSubstr("the cache cannot be used"));
}

TEST(BlobCache, SeveralAtOnceDoNoHarm) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "scene.sqlite";
  std::vector<city::Diagnostics> said(4);
  {
    std::vector<std::jthread> writers;
    for (size_t w = 0; w < said.size(); ++w)
      writers.emplace_back([&, w] {
        for (int round = 0; round < 8; ++round) {
          BlobCache cache(file, said[w]);
          cache.write("city", "11", "v1", content(50'000, static_cast<char>(w)));
          const auto bytes = cache.read("city", "11", "v1");
          ASSERT_TRUE(bytes);
          EXPECT_EQ(*bytes, content(50'000, (*bytes)[0]));
        }
      });
  }
  for (const city::Diagnostics& d : said) EXPECT_TRUE(d.messages.empty()) << messagesOf(d);
}

TEST(Hash, KnownValuesAndOrder) {
  Hash64 empty, a, foobar;
  a.add("a");
  foobar.add("foobar");
  EXPECT_EQ(empty.text(), "cbf29ce484222325");
  EXPECT_EQ(a.text(), "af63dc4c8601ec8c");
  EXPECT_EQ(foobar.text(), "85944171f73967e8");
  Hash64 one, other;
  one.addText("ab"), one.addText("c");
  other.addText("a"), other.addText("bc");
  EXPECT_NE(one.value(), other.value());
}

TEST(Hash, ContentCountsSideFilesToo) {
  const TemporaryFolder folder;
  const std::string file = folder.write("town.shp", "shapes");
  const auto hashOf = [&] {
    Hash64 h;
    addContent(h, file);
    return h.value();
  };
  const uint64_t bare = hashOf();
  folder.write("town.dbf", "height 5");
  const uint64_t with = hashOf();
  folder.write("town.dbf", "height 6");
  const uint64_t changed = hashOf();
  folder.write("town.txt", "not part of it");
  EXPECT_NE(bare, with);
  EXPECT_NE(with, changed);
  EXPECT_EQ(changed, hashOf());
}

}  // namespace
}  // namespace vicus::assets
