#include "assets/shaders/shaders.hpp"

#include <algorithm>
#include <vector>

namespace vicus::assets {
namespace {

/// The file's name where `line` is `#include "name"`, else empty.
std::string_view includedFile(std::string_view line) {
  constexpr std::string_view kStart = "#include \"";
  if (!line.starts_with(kStart)) return {};
  line.remove_prefix(kStart.size());
  return line.substr(0, line.find('"'));
}

void append(std::string& out, std::string_view fileName, std::vector<std::string_view>& done) {
  if (std::find(done.begin(), done.end(), fileName) != done.end()) return;
  done.push_back(fileName);
  std::string_view text = shaderText(fileName);
  if (text.empty()) {
    out += "#error no shader file " + std::string(fileName) + "\n";
    return;
  }
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (const std::string_view included = includedFile(line); !included.empty())
      append(out, included, done);
    else
      out.append(line).push_back('\n');
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
}

}  // namespace

std::string shaderSource(std::string_view fileName, std::span<const std::string> defines) {
  std::string out = "#version 430 compatibility\n";
  for (const std::string& define : defines) out += "#define " + define + "\n";
  std::vector<std::string_view> done;
  append(out, fileName, done);
  return out;
}

}  // namespace vicus::assets
