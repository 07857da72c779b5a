/// Which of some files have changed since one last looked.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vicus::assets {

/// A file counts as changed when its content is another one: neither a new date alone nor the moment in which an
/// editor has put it away to write it anew is a change. Looking costs a call of the system for each file, and reading
/// it where its date or size is another.
class FileWatch {
 public:
  FileWatch() = default;
  explicit FileWatch(std::vector<std::string> files);

  /// The files that have changed since the last call, or since this was made.
  std::vector<std::string> changed();

 private:
  struct Watched {
    std::string file;
    std::filesystem::file_time_type written{};
    uintmax_t size = 0;
    uint64_t content = 0;
  };
  static bool look(Watched& watched);
  std::vector<Watched> watched_;
};

}  // namespace vicus::assets
