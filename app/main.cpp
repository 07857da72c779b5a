#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/interrupt.hpp"

namespace {

/// The folder for what Vicus may forget: XDG_CACHE_HOME/vicus, else ~/.cache/vicus; empty where there is neither.
std::string cacheFolder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache && *cache) return (std::filesystem::path(cache) / "vicus").string();
  const char* home = std::getenv("HOME");
  if (home && *home) return (std::filesystem::path(home) / ".cache" / "vicus").string();
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  vicus::app::catchInterrupts();
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const char* data = std::getenv("VICUS_DATA");
  return vicus::app::run(arguments,
                         {std::cout, std::cerr, isatty(STDERR_FILENO) == 1, cacheFolder(), data ? data : ""});
}
