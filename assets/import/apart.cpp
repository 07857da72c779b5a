#include "assets/import/apart.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>

namespace vicus::assets {
namespace {

constexpr int kDone = 0, kThrew = 3;

/// In the new process: never returns.
[[noreturn]] void workAndLeave(const std::function<std::string()>& work, const ApartLimits& limits, int out) {
  // What dying libraries print is nobody's business, and a crash here is an answer, not a report to write.
  if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) dup2(nowhere, STDERR_FILENO);
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL}) std::signal(signal, SIG_DFL);
#ifndef __SANITIZE_ADDRESS__
  const rlimit memory{limits.bytes, limits.bytes}, none{0, 0};
  setrlimit(RLIMIT_DATA, &memory);
  setrlimit(RLIMIT_CORE, &none);
#else
  (void)limits;
#endif
  int code = kDone;
  std::string result;
  try {
    result = work();
  } catch (...) {
    code = kThrew;
  }
  for (size_t at = 0; at < result.size();) {
    const ssize_t n = write(out, result.data() + at, result.size() - at);
    if (n < 0 && errno != EINTR) _exit(kThrew);
    if (n > 0) at += static_cast<size_t>(n);
  }
  _exit(code);
}

/// What a process has in memory: bytes; 0 where the system does not say.
uint64_t residentBytes(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/statm");
  uint64_t whole = 0, resident = 0;
  if (!(file >> whole >> resident)) return 0;
  return resident * static_cast<uint64_t>(std::max(sysconf(_SC_PAGESIZE), 0L));
}

}  // namespace

std::optional<std::string> runApart(const std::function<std::string()>& work, const ApartLimits& limits,
                                    std::string& why) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    why = "no process could be started for it";
    return std::nullopt;
  }
  // The new process begins with what this one has.
  const uint64_t before = residentBytes(getpid());
  const pid_t child = fork();
  if (child == 0) workAndLeave(work, limits, ends[1]);
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    why = "no process could be started for it";
    return std::nullopt;
  }
  using Clock = std::chrono::steady_clock;
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limits.seconds));
  std::string result;
  bool late = false, greedy = false;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd ready{ends[0], POLLIN, 0};
    // The limit of data does not hold under a sanitizer: what is in memory is looked at meanwhile.
    constexpr long kLook = 20;  // milliseconds
    const int n = left > 0 ? poll(&ready, 1, static_cast<int>(std::min<long>(left, kLook))) : 0;
    if (n < 0 && errno == EINTR) continue;
    greedy = n == 0 && residentBytes(child) > before + limits.bytes;
    if (n == 0 && left > 0 && !greedy) continue;
    if (n <= 0) {
      late = true;
      break;
    }
    char buffer[1 << 16];
    const ssize_t got = read(ends[0], buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    result.append(buffer, static_cast<size_t>(got));
  }
  close(ends[0]);
  if (late) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (greedy)
    why = "reading it asked for more memory than there is";
  else if (late)
    why = "reading it took too long and was given up";
  else if (!WIFEXITED(status))
    why = "the library that reads it broke down over it: the file is damaged";
  else if (WEXITSTATUS(status) != kDone)
    why = "reading it failed, or asked for more memory than there is";
  else
    return result;
  return std::nullopt;
}

}  // namespace vicus::assets
