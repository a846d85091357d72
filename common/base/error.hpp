/// @file The ways in which a run can end badly, one exception class for each exit code.
/// What a user can cause is an InputError; what the numbers do, a NumericalError; what a peer does, a PeerError; a full
/// or failing disk, an OutputError. Our own bugs are assertions (assert.hpp) and are never caught.
#pragma once

#include <stdexcept>
#include <string>

namespace grainstep {

/// Exit codes of every program of the project.
enum class ExitCode : int {
  done = 0,
  unforeseen = 1,
  bad_input = 2,
  numerical = 3,
  peer = 4,
  output = 5,
  interrupted = 130
};

/// The user's input cannot be computed. The text says where, what was found, what was expected and what to do.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The computation left its range of validity: unstable, not a number, a guard's limit exceeded.
class NumericalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A peer was lost, kept silent beyond a deadline, or broke the protocol.
class PeerError : public std::runtime_error {
 public:
  PeerError(std::string peer, const std::string& text)
      : std::runtime_error(peer + ": " + text), peer_(std::move(peer)), text_(text) {}
  [[nodiscard]] const std::string& peer() const noexcept { return peer_; }
  [[nodiscard]] const std::string& text() const noexcept { return text_; }  ///< what(), without the peer's name

 private:
  std::string peer_;
  std::string text_;
};

/// Results could not be written: no space, no permission any more, a failing disk.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace grainstep
