#include "mutate.hpp"

#include <algorithm>

#include "mutate_bytes.hpp"
#include "mutate_fields.hpp"

namespace grainstep::fuzz {
namespace {

constexpr int most_messages = 64;

int any_of(int count, Random& random) { return static_cast<int>(random() % static_cast<std::uint64_t>(count)); }

/// Drops, repeats, exchanges messages.
void change_order(Script& script, Random& random) {
  auto& said = *script.mutable_said();
  const int at = any_of(said.size(), random);
  const int other = any_of(said.size(), random);
  switch (random() % 4) {
    case 0:
      said.DeleteSubrange(at, 1);
      break;
    case 1:
      if (said.size() < most_messages) *said.Add() = Said(said.Get(at));
      if (said.size() > 1) said.SwapElements(other, said.size() - 1);
      break;
    case 2:
      said.SwapElements(at, other);
      break;
    default:
      said.DeleteSubrange(at, said.size() - at);
  }
}

/// Damage that a checksum, a header or the order of turns is there for.
void damage_frame(Said& said, Random& random) {
  switch (random() % 6) {
    case 0:
      said.set_flipped_bit(1 + static_cast<std::uint32_t>(random() % (8 * (24 + said.ByteSizeLong()))));
      break;
    case 1:
      said.set_cut(static_cast<std::uint32_t>(random() % (1 + said.ByteSizeLong())));
      break;
    case 2:
      said.set_lost_messages(static_cast<std::int64_t>(random() % 5) - 2);
      break;
    case 3:
      said.set_other_version(static_cast<std::uint32_t>(random() % 4));
      break;
    case 4:
      said.set_after(said.after() + static_cast<std::uint32_t>(random() % 5) - 2);
      break;
    default:
      said.set_frame(bytes_of_any(random));
  }
}

/// The checksum is right, what it is of is not quite an Envelope.
void damage_payload(Said& said, Random& random) {
  if (said.payload().empty()) said.set_payload(said.message().SerializeAsString());
  damage_bytes(*said.mutable_payload(), random);
}

void change_once(Script& script, Random& random) {
  if (script.said().empty()) {
    script.add_said()->mutable_message()->mutable_hello()->set_protocol(wire::PROTOCOL_VERSION);
    return;
  }
  const std::uint64_t kind = random() % 100;
  if (kind < 12) return change_order(script, random);
  if (kind < 13) return script.set_hangs_up(!script.hangs_up());
  if (kind < 14) return script.set_variant(static_cast<std::uint32_t>(random() % 16));
  Said& said = *script.mutable_said(any_of(script.said_size(), random));
  if (kind < 19) return damage_frame(said, random);
  if (kind < 27 || !said.payload().empty()) return damage_payload(said, random);
  change_field(*said.mutable_message(), random);
}

}  // namespace

void mutate(Script& script, Random& random) {
  // Mostly one alone: what comes after a lie is heard only where the lie is believed.
  do {
    change_once(script, random);
  } while (random() % 3 == 0);
}

void cross(Script& script, const Script& other, Random& random) {
  if (script.said().empty() || other.said().empty()) return;
  auto& said = *script.mutable_said();
  const int keep = any_of(said.size() + 1, random);
  said.DeleteSubrange(keep, said.size() - keep);
  for (int i = any_of(other.said_size(), random); i < other.said_size() && said.size() < most_messages; ++i) {
    *said.Add() = other.said(i);
  }
}

}  // namespace grainstep::fuzz
