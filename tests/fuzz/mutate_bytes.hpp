/// @file Damage to bytes that were a message once.
#pragma once

#include <random>
#include <string>

namespace grainstep::fuzz {

/// Bits, bytes and stretches of them: changed, removed, put in, repeated. `bytes` may grow by some.
void damage_bytes(std::string& bytes, std::mt19937_64& random);

/// Up to 64 bytes from nowhere.
[[nodiscard]] std::string bytes_of_any(std::mt19937_64& random);

}  // namespace grainstep::fuzz
