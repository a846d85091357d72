/// @file The conversation of an engine with the other side: impulses go out, surfaces come in. An engine that shares
/// its particles among several processes sums and passes on what each has (rank_exchange.hpp); here is what one alone
/// needs.
#pragma once

#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "contact/moving_surface.hpp"
#include "participant/backend.hpp"

namespace grainstep::dem {

using contact::MovingSurface;

class Exchange {
 public:
  /// `link`: of the process that talks to the other side, the root; nullptr elsewhere.
  Exchange(participant::ImpactorLink* link, std::size_t nodes);
  virtual ~Exchange() = default;
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;
  Exchange(Exchange&&) = delete;
  Exchange& operator=(Exchange&&) = delete;

  /// hand_over() is next, within microseconds.
  void announce() {
    if (link_) link_->soon();
  }

  /// Sends the nodal impulses of window n (N s), summed over all processes; empties `nodal`.
  void hand_over(std::uint64_t window, std::vector<surface::Vec2>& nodal);

  /// Waits for the surface at the end of window n and aims `surface` at it. False: the run ends here, because the other
  /// side ended it or because something failed in some process.
  [[nodiscard]] bool receive(std::uint64_t window, MovingSurface& surface);

  /// This process cannot go on. Takes effect in all of them at the next receive().
  void fail(const std::string& text);
  /// Likewise, with the exception in flight, which finish() throws again on the root.
  void fail_with_current_exception();

  /// Root only: sends a report or a snapshot.
  template <typename Message>
  void send(Message& message) {
    if (failure_ || thrown_) return;
    try {
      link_->send(message);
    } catch (...) {
      fail_with_current_exception();
    }
  }

  /// The state of window n (participant/backend.hpp), of an engine that has it in one process.
  [[nodiscard]] bool wants_state(std::uint64_t window) { return link_ != nullptr && link_->wants_state(window); }
  void send_state(const std::string& state) { link_->send_state(state); }

  /// After the run. Throws on the root what failed in any process.
  void finish();

  [[nodiscard]] virtual bool is_root() const { return true; }
  /// Over all processes, in place; the result counts on the root.
  virtual void sum(double* /*values*/, int /*count*/) const {}
  virtual void largest(double* /*values*/, int /*count*/) const {}
  /// One process's values after the other; complete on the root.
  [[nodiscard]] virtual std::vector<double> gathered(std::vector<double> mine) const { return mine; }

 private:
  /// The root's values everywhere.
  virtual void pass_on(double* /*values*/, int /*count*/) const {}
  /// What the first process with something to say has to say, everywhere.
  [[nodiscard]] virtual std::string first_of(std::string mine) const { return mine; }

  [[nodiscard]] bool fetch(std::uint64_t window);

  participant::ImpactorLink* link_;
  wire::Forces forces_;
  std::vector<double> outgoing_;  ///< nodal impulses, then the number of processes that failed
  std::vector<double> incoming_;  ///< 1 to go on or 0, positions, velocities
  bool failed_somewhere_ = false;
  std::optional<std::string> failure_;
  std::exception_ptr thrown_;
};

}  // namespace grainstep::dem
