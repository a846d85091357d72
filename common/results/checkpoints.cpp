#include "results/checkpoints.hpp"

#include <xxhash.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/archive.hpp"
#include "base/error.hpp"
#include "results/atomic_file.hpp"

namespace grainstep::results {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "Grainstep checkpoint 1\n";
constexpr std::string_view prefix = "window-";
constexpr std::string_view suffix = ".checkpoint";
constexpr std::size_t kept = 2;

struct Part {
  std::string name, bytes;

  template <class Archive>
  void serialize(Archive& archive) {
    archive("name", name);
    archive("bytes", bytes);
  }
};

struct File {
  std::vector<Part> parts;

  template <class Archive>
  void serialize(Archive& archive) {
    archive("parts", parts);
  }
};

std::string checksum_of(std::string_view bytes) {
  const std::uint64_t sum = XXH3_64bits(bytes.data(), bytes.size());
  return {reinterpret_cast<const char*>(&sum), sizeof sum};
}

}  // namespace

fs::path Checkpoints::file(std::uint64_t window) const {
  return directory_ / (std::string(prefix) + std::to_string(window) + std::string(suffix));
}

void Checkpoints::write(std::uint64_t window, Parts parts) const {
  File file;
  while (!parts.empty()) {
    auto one = parts.extract(parts.begin());
    file.parts.push_back({std::move(one.key()), std::move(one.mapped())});
  }
  const std::string bytes = base::saved(file);
  std::error_code refused;
  fs::create_directory(directory_, refused);
  if (refused) throw OutputError(directory_.string() + ": cannot be made: " + refused.message());
  write_durably(this->file(window), std::string(magic) + checksum_of(bytes) + bytes);
  const std::vector<std::uint64_t> all = windows();
  for (std::size_t n = 0; n + kept < all.size(); ++n) fs::remove(this->file(all[n]), refused);
}

std::optional<std::uint64_t> Checkpoints::window_of(std::string_view file) {
  if (!file.starts_with(prefix) || !file.ends_with(suffix)) return std::nullopt;
  file.remove_prefix(prefix.size());
  file.remove_suffix(suffix.size());
  std::uint64_t window = 0;
  const auto [end, error] = std::from_chars(file.data(), file.data() + file.size(), window);
  if (error != std::errc() || end != file.data() + file.size()) return std::nullopt;
  return window;
}

std::vector<std::uint64_t> Checkpoints::windows() const {
  std::vector<std::uint64_t> found;
  std::error_code nothing;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory_, nothing)) {
    if (const auto window = window_of(entry.path().filename().native())) found.push_back(*window);
  }
  std::sort(found.begin(), found.end());
  return found;
}

Parts Checkpoints::read(std::uint64_t window) const {
  const fs::path path = file(window);
  std::ifstream in(path, std::ios::binary);
  std::ostringstream read;
  read << in.rdbuf();
  const std::string all = std::move(read).str();
  const auto refuse = [&path](const std::string& why) { throw InputError(path.string() + ": " + why); };
  if (!in) refuse("cannot be read");
  if (!all.starts_with(magic)) refuse("is no checkpoint of this version");
  const std::string_view rest = std::string_view(all).substr(magic.size());
  const std::string_view bytes = rest.substr(std::min(rest.size(), sizeof(std::uint64_t)));
  if (rest.substr(0, sizeof(std::uint64_t)) != checksum_of(bytes)) {
    refuse("is damaged; --from takes another one, grainstep show lists them");
  }
  File file;
  try {
    base::restore(file, bytes);
  } catch (const std::range_error& error) {
    refuse(error.what());
  }
  Parts parts;
  for (Part& part : file.parts) parts[part.name] = std::move(part.bytes);
  return parts;
}

}  // namespace grainstep::results
