/// @file results.h5: rows and snapshots are kept in memory and written in bursts. Between two bursts the file is
/// closed, so that whatever ends this process leaves the last burst readable. docs/user/results.md is the file's
/// catalogue.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "results/hdf5.hpp"

namespace grainstep::results {

/// One value of a row: a dataset of its own, so that a reader takes what it wants by name.
struct Entry {
  std::string dataset;  ///< e.g. "/series/time"
  h5::Meaning meaning;
  double value = 0.0;
};

/// A row of many values, e.g. a pressure profile: one row of a matrix.
struct Line {
  std::string dataset;
  h5::Meaning meaning;
  std::vector<double> values;
};

/// Something written once, when the next burst comes.
struct Array {
  std::string dataset;
  h5::Meaning meaning;
  std::size_t columns = 0;  ///< 0: a vector
  std::vector<double> values;
  std::vector<std::uint32_t> indices;  ///< used instead of values when not empty
};

struct Text {
  std::string dataset;
  std::string title;
  std::string contents;
};

class ResultsFile {
 public:
  /// Creates the file with the texts in it. OutputError when it exists or cannot be written.
  ResultsFile(std::filesystem::path path, const std::vector<Text>& texts);

  void add(const std::vector<Entry>& row);
  void add(const Line& line);
  void add(Array array);

  [[nodiscard]] std::size_t pending_bytes() const { return pending_bytes_; }

  /// Writes everything pending. The space is reserved first: on a full disk (OutputError) the file is as the last burst
  /// left it, whole and readable, and what was pending is dropped.
  void flush();

 private:
  struct Rows {
    h5::Meaning meaning;
    std::size_t columns = 0;
    std::vector<double> values;
  };

  void reserve() const;
  void write_pending();

  std::filesystem::path path_;
  std::map<std::string, Rows> rows_;
  std::vector<Array> arrays_;
  std::size_t pending_bytes_ = 0;
};

}  // namespace grainstep::results
