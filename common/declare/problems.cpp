#include "declare/problems.hpp"

#include "base/error.hpp"

namespace grainstep::declare {
namespace {

/// Nobody reads more, and a file of garbage would give thousands.
constexpr std::size_t most_lines = 50;

}  // namespace

std::string problem_line(const Origin& origin, const std::string& path, const std::string& text) {
  std::string line = origin.text() + ": " + (path.empty() ? std::string() : path + ": ") + text;
  // What is quoted from the input must neither break the line nor reach the terminal as a control sequence.
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return line;
}

void Problems::add(const Origin& origin, const std::string& path, const std::string& text) {
  ++count_;
  if (lines_.size() < most_lines) lines_.push_back(problem_line(origin, path, text));
}

void Problems::throw_if_any() const {
  if (empty()) return;
  std::string all;
  for (const auto& line : lines_) all += (all.empty() ? "" : "\n") + line;
  if (count_ > lines_.size()) all += "\nand " + std::to_string(count_ - lines_.size()) + " more";
  throw InputError(all);
}

}  // namespace grainstep::declare
