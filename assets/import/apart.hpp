/// Work that may crash, hang or fill the memory, in a process of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace vicus::assets {

struct ApartLimits {
  double seconds = 8;                     ///< then it is ended
  uint64_t bytes = uint64_t{1200} << 20;  ///< of memory, besides what the caller has; under sanitizers it is looked at
                                          ///< every 20 ms only
};

/// Runs `work` in a forked process and gives what it returns; nothing, with the reason in `why`, where that process
/// crashed or ran into a limit. For libraries that were not made for damaged files. What `work` changes is lost.
std::optional<std::string> runApart(const std::function<std::string()>& work, const ApartLimits& limits,
                                    std::string& why);

}  // namespace vicus::assets
