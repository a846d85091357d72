/// @file The conversation of all MPI ranks with the other side: rank 0 holds the link, impulses are summed up to it and
/// surfaces are passed on from it. Failures of any rank travel the same way, so that nobody is left waiting.
#pragma once

#include <mpi.h>

#include "dem-service/slug/exchange.hpp"

namespace grainstep::dem {

/// Everything is collective but fail() and send().
class RankExchange final : public Exchange {
 public:
  RankExchange(MPI_Comm communicator, participant::ImpactorLink* link, std::size_t nodes);

  [[nodiscard]] bool is_root() const override { return rank_ == 0; }
  void sum(double* values, int count) const override;
  void largest(double* values, int count) const override;
  [[nodiscard]] std::vector<double> gathered(std::vector<double> mine) const override;

 private:
  void pass_on(double* values, int count) const override;
  [[nodiscard]] std::string first_of(std::string mine) const override;

  MPI_Comm communicator_;
  int rank_ = 0;
  int ranks_ = 1;
};

}  // namespace grainstep::dem
