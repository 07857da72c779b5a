#include "assets/styles/file_watch.hpp"

#include <fstream>
#include <iterator>
#include <utility>

#include "assets/cache/hash.hpp"

namespace vicus::assets {

FileWatch::FileWatch(std::vector<std::string> files) {
  for (std::string& file : files) {
    Watched& w = watched_.emplace_back();
    w.file = std::move(file);
    look(w);
  }
}

/// Brings what is known of the file up to date; true where its content is another one.
bool FileWatch::look(Watched& w) {
  std::error_code error;
  const auto written = std::filesystem::last_write_time(w.file, error);
  if (error) return false;
  const uintmax_t size = std::filesystem::file_size(w.file, error);
  if (error || (written == w.written && size == w.size)) return false;
  std::ifstream stream(w.file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (!stream) return false;
  Hash64 hash;
  hash.addText(text);
  w.written = written, w.size = size;
  return std::exchange(w.content, hash.value()) != hash.value();
}

std::vector<std::string> FileWatch::changed() {
  std::vector<std::string> out;
  for (Watched& w : watched_)
    if (look(w)) out.push_back(w.file);
  return out;
}

}  // namespace vicus::assets
