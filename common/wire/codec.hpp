/// @file Messages to frames of bytes and back. A frame is a header of 24 bytes, little endian,
///
///     offset 0   u32  magic: the bytes 'G' 'S' 'T' 'P'
///            4   u32  Protocol.PROTOCOL_VERSION
///            8   u64  sequence number: one count for each direction, from 1, without gaps
///           16   u64  XXH3-64 of the payload
///
/// followed by the payload, a serialised wire::Envelope that holds exactly one body and nothing else.
///
/// Neither side allocates in a steady exchange: the encoder writes into its own buffer, the decoder only looks into the
/// frame, and parse() fills an object of the caller's, whose repeated fields keep their capacity.
#pragma once

#include <google/protobuf/message.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "grainstep/wire.pb.h"
#include "transport/channel.hpp"

namespace grainstep::wire {

inline constexpr std::size_t header_size = 24;

/// Which body of an Envelope a message is.
template <class Body>
inline constexpr Envelope::BodyCase kind_of = Envelope::BODY_NOT_SET;
template <>
inline constexpr Envelope::BodyCase kind_of<Hello> = Envelope::kHello;
template <>
inline constexpr Envelope::BodyCase kind_of<Setup> = Envelope::kSetup;
template <>
inline constexpr Envelope::BodyCase kind_of<Ready> = Envelope::kReady;
template <>
inline constexpr Envelope::BodyCase kind_of<Start> = Envelope::kStart;
template <>
inline constexpr Envelope::BodyCase kind_of<Forces> = Envelope::kForces;
template <>
inline constexpr Envelope::BodyCase kind_of<Kinematics> = Envelope::kKinematics;
template <>
inline constexpr Envelope::BodyCase kind_of<Report> = Envelope::kReport;
template <>
inline constexpr Envelope::BodyCase kind_of<Snapshot> = Envelope::kSnapshot;
template <>
inline constexpr Envelope::BodyCase kind_of<Stop> = Envelope::kStop;
template <>
inline constexpr Envelope::BodyCase kind_of<Finished> = Envelope::kFinished;
template <>
inline constexpr Envelope::BodyCase kind_of<Error> = Envelope::kError;

template <>
inline constexpr Envelope::BodyCase kind_of<Save> = Envelope::kSave;
template <>
inline constexpr Envelope::BodyCase kind_of<State> = Envelope::kState;
template <>
inline constexpr Envelope::BodyCase kind_of<Saved> = Envelope::kSaved;

template <class Message>
concept Body = kind_of<Message>
!= Envelope::BODY_NOT_SET;

/// A checked frame. Views into the bytes that were decoded; valid as long as they are.
struct Frame {
  std::uint64_t sequence = 0;
  Envelope::BodyCase kind = Envelope::BODY_NOT_SET;
  std::span<const std::byte> payload;  ///< the Envelope
  std::span<const std::byte> body;     ///< the message inside it
};

/// One per direction of a channel: it counts.
class Encoder {
 public:
  /// The frame of `body`; valid until the next call. No Envelope is built: the body is written behind its tag.
  template <Body Message>
  [[nodiscard]] std::span<const std::byte> encode(const Message& body) {
    return encode(kind_of<Message>, body);
  }

  /// The frame of a payload that another peer serialised: a hub passes it on without touching it.
  [[nodiscard]] std::span<const std::byte> forward(std::span<const std::byte> payload);

 private:
  std::span<const std::byte> encode(Envelope::BodyCase kind, const google::protobuf::MessageLite& body);
  std::byte* reserve(std::size_t payload_size);
  std::span<const std::byte> seal(std::size_t payload_size);

  transport::Bytes buffer_;  // grows only
  std::uint64_t sequence_ = 0;
};

class Decoder {
 public:
  /// `peer`: the sender's name in PeerErrors.
  explicit Decoder(std::string peer) : peer_(std::move(peer)) {}

  /// Checks size, magic, version, sequence, checksum and the Envelope's outer form. Throws PeerError that names what
  /// was found, what was expected and the sequence number.
  [[nodiscard]] Frame decode(std::span<const std::byte> frame);

 private:
  [[noreturn]] void refuse(const std::string& text) const;
  void check_header(std::span<const std::byte> frame);

  std::string peer_;
  std::uint64_t sequence_ = 0;  // of the last good frame
};

/// Parses the body of `frame` into `message`, whose kind must be the frame's. False when the bytes are not such a
/// message.
template <Body Message>
[[nodiscard]] bool parse(const Frame& frame, Message& message) {
  return frame.kind == kind_of<Message> &&
         message.ParseFromArray(frame.body.data(), static_cast<int>(frame.body.size()));
}

/// The window that a Forces, Kinematics, Report or Snapshot belongs to, read without parsing the rest; nullopt for
/// other kinds and for damaged bytes.
[[nodiscard]] std::optional<std::uint64_t> window_of(const Frame& frame);

/// For people: "Kinematics of window 17", "Hello", "Error: <its text>".
[[nodiscard]] std::string describe(const Frame& frame);

/// "Kinematics" for Envelope::kKinematics.
[[nodiscard]] std::string kind_name(Envelope::BodyCase kind);

}  // namespace grainstep::wire
