/// Letters are drawn by OpenImageIO from DejaVu Sans. Where that is missing panels are empty; all they say is on the
/// console, too.
#include "viewer/panel.hpp"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>

namespace vicus::viewer {
namespace {

using Colour = std::array<float, 3>;
constexpr Colour kPaper{0.11f, 0.11f, 0.12f}, kInk{0.93f, 0.91f, 0.86f}, kQuiet{0.66f, 0.64f, 0.60f},
    kAccent{0.85f, 0.67f, 0.38f}, kRule{0.25f, 0.24f, 0.23f};

std::string fontFile(const std::string& name) {
  std::error_code error;
  for (const char* folder : {"/usr/share/fonts", "/usr/local/share/fonts"})
    for (std::filesystem::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
      if (it->path().filename() == name + ".ttf") return it->path().string();
  return name;
}

/// The font's file, looked for once: given a name alone, OpenImageIO searches all folders of fonts for every word. The
/// name where the file is not there.
const std::string& font(bool code = false) {
  static const std::string text = fontFile("DejaVuSans"), file = fontFile("DejaVuSansMono");
  return code ? file : text;
}

int letters(double scale) {
  return std::max(6, static_cast<int>(std::lround(16 * scale)));
}

int widthOf(const std::string& text, int size, bool code = false) {
  const OIIO::ROI roi = OIIO::ImageBufAlgo::text_size(text, size, font(code));
  return roi.defined() ? std::max(roi.xend, 0) : 0;
}

/// A picture to draw letters and boxes on.
class Sheet {
 public:
  Sheet(glm::ivec2 size, const Colour& colour)
      : size_(glm::max(size, glm::ivec2(1))), buffer_(OIIO::ImageSpec(size_.x, size_.y, 3, OIIO::TypeDesc::UINT8)) {
    fill({0, 0}, size_, colour);
  }
  glm::ivec2 size() const { return size_; }
  void fill(glm::ivec2 from, glm::ivec2 to, const Colour& colour) {
    const glm::ivec2 a = glm::clamp(from, glm::ivec2(0), size_), b = glm::clamp(to, glm::ivec2(0), size_);
    if (a.x >= b.x || a.y >= b.y) return;
    OIIO::ImageBufAlgo::fill(buffer_, {colour[0], colour[1], colour[2]}, OIIO::ROI(a.x, b.x, a.y, b.y));
  }
  /// `baseline` is the left end of the line that the letters stand on.
  void write(glm::ivec2 baseline, const std::string& text, int letterSize, const Colour& colour, bool code = false) {
    if (!text.empty())
      OIIO::ImageBufAlgo::render_text(buffer_, baseline.x, baseline.y, text, letterSize, font(code),
                                      {colour[0], colour[1], colour[2]});
  }
  Picture picture() const {
    Picture out;
    out.width = size_.x, out.height = size_.y;
    out.rgb.resize(3 * static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y));
    buffer_.get_pixels(OIIO::ROI::All(), OIIO::TypeDesc::UINT8, out.rgb.data());
    return out;
  }

 private:
  glm::ivec2 size_;
  OIIO::ImageBuf buffer_;
};

/// Breaks a text at spaces into lines of at most `width` pixels; a longer word stands alone.
std::vector<std::string> broken(const std::string& text, int width, int size) {
  std::vector<std::string> lines{""};
  size_t at = 0;
  while (at < text.size()) {
    const size_t space = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, space - at);
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || widthOf(longer, size) <= width)
      lines.back() = longer;
    else
      lines.push_back(word);
    at = space + 1;
  }
  return lines;
}

/// The panel at one size of letters; `whole` where nothing had to be left out.
Picture drawAt(std::span<const PanelLine> lines, double scale, glm::ivec2 largest, bool& whole) {
  const int size = letters(scale), line = size * 3 / 2, margin = size;
  int keyWidth = 0, textWidth = 0;
  for (const PanelLine& l : lines) {
    if (!l.key.empty()) keyWidth = std::max(keyWidth, widthOf(l.key, size) + 3 * size / 2);
    textWidth = std::max(textWidth, widthOf(l.text, size, l.code));
  }
  const int room = std::max(largest.x - 2 * margin, 4 * size);
  textWidth = std::clamp(textWidth, 1, std::max(room - keyWidth, 2 * size));

  struct Row {
    std::string text, key;
    bool heading, code;
    int top;
  };
  std::vector<Row> rows;
  int height = margin;
  for (const PanelLine& l : lines) {
    if (l.heading && !rows.empty()) height += line / 2;
    bool first = true;
    const int width = textWidth + (l.key.empty() ? keyWidth : 0);
    for (const std::string& text : l.code ? std::vector{l.text} : broken(l.text, width, size)) {
      rows.push_back({text, first ? l.key : std::string(), l.heading, l.code, height});
      height += line;
      first = false;
    }
  }
  whole = height + margin <= largest.y;
  Sheet sheet(glm::min({keyWidth + textWidth + 2 * margin, height + margin}, glm::max(largest, glm::ivec2(1))), kPaper);
  const bool columns = keyWidth > 0;
  for (const Row& row : rows) {
    if (row.top + line > sheet.size().y) break;
    const int base = row.top + size;
    const bool indented = columns && !row.heading;
    sheet.write({margin, base}, row.key, size, kAccent);
    sheet.write({margin + (indented ? keyWidth : 0), base}, row.text, size, row.heading ? kQuiet : kInk, row.code);
  }
  return sheet.picture();
}

}  // namespace

std::vector<PanelLine> helpLines() {
  return {
      {"On foot", "", true},
      {"walk; Shift runs", "W A S D, arrows"},
      {"look about", "Mouse"},
      {"take me back to the last good place", "B"},
      {"Other ways to move", "", true},
      {"fly (E and Q: up and down), or walk again", "F"},
      {"about what you look at (W and S, or the wheel: nearer, farther)", "O"},
      {"map: drag it, wheel changes its height, click to go there", "M"},
      {"tour: lean back", "T"},
      {"views", "1 to 9"},
      {"record a tour; again: keep it", "R"},
      {"The window", "", true},
      {"this help", "F1"},
      {"people on or off", "P"},
      {"full screen", "F11"},
      {"keep a picture", "F12"},
      {"leave", "Esc"},
  };
}

Picture drawPanel(std::span<const PanelLine> lines, double scale, glm::ivec2 largest) {
  bool whole = false;
  Picture picture = drawAt(lines, scale, largest, whole);
  for (double smaller = 0.85; !whole && smaller > 0.5; smaller *= 0.85)
    picture = drawAt(lines, smaller * scale, largest, whole);
  return picture;
}

Picture drawLoading(glm::ivec2 size, double scale, const std::string& title, const std::string& stage,
                    double fraction) {
  Sheet sheet(size, kPaper);
  const int letter = letters(scale), large = 2 * letter;
  const glm::ivec2 middle = sheet.size() / 2;
  const int half = std::min(sheet.size().x * 2 / 5, 20 * letter);
  sheet.write({middle.x - std::min(half, widthOf(title, large) / 2), middle.y - large}, title, large, kInk);
  const int share = static_cast<int>(2 * half * std::clamp(std::isfinite(fraction) ? fraction : 0, 0.0, 1.0));
  const int top = middle.y, bottom = middle.y + std::max(letter / 3, 2);
  sheet.fill({middle.x - half, top}, {middle.x + half, bottom}, kRule);
  sheet.fill({middle.x - half, top}, {middle.x - half + share, bottom}, kAccent);
  sheet.write({middle.x - std::min(half, widthOf(stage, letter) / 2), bottom + 2 * letter}, stage, letter, kQuiet);
  return sheet.picture();
}

Picture drawError(glm::ivec2 size, double scale, const std::string& title, std::span<const std::string> reasons) {
  Sheet sheet(size, kPaper);
  const int letter = letters(scale), large = letter * 3 / 2, line = letter * 3 / 2;
  const int left = sheet.size().x / 10, width = sheet.size().x - 2 * left;
  int base = sheet.size().y / 5 + large;
  for (const std::string& text : broken(title, width, large)) {
    sheet.write({left, base}, text, large, kAccent);
    base += large * 3 / 2;
  }
  base += line / 2;
  for (const std::string& reason : reasons)
    for (const std::string& text : broken(reason, width, letter)) {
      if (base + 3 * line > sheet.size().y) break;
      sheet.write({left, base}, text, letter, kInk);
      base += line;
    }
  sheet.write({left, base + line}, "Esc closes this window.", letter, kQuiet);
  return sheet.picture();
}

}  // namespace vicus::viewer
