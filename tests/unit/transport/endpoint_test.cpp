#include "transport/endpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"

namespace grainstep::transport {
namespace {

using ::testing::HasSubstr;

std::string refusal(const std::string& endpoint, Use use) {
  try {
    check_form(endpoint, use);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Endpoint, is_ipc_or_tcp) {
  for (const auto* const endpoint : {"ipc:///run/channel", "tcp://127.0.0.1:5555", "tcp://node17.example.org:1",
                                     "tcp://[::1]:5555", "tcp://[fe80::1%eth0]:65535", "tcp://eth0:5555"}) {
    EXPECT_EQ(refusal(endpoint, Use::listen), "accepted") << endpoint;
    EXPECT_EQ(refusal(endpoint, Use::connect), "accepted") << endpoint;
  }
}

// Everything else that libzmq knows, some of it on all interfaces and unencrypted.
TEST(Endpoint, is_nothing_else) {
  for (const auto* const endpoint :
       {"ws://0.0.0.0:5555", "wss://0.0.0.0:5555", "udp://0.0.0.0:5555", "pgm://eth0;239.192.1.1:5555",
        "epgm://eth0;239.192.1.1:5555", "tipc://{5560,0,0}", "vmci://*:5555", "norm://2,127.0.0.1:5555",
        "inproc://name", "hvsocket://a:1", "TCP://0.0.0.0:5555", " tcp://0.0.0.0:5555", "carrier-pigeon://here", ""}) {
    EXPECT_THAT(refusal(endpoint, Use::listen), HasSubstr("xpected tcp://HOST:PORT, or ipc:///PATH")) << endpoint;
    EXPECT_NE(refusal(endpoint, Use::connect), "accepted") << endpoint;
  }
}

TEST(Endpoint, says_what_was_meant) {
  EXPECT_EQ(refusal("127.0.0.1:5555", Use::connect),
            "127.0.0.1:5555: did you mean tcp://127.0.0.1:5555? Expected tcp://HOST:PORT, or ipc:///PATH on this host");
  EXPECT_THAT(refusal("*:5555", Use::listen), HasSubstr("did you mean tcp://*:5555?"));
  EXPECT_THAT(refusal("/run/channel", Use::connect), HasSubstr("did you mean ipc:///run/channel?"));
  EXPECT_THAT(refusal("ws://0.0.0.0:1", Use::listen), HasSubstr("'ws' is not a way to connect"));
  EXPECT_THAT(refusal("tcp://127.0.0.1", Use::connect), HasSubstr("it has no port"));
  EXPECT_THAT(refusal("tcp://127.0.0.1:http", Use::connect), HasSubstr("'http' is no port"));
  EXPECT_THAT(refusal("tcp://127.0.0.1:65536", Use::connect), HasSubstr("'65536' is no port"));
  EXPECT_THAT(refusal("tcp://:5555", Use::connect), HasSubstr("is no host"));
  EXPECT_THAT(refusal("ipc://channel", Use::listen), HasSubstr("by its absolute path"));
  EXPECT_THAT(refusal("ipc://@channel", Use::listen), HasSubstr("by its absolute path"));
}

TEST(Endpoint, names_one_place) {
  // libzmq takes the first for the own address; it would decide by another one than we look at.
  EXPECT_NE(refusal("tcp://127.0.0.1:5555;10.0.0.1:5555", Use::connect), "accepted");
  EXPECT_EQ(refusal("tcp://127.0.0.1:*", Use::listen), "accepted");
  EXPECT_EQ(refusal("tcp://*:0", Use::listen), "accepted");
  for (const auto* const endpoint : {"tcp://*:5555", "tcp://127.0.0.1:*", "tcp://127.0.0.1:0"}) {
    EXPECT_THAT(refusal(endpoint, Use::connect), HasSubstr("one host and one port")) << endpoint;
  }
}

TEST(LeavesThisHost, only_tcp_beyond_loopback) {
  EXPECT_FALSE(leaves_this_host("ipc:///run/channel"));
  EXPECT_FALSE(leaves_this_host("tcp://127.0.0.1:5555"));
  EXPECT_FALSE(leaves_this_host("tcp://localhost:*"));
  EXPECT_FALSE(leaves_this_host("tcp://[::1]:5555"));
  EXPECT_TRUE(leaves_this_host("tcp://*:5555"));
  EXPECT_TRUE(leaves_this_host("tcp://0.0.0.0:5555"));
  EXPECT_TRUE(leaves_this_host("tcp://node17:5555"));
  EXPECT_TRUE(leaves_this_host("tcp://127.example.org:5555"));
}

}  // namespace
}  // namespace grainstep::transport
