#include "transport/faulty_channel.hpp"

#include <algorithm>

namespace grainstep::transport {

void FaultyChannel::send(std::span<const std::byte> message) {
  if (++sent_ == fault_.message) {
    return mistreat(message);
  }
  inner_.send(message);
  if (held_back_) {
    inner_.send(*held_back_);
    held_back_.reset();
  }
}

void FaultyChannel::mistreat(std::span<const std::byte> message) {
  Bytes copy(message.begin(), message.end());
  switch (fault_.kind) {
    case Fault::Kind::drop:
      break;
    case Fault::Kind::duplicate:
      inner_.send(copy);
      inner_.send(copy);
      break;
    case Fault::Kind::delay:
      held_back_ = std::move(copy);
      break;
    case Fault::Kind::truncate:
      copy.resize(std::min(fault_.position, copy.size()));
      inner_.send(copy);
      break;
    case Fault::Kind::flip_bit:
      copy.at(fault_.position / 8) ^= static_cast<std::byte>(1U << (fault_.position % 8));
      inner_.send(copy);
      break;
  }
}

}  // namespace grainstep::transport
