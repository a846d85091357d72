/// @file The first message of a participant.
#pragma once

#include <unistd.h>

#include <initializer_list>
#include <string>

#include "grainstep/wire.pb.h"

namespace grainstep::participant {

/// `dimensions`: those that it can compute in.
[[nodiscard]] inline wire::Hello hello(wire::Role role, const std::string& backend, const std::string& version,
                                       std::initializer_list<unsigned> dimensions) {
  wire::Hello out;
  out.set_protocol(wire::PROTOCOL_VERSION);
  out.set_role(role);
  out.set_backend(backend);
  out.set_version(version);
  for (const unsigned dimension : dimensions) out.add_dimension(dimension);
  out.set_process(static_cast<std::uint64_t>(getpid()));
  return out;
}

/// A line of what `grainstep check` shows of a side.
inline void add_fact(wire::Ready& ready, const std::string& name, const std::string& text) {
  wire::Fact& fact = *ready.add_fact();
  fact.set_name(name);
  fact.set_text(text);
}

}  // namespace grainstep::participant
