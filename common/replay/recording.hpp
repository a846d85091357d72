/// @file What a run has recorded of its surface, row by row.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "grainstep/record.pb.h"
#include "results/hdf5.hpp"

namespace grainstep::replay {

/// Rows are read in blocks, so that a record may be larger than the memory; who goes from row to row reads each once.
class Recording {
 public:
  /// `path`: the file, or the directory of its run. `key`: of the scene, for messages. InputError where it cannot be
  /// read, or is no record.
  Recording(const std::filesystem::path& path, const std::string& key);

  [[nodiscard]] const record::About& about() const { return about_; }
  [[nodiscard]] std::uint64_t last() const { return last_; }  ///< window: there are rows 0 to this one
  [[nodiscard]] double end() const { return static_cast<double>(last_) * about_.window(); }  ///< s

  /// What the impactor had at t = 0: J, and N s for each dimension; 0 where it had none, or did not say so.
  [[nodiscard]] double impactor_energy() const { return impactor_energy_; }
  [[nodiscard]] const std::vector<double>& impactor_momentum() const { return impactor_momentum_; }

  /// Of window n <= last(), nodes x dimension; valid until the next call of the same. InputError where the file is
  /// damaged.
  [[nodiscard]] std::span<const double> impulse(std::uint64_t window) { return row(impulse_, window); }    ///< N s
  [[nodiscard]] std::span<const double> position(std::uint64_t window) { return row(position_, window); }  ///< m
  [[nodiscard]] std::span<const double> velocity(std::uint64_t window) { return row(velocity_, window); }  ///< m/s

 private:
  struct Rows {
    const char* dataset;
    std::uint64_t first = 0;
    std::vector<double> values = {};
  };
  [[noreturn]] void refuse(const std::string& why) const;
  void read_about();
  void read_shapes();
  void read_books();
  [[nodiscard]] std::span<const double> row(Rows& rows, std::uint64_t window);

  std::string key_;
  std::filesystem::path path_;
  results::h5::File file_;
  record::About about_;
  std::uint64_t last_ = 0;
  std::size_t columns_ = 0;
  double impactor_energy_ = 0.0;
  std::vector<double> impactor_momentum_;
  Rows impulse_, position_, velocity_;
};

}  // namespace grainstep::replay
