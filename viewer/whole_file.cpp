#include "viewer/whole_file.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>

namespace vicus::viewer {

std::string writeWhole(const std::filesystem::path& path, std::string_view bytes) {
  const std::string name = path.string();
  std::error_code failed;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), failed);
  if (failed) return name + ": the folder cannot be made: " + failed.message();

  std::filesystem::path beside = path;
  beside += ".part";
  std::ofstream out(beside, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  std::string problem;
  if (!out) problem = std::generic_category().message(errno);
  if (problem.empty()) {
    std::filesystem::rename(beside, path, failed);
    if (failed) problem = failed.message();
  }
  if (problem.empty()) return {};
  std::filesystem::remove(beside, failed);
  return name + ": cannot be written: " + problem;
}

}  // namespace vicus::viewer
