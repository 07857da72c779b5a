/// What the program says while it works: progress, warnings, errors.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "city/diagnostics.hpp"

namespace vicus::app {

/// Where the program reads and writes besides the files that its arguments name. Filled in by `main` from the process,
/// by tests as they like.
struct Surroundings {
  std::ostream& out;        ///< results
  std::ostream& err;        ///< progress and messages
  bool terminal = false;    ///< err is a terminal: progress is one line that is rewritten
  std::string cacheFolder;  ///< empty: no cache
  std::string dataFolder;   ///< where scene descriptions find files that are not beside them; empty: nowhere else
};

/// Speaks on Surroundings::err, from any thread. Invariant: a line of progress never runs into a message.
class Console {
 public:
  explicit Console(const Surroundings& surroundings);
  ~Console();

  void say(std::string_view text);
  void warn(std::string_view text);
  void error(std::string_view text);

  /// Shows how far a piece of work is, 0 to 1. In a terminal one line is rewritten at each whole percent; elsewhere
  /// each stage gets one line.
  void progress(std::string_view stage, double fraction);
  /// Wipes the line of progress.
  void progressDone();
  /// The stage and fraction that were shown last, for others who show them.
  std::pair<std::string, double> shownProgress() const;
  /// The errors so far, as they were said.
  std::vector<std::string> errors() const;

  /// Says the first ten messages of each kind (same file and wording, whatever their numbers) and how many more there
  /// are, then what was left out.
  void report(const city::Diagnostics& diagnostics);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vicus::app
