#include <gtest/gtest.h>

#include <cstring>

#include "base/error.hpp"
#include "wire/codec.hpp"

namespace grainstep::wire {
namespace {

transport::Bytes copy(std::span<const std::byte> bytes) { return {bytes.begin(), bytes.end()}; }

Kinematics some_kinematics(std::uint64_t window, int values) {
  Kinematics message;
  message.set_window(window);
  for (int i = 0; i < values; ++i) {
    message.add_position(0.1 * i);
    message.add_velocity(-3.0 * i);
  }
  return message;
}

std::string refusal(Decoder& decoder, std::span<const std::byte> frame) {
  try {
    (void)decoder.decode(frame);
  } catch (const PeerError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Codec, a_message_comes_back_as_it_was) {
  Encoder encoder;
  Decoder decoder("structure");
  const auto sent = some_kinematics(17, 50);
  const auto bytes = copy(encoder.encode(sent));
  const Frame frame = decoder.decode(bytes);
  EXPECT_EQ(frame.kind, Envelope::kKinematics);
  EXPECT_EQ(frame.sequence, 1U);
  EXPECT_EQ(window_of(frame), 17U);
  Kinematics received;
  ASSERT_TRUE(parse(frame, received));
  EXPECT_EQ(received.SerializeAsString(), sent.SerializeAsString());
}

TEST(Codec, the_bytes_are_the_documented_ones) {
  Encoder encoder;
  Forces forces;
  forces.set_window(5);
  forces.add_impulse(1.0);
  const auto frame = copy(encoder.encode(forces));
  // proto/README.md prints these bytes.
  EXPECT_EQ(std::memcmp(frame.data(), "GSTP\x02\0\0\0\x01\0\0\0\0\0\0\0\x75\x0c\xdc\x68\x67\x77\xe4\xb5", 24), 0);
  Envelope envelope;  // what any Protobuf library would send and expect
  *envelope.mutable_forces() = forces;
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(frame.data()) + header_size, frame.size() - header_size),
            envelope.SerializeAsString());
}

TEST(Codec, a_forwarded_payload_is_the_same_message_under_the_next_number) {
  Encoder source;
  Encoder hub;
  Decoder at_hub("impactor");
  Decoder at_end("orchestrator");
  Stop stop;
  stop.set_reason("first");
  const auto first = copy(hub.encode(stop));
  (void)at_end.decode(first);
  const auto sent = copy(source.encode(some_kinematics(3, 4)));
  const auto passed_on = copy(hub.forward(at_hub.decode(sent).payload));
  const Frame frame = at_end.decode(passed_on);
  EXPECT_EQ(frame.sequence, 2U);
  Kinematics received;
  ASSERT_TRUE(parse(frame, received));
  EXPECT_EQ(received.SerializeAsString(), some_kinematics(3, 4).SerializeAsString());
}

TEST(Codec, a_steady_exchange_reuses_every_buffer) {
  Encoder encoder;
  Decoder decoder("structure");
  Kinematics received;
  const auto sent = some_kinematics(1, 100);
  const auto first = encoder.encode(sent);
  ASSERT_TRUE(parse(decoder.decode(first), received));
  const double* const storage = received.position().data();
  for (int i = 0; i < 10; ++i) {
    const auto frame = encoder.encode(sent);
    EXPECT_EQ(frame.data(), first.data());
    ASSERT_TRUE(parse(decoder.decode(frame), received));
    EXPECT_EQ(received.position().data(), storage);
  }
}

TEST(Codec, every_damage_is_named) {
  Encoder encoder;
  const auto good = copy(encoder.encode(some_kinematics(1, 3)));
  const auto with = [&](std::size_t offset, unsigned value) {
    auto frame = good;
    frame[offset] = static_cast<std::byte>(value);
    return frame;
  };
  Decoder decoder("structure");
  EXPECT_NE(refusal(decoder, std::span(good).first(23)).find("found a frame of 23 bytes, expected at least 24"),
            std::string::npos);
  EXPECT_NE(refusal(decoder, with(0, 'X')).find("starts with 'GSTP'"), std::string::npos);
  EXPECT_NE(refusal(decoder, with(4, 9)).find("speaks protocol version 9, this program version 2"), std::string::npos);
  EXPECT_NE(refusal(decoder, with(8, 7)).find("sequence number 7, expected 1"), std::string::npos);
  EXPECT_NE(refusal(decoder, with(good.size() - 1, 0x55)).find("message 1: checksum"), std::string::npos);
  EXPECT_NE(refusal(decoder, std::span(good).first(good.size() - 1)).find("checksum"), std::string::npos);
  EXPECT_EQ(refusal(decoder, good), "accepted");
  EXPECT_NE(refusal(decoder, good).find("sequence number 1, expected 2"), std::string::npos);
}

TEST(Codec, an_envelope_with_no_or_two_bodies_is_refused) {
  Encoder encoder;
  const auto refused = [&](const std::string& payload) {
    Decoder decoder("structure");
    Encoder fresh;
    const auto frame = fresh.forward(std::as_bytes(std::span(payload)));
    return refusal(decoder, frame).find("not an Envelope with exactly one body") != std::string::npos;
  };
  Envelope stop;
  stop.mutable_stop()->set_reason("done");
  const std::string one = stop.SerializeAsString();
  EXPECT_FALSE(refused(one));
  EXPECT_TRUE(refused(""));
  EXPECT_TRUE(refused(one + one));
  EXPECT_TRUE(refused(std::string("\x7a\x00", 2)));  // field 15: no such body
}

TEST(Codec, window_of_is_zero_when_absent_and_none_for_other_kinds) {
  Encoder encoder;
  Decoder decoder("impactor");
  EXPECT_EQ(window_of(decoder.decode(encoder.encode(Forces()))), 0U);
  EXPECT_EQ(window_of(decoder.decode(encoder.encode(Hello()))), std::nullopt);
}

}  // namespace
}  // namespace grainstep::wire
