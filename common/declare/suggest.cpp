#include "declare/suggest.hpp"

#include <algorithm>

namespace grainstep::declare {
namespace {

/// Optimal string alignment distance.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1, 0));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

/// One slip in three letters is still a slip.
constexpr std::size_t letters_per_slip = 3;
constexpr std::size_t longest_word = 64;

}  // namespace

std::string nearest_word(std::string_view written, const std::vector<std::string>& known) {
  if (written.size() > longest_word) return {};
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, written.size() / letters_per_slip) + 1;
  for (const auto& word : known) {
    const std::size_t distance = edit_distance(written, word);
    if (distance < best_distance) {
      best = word;
      best_distance = distance;
    }
  }
  return best;
}

std::string hint(std::string_view written, const std::vector<std::string>& known) {
  const std::string word = nearest_word(written, known);
  return word.empty() ? word : "; did you mean '" + word + "'?";
}

std::string join_words(const std::vector<std::string>& words) {
  std::string all;
  for (const auto& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

}  // namespace grainstep::declare
