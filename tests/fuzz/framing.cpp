#include "framing.hpp"

#include <algorithm>

namespace grainstep::fuzz {
namespace {

constexpr std::size_t version_at = 4;
constexpr std::size_t sequence_at = 8;

template <class Unsigned>
Unsigned load(const std::byte* at) {
  Unsigned value = 0;
  for (std::size_t i = sizeof value; i-- > 0;) {
    value = static_cast<Unsigned>((std::uint64_t{value} << 8U) | std::to_integer<unsigned>(at[i]));
  }
  return value;
}

template <class Unsigned>
void store(std::byte* at, Unsigned value) {
  for (std::size_t i = 0; i < sizeof value; ++i) at[i] = static_cast<std::byte>(std::uint64_t{value} >> (8 * i));
}

void damage(const Said& said, transport::Bytes& frame) {
  if (said.other_version() != 0) store(frame.data() + version_at, said.other_version());
  if (said.lost_messages() != 0) {
    const auto sequence = load<std::uint64_t>(frame.data() + sequence_at);
    store(frame.data() + sequence_at, sequence + static_cast<std::uint64_t>(said.lost_messages()));
  }
  if (said.flipped_bit() != 0) {
    const std::size_t bit = (said.flipped_bit() - 1) % (8 * frame.size());
    frame[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
  }
  frame.resize(frame.size() - std::min<std::size_t>(frame.size(), said.cut()));
}

}  // namespace

const transport::Bytes& Framing::frame_of(const Said& said) {
  if (!said.frame().empty()) {
    const auto bytes = std::as_bytes(std::span(said.frame()));
    frame_.assign(bytes.begin(), bytes.end());
    return frame_;
  }
  const std::string own = said.payload().empty() ? said.message().SerializeAsString() : std::string();
  const auto sealed = encoder_.forward(std::as_bytes(std::span(said.payload().empty() ? own : said.payload())));
  frame_.assign(sealed.begin(), sealed.end());
  damage(said, frame_);
  return frame_;
}

}  // namespace grainstep::fuzz
