/// @file A file descriptor that has an owner.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <utility>

namespace grainstep {

/// Closes on every way out. -1: none.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int value) : value_(value) {}
  Descriptor(Descriptor&& other) noexcept : value_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    if (this != &other) {
      close();
      value_ = other.release();
    }
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  [[nodiscard]] int get() const noexcept { return value_; }
  [[nodiscard]] bool is_open() const noexcept { return value_ >= 0; }
  /// Leaves errno as it is: it often says why whoever closes does so.
  void close() noexcept {
    if (!is_open()) return;
    const int error = errno;
    ::close(release());
    errno = error;
  }

 private:
  int release() noexcept { return std::exchange(value_, -1); }

  int value_ = -1;
};

}  // namespace grainstep
