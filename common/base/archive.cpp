#include "base/archive.hpp"

#include <stdexcept>

namespace grainstep::base {

void Saving::bytes(const void* from, std::size_t size) { bytes_.append(static_cast<const char*>(from), size); }

void Loading::refuse(const char* why) const { throw std::range_error("the part '" + std::string(part_) + "' " + why); }

std::string_view Loading::next(std::size_t size) {
  if (size > left_.size()) refuse("is cut off");
  const std::string_view out = left_.substr(0, size);
  left_.remove_prefix(size);
  return out;
}

std::uint64_t Loading::count() {
  std::uint64_t number = 0;
  std::memcpy(&number, next(sizeof number).data(), sizeof number);
  return number;
}

void Loading::end() const {
  if (!left_.empty()) throw std::range_error(std::to_string(left_.size()) + " bytes are left over");
}

}  // namespace grainstep::base
