/// @file By which address of its own this host reaches another one.
#pragma once

#include <optional>
#include <string>

namespace grainstep::transport {

/// Of the interface that leads to `endpoint` (tcp://HOST:PORT), as a number; nothing for any other endpoint, where HOST
/// has no address, or where it is this host itself. Nothing is sent.
[[nodiscard]] std::optional<std::string> local_address_towards(const std::string& endpoint);

}  // namespace grainstep::transport
