#include "mutations.hpp"

#include <algorithm>
#include <vector>

namespace vicus::fuzz {
namespace {

/// Runs of digits in a text: begin and length.
std::vector<std::pair<size_t, size_t>> numbersIn(std::string_view text) {
  std::vector<std::pair<size_t, size_t>> out;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] < '0' || text[i] > '9') continue;
    const size_t begin = i;
    while (i < text.size() && ((text[i] >= '0' && text[i] <= '9') || text[i] == '.')) ++i;
    out.emplace_back(begin, i - begin);
  }
  return out;
}

size_t place(size_t size, city::Random& random) {
  return size == 0 ? 0 : random.bits() % size;
}

}  // namespace

std::string mutated(std::string_view bytes, size_t kind, city::Random& random) {
  std::string out(bytes);
  if (out.empty()) return out;
  switch (kind) {
    case 0: {
      const size_t count = 1 + random.bits() % 32;
      for (size_t k = 0; k < count; ++k) {
        char& c = out[place(out.size(), random)];
        c = static_cast<char>(static_cast<unsigned char>(c) ^ (1u << (random.bits() % 8)));
      }
      break;
    }
    case 1:
      out.resize(place(out.size(), random));
      break;
    case 2: {
      const auto numbers = numbersIn(out);
      if (numbers.size() < 2) break;
      for (int k = 0; k < 8; ++k) {
        const auto& a = numbers[place(numbers.size(), random)];
        const auto& b = numbers[place(numbers.size(), random)];
        const size_t length = std::min(a.second, b.second);
        for (size_t i = 0; i < length; ++i) std::swap(out[a.first + i], out[b.first + i]);
      }
      break;
    }
    case 3: {
      static constexpr const char* kHuge[] = {
          "4294967295",  "-1",  "1e308", "18446744073709551616", "2147483648", "1e-320",
          "99999999999", "nan", "1e999", "-9223372036854775808"};
      const auto numbers = numbersIn(out);
      if (numbers.empty()) break;
      const auto& [begin, length] = numbers[place(numbers.size(), random)];
      out.replace(begin, length, kHuge[random.bits() % std::size(kHuge)]);
      break;
    }
    case 4: {
      static constexpr const char* kOpen[] = {"[", "{\"a\":", "(", "<a>", "[["};
      const char* open = kOpen[random.bits() % std::size(kOpen)];
      std::string nest;
      const size_t depth = size_t{1} << (4 + random.bits() % 14);
      for (size_t k = 0; k < depth; ++k) nest += open;
      out.insert(place(out.size(), random), nest);
      break;
    }
    case 5: {
      const size_t from = place(out.size(), random);
      out.erase(from, place(out.size() - from, random));
      break;
    }
    case 6: {
      const size_t from = place(out.size(), random), length = std::min<size_t>(place(out.size() - from, random), 10000);
      const std::string piece = out.substr(from, length);
      const size_t times = 1 + random.bits() % 20;
      for (size_t k = 0; k < times; ++k) out.insert(from, piece);
      break;
    }
    default: {
      static constexpr unsigned char kBytes[] = {0, 0xff, 0x7f, 0x80, '"', '\n'};
      const size_t from = place(out.size(), random), length = 1 + random.bits() % 16;
      const unsigned char value = kBytes[random.bits() % std::size(kBytes)];
      for (size_t i = from; i < std::min(out.size(), from + length); ++i) out[i] = static_cast<char>(value);
    }
  }
  return out;
}

}  // namespace vicus::fuzz
