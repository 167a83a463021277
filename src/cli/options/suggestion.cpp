#include "cli/options/suggestion.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace vorpipe::cli {
namespace {

constexpr std::size_t most_edits = 2;

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// Returns how many letters must be added, omitted, changed, or swapped with the next to turn a into b.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> least(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      std::size_t& here = least[i][j];
      here = i + j;
      if (i == 0 || j == 0) continue;
      const std::size_t changed = a[i - 1] == b[j - 1] ? 0 : 1;
      here = std::min({least[i - 1][j] + 1, least[i][j - 1] + 1, least[i - 1][j - 1] + changed});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) here = std::min(here, least[i - 2][j - 2] + 1);
    }
  }
  return least[a.size()][b.size()];
}

}  // namespace

std::string closestTo(std::string_view typed, std::span<const std::string> known) {
  constexpr std::size_t longest = 40;
  const std::string word = lower(typed);
  const std::string_view letters =
      std::string_view(word).substr(std::min(word.find_first_not_of('-'), word.size()));
  if (letters.size() < 2 || word.size() > longest) return {};
  // In a word of three letters, two edits would change nearly everything.
  std::size_t best = std::min(most_edits, letters.size() - 2) + 1;
  std::string closest;
  for (const std::string& candidate : known) {
    const std::size_t distance = edits(word, lower(candidate));
    if (distance >= best) continue;
    best = distance;
    closest = candidate;
  }
  if (!closest.empty()) return closest;
  for (const std::string& candidate : known) {
    if (!lower(candidate).starts_with(word)) continue;
    if (closest.empty() || candidate.size() < closest.size()) closest = candidate;
  }
  return closest;
}

std::string didYouMean(std::string_view typed, std::span<const std::string> known) {
  const std::string closest = closestTo(typed, known);
  return closest.empty() ? "" : "; did you mean " + closest + "?";
}

}  // namespace vorpipe::cli
