#include "assets/cache/blob_cache.hpp"

#include <sqlite3.h>
#include <zstd.h>

#include <system_error>

#include "assets/cache/hash.hpp"

namespace vicus::assets {
namespace {

namespace fs = std::filesystem;

/// Level 1: a city's bytes shrink to about a third at several hundred MB/s; higher levels cost more time than the
/// rebuild that they save.
constexpr int kZstdLevel = 1;
constexpr const char* kCodec = "zstd";
/// What one entry may grow to when unpacked: a damaged length must not ask for all memory. SQLite itself keeps at most
/// 1 GB in a value.
constexpr unsigned long long kLargestEntry = 8ULL << 30;

class Statement {
 public:
  Statement(sqlite3* database, const char* sql) { sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr); }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  explicit operator bool() const { return statement_ != nullptr; }
  void bind(int place, std::string_view text) {
    sqlite3_bind_text(statement_, place, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  }
  void bindBlob(int place, std::string_view bytes) {
    sqlite3_bind_blob64(statement_, place, bytes.data(), bytes.size(), SQLITE_STATIC);
  }
  void bind(int place, int64_t value) { sqlite3_bind_int64(statement_, place, value); }
  int step() { return sqlite3_step(statement_); }
  std::string_view text(int column) const {
    const auto* t = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    return t ? std::string_view(t) : std::string_view();
  }
  std::string_view blob(int column) const {
    const auto* b = static_cast<const char*>(sqlite3_column_blob(statement_, column));
    return b ? std::string_view(b, static_cast<size_t>(sqlite3_column_bytes(statement_, column))) : std::string_view();
  }
  int64_t number(int column) const { return sqlite3_column_int64(statement_, column); }

 private:
  sqlite3_stmt* statement_ = nullptr;
};

int64_t checksum(std::string_view bytes) {
  Hash64 hash;
  hash.add(bytes);
  return static_cast<int64_t>(hash.value());
}

std::optional<std::string> unpack(std::string_view packed) {
  const unsigned long long size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN || size > kLargestEntry) return std::nullopt;
  std::string bytes(static_cast<size_t>(size), '\0');
  const size_t got = ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size());
  if (ZSTD_isError(got) || got != bytes.size()) return std::nullopt;
  return bytes;
}

}  // namespace

bool BlobCache::run(const char* sql) {
  return sqlite3_exec(database_, sql, nullptr, nullptr, nullptr) == SQLITE_OK;
}

bool BlobCache::open() {
  if (sqlite3_open_v2(file_.c_str(), &database_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr) == SQLITE_OK) {
    sqlite3_busy_timeout(database_, 10'000);
    if (run("CREATE TABLE IF NOT EXISTS blob(key TEXT PRIMARY KEY, version TEXT, codec TEXT, bytes BLOB, crc "
            "INTEGER)") &&
        Statement(database_, "SELECT key, version, codec, bytes, crc FROM blob LIMIT 1"))
      return true;
  }
  return false;
}

BlobCache::BlobCache(const fs::path& file, city::Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {
  std::error_code error;
  fs::create_directories(file_.parent_path(), error);
  if (open()) return;
  const int code = sqlite3_errcode(database_);
  const std::string why = sqlite3_errmsg(database_);
  sqlite3_close(database_);
  database_ = nullptr;
  if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT || code == SQLITE_ERROR) {
    diagnostics_.warn(file_.string(), "", "the cache is damaged (" + why + ") and is made anew");
    fs::remove(file_, error);
    fs::remove(file_.string() + "-journal", error);
    if (open()) return;
    sqlite3_close(database_);
    database_ = nullptr;
  }
  diagnostics_.warn(file_.string(), "", "the cache cannot be used (" + why + "); loading takes longer without it");
}

BlobCache::~BlobCache() {
  sqlite3_close(database_);
}

std::optional<std::string> BlobCache::read(std::string_view kind, std::string_view hash, std::string_view version) {
  if (!database_) return std::nullopt;
  const std::string prefix = std::string(kind) + "/", key = prefix + std::string(hash);
  Statement select(database_, "SELECT key, version, codec, bytes, crc FROM blob WHERE key >= ?1 AND key < ?2");
  if (!select) return std::nullopt;
  select.bind(1, prefix);
  select.bind(2, std::string(kind) + "0");  // '0' is the character after '/'
  bool other = false;
  int status = select.step();
  for (; status == SQLITE_ROW; status = select.step()) {
    if (select.text(0) != key || select.text(1) != version || select.text(2) != kCodec) {
      other = true;
      continue;
    }
    const std::string_view packed = select.blob(3);
    std::optional<std::string> bytes;
    if (checksum(packed) == select.number(4)) bytes = unpack(packed);
    if (!bytes) diagnostics_.warn(file_.string(), key, "this entry of the cache is damaged and is made anew");
    return bytes;
  }
  if (status != SQLITE_DONE)
    diagnostics_.warn(file_.string(), key,
                      "the cache cannot be read (" + std::string(sqlite3_errmsg(database_)) + "); made anew");
  else if (other)
    diagnostics_.warn(
        file_.string(), key,
        "the cache's entry was made from other data or by another version of the program and is made anew");
  return std::nullopt;
}

void BlobCache::write(std::string_view kind, std::string_view hash, std::string_view version, std::string_view bytes) {
  if (!database_) return;
  const std::string prefix = std::string(kind) + "/", key = prefix + std::string(hash);
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const size_t size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kZstdLevel);
  if (ZSTD_isError(size)) {
    diagnostics_.warn(file_.string(), key, std::string("cannot be packed: ") + ZSTD_getErrorName(size));
    return;
  }
  packed.resize(size);

  bool done = run("BEGIN IMMEDIATE");
  if (done) {
    Statement clear(database_, "DELETE FROM blob WHERE key >= ?1 AND key < ?2");
    Statement insert(database_, "INSERT INTO blob(key, version, codec, bytes, crc) VALUES(?1, ?2, ?3, ?4, ?5)");
    done = clear && insert;
    if (done) {
      clear.bind(1, prefix);
      clear.bind(2, std::string(kind) + "0");
      insert.bind(1, key);
      insert.bind(2, version);
      insert.bind(3, kCodec);
      insert.bindBlob(4, packed);
      insert.bind(5, checksum(packed));
      done = clear.step() == SQLITE_DONE && insert.step() == SQLITE_DONE;
    }
  }
  done = done && run("COMMIT");
  if (done) return;
  diagnostics_.warn(file_.string(), key,
                    "cannot be written (" + std::string(sqlite3_errmsg(database_)) + "); the next start takes as long");
  run("ROLLBACK");
}

}  // namespace vicus::assets
