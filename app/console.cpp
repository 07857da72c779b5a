#include "app/console.hpp"

#include <spdlog/logger.h>
#include <spdlog/sinks/ostream_sink.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <mutex>
#include <ostream>
#include <vector>

namespace vicus::app {
namespace {

/// The message with every number as #, so that messages that differ in figures alone are of one kind.
std::string kindOf(const city::Diagnostic& d) {
  std::string kind = d.severity == city::Severity::Error ? "E" : "W";
  kind += d.file + "\n";
  bool inNumber = false;
  for (const char c : d.message) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0 || (inNumber && c == '.');
    if (!digit) kind += c;
    if (digit && !inNumber) kind += '#';
    inNumber = digit;
  }
  return kind;
}

}  // namespace

struct Console::Impl {
  explicit Impl(const Surroundings& s)
      : err(s.err), terminal(s.terminal), log("vicus", std::make_shared<spdlog::sinks::ostream_sink_mt>(s.err, true)) {
    log.set_pattern("%v");
  }
  std::recursive_mutex mutex;  ///< `report` says many things in one go
  std::ostream& err;
  bool terminal;
  spdlog::logger log;
  std::string stage;  ///< shown last
  int percent = -1;   ///< shown last
  std::vector<std::string> errors;
  bool lineOpen = false;  ///< a line of progress stands in the terminal

  void wipe() {
    if (lineOpen) err << "\r\x1b[K" << std::flush;
    lineOpen = false;
  }
};

Console::Console(const Surroundings& surroundings) : impl_(std::make_unique<Impl>(surroundings)) {}
Console::~Console() {
  progressDone();
}

void Console::say(std::string_view text) {
  const std::lock_guard lock(impl_->mutex);
  impl_->wipe();
  impl_->log.info("{}", text);
}

void Console::warn(std::string_view text) {
  const std::lock_guard lock(impl_->mutex);
  impl_->wipe();
  impl_->log.warn("warning: {}", text);
}

void Console::error(std::string_view text) {
  const std::lock_guard lock(impl_->mutex);
  impl_->wipe();
  impl_->log.error("error: {}", text);
  impl_->errors.emplace_back(text);
}

void Console::progress(std::string_view stage, double fraction) {
  const std::lock_guard lock(impl_->mutex);
  Impl& p = *impl_;
  const int percent = std::isfinite(fraction) ? static_cast<int>(100 * std::clamp(fraction, 0.0, 1.0)) : 0;
  const bool newStage = stage != p.stage;
  if (!newStage && percent == p.percent) return;
  p.stage = stage, p.percent = percent;
  if (p.terminal) {
    p.err << "\r\x1b[K" << stage << " " << percent << " %" << std::flush;
    p.lineOpen = true;
  } else if (newStage) {
    p.log.info("{}", stage);
  }
}

void Console::progressDone() {
  const std::lock_guard lock(impl_->mutex);
  impl_->wipe();
  impl_->stage.clear();
  impl_->percent = -1;
}

std::pair<std::string, double> Console::shownProgress() const {
  const std::lock_guard lock(impl_->mutex);
  return {impl_->stage, std::max(impl_->percent, 0) / 100.0};
}

std::vector<std::string> Console::errors() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->errors;
}

void Console::report(const city::Diagnostics& diagnostics) {
  const std::lock_guard lock(impl_->mutex);
  constexpr size_t kShown = 10;
  struct Kind {
    std::vector<const city::Diagnostic*> messages;
  };
  std::vector<std::string> order;
  std::map<std::string, Kind> kinds;
  for (const city::Diagnostic& d : diagnostics.messages) {
    Kind& kind = kinds[order.emplace_back(kindOf(d))];
    if (!kind.messages.empty()) order.pop_back();
    kind.messages.push_back(&d);
  }
  for (const std::string& name : order) {
    const auto& messages = kinds[name].messages;
    const bool isError = messages.front()->severity == city::Severity::Error;
    const auto tell = [&](const std::string& text) { isError ? error(text) : warn(text); };
    for (size_t i = 0; i < std::min(messages.size(), kShown); ++i) tell(describe(*messages[i]));
    if (messages.size() > kShown)
      tell(messages.front()->file + ": and " + std::to_string(messages.size() - kShown) + " more of this kind");
  }
  for (const city::LeftOut& l : diagnostics.leftOut)
    if (l.count > 0) warn("left out: " + std::to_string(l.count) + " " + l.what + ": " + l.why);
}

}  // namespace vicus::app
