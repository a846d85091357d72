/// @file A thin layer over the HDF5 C library: handles that close themselves, every return value looked at, and the few
/// operations that results need. Object times are not tracked, so that equal contents are equal bytes of metadata.
/// Errors: OutputError with the file, the dataset and the library's innermost message.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace grainstep::results::h5 {

/// Owns one identifier of the library.
class Handle {
 public:
  using Closer = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
  Handle& operator=(Handle&& other) noexcept;
  ~Handle() { static_cast<void>(close()); }

  [[nodiscard]] hid_t get() const { return id_; }
  [[nodiscard]] bool close();  ///< false when the library reports an error

 private:
  hid_t id_ = -1;
  Closer closer_ = nullptr;
};

/// What every dataset says about itself.
struct Meaning {
  std::string unit;   ///< UDUNITS spelling; empty: a pure number
  std::string title;  ///< one line
};

/// How rows lie in the file. Packed ones are compressed without loss, and each chunk has a checksum.
enum class Packing { none, packed };

class File {
 public:
  [[nodiscard]] static File create(const std::filesystem::path& path);  ///< the file must not exist
  [[nodiscard]] static File open(const std::filesystem::path& path);    ///< for reading and appending
  [[nodiscard]] static File read(const std::filesystem::path& path);    ///< for reading only

  /// Appends rows to a dataset of shape [rows x columns] ([rows] when columns == 0), made on first use with its groups.
  void append(const std::string& dataset, std::span<const double> values, std::size_t columns, const Meaning& meaning,
              Packing packing = Packing::none);
  void append(const std::string& dataset, std::span<const std::uint64_t> values, const Meaning& meaning);

  /// A dataset that is written once. Shape [n], or [n / columns x columns].
  void write(const std::string& dataset, std::span<const double> values, std::size_t columns, const Meaning& meaning);
  void write(const std::string& dataset, std::span<const std::uint32_t> values, std::size_t columns,
             const Meaning& meaning);
  void write(const std::string& dataset, const std::string& text, const std::string& title);
  void attribute(const std::string& object, const std::string& name, double value);

  /// Leaves the first rows of a dataset that append() has made.
  void shrink(const std::string& dataset, std::uint64_t rows);
  /// And the groups that it was the last in.
  void remove(const std::string& dataset);

  [[nodiscard]] bool has(const std::string& dataset) const;
  [[nodiscard]] std::vector<std::string> datasets() const;
  [[nodiscard]] std::vector<double> read_doubles(const std::string& dataset) const;
  /// Rows and columns of a dataset of numbers; columns of a vector: 0.
  struct Shape {
    std::uint64_t rows = 0, columns = 0;
  };
  [[nodiscard]] Shape shape(const std::string& dataset) const;
  /// `rows` rows from the `first` on, as many as `out` has room for.
  void read_rows(const std::string& dataset, std::uint64_t first, std::uint64_t rows, std::span<double> out) const;
  [[nodiscard]] std::string read_text(const std::string& dataset) const;

  /// Closes the file: everything is on its way to the disk when this returns.
  void close();

 private:
  File(Handle file, std::filesystem::path path);
  [[noreturn]] void fail(const std::string& what) const;
  [[nodiscard]] Handle take(hid_t id, Handle::Closer closer, const std::string& what) const;
  void require(herr_t result, const std::string& what) const;
  struct Kind {
    hid_t type;
    Packing packing = Packing::none;
  };
  void append_rows(const std::string& dataset, const void* values, std::size_t count, std::size_t columns, Kind kind,
                   const Meaning& meaning);
  void write_array(const std::string& dataset, const void* values, std::size_t count, std::size_t columns, hid_t type,
                   const Meaning& meaning);
  [[nodiscard]] Handle make_extendable(const std::string& dataset, std::size_t columns, Kind kind,
                                       const Meaning& meaning) const;
  void label(hid_t object, const Meaning& meaning) const;
  void text_attribute(hid_t object, const char* name, const std::string& text) const;

  std::filesystem::path path_;
  Handle file_;
  Handle links_;  // link creation: makes missing groups
};

}  // namespace grainstep::results::h5
