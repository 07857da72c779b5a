/// Pictures to a video file, one after another.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>

#include "viewer/renderer.hpp"

namespace vicus::viewer {

/// Whether the name ends like a video file: .mp4, .mkv, .mov or .webm.
bool isFilmName(const std::filesystem::path& path);

/// Encodes with libav: H.264 where there is an encoder for it, else what the file's kind takes by itself; 4:2:0,
/// BT.709. The same pictures give the same bytes: a fixed number of threads, no dates, no versions. Invariant: the file
/// has its name only once it is whole.
class Film {
 public:
  /// `size` in pixels; odd sides lose their last row or column. `rate` in pictures a second. Null with the reason in
  /// `error` where it cannot be.
  static std::unique_ptr<Film> open(const std::filesystem::path& path, glm::ivec2 size, double rate,
                                    std::string& error);
  ~Film();

  /// Adds a picture of that size. An empty text, or what went wrong.
  std::string add(const Picture& picture);
  /// Writes what is left and gives the file its name. An empty text, or what went wrong.
  std::string finish();

 private:
  struct Impl;
  explicit Film(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace vicus::viewer
