#include "transport/endpoint.hpp"

#include <charconv>
#include <string_view>

#include "base/error.hpp"

namespace grainstep::transport {
namespace {

constexpr std::string_view tcp = "tcp://";
constexpr std::string_view ipc = "ipc://";
constexpr const char* digits = "0123456789";
constexpr const char* letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

[[noreturn]] void refuse(const std::string& endpoint, const std::string& text) {
  throw InputError(endpoint + ": " + text + (text.ends_with('?') ? " Expected" : "; expected") +
                   " tcp://HOST:PORT, or ipc:///PATH on this host");
}

bool holds_only(std::string_view text, const std::string& characters) {
  return !text.empty() && text.find_first_not_of(characters) == std::string_view::npos;
}

bool is_port(std::string_view text) {
  unsigned port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  return holds_only(text, digits) && error == std::errc() && end == text.data() + text.size() && port <= 65535;
}

struct Address {
  std::string_view host, port;
};

/// What stands behind tcp://, as far as the last colon and behind it.
Address split(std::string_view address) {
  const auto colon = address.rfind(':');
  if (colon == std::string_view::npos) return {address, {}};
  return {address.substr(0, colon), address.substr(colon + 1)};
}

bool is_host(std::string_view host) {
  if (host.starts_with('[') && host.ends_with(']')) {
    return holds_only(host.substr(1, host.size() - 2), std::string(digits) + letters + ":.%");
  }
  return holds_only(host, std::string(digits) + letters + "._-");
}

void check_tcp(const std::string& endpoint, Use use) {
  const auto [host, port] = split(std::string_view(endpoint).substr(tcp.size()));
  const bool open_host = host == "*";
  const bool open_port = port == "*" || port == "0";
  if (!open_host && !is_host(host)) refuse(endpoint, "'" + std::string(host) + "' is no host");
  if (!open_port && !is_port(port)) {
    refuse(endpoint, port.empty() ? "it has no port" : "'" + std::string(port) + "' is no port");
  }
  if (use == Use::connect && (open_host || open_port)) {
    refuse(endpoint, "a participant connects to one host and one port: those that the orchestrator prints");
  }
}

void refuse_scheme(const std::string& endpoint) {
  const auto end = endpoint.find("://");
  if (end != std::string::npos) refuse(endpoint, "'" + endpoint.substr(0, end) + "' is not a way to connect");
  if (endpoint.starts_with('/')) refuse(endpoint, "did you mean ipc://" + endpoint + "?");
  const auto [host, port] = split(endpoint);
  const bool address = (host == "*" || is_host(host)) && (port == "*" || is_port(port));
  refuse(endpoint, address ? "did you mean tcp://" + endpoint + "?" : "not an endpoint");
}

}  // namespace

void check_form(const std::string& endpoint, Use use) {
  if (endpoint.starts_with(tcp)) return check_tcp(endpoint, use);
  if (!endpoint.starts_with(ipc)) refuse_scheme(endpoint);
  // Names without a file (ipc://@name) have no permissions: everybody on this host could connect.
  if (!endpoint.starts_with("ipc:///")) refuse(endpoint, "a local socket is named by its absolute path");
}

bool is_tcp(const std::string& endpoint) { return endpoint.starts_with(tcp); }

bool leaves_this_host(const std::string& endpoint) {
  if (!is_tcp(endpoint)) return false;
  const std::string_view host = split(std::string_view(endpoint).substr(tcp.size())).host;
  const bool numeric = holds_only(host, std::string(digits) + ".");  // a name may begin with 127. too
  return !(numeric && host.starts_with("127.")) && host != "localhost" && host != "[::1]";
}

}  // namespace grainstep::transport
