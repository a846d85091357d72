/// @file results.h5: rows and snapshots are kept in memory and written in bursts. A burst is visible as a whole or not
/// at all (twin_file.hpp), so that whatever ends this process leaves the last burst readable. docs/user/results.md is
/// the file's catalogue.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "results/hdf5.hpp"
#include "results/twin_file.hpp"

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
  h5::Packing packing = h5::Packing::none;
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

/// Names of all datasets, and how many rows each has; 0: it was written once.
using Contents = std::map<std::string, std::uint64_t>;

class ResultsFile {
 public:
  /// Creates the file with the texts in it. OutputError when it exists or cannot be written.
  ResultsFile(std::filesystem::path path, const std::vector<Text>& texts);

  /// Goes on with a file that held this when everything was flushed: what came later is taken away. OutputError where
  /// it holds less, or cannot be written.
  struct GoOn {};
  ResultsFile(GoOn mode, std::filesystem::path path, const Contents& contents);

  /// Of what was added up to now.
  [[nodiscard]] const Contents& contents() const { return contents_; }

  void add(const std::vector<Entry>& row);
  void add(const Line& line);
  void add(Array array);

  [[nodiscard]] std::size_t pending_bytes() const { return pending_.bytes; }

  /// Writes everything pending. On a full disk (OutputError) the file is as the last burst left it, whole and readable,
  /// and what was pending is dropped.
  void flush();

 private:
  struct Rows {
    h5::Meaning meaning;
    std::size_t columns = 0;
    std::vector<double> values;
    h5::Packing packing = h5::Packing::none;
  };

  /// What one burst writes.
  struct Burst {
    std::map<std::string, Rows> rows;
    std::vector<Array> arrays;
    std::size_t bytes = 0;

    void write_to(h5::File& file) const;
    void clear();
  };

  void write_bursts();

  TwinFile file_;
  Contents contents_;
  Burst pending_;
  Burst before_;  // the last one written: visible, but not in the twin yet
};

}  // namespace grainstep::results
