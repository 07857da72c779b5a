#include "assets/cache/hash.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <vector>

namespace vicus::assets {
namespace {

namespace fs = std::filesystem;

/// What GDAL's formats keep in files beside the named one.
constexpr std::string_view kSideFiles[] = {".dbf", ".shx",  ".prj", ".cpg", ".qpj", ".qix", ".hdr",
                                           ".tfw", ".tifw", ".wld", ".jgw", ".gfs", ".clr", ".ovr"};
constexpr std::string_view kSuffixes[] = {".aux.xml", ".ovr", ".msk", "-wal"};

void addFile(Hash64& hash, const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    hash.addText("missing");
    return;
  }
  std::vector<char> block(size_t{1} << 20);
  uint64_t size = 0;
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) || stream.gcount() > 0) {
    const auto count = static_cast<size_t>(stream.gcount());
    hash.add({block.data(), count});
    size += count;
  }
  hash.addNumber(size);
}

}  // namespace

std::string Hash64::text() const {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(value_));
  return digits;
}

void addContent(Hash64& hash, const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path, error))
      if (entry.is_regular_file(error)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
      hash.addText(fs::relative(file, path, error).generic_string());
      addFile(hash, file);
    }
    return;
  }
  addFile(hash, path);
  for (const std::string_view extension : kSideFiles) {
    fs::path side = fs::path(path).replace_extension(extension);
    if (side == path || !fs::is_regular_file(side, error)) continue;
    hash.addText(extension);
    addFile(hash, side);
  }
  for (const std::string_view suffix : kSuffixes) {
    const std::string side = path + std::string(suffix);
    if (!fs::is_regular_file(side, error)) continue;
    hash.addText(suffix);
    addFile(hash, side);
  }
}

}  // namespace vicus::assets
