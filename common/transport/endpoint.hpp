/// @file Where a channel may be: on this host (ipc), or on a network (tcp), which wants encryption. Nothing else:
/// ZeroMQ knows more schemes, some of which would reach a network unencrypted.
#pragma once

#include <string>

namespace grainstep::transport {

enum class Use { listen, connect };

/// InputError for everything but "ipc:///PATH" and "tcp://HOST:PORT", saying what was meant where that can be guessed.
/// Who listens may leave host and port open ("*", port 0), who connects may not.
void check_form(const std::string& endpoint, Use use);

/// Of an endpoint of the right form.
[[nodiscard]] bool is_tcp(const std::string& endpoint);

/// Whether data to `endpoint` can be seen on a network: tcp to anything but 127.x.y.z, localhost or [::1].
[[nodiscard]] bool leaves_this_host(const std::string& endpoint);

}  // namespace grainstep::transport
