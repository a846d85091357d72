/// @file The history of contacts while particles are on the move: with each particle the list of those it touches.
/// Lists share one pool; a particle's list is the place where it begins, so moving a particle moves one number.
#pragma once

#include <cstdint>
#include <vector>

#include "dem-service/pair/batch.hpp"

namespace grainstep::dem {

class Partners {
 public:
  struct Entry {
    std::int32_t partner;  ///< its identity
    std::int32_t next;
    double value[most_history_values];
  };
  static constexpr std::int32_t none = -1;

  void grow(int particles) { first_.resize(static_cast<std::size_t>(particles), none); }
  void clear() {
    entries_.clear();
    first_.assign(first_.size(), none);
  }
  void clear(int particle) { first_[static_cast<std::size_t>(particle)] = none; }
  void move(int from, int to) { first_[static_cast<std::size_t>(to)] = first_[static_cast<std::size_t>(from)]; }

  /// A new entry of a particle's, with values to be filled in.
  Entry& add(int particle, std::int32_t partner) {
    std::int32_t& first = first_[static_cast<std::size_t>(particle)];
    entries_.push_back({partner, first, {}});
    first = static_cast<std::int32_t>(entries_.size() - 1);
    return entries_.back();
  }
  [[nodiscard]] std::int32_t first_of(int particle) const { return first_[static_cast<std::size_t>(particle)]; }
  [[nodiscard]] const Entry& entry(std::int32_t number) const { return entries_[static_cast<std::size_t>(number)]; }

  [[nodiscard]] int count_of(int particle) const {
    int count = 0;
    for (auto e = first_of(particle); e != none; e = entry(e).next) ++count;
    return count;
  }
  /// nullptr where the particle does not touch that partner.
  [[nodiscard]] const Entry* find(int particle, std::int32_t partner) const {
    for (auto e = first_of(particle); e != none; e = entry(e).next) {
      if (entry(e).partner == partner) return &entry(e);
    }
    return nullptr;
  }

 private:
  std::vector<std::int32_t> first_;
  std::vector<Entry> entries_;
};

}  // namespace grainstep::dem
