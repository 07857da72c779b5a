/// The page in a browser: headless Chromium lays it out at several widths and runs its script.
#include "report/page.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>

#include "synthetic.hpp"

namespace vicus::report {
namespace {

using ::testing::HasSubstr;
using testing::syntheticReport;

/// What a command prints; empty where it cannot be run.
std::string outputOf(const std::string& command) {
  std::string out;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return out;
  std::array<char, 4096> bytes{};
  for (size_t n = fread(bytes.data(), 1, bytes.size(), pipe); n > 0; n = fread(bytes.data(), 1, bytes.size(), pipe))
    out.append(bytes.data(), n);
  pclose(pipe);
  return out;
}

class PageInBrowser : public ::testing::Test {
 protected:
  void SetUp() override {
    if (outputOf("command -v chromium 2>/dev/null").empty()) GTEST_SKIP() << "no Chromium here (packages-full.txt)";
    folder_ = std::filesystem::temp_directory_path() /
              ("vicus-page-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  /// What `probe` writes into document.title, run once everything on the page has loaded in a window of that width.
  /// Pictures that wait to be scrolled to are loaded with the rest: the load event then waits for them, so that probe
  /// has nothing to wait for itself. (Virtual time does not stand still for a decoder's thread on a busy machine.)
  std::string titleAfter(const std::string& probe, int width) {
    std::string page = std::regex_replace(reportPage(syntheticReport()), std::regex(" loading=\"?lazy\"?"), "");
    const std::string script = "<script>addEventListener('load', () => { " + probe + " });</script></body>";
    page.replace(page.rfind("</body>"), 7, script);
    const std::filesystem::path file = folder_ / "page.html";
    std::ofstream(file) << page;
    const std::string command =
        "chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --virtual-time-budget=2000 "
        "--user-data-dir=" +
        (folder_ / "profile").string() + " --window-size=" + std::to_string(width) + ",900 --dump-dom file://" +
        file.string() + " 2>/dev/null";
    std::string dom;
    for (int start = 0; start < 3 && dom.empty(); ++start) dom = outputOf(command);  // a browser may fail to start
    std::smatch title;
    return std::regex_search(dom, title, std::regex("<title>([^<]*)</title>")) ? title[1].str() : dom;
  }

  std::filesystem::path folder_;
};

TEST_F(PageInBrowser, FitsNarrowAndWideWindows) {
  // Tables scroll within themselves; the page itself never does sideways. Headless windows are 500 pixels wide at
  // least.
  for (const int width : {500, 1280, 2560})
    EXPECT_EQ(titleAfter("document.title = document.documentElement.scrollWidth <= innerWidth ? 'fits' : "
                         "document.documentElement.scrollWidth + ' in ' + innerWidth",
                         width),
              "fits")
        << "a window " << width << " pixels wide";
}

TEST_F(PageInBrowser, EveryPictureAndPlotIsThere) {
  EXPECT_EQ(titleAfter("const shown = [...document.images].filter(i => i.complete && i.naturalWidth > 0).length;"
                       "document.title = shown + ' of ' + document.images.length + ' pictures, ' + "
                       "document.querySelectorAll('svg.plot').length + ' plots'",
                       1280),
            "3 of 3 pictures, 6 plots");
}

TEST_F(PageInBrowser, PointsTellTheirFiguresWhenPointedAt) {
  const std::string title = titleAfter(
      "const mark = document.querySelector('svg.plot [data-tip]'); mark.dispatchEvent(new PointerEvent('pointermove', "
      "{bubbles: true, clientX: 50, clientY: 50})); const tip = document.getElementById('tip');"
      "document.title = tip.style.display + ': ' + tip.textContent",
      1280);
  EXPECT_THAT(title, HasSubstr("block: "));
  EXPECT_THAT(title, HasSubstr(" ms ("));
}

TEST_F(PageInBrowser, NothingIsFetched) {
  EXPECT_EQ(titleAfter("document.title = performance.getEntriesByType('resource').filter(e => "
                       "!e.name.startsWith('data:')).length + ' fetched'",
                       1280),
            "0 fetched");
}

}  // namespace
}  // namespace vicus::report
