#include "transport/peer_watch.hpp"

#include <gtest/gtest.h>
#include <zmq.h>

namespace grainstep::transport {
namespace {

TEST(PeerWatch, the_only_connection_is_the_peers) {
  PeerWatch watch;
  watch.see(ZMQ_EVENT_ACCEPTED, 7);
  EXPECT_FALSE(watch.connected());
  watch.see(ZMQ_EVENT_HANDSHAKE_SUCCEEDED, 0);
  EXPECT_TRUE(watch.connected());
  watch.see(ZMQ_EVENT_DISCONNECTED, 7);
  EXPECT_TRUE(watch.lost());
}

TEST(PeerWatch, strangers_come_and_go) {
  PeerWatch watch;
  watch.see(ZMQ_EVENT_ACCEPTED, 5);  // a port scanner
  watch.see(ZMQ_EVENT_ACCEPTED, 7);
  watch.see(ZMQ_EVENT_HANDSHAKE_SUCCEEDED, 0);
  watch.see(ZMQ_EVENT_DISCONNECTED, 5);
  EXPECT_FALSE(watch.lost());
  watch.heard_from(7);
  watch.see(ZMQ_EVENT_ACCEPTED, 5);
  watch.see(ZMQ_EVENT_HANDSHAKE_FAILED_AUTH, 400);
  watch.see(ZMQ_EVENT_DISCONNECTED, 5);
  EXPECT_FALSE(watch.lost());
  watch.see(ZMQ_EVENT_DISCONNECTED, 7);
  EXPECT_TRUE(watch.lost());
}

TEST(PeerWatch, the_peer_may_be_gone_before_it_is_heard) {
  PeerWatch watch;
  watch.see(ZMQ_EVENT_ACCEPTED, 5);
  watch.see(ZMQ_EVENT_ACCEPTED, 7);
  watch.see(ZMQ_EVENT_HANDSHAKE_SUCCEEDED, 0);
  watch.see(ZMQ_EVENT_DISCONNECTED, 7);
  EXPECT_FALSE(watch.lost());
  watch.heard_from(7);
  EXPECT_TRUE(watch.lost());
}

TEST(PeerWatch, a_failed_attempt_says_why) {
  PeerWatch watch;
  watch.see(ZMQ_EVENT_CONNECTED, 7);
  watch.see(ZMQ_EVENT_HANDSHAKE_FAILED_AUTH, 400);
  watch.see(ZMQ_EVENT_DISCONNECTED, 7);
  EXPECT_TRUE(watch.attempt_failed());
  EXPECT_FALSE(watch.connected());
  EXPECT_FALSE(watch.lost());
  EXPECT_NE(watch.refusal().find("status 400"), std::string::npos);
}

}  // namespace
}  // namespace grainstep::transport
