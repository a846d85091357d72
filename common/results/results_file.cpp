#include "results/results_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstring>
#include <utility>

#include "base/error.hpp"
#include "results/atomic_file.hpp"

namespace grainstep::results {
namespace {

// Room beside the raw values: new chunks are allocated whole (64 KiB a dataset), plus the library's own bookkeeping.
constexpr std::size_t room_per_dataset = std::size_t{80} * 1024;
constexpr std::size_t room_for_library = std::size_t{256} * 1024;

// The system's own reason, without the exception for errno values that ::posix_fallocate returns.
// `name` is the one that people know the file by.
void reserve_bytes(const std::filesystem::path& path, const std::filesystem::path& name, std::size_t bytes) {
  const int fd = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (fd < 0) {
    throw OutputError(name.string() + ": cannot be opened: " + std::strerror(errno));
  }
  const off_t size = ::lseek(fd, 0, SEEK_END);
  const int reason = ::posix_fallocate(fd, size, static_cast<off_t>(bytes));
  if (reason != 0) {
    static_cast<void>(::ftruncate(fd, size));
  }
  ::close(fd);
  if (reason != 0) {
    throw OutputError(name.string() + ": no room for " + std::to_string(bytes / 1024) + " KiB more: " +
                      std::strerror(reason) + (size > 0 ? ". What was written before is readable." : ""));
  }
}

// The library does not survive that it cannot write a new file (it crashes when the process ends): make sure before.
void require_room_for_a_new(const std::filesystem::path& path) {
  std::error_code ignored;
  try {
    write_atomically(path, "");
    reserve_bytes(path, path, room_for_library);
  } catch (...) {
    std::filesystem::remove(path, ignored);
    throw;
  }
  std::filesystem::remove(path, ignored);
}

}  // namespace

ResultsFile::ResultsFile(std::filesystem::path path, const std::vector<Text>& texts) : file_(std::move(path)) {
  const std::filesystem::path& visible = file_.visible();
  if (std::filesystem::exists(visible)) {
    throw OutputError(visible.string() + ": exists already");
  }
  require_room_for_a_new(visible);
  h5::File file = h5::File::create(visible);
  for (const Text& text : texts) {
    file.write(text.dataset, text.contents, text.title);
    contents_[text.dataset] = 0;
  }
  file.close();
}

ResultsFile::ResultsFile(GoOn /*mode*/, std::filesystem::path path, const Contents& contents)
    : file_(std::move(path)), contents_(contents) {
  static_cast<void>(file_.open());
  h5::File file = h5::File::open(file_.twin());
  for (const std::string& dataset : file.datasets()) {
    const auto kept = contents.find(dataset);
    if (kept == contents.end()) {
      file.remove(dataset);
    } else if (kept->second > 0) {
      file.shrink(dataset, kept->second);
    }
  }
  for (const auto& [dataset, rows] : contents) {
    if (!file.has(dataset)) throw OutputError(file_.visible().string() + ": " + dataset + " is missing");
  }
  file.close();
  file_.exchange();
  file_.abandon();  // the other one holds what was taken away
}

void ResultsFile::add(const std::vector<Entry>& row) {
  for (const Entry& entry : row) {
    Rows& rows = pending_.rows[entry.dataset];
    rows.meaning = entry.meaning;
    rows.values.push_back(entry.value);
    ++contents_[entry.dataset];
  }
  pending_.bytes += row.size() * sizeof(double);
}

void ResultsFile::add(const Line& line) {
  Rows& rows = pending_.rows[line.dataset];
  rows.meaning = line.meaning;
  rows.columns = line.values.size();
  rows.packing = line.packing;
  rows.values.insert(rows.values.end(), line.values.begin(), line.values.end());
  ++contents_[line.dataset];
  pending_.bytes += line.values.size() * sizeof(double);
}

void ResultsFile::add(Array array) {
  pending_.bytes += array.values.size() * sizeof(double) + array.indices.size() * sizeof(std::uint32_t);
  contents_[array.dataset] = 0;
  pending_.arrays.push_back(std::move(array));
}

void ResultsFile::Burst::write_to(h5::File& file) const {
  for (const auto& [dataset, kept] : rows) {
    file.append(dataset, kept.values, kept.columns, kept.meaning, kept.packing);
  }
  for (const Array& array : arrays) {
    if (array.indices.empty()) {
      file.write(array.dataset, array.values, array.columns, array.meaning);
    } else {
      file.write(array.dataset, array.indices, array.columns, array.meaning);
    }
  }
}

void ResultsFile::Burst::clear() {
  for (auto& [dataset, kept] : rows) {
    kept.values.clear();
  }
  arrays.clear();
  bytes = 0;
}

void ResultsFile::write_bursts() {
  if (file_.open()) before_.clear();
  const std::size_t datasets = before_.rows.size() + pending_.rows.size();
  const std::size_t arrays = before_.arrays.size() + pending_.arrays.size();
  reserve_bytes(file_.twin(), file_.visible(),
                before_.bytes + pending_.bytes + datasets * room_per_dataset + arrays * 1024 + room_for_library);
  h5::File file = h5::File::open(file_.twin());
  before_.write_to(file);
  pending_.write_to(file);
  file.close();
  file_.exchange();
}

void ResultsFile::flush() {
  if (pending_.bytes == 0) {
    return;
  }
  try {
    write_bursts();
  } catch (...) {
    file_.abandon();
    pending_.clear();
    throw;
  }
  std::swap(before_, pending_);
  pending_.clear();
}

}  // namespace grainstep::results
