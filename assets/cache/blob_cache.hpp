/// The cache of one scene: one SQLite file with named, compressed entries.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "city/diagnostics.hpp"

struct sqlite3;

namespace vicus::assets {

/// Table `blob(key, version, codec, bytes, crc)`. An entry's key is KIND/HASH: the kind of thing ("city") and the hash
/// of all that it was made from. Only the newest entry of a kind is kept.
///
/// Invariant: a read gives either exactly the bytes that one write was given, or nothing. Several programs may use the
/// file at once: writes are transactions, and wait for each other up to 10 s. Where the file cannot be used at all,
/// reads give nothing and writes do nothing; that is a warning, never an error.
class BlobCache {
 public:
  /// Opens or makes the file and its folder. A file that is no cache is replaced, with a warning.
  BlobCache(const std::filesystem::path& file, city::Diagnostics& diagnostics);
  ~BlobCache();
  BlobCache(const BlobCache&) = delete;
  BlobCache& operator=(const BlobCache&) = delete;

  /// The entry's bytes; nothing where there is none. One that is damaged, or made from other data or by another version
  /// of the program, gives nothing and a warning.
  std::optional<std::string> read(std::string_view kind, std::string_view hash, std::string_view version);
  /// Replaces all entries of the kind by this one.
  void write(std::string_view kind, std::string_view hash, std::string_view version, std::string_view bytes);

 private:
  bool open();
  bool run(const char* sql);

  std::filesystem::path file_;
  city::Diagnostics& diagnostics_;
  sqlite3* database_ = nullptr;
};

}  // namespace vicus::assets
