#include "mutate_bytes.hpp"

#include <algorithm>

namespace grainstep::fuzz {
namespace {

using Random = std::mt19937_64;

constexpr std::size_t most_bytes = 1U << 15U;

std::size_t place_in(const std::string& bytes, Random& random) { return random() % bytes.size(); }

void change_one(std::string& bytes, Random& random) {
  char& at = bytes[place_in(bytes, random)];
  switch (random() % 4) {
    case 0:
      at = static_cast<char>(at ^ (1 << (random() % 8)));
      break;
    case 1:
      at = static_cast<char>(random());
      break;
    case 2:
      at = static_cast<char>(0xff);  // a varint that goes on
      break;
    default:
      at = static_cast<char>(at + 1);
  }
}

/// What protobuf calls merging: a second body behind the first one's bytes, so that fields come twice.
void repeat_fields(std::string& bytes) {
  constexpr std::size_t prefix = 2;  // a tag, and a length below 128
  if (bytes.size() < prefix || bytes.size() > 64 || bytes[1] < 0) return;
  const std::string body = bytes.substr(prefix);
  bytes[1] = static_cast<char>(2 * body.size());
  if (bytes[1] < 0) return;
  bytes += body;
}

}  // namespace

std::string bytes_of_any(Random& random) {
  std::string out(1 + random() % 64, '\0');
  for (char& byte : out) byte = static_cast<char>(random());
  return out;
}

void damage_bytes(std::string& bytes, Random& random) {
  if (bytes.empty()) {
    bytes = bytes_of_any(random);
    return;
  }
  const std::size_t at = place_in(bytes, random);
  const std::size_t length = 1 + random() % std::min<std::size_t>(16, bytes.size() - at);
  switch (random() % 6) {
    case 0:
      bytes.erase(at, length);
      break;
    case 1:
      bytes.insert(at, bytes_of_any(random));
      break;
    case 2:
      if (bytes.size() < most_bytes) bytes.insert(at, std::string(bytes, at, length));
      break;
    case 3:
      repeat_fields(bytes);
      break;
    default:
      change_one(bytes, random);
  }
}

}  // namespace grainstep::fuzz
