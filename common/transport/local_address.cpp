#include "transport/local_address.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <memory>

#include "transport/endpoint.hpp"

namespace grainstep::transport {
namespace {

using Addresses = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

/// Version 4 alone, as ZeroMQ's sockets here.
Addresses addresses_of(const std::string& host, const std::string& port) {
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), port.c_str(), &wanted, &found) != 0) found = nullptr;
  return {found, &::freeaddrinfo};
}

/// Connected, a datagram socket knows its own address; it sends nothing until it is told to.
std::optional<in_addr> own_address_towards(const addrinfo& there) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return std::nullopt;
  sockaddr_in own{};
  socklen_t size = sizeof own;
  const bool known = ::connect(socket, there.ai_addr, there.ai_addrlen) == 0 &&
                     ::getsockname(socket, reinterpret_cast<sockaddr*>(&own), &size) == 0;
  ::close(socket);
  return known ? std::optional(own.sin_addr) : std::nullopt;
}

bool is_loopback(in_addr address) { return ntohl(address.s_addr) >> 24U == 127; }

}  // namespace

std::optional<std::string> local_address_towards(const std::string& endpoint) {
  if (!is_tcp(endpoint)) return std::nullopt;
  const std::size_t begin = endpoint.find("://") + 3;
  const std::size_t colon = endpoint.rfind(':');
  if (colon < begin) return std::nullopt;
  const Addresses there = addresses_of(endpoint.substr(begin, colon - begin), endpoint.substr(colon + 1));
  if (there == nullptr) return std::nullopt;
  const auto own = own_address_towards(*there);
  if (!own || is_loopback(*own)) return std::nullopt;
  std::array<char, INET_ADDRSTRLEN> text{};
  if (::inet_ntop(AF_INET, &*own, text.data(), text.size()) == nullptr) return std::nullopt;
  return text.data();
}

}  // namespace grainstep::transport
