/// @file The conversation of all ranks with the other side: rank 0 holds the link, impulses are summed up to it and
/// surfaces are passed on from it. Failures of any rank travel the same way, so that nobody is left waiting.
#pragma once

#include <mpi.h>

#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "contact/moving_surface.hpp"
#include "participant/backend.hpp"

namespace grainstep::dem {

using contact::MovingSurface;

class RankExchange {
 public:
  /// `link`: rank 0's; nullptr on the other ranks.
  RankExchange(MPI_Comm communicator, participant::ImpactorLink* link, std::size_t nodes);

  /// Collective. Sums the ranks' nodal impulses of window n (N s) and sends them; empties `nodal`.
  void hand_over(std::uint64_t window, std::vector<surface::Vec2>& nodal);

  /// Collective. Waits for the surface at the end of window n and aims `surface` at it. False: the run ends here,
  /// because the other side ended it or because something failed on some rank.
  [[nodiscard]] bool receive(std::uint64_t window, MovingSurface& surface);

  /// This rank cannot go on. Takes effect on all ranks at the next receive().
  void fail(const std::string& text);
  /// Likewise, with the exception in flight, which finish() throws again on rank 0.
  void fail_with_current_exception();

  /// Rank 0 only: sends a report or a snapshot.
  template <typename Message>
  void send(Message& message) {
    if (failure_ || thrown_) return;
    try {
      link_->send(message);
    } catch (...) {
      fail_with_current_exception();
    }
  }

  /// Collective, after the run. Throws on rank 0 what failed on any rank.
  void finish();

  [[nodiscard]] bool is_root() const { return rank_ == 0; }
  [[nodiscard]] MPI_Comm communicator() const { return communicator_; }
  [[nodiscard]] int ranks() const { return ranks_; }

 private:
  [[nodiscard]] bool fetch(std::uint64_t window);
  [[nodiscard]] std::string gathered_failure() const;

  MPI_Comm communicator_;
  participant::ImpactorLink* link_;
  int rank_ = 0;
  int ranks_ = 1;
  wire::Forces forces_;
  std::vector<double> outgoing_;  ///< nodal impulses, then the number of failed ranks
  std::vector<double> summed_;
  std::vector<double> incoming_;  ///< 1 to go on or 0, positions, velocities
  bool failed_somewhere_ = false;
  std::optional<std::string> failure_;
  std::exception_ptr thrown_;
};

}  // namespace grainstep::dem
