#include "mutation.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace vorpipe::fuzz {
namespace {

using namespace std::string_view_literals;

/// What is seldom made by changing a byte here and there.
constexpr std::array words = {"\0"sv,
                              "\n"sv,
                              "\r\n"sv,
                              ","sv,
                              ";"sv,
                              "\""sv,
                              "\xFF\xFF"sv,
                              "\xEF\xBB\xBF"sv,
                              "-"sv,
                              "1e308"sv,
                              "1e999"sv,
                              "5e-324"sv,
                              "-0"sv,
                              "nan"sv,
                              "inf"sv,
                              "0x1p3"sv,
                              "1,5"sv,
                              "1.5"sv,
                              "9223372036854775808"sv,
                              "18446744073709551616"sv,
                              "-1"sv,
                              "[["sv,
                              "]]"sv,
                              "{}"sv,
                              "[]"sv,
                              "null"sv,
                              "EMPTY"sv,
                              "("sv,
                              ")"sv,
                              "\xFF\xFF\xFF\xFF"sv,
                              "\0\0\0\0"sv,
                              "\x7F\xFF\xFF\xFF"sv,
                              "\0\0\0\x80"sv,
                              "\x1F\x8B"sv};

}  // namespace

Mutation::Mutation(std::vector<std::string> seeds, std::size_t longest)
    : seeds_(std::move(seeds)), longest_(longest) {}

void Mutation::change(std::string& bytes) {
  const std::size_t at = below(bytes.size() + 1);
  switch (below(7)) {
    case 0:  // a bit
      if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ 1 << below(8));
      break;
    case 1:  // a byte
      if (at < bytes.size()) bytes[at] = static_cast<char>(below(256));
      break;
    case 2:  // a piece is left out
      bytes.erase(at, 1 + below(below(64) + 1));
      break;
    case 3:  // a piece comes again, or several times
      for (auto times = below(4) + 1; times > 0; --times)
        bytes.insert(at, bytes.substr(below(bytes.size() + 1), 1 + below(64)));
      break;
    case 4:  // a word
      bytes.insert(at, words[below(words.size())]);
      break;
    case 5:  // a word in place of as many bytes
    {
      const auto word = words[below(words.size())];
      bytes.replace(at, word.size(), word);
      break;
    }
    default:  // the rest of another seed
    {
      const std::string& other = seeds_[below(seeds_.size())];
      bytes.replace(at, std::string::npos, other, below(other.size() + 1), std::string::npos);
    }
  }
}

std::string Mutation::next() {
  std::string bytes = seeds_[below(seeds_.size())];
  for (auto changes = below(6) + 1; changes > 0; --changes) change(bytes);
  if (bytes.size() > longest_) bytes.resize(longest_);
  return bytes;
}

}  // namespace vorpipe::fuzz
