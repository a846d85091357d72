/// @file Keys that encrypt and authenticate tcp connections (CURVE). A directory holds up to four files:
///
///     orchestrator.key  orchestrator.pub     secret and public key of the orchestrator
///     participant.key   participant.pub      secret and public key shared by a run's participants
///
/// The orchestrator needs orchestrator.key and participant.pub, a participant participant.key and orchestrator.pub.
/// Between themselves participants know each other by the pair that they share.
#pragma once

#include <array>
#include <filesystem>
#include <string>

namespace grainstep::transport {

inline constexpr std::size_t key_text_size = 40;  // Z85, as libzmq takes and prints it

/// What one end needs: its own pair and the public key of the other end.
struct CurveKeys {
  std::string own_secret;
  std::string own_public;
  std::string peer_public;
};

enum class Side { orchestrator, participant, among_participants };

/// Makes the directory (readable by its owner only) and the four files. InputError where one of them exists already:
/// keys in use are never overwritten.
void make_keys(const std::filesystem::path& directory);

/// InputError when a file is missing, is not a key, or is a secret that others than its owner may read.
[[nodiscard]] CurveKeys load_keys(const std::filesystem::path& directory, Side side);

/// The 32 bytes of a key in text form, as ZAP requests carry them.
[[nodiscard]] std::array<std::uint8_t, 32> key_bytes(const std::string& text);

}  // namespace grainstep::transport
