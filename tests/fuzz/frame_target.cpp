/// @file The frame and the codec: bytes that arrive become a frame, a name for people, and a message of their kind, or
/// a PeerError.
#include <tuple>

#include "base/assert.hpp"
#include "base/error.hpp"
#include "framing.hpp"
#include "mutate.hpp"
#include "mutate_bytes.hpp"
#include "target.hpp"

namespace grainstep::fuzz {
namespace {

/// Parsed messages are written again, and read again: the same bytes.
template <wire::Body Message>
void parse_as(const wire::Frame& frame) {
  Message message;
  if (!wire::parse(frame, message)) return;
  wire::Encoder encoder;
  wire::Decoder decoder("ourselves");
  Message again;
  const bool read = wire::parse(decoder.decode(encoder.encode(message)), again);
  GS_ASSERT(read && again.SerializeAsString() == message.SerializeAsString(), message.ShortDebugString());
}

template <class... Message>
void parse_as_any(const wire::Frame& frame, std::tuple<Message...>* /*kinds*/) {
  (parse_as<Message>(frame), ...);
}

using Kinds =
    std::tuple<wire::Hello, wire::Setup, wire::Ready, wire::Start, wire::Forces, wire::Kinematics, wire::Report,
               wire::Snapshot, wire::Stop, wire::Finished, wire::Error, wire::Save, wire::State, wire::Saved>;

/// What is made of bytes that arrive.
void arrive(wire::Decoder& decoder, std::span<const std::byte> frame_seen) {
  ++statistics().messages;
  const transport::Bytes bytes(frame_seen.begin(), frame_seen.end());  // of its own size: a read beyond it is seen
  try {
    const wire::Frame frame = decoder.decode(bytes);
    static_cast<void>(wire::describe(frame));
    parse_as_any(frame, static_cast<Kinds*>(nullptr));
    ++statistics().complete;
  } catch (const PeerError& error) {
    GS_ASSERT(error.peer() == "liar", error.what());
    ++statistics().blamed;
  }
}

/// The same payload with damage behind a right header, some times over: checksums are no guess of a fuzzer's.
void arrive_damaged(const std::string& payload, Random& random) {
  constexpr int times = 12;
  std::string damaged = payload;
  for (int i = 0; i < times; ++i) {
    damage_bytes(damaged, random);
    wire::Decoder fresh("liar");
    wire::Encoder first;
    arrive(fresh, first.forward(std::as_bytes(std::span(damaged))));
  }
}

}  // namespace

void try_script(const Script& script) {
  Framing framing;
  wire::Decoder decoder("liar");
  Random random(script.variant() + script.ByteSizeLong());
  for (const Said& said : script.said()) {
    arrive(decoder, framing.frame_of(said));
    arrive_damaged(said.payload().empty() ? said.message().SerializeAsString() : said.payload(), random);
  }
}

}  // namespace grainstep::fuzz
