/// @file A file descriptor that is closed on every way out.
#pragma once

#include <unistd.h>

namespace grainstep {

class Descriptor {
 public:
  /// Takes over `value`; negative: none.
  explicit Descriptor(int value) : value_(value) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  [[nodiscard]] int get() const noexcept { return value_; }

  void close() noexcept {
    if (value_ >= 0) ::close(value_);
    value_ = -1;
  }

 private:
  int value_;
};

}  // namespace grainstep
