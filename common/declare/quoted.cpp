#include "declare/quoted.hpp"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace grainstep::declare {
namespace {

/// Characters that JSON writes as they are, but YAML does not read or takes for the end of a line: their bytes and
/// their escapes.
std::vector<std::pair<std::string, std::string>> unreadable() {
  std::vector<std::pair<std::string, std::string>> all{{"\x7f", "\\x7F"},           {"\u2028", "\\u2028"},
                                                       {"\u2029", "\\u2029"},       {"\xef\xbb\xbf", "\\uFEFF"},
                                                       {"\xef\xbf\xbe", "\\uFFFE"}, {"\xef\xbf\xbf", "\\uFFFF"}};
  for (int c = 0x80; c < 0xa0; ++c) {  // control characters of Latin-1
    const std::string hex = std::string(c < 0x90 ? "8" : "9") + "0123456789ABCDEF"[c & 0xf];
    all.emplace_back(std::string("\xc2") + static_cast<char>(c), "\\x" + hex);
  }
  return all;
}

}  // namespace

/// JSON's, with some escapes more.
std::string quoted(const std::string& text) {
  static const auto escapes = unreadable();
  std::string yaml = nlohmann::json(text).dump();
  for (const auto& [bytes, escape] : escapes) {
    for (auto at = yaml.find(bytes); at != std::string::npos; at = yaml.find(bytes, at)) {
      yaml.replace(at, bytes.size(), escape);
    }
  }
  return yaml;
}

}  // namespace grainstep::declare
