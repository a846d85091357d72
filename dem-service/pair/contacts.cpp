#include "dem-service/pair/contacts.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/instruction_set.hpp"

namespace grainstep::dem {

// Defined by the copies of kernel.cpp.
#if defined(__x86_64__) && !defined(GRAINSTEP_ONE_KERNEL)
extern const PairKernels pair_kernels_x86_64;
extern const PairKernels pair_kernels_x86_64_v3;
extern const PairKernels pair_kernels_x86_64_v4;
#else
extern const PairKernels pair_kernels_generic;
#endif

namespace {

constexpr std::uint32_t no_pair = std::numeric_limits<std::uint32_t>::max();

std::vector<const PairKernels*> detect() {
  std::vector<const PairKernels*> found;
#if defined(__x86_64__) && !defined(GRAINSTEP_ONE_KERNEL)
  if (x86_level() >= X86Level::v4) found.push_back(&pair_kernels_x86_64_v4);
  if (x86_level() >= X86Level::v3) found.push_back(&pair_kernels_x86_64_v3);
  found.push_back(&pair_kernels_x86_64);
#else
  found.push_back(&pair_kernels_generic);
#endif
  return found;
}

}  // namespace

const std::vector<const PairKernels*>& available_pair_kernels() {
  static const std::vector<const PairKernels*> kernels = detect();
  return kernels;
}

void PairContacts::Contacts::reserve(std::size_t contacts, int values) {
  const std::size_t room = contacts + batch_lanes + 1;
  if (pair.size() >= room) return;
  const std::size_t capacity = room + room / 2;
  pair.resize(capacity);
  for (int h = 0; h < values; ++h) value[h].resize(capacity);
}

void PairContacts::Contacts::end(int values) {
  pair[size] = no_pair;
  for (int h = 0; h < values; ++h) value[h][size] = 0.0;
}

PairContacts::PairContacts(const PairLaw& law, const PairFeatures& features)
    : law_(law),
      features_(features),
      layout_(history_layout(features.dimension, features.friction)),
      kernel_(available_pair_kernels().front()->of(features)) {
  clear(0.0);
}

void PairContacts::clear(double largest_radius) {
  nearly_ = 4.0 * largest_radius * largest_radius;  // a power of two times a square: never below a pair's own (r+r)^2
  own_pairs_.clear();
  pairs_ = {};
  now_.size = 0;
  now_.reserve(0, layout_.values);
  now_.end(layout_.values);
}

void PairContacts::set_equal(double radius, double mass) {
  equal_radius_ = radius;
  std::fill(std::begin(batch_.reach), std::end(batch_.reach), radius + radius);
  std::fill(std::begin(batch_.effective_mass), std::end(batch_.effective_mass), mass * mass / (mass + mass));
}

void PairContacts::adopt(std::size_t pair, const double* values) {
  now_.reserve(now_.size + 1, layout_.values);
  now_.pair[now_.size] = static_cast<std::uint32_t>(pair);
  for (int h = 0; h < layout_.values; ++h) now_.value[h][now_.size] = values[h];
  ++now_.size;
  now_.end(layout_.values);
}

void PairContacts::adopt_all(const std::vector<std::uint32_t>& touching, const std::vector<double>& history) {
  const auto values = static_cast<std::size_t>(layout_.values);
  if (history.size() != touching.size() * values) throw std::range_error("histories of other contacts");
  for (std::size_t n = 0; n < touching.size(); ++n) {
    if (touching[n] >= pairs_.size()) throw std::range_error("a contact of no pair");
    adopt(touching[n], history.data() + n * values);
  }
}

}  // namespace grainstep::dem
