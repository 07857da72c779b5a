/// Hashes of bytes and of files, for the cache's keys.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace vicus::assets {

/// FNV-1a, 64 bits (Fowler, Noll, Vo; IETF draft-eastlake-fnv), fed piece by piece. Not against malice: a cache's owner
/// has no reason to deceive himself.
class Hash64 {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) value_ = (value_ ^ static_cast<uint8_t>(c)) * 0x100000001b3ULL;
  }
  /// Text with its length, so that neighbouring texts cannot run into each other.
  void addText(std::string_view text) {
    addNumber(text.size());
    add(text);
  }
  void addNumber(uint64_t n) {
    for (int k = 0; k < 8; ++k) value_ = (value_ ^ (n >> (8 * k) & 0xff)) * 0x100000001b3ULL;
  }
  uint64_t value() const { return value_; }
  /// 16 hexadecimal digits.
  std::string text() const;

 private:
  uint64_t value_ = 0xcbf29ce484222325ULL;
};

/// Adds a file's content, and that of the side files that formats keep beside it (a shapefile's .dbf and .prj, a
/// raster's .tfw, …); for a folder, of all files in it. What is missing counts as missing.
void addContent(Hash64& hash, const std::string& path);

}  // namespace vicus::assets
