/// What went wrong with data from outside, as values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vicus::city {

enum class Severity : uint8_t { Warning, Error };

/// One thing about a file that its owner should know.
struct Diagnostic {
  Severity severity = Severity::Warning;
  std::string file;     ///< path as given
  std::string place;    ///< line, feature id, band…; may be empty
  std::string message;  ///< what is wrong, what was done about it
};

/// One line: "file: place: message".
inline std::string describe(const Diagnostic& d) {
  return d.file + (d.place.empty() ? "" : ": " + d.place) + ": " + d.message;
}

/// What of the input is not in the city, by reason.
struct LeftOut {
  std::string what;  ///< "buildings", "terrain samples", …
  uint64_t count = 0;
  std::string why;
};

struct Diagnostics {
  std::vector<Diagnostic> messages;
  std::vector<LeftOut> leftOut;

  void warn(std::string file, std::string place, std::string message) {
    messages.push_back({Severity::Warning, std::move(file), std::move(place), std::move(message)});
  }
  void error(std::string file, std::string place, std::string message) {
    messages.push_back({Severity::Error, std::move(file), std::move(place), std::move(message)});
  }
  bool hasErrors() const {
    for (const Diagnostic& d : messages)
      if (d.severity == Severity::Error) return true;
    return false;
  }
};

}  // namespace vicus::city
