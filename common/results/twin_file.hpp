/// @file A file that grows in bursts and is whole whenever anybody opens it, whatever ends the process that writes.
///
/// Two copies take turns. The visible one is never written: a burst goes to its twin beside it (PATH.next), and then
/// the two exchange their names in one step. So death at any instant leaves the visible file as one of two bursts left
/// it. The price is the file's space a second time while the run goes on, and every byte written twice.
///
///     const bool fresh = file.open();  // fresh: a copy of the visible file; else it lacks the last burst
///     ... write to file.twin(), close it ...
///     file.exchange();                 // or file.abandon(), where writing failed
#pragma once

#include <filesystem>

namespace grainstep::results {

class TwinFile {
 public:
  /// `visible` must be there before open() is called; it belongs to this object from then on.
  explicit TwinFile(std::filesystem::path visible);
  ~TwinFile();  ///< removes what stands beside the visible file
  TwinFile(const TwinFile&) = delete;
  TwinFile& operator=(const TwinFile&) = delete;

  /// Makes sure that there is a twin to write to. True: it was copied from the visible file just now. False: it is what
  /// was visible before the last exchange. OutputError where it cannot be made.
  [[nodiscard]] bool open();
  /// The twin, closed by whoever wrote it, is what is visible from now on; durable (fsync) before it is. OutputError
  /// where the system refuses: the visible file is as it was.
  void exchange();
  /// The twin's contents are lost; the next open() makes a fresh one.
  void abandon() noexcept;

  [[nodiscard]] const std::filesystem::path& visible() const { return visible_; }
  [[nodiscard]] const std::filesystem::path& twin() const { return twin_; }

  /// What may stand beside `visible` when its writer was killed.
  static constexpr const char* leftovers[] = {".next", ".last"};

 private:
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path visible_;
  std::filesystem::path twin_;
  std::filesystem::path last_;  // the file that was visible, for the moment between two renames
  bool open_ = false;
};

}  // namespace grainstep::results
