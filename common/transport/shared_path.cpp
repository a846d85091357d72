#include "transport/shared_path.hpp"

#include <algorithm>
#include <atomic>
#include <new>
#include <stdexcept>

namespace grainstep::transport {
namespace {

constexpr std::uint64_t layout = 0x3148545041505347;  // "GSPAPTH1": raised by every change of what is written here
constexpr std::uint64_t ring_bytes = 2U << 20U;       // whoever listens comes by every millisecond
constexpr std::uint64_t fewest_slots = 16;
constexpr std::uint64_t most_slots = 1024;
constexpr unsigned participants = 2;

}  // namespace

struct SharedPath::Header {
  std::uint64_t layout;
  RingShape shape;
  alignas(64) std::atomic<std::uint32_t> came;  ///< participants that have opened it
  std::uint32_t padding[15];
};

SharedPath::Header& SharedPath::header() const {
  return *std::launder(reinterpret_cast<Header*>(memory_.bytes().data()));
}

SharedPath SharedPath::create(std::uint64_t longest) {
  const RingShape shape{
      .slot_bytes = longest,
      .slots = std::clamp(ring_bytes / std::max<std::uint64_t>(longest, 1), fewest_slots, most_slots)};
  SharedPath path(SharedMemory::create(sizeof(Header) + 2 * SharedRing::bytes_for(shape)));
  path.shape_ = shape;
  path.header().shape = shape;
  path.header().layout = layout;
  return path;
}

SharedPath SharedPath::open(const std::filesystem::path& file) {
  SharedPath path(SharedMemory::open(file));
  const std::size_t found = path.memory_.bytes().size();
  const auto refuse = [&] {
    throw std::range_error(file.string() + ": no path of data of this version: " + std::to_string(found) + " bytes");
  };
  if (found < sizeof(Header) || path.header().layout != layout) refuse();
  path.shape_ = path.header().shape;
  const RingShape& shape = path.shape_;
  if (shape.slots == 0 || shape.slots > most_slots || shape.slot_bytes > found) refuse();
  if (found != sizeof(Header) + 2 * SharedRing::bytes_for(shape)) refuse();
  path.header().came.fetch_add(1, std::memory_order_release);
  return path;
}

SharedRing SharedPath::ring(Way way) const {
  const std::size_t bytes = SharedRing::bytes_for(shape_);
  return {memory_.bytes().subspan(sizeof(Header) + (way == Way::forces ? 0 : bytes), bytes), shape_};
}

void SharedPath::close_door() {
  if (!open_ || header().came.load(std::memory_order_acquire) < participants) return;
  memory_.remove_name();
  open_ = false;
}

}  // namespace grainstep::transport
