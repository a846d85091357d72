/// @file From what a script says to the bytes that arrive.
#pragma once

#include "script.pb.h"
#include "transport/channel.hpp"
#include "wire/codec.hpp"

namespace grainstep::fuzz {

/// One per direction: it counts, as an honest peer's encoder does.
class Framing {
 public:
  /// The frame of what is said, with its damage. Valid until the next call.
  [[nodiscard]] const transport::Bytes& frame_of(const Said& said);

 private:
  wire::Encoder encoder_;
  transport::Bytes frame_;
};

}  // namespace grainstep::fuzz
