// Based on: Damerau 1964, "A technique for computer detection and correction of spelling errors"; the restricted
// (optimal string alignment) form.
#include "assets/scene/suggest.hpp"

#include <algorithm>
#include <vector>

namespace vicus::assets {

size_t editDistance(std::string_view a, std::string_view b) {
  // Three rows of the table: two above suffice for swaps.
  std::vector<size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last.swap(row);
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t change = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string nearest(std::string_view word, std::span<const std::string> known) {
  constexpr size_t kLongestWord = 60;
  if (word.size() > kLongestWord) return {};
  std::string best;
  size_t distance = SIZE_MAX;
  for (const std::string& k : known)
    if (const size_t d = editDistance(word, k); d < distance) distance = d, best = k;
  return distance <= std::max<size_t>(1, best.size() / 3) ? best : std::string();
}

}  // namespace vicus::assets
