#include "results/results_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstring>

#include "base/error.hpp"
#include "results/atomic_file.hpp"

namespace grainstep::results {
namespace {

// Room beside the raw values: new chunks are allocated whole (64 KiB a dataset), plus the library's own bookkeeping.
constexpr std::size_t room_per_dataset = std::size_t{80} * 1024;
constexpr std::size_t room_for_library = std::size_t{256} * 1024;

// The system's own reason, without the exception for errno values that ::posix_fallocate returns.
void reserve_bytes(const std::filesystem::path& path, std::size_t bytes) {
  const int fd = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (fd < 0) {
    throw OutputError(path.string() + ": cannot be opened: " + std::strerror(errno));
  }
  const off_t size = ::lseek(fd, 0, SEEK_END);
  const int reason = ::posix_fallocate(fd, size, static_cast<off_t>(bytes));
  if (reason != 0) {
    static_cast<void>(::ftruncate(fd, size));
  }
  ::close(fd);
  if (reason != 0) {
    throw OutputError(path.string() + ": no room for " + std::to_string(bytes / 1024) + " KiB more: " +
                      std::strerror(reason) + (size > 0 ? ". What was written before is readable." : ""));
  }
}

// The library does not survive that it cannot write a new file (it crashes when the process ends): make sure before.
void require_room_for_a_new(const std::filesystem::path& path) {
  std::error_code ignored;
  try {
    write_atomically(path, "");
    reserve_bytes(path, room_for_library);
  } catch (...) {
    std::filesystem::remove(path, ignored);
    throw;
  }
  std::filesystem::remove(path, ignored);
}

}  // namespace

ResultsFile::ResultsFile(std::filesystem::path path, const std::vector<Text>& texts) : path_(std::move(path)) {
  if (std::filesystem::exists(path_)) {
    throw OutputError(path_.string() + ": exists already");
  }
  require_room_for_a_new(path_);
  h5::File file = h5::File::create(path_);
  for (const Text& text : texts) {
    file.write(text.dataset, text.contents, text.title);
  }
  file.close();
}

void ResultsFile::add(const std::vector<Entry>& row) {
  for (const Entry& entry : row) {
    Rows& rows = rows_[entry.dataset];
    rows.meaning = entry.meaning;
    rows.values.push_back(entry.value);
  }
  pending_bytes_ += row.size() * sizeof(double);
}

void ResultsFile::add(const Line& line) {
  Rows& rows = rows_[line.dataset];
  rows.meaning = line.meaning;
  rows.columns = line.values.size();
  rows.values.insert(rows.values.end(), line.values.begin(), line.values.end());
  pending_bytes_ += line.values.size() * sizeof(double);
}

void ResultsFile::add(Array array) {
  pending_bytes_ += array.values.size() * sizeof(double) + array.indices.size() * sizeof(std::uint32_t);
  arrays_.push_back(std::move(array));
}

void ResultsFile::reserve() const {
  reserve_bytes(path_, pending_bytes_ + rows_.size() * room_per_dataset + arrays_.size() * 1024 + room_for_library);
}

void ResultsFile::write_pending() {
  h5::File file = h5::File::open(path_);
  for (auto& [dataset, rows] : rows_) {
    file.append(dataset, rows.values, rows.columns, rows.meaning);
  }
  for (const Array& array : arrays_) {
    if (array.indices.empty()) {
      file.write(array.dataset, array.values, array.columns, array.meaning);
    } else {
      file.write(array.dataset, array.indices, array.columns, array.meaning);
    }
  }
  file.close();
}

void ResultsFile::flush() {
  if (pending_bytes_ == 0) {
    return;
  }
  const auto drop = [this] {
    for (auto& [dataset, rows] : rows_) {
      rows.values.clear();
    }
    arrays_.clear();
    pending_bytes_ = 0;
  };
  try {
    reserve();
    write_pending();
  } catch (...) {
    drop();
    throw;
  }
  drop();
}

}  // namespace grainstep::results
