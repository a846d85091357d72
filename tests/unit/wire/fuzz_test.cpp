/// Bytes from nowhere and damaged frames: always a PeerError or a good message, never anything else.
#include <gtest/gtest.h>
#include <xxhash.h>

#include <cstring>
#include <random>

#include "base/error.hpp"
#include "wire/message_channel.hpp"

namespace grainstep::wire {
namespace {

using Random = std::mt19937_64;

transport::Bytes random_bytes(Random& random, std::size_t size) {
  transport::Bytes bytes(size);
  for (auto& byte : bytes) {
    byte = static_cast<std::byte>(random());
  }
  return bytes;
}

/// A frame of a message with nested parts.
transport::Bytes snapshot_frame() {
  Snapshot snapshot;
  snapshot.set_window(7);
  for (int i = 0; i < 6; ++i) {
    snapshot.add_position(i);
    snapshot.add_cell(static_cast<std::uint32_t>(i));
  }
  auto* field = snapshot.add_point_field();
  field->set_name("velocity");
  field->add_value(1.5);
  Encoder encoder;
  const auto frame = encoder.encode(snapshot);
  return {frame.begin(), frame.end()};
}

/// Returns whether the frame was refused. Anything but acceptance or PeerError fails the test by escaping.
bool refused(std::span<const std::byte> bytes) {
  Decoder decoder("fuzz");
  try {
    const Frame frame = decoder.decode(bytes);
    (void)describe(frame);
    (void)window_of(frame);
    Snapshot snapshot;
    return !parse(frame, snapshot);
  } catch (const PeerError&) {
    return true;
  }
}

void reseal(transport::Bytes& frame) {
  const std::uint64_t sum = XXH3_64bits(frame.data() + header_size, frame.size() - header_size);
  std::memcpy(frame.data() + 16, &sum, sizeof sum);
}

TEST(Fuzz, random_bytes_are_refused) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    EXPECT_TRUE(refused(random_bytes(random, random() % 200)));
  }
}

TEST(Fuzz, every_single_flipped_bit_is_noticed) {
  const auto good = snapshot_frame();
  ASSERT_FALSE(refused(good));
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    auto frame = good;
    frame[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    EXPECT_TRUE(refused(frame)) << "bit " << bit;
  }
}

TEST(Fuzz, damage_behind_a_right_checksum_never_crashes) {
  Random random(2);
  const auto good = snapshot_frame();
  int refusals = 0;
  for (int i = 0; i < 20000; ++i) {
    auto frame = good;
    for (std::uint64_t changes = random() % 4; changes-- > 0;) {
      frame[header_size + random() % (frame.size() - header_size)] = static_cast<std::byte>(random());
    }
    frame.resize(header_size + random() % (frame.size() - header_size + 1));
    reseal(frame);
    refusals += refused(frame) ? 1 : 0;
  }
  EXPECT_GT(refusals, 15000);  // most are cut, and a cut Envelope does not have its declared length
}

}  // namespace
}  // namespace grainstep::wire
