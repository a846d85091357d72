#include "wire/codec.hpp"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>
#include <xxhash.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "base/error.hpp"

namespace grainstep::wire {
namespace {

using google::protobuf::io::CodedInputStream;
using google::protobuf::io::CodedOutputStream;

constexpr std::array<std::uint8_t, 4> magic = {'G', 'S', 'T', 'P'};
constexpr std::uint32_t length_delimited = 2;
constexpr std::size_t largest_prefix = 1 + 5;  // a tag below 16 and a length of 32 bits

template <class Unsigned>
void store(std::byte* at, Unsigned value) {
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    at[i] = static_cast<std::byte>(value >> (8 * i));
  }
}

template <class Unsigned>
Unsigned load(const std::byte* at) {
  Unsigned value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    value = static_cast<Unsigned>(value | static_cast<Unsigned>(static_cast<Unsigned>(at[i]) << (8 * i)));
  }
  return value;
}

std::uint64_t checksum(std::span<const std::byte> payload) { return XXH3_64bits(payload.data(), payload.size()); }

std::string hex(std::uint64_t value) {
  std::array<char, 19> text{};
  std::snprintf(text.data(), text.size(), "0x%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

const std::uint8_t* octets(std::span<const std::byte> bytes) {
  return reinterpret_cast<const std::uint8_t*>(bytes.data());
}

/// Splits an Envelope into its only field. False when it is anything else than one known length-delimited field.
bool split(std::span<const std::byte> payload, Frame& frame) {
  if (payload.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    return false;
  }
  CodedInputStream in(octets(payload), static_cast<int>(payload.size()));
  const std::uint32_t tag = in.ReadTag();
  const int number = static_cast<int>(tag >> 3);
  std::uint32_t length = 0;
  if ((tag & 7U) != length_delimited || Envelope::descriptor()->FindFieldByNumber(number) == nullptr ||
      !in.ReadVarint32(&length)) {
    return false;
  }
  const auto start = static_cast<std::size_t>(in.CurrentPosition());
  if (payload.size() - start != length) {
    return false;
  }
  frame.kind = static_cast<Envelope::BodyCase>(number);
  frame.payload = payload;
  frame.body = payload.subspan(start);
  return true;
}

}  // namespace

std::byte* Encoder::reserve(std::size_t payload_size) {
  if (buffer_.size() < header_size + payload_size) {
    buffer_.resize(header_size + payload_size);
  }
  return buffer_.data() + header_size;
}

std::span<const std::byte> Encoder::seal(std::size_t payload_size) {
  std::byte* header = buffer_.data();
  std::memcpy(header, magic.data(), magic.size());
  store(header + 4, static_cast<std::uint32_t>(PROTOCOL_VERSION));
  store(header + 8, ++sequence_);
  store(header + 16, checksum({header + header_size, payload_size}));
  return {header, header_size + payload_size};
}

std::span<const std::byte> Encoder::encode(Envelope::BodyCase kind, const google::protobuf::MessageLite& body) {
  const std::size_t size = body.ByteSizeLong();
  if (size > static_cast<std::size_t>(std::numeric_limits<int>::max()) - largest_prefix) {
    throw std::length_error(kind_name(kind) + " of " + std::to_string(size) +
                            " bytes: a message holds less than 2 GiB; record fewer points");
  }
  auto* const begin = reinterpret_cast<std::uint8_t*>(reserve(size + largest_prefix));
  auto* at = CodedOutputStream::WriteTagToArray((static_cast<std::uint32_t>(kind) << 3) | length_delimited, begin);
  at = CodedOutputStream::WriteVarint32ToArray(static_cast<std::uint32_t>(size), at);
  at = body.SerializeWithCachedSizesToArray(at);
  return seal(static_cast<std::size_t>(at - begin));
}

std::span<const std::byte> Encoder::forward(std::span<const std::byte> payload) {
  std::memcpy(reserve(payload.size()), payload.data(), payload.size());
  return seal(payload.size());
}

void Decoder::refuse(const std::string& text) const {
  throw PeerError(peer_, "message " + std::to_string(sequence_ + 1) + ": " + text);
}

void Decoder::check_header(std::span<const std::byte> frame) {
  if (frame.size() < header_size) {
    refuse("found a frame of " + std::to_string(frame.size()) + " bytes, expected at least " +
           std::to_string(header_size));
  }
  if (std::memcmp(frame.data(), magic.data(), magic.size()) != 0) {
    refuse("expected a frame that starts with 'GSTP': the peer does not speak this protocol");
  }
  const auto version = load<std::uint32_t>(frame.data() + 4);
  if (version != PROTOCOL_VERSION) {
    refuse("the peer speaks protocol version " + std::to_string(version) + ", this program version " +
           std::to_string(PROTOCOL_VERSION) + ": update the older one");
  }
  const auto sequence = load<std::uint64_t>(frame.data() + 8);
  if (sequence != sequence_ + 1) {
    refuse("found sequence number " + std::to_string(sequence) + ", expected " + std::to_string(sequence_ + 1) +
           ": messages were lost or repeated");
  }
}

Frame Decoder::decode(std::span<const std::byte> frame) {
  check_header(frame);
  const auto payload = frame.subspan(header_size);
  const auto expected = load<std::uint64_t>(frame.data() + 16);
  const auto found = checksum(payload);
  if (found != expected) {
    refuse("checksum of the payload is " + hex(found) + ", its header says " + hex(expected) + ": damaged on its way");
  }
  Frame result;
  result.sequence = sequence_ + 1;
  if (!split(payload, result)) {
    refuse("the payload (" + std::to_string(payload.size()) + " bytes) is not an Envelope with exactly one body");
  }
  ++sequence_;
  return result;
}

std::optional<std::uint64_t> window_of(const Frame& frame) {
  using google::protobuf::internal::WireFormatLite;
  if (frame.kind != Envelope::kForces && frame.kind != Envelope::kKinematics && frame.kind != Envelope::kReport &&
      frame.kind != Envelope::kSnapshot && frame.kind != Envelope::kState && frame.kind != Envelope::kSaved) {
    return std::nullopt;
  }
  constexpr std::uint32_t window_tag = 1 << 3;  // field 1 of all of them, a varint
  CodedInputStream in(octets(frame.body), static_cast<int>(frame.body.size()));
  while (const std::uint32_t tag = in.ReadTag()) {
    std::uint64_t window = 0;
    if (tag == window_tag) {
      return in.ReadVarint64(&window) ? std::optional(window) : std::nullopt;
    }
    if (!WireFormatLite::SkipField(&in, tag)) {
      return std::nullopt;
    }
  }
  return in.ConsumedEntireMessage() ? std::optional<std::uint64_t>(0) : std::nullopt;  // absent: zero, as in proto3
}

std::string kind_name(Envelope::BodyCase kind) {
  const auto* const field = Envelope::descriptor()->FindFieldByNumber(kind);
  return field == nullptr ? "nothing" : field->message_type()->name();
}

std::string describe(const Frame& frame) {
  if (const auto window = window_of(frame)) {
    return kind_name(frame.kind) + " of window " + std::to_string(*window);
  }
  if (Error error; parse(frame, error)) {
    return "Error: " + error.text();
  }
  if (Stop stop; parse(frame, stop)) {
    return "Stop (" + stop.reason() + ")";
  }
  return kind_name(frame.kind);
}

}  // namespace grainstep::wire
