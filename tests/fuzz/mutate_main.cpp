// Loads files, or mutated copies of them, each in a process of its own that may take 10 seconds of the processor (a
// minute by the clock, for those that wait) and 2 GB: the largest that was in memory at once, asked of the system when
// it has ended, which holds for sanitizers too, whose shadow memory no limit of addresses would let through.
//
//   fuzz_mutate [--copies N] [--seed S] [--keep DIR] [--table] FILE|FOLDER…
//
// Without --copies every file is loaded once as it is. Exit code 1 where any load crashed, hung, took more memory, or
// ended with neither a city nor an error; the copies that did so are kept in DIR.
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "assets/load_city.hpp"
#include "mutations.hpp"

namespace {

namespace fs = std::filesystem;

constexpr long kMostSeconds = 10;
constexpr unsigned kMostClockSeconds = 60;
constexpr long kMostKilobytes = 2'000'000;

enum class Ending { City, Refused, Silent, Crash, Hang, Memory };

struct Outcome {
  Ending ending = Ending::City;
  double seconds = 0;
  long kilobytes = 0;
  std::string message;  ///< the first error's, or the signal
};

/// Loads a file in a child process; what it says comes back through a pipe.
Outcome loadApart(const std::string& file) {
  int ends[2];
  if (pipe(ends) != 0) return {Ending::Crash, 0, 0, "no pipe"};
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    const itimerval busy{{0, 0}, {kMostSeconds, 0}};
    setitimer(ITIMER_PROF, &busy, nullptr);
    alarm(kMostClockSeconds);
    const std::string inputs[] = {file};
    const vicus::assets::LoadResult r = vicus::assets::loadCity(inputs, {});
    std::string message = r.city ? "" : "?";
    for (const vicus::city::Diagnostic& d : r.diagnostics.messages)
      if (d.severity == vicus::city::Severity::Error || message.empty()) {
        message = vicus::city::describe(d);
        break;
      }
    const ssize_t ignored = write(ends[1], message.data(), std::min<size_t>(message.size(), 4000));
    (void)ignored;
    _exit(r.city ? 0 : r.diagnostics.hasErrors() ? 10 : 11);
  }
  close(ends[1]);
  Outcome out;
  char buffer[4096];
  for (ssize_t n; (n = read(ends[0], buffer, sizeof buffer)) > 0;) out.message.append(buffer, static_cast<size_t>(n));
  close(ends[0]);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  const auto secondsOf = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  out.seconds = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
  out.kilobytes = usage.ru_maxrss;
  if (WIFSIGNALED(status)) {
    out.ending = WTERMSIG(status) == SIGALRM || WTERMSIG(status) == SIGPROF ? Ending::Hang : Ending::Crash;
    out.message = "signal " + std::to_string(WTERMSIG(status));
  } else {
    const int code = WEXITSTATUS(status);
    out.ending = code == 0 ? Ending::City : code == 10 ? Ending::Refused : code == 11 ? Ending::Silent : Ending::Crash;
  }
  if (out.ending != Ending::Crash && out.ending != Ending::Hang && out.kilobytes > kMostKilobytes)
    out.ending = Ending::Memory;
  return out;
}

const char* nameOf(Ending e) {
  constexpr const char* kNames[] = {"opened", "refused", "SILENT", "CRASH", "HANG", "MEMORY"};
  return kNames[static_cast<int>(e)];
}

std::string readAll(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct Options {
  size_t copies = 0;
  uint32_t seed = 1;
  bool table = false;
  fs::path keep = fs::temp_directory_path() / "vicus-fuzz";
  std::vector<fs::path> files;
};

Options parse(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    const auto value = [&] { return i + 1 < argc ? argv[++i] : ""; };
    if (a == "--copies") {
      o.copies = std::strtoull(value(), nullptr, 10);
    } else if (a == "--seed") {
      o.seed = static_cast<uint32_t>(std::strtoul(value(), nullptr, 10));
    } else if (a == "--keep") {
      o.keep = value();
    } else if (a == "--table") {
      o.table = true;
    } else if (fs::is_directory(a)) {
      for (const auto& entry : fs::recursive_directory_iterator(a))
        if (entry.is_regular_file() && entry.path().extension() != ".md" && entry.path().has_extension())
          o.files.push_back(entry.path());
    } else {
      o.files.emplace_back(a);
    }
  }
  std::sort(o.files.begin(), o.files.end());
  return o;
}

/// What became of all files of one kind.
struct Tally {
  size_t files = 0, endings[6] = {};
  double slowest = 0;
  long largest = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  fs::create_directories(options.keep);
  std::map<std::string, Tally> tallies;
  size_t bad = 0;
  const auto count = [&](const std::string& kind, const Outcome& out) {
    Tally& t = tallies[kind];
    ++t.files, ++t.endings[static_cast<int>(out.ending)];
    t.slowest = std::max(t.slowest, out.seconds), t.largest = std::max(t.largest, out.kilobytes);
    return out.ending != Ending::City && out.ending != Ending::Refused;
  };

  for (const fs::path& file : options.files) {
    if (options.copies > 0) break;
    const Outcome out = loadApart(file.string());
    const bool isBad =
        count(file.parent_path().parent_path().filename().string() + "/" + file.extension().string(), out);
    bad += isBad;
    if (isBad || options.table)
      std::printf("%s\t%s\t%.1f s\t%ld MB\t%s\n", nameOf(out.ending), file.c_str(), out.seconds, out.kilobytes / 1000,
                  out.message.c_str());
  }
  for (size_t i = 0; i < options.copies && !options.files.empty(); ++i) {
    const fs::path& original = options.files[i % options.files.size()];
    const size_t kind = (i / options.files.size()) % vicus::fuzz::kMutations.size();
    vicus::city::Random random(options.seed * 1'000'003u + static_cast<uint32_t>(i));
    // The copy keeps the name's ending, which decides how it is read.
    std::string name = original.filename().string();
    const fs::path copy =
        options.keep / ("copy" + std::to_string(getpid()) + name.substr(std::min(name.find('.'), name.size())));
    std::ofstream(copy, std::ios::binary) << vicus::fuzz::mutated(readAll(original), kind, random);
    const Outcome out = loadApart(copy.string());
    if (count(std::string(vicus::fuzz::kMutations[kind]), out)) {
      ++bad;
      const fs::path kept =
          options.keep / ("bad-" + std::to_string(options.seed) + "-" + std::to_string(i) + "-" + name);
      fs::copy_file(copy, kept, fs::copy_options::overwrite_existing);
      std::printf("%s\t%s\t%.1f s\t%ld MB\t%s\n", nameOf(out.ending), kept.c_str(), out.seconds, out.kilobytes / 1000,
                  out.message.c_str());
    }
    fs::remove(copy);
  }
  std::printf(
      "| kind | files | opened | refused | silent | crashed | hung | over 2 GB | slowest | most memory |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& [kind, t] : tallies)
    std::printf("| %s | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %.1f s | %ld MB |\n", kind.c_str(), t.files,
                t.endings[0], t.endings[1], t.endings[2], t.endings[3], t.endings[4], t.endings[5], t.slowest,
                t.largest / 1000);
  return bad > 0 ? 1 : 0;
}
