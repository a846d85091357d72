#include "dem-service/lammps/rank_exchange.hpp"

#include <algorithm>

namespace grainstep::dem {
namespace {

void reduce(double* values, int count, MPI_Op operation, int rank, MPI_Comm communicator) {
  MPI_Reduce(rank == 0 ? MPI_IN_PLACE : values, values, count, MPI_DOUBLE, operation, 0, communicator);
}

}  // namespace

RankExchange::RankExchange(MPI_Comm communicator, participant::ImpactorLink* link, std::size_t nodes)
    : Exchange(link, nodes), communicator_(communicator) {
  MPI_Comm_rank(communicator_, &rank_);
  MPI_Comm_size(communicator_, &ranks_);
}

void RankExchange::sum(double* values, int count) const {
  if (ranks_ > 1) reduce(values, count, MPI_SUM, rank_, communicator_);
}

void RankExchange::largest(double* values, int count) const {
  if (ranks_ > 1) reduce(values, count, MPI_MAX, rank_, communicator_);
}

void RankExchange::pass_on(double* values, int count) const {
  if (ranks_ > 1) MPI_Bcast(values, count, MPI_DOUBLE, 0, communicator_);
}

std::vector<double> RankExchange::gathered(std::vector<double> mine) const {
  if (ranks_ == 1) return mine;
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(static_cast<std::size_t>(ranks_));
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, communicator_);
  std::vector<int> offsets;
  int total = 0;
  for (const int of_rank : counts) {
    offsets.push_back(total);
    total += of_rank;
  }
  std::vector<double> all(static_cast<std::size_t>(total));
  MPI_Gatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), offsets.data(), MPI_DOUBLE, 0, communicator_);
  return all;
}

std::string RankExchange::first_of(std::string mine) const {
  const int length = static_cast<int>(mine.size());
  std::vector<int> lengths(static_cast<std::size_t>(ranks_));
  MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, communicator_);
  const auto speaker = std::find_if(lengths.begin(), lengths.end(), [](int l) { return l > 0; });
  if (speaker == lengths.end()) return {};
  mine.resize(static_cast<std::size_t>(*speaker));
  MPI_Bcast(mine.data(), *speaker, MPI_CHAR, static_cast<int>(speaker - lengths.begin()), communicator_);
  return mine;
}

}  // namespace grainstep::dem
