/// @file One participant as the orchestrator sees it.
#pragma once

#include <string>

#include "grainstep/wire.pb.h"
#include "transport/channel.hpp"
#include "wire/message_channel.hpp"

namespace grainstep::orchestrator {

[[nodiscard]] inline const char* name_of(wire::Role role) { return role == wire::IMPACTOR ? "impactor" : "structure"; }

struct Peer {
  Peer(wire::Role of_role, transport::Channel& channel)
      : role(of_role), messages(channel, name_of(of_role)), heard(transport::Clock::now()) {}

  [[nodiscard]] const std::string& name() const { return messages.peer(); }

  wire::Role role;
  wire::MessageChannel messages;
  transport::Clock::time_point heard;  ///< when it last said something, or was last given something to do
  bool introduced = false;             ///< its Hello is here
  bool under_way = false;              ///< data of it have come
  bool finished = false;               ///< Finished, Error or lost: nothing more is expected of it
  wire::Hello hello;
  wire::Ready ready;
  wire::Timing timing;  ///< of its last Report, then of Finished
};

/// The exception that a participant's Error stands for: InputError, NumericalError or PeerError.
[[noreturn]] void throw_error_of(const Peer& peer, const wire::Frame& frame);

}  // namespace grainstep::orchestrator
