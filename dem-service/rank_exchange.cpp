#include "dem-service/rank_exchange.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace grainstep::dem {
namespace {

int count_of(const std::vector<double>& values) { return static_cast<int>(values.size()); }

}  // namespace

RankExchange::RankExchange(MPI_Comm communicator, participant::ImpactorLink* link, std::size_t nodes)
    : communicator_(communicator),
      link_(link),
      outgoing_(2 * nodes + 1),
      summed_(2 * nodes + 1),
      incoming_(4 * nodes + 1) {
  MPI_Comm_rank(communicator_, &rank_);
  MPI_Comm_size(communicator_, &ranks_);
}

void RankExchange::hand_over(std::uint64_t window, std::vector<surface::Vec2>& nodal) {
  for (std::size_t i = 0; i < nodal.size(); ++i) {
    outgoing_[2 * i] = nodal[i][0];
    outgoing_[2 * i + 1] = nodal[i][1];
    nodal[i] = {};
  }
  outgoing_.back() = failure_ || thrown_ ? 1.0 : 0.0;
  if (ranks_ > 1) {
    MPI_Reduce(outgoing_.data(), summed_.data(), count_of(outgoing_), MPI_DOUBLE, MPI_SUM, 0, communicator_);
  } else {
    summed_ = outgoing_;
  }
  if (!is_root()) return;
  if (!std::all_of(summed_.begin(), summed_.end(), [](double x) { return std::isfinite(x); })) {
    fail(
        "the contact force on the structure is not a number: the computation is unstable; take shorter steps "
        "(steps.impactor)");
  }
  failed_somewhere_ = failed_somewhere_ || failure_ || summed_.back() > 0.0;
  if (failed_somewhere_) return;
  forces_.set_window(window);
  forces_.mutable_impulse()->Assign(summed_.begin(), summed_.end() - 1);
  send(static_cast<const wire::Forces&>(forces_));
}

bool RankExchange::fetch(std::uint64_t window) {
  if (failed_somewhere_ || failure_ || thrown_) return false;
  try {
    const wire::Kinematics* kinematics = link_->surface(window);
    if (kinematics == nullptr) return false;
    const auto expected = static_cast<int>(outgoing_.size() - 1);
    if (kinematics->window() != window || kinematics->position_size() != expected ||
        kinematics->velocity_size() != expected) {
      throw PeerError("structure", "expected kinematics of window " + std::to_string(window) + " with " +
                                       std::to_string(expected) + " coordinates, found window " +
                                       std::to_string(kinematics->window()) + " with " +
                                       std::to_string(kinematics->position_size()));
    }
    const auto velocities =
        std::copy(kinematics->position().begin(), kinematics->position().end(), incoming_.begin() + 1);
    std::copy(kinematics->velocity().begin(), kinematics->velocity().end(), velocities);
    return true;
  } catch (...) {
    fail_with_current_exception();
    return false;
  }
}

bool RankExchange::receive(std::uint64_t window, MovingSurface& surface) {
  if (is_root()) incoming_.front() = fetch(window) ? 1.0 : 0.0;
  if (ranks_ > 1) MPI_Bcast(incoming_.data(), count_of(incoming_), MPI_DOUBLE, 0, communicator_);
  if (incoming_.front() == 0.0) return false;
  surface.aim(incoming_.data() + 1, incoming_.data() + outgoing_.size());
  return true;
}

void RankExchange::fail(const std::string& text) {
  if (!failure_) failure_ = text;
}

void RankExchange::fail_with_current_exception() {
  if (!thrown_) thrown_ = std::current_exception();
  try {
    throw;
  } catch (const std::exception& error) {
    fail(error.what());
  } catch (...) {
    fail("unknown exception");
  }
}

std::string RankExchange::gathered_failure() const {
  const std::string mine = failure_.value_or("");
  const int length = static_cast<int>(mine.size());
  std::vector<int> lengths(static_cast<std::size_t>(ranks_));
  MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, communicator_);
  // The first rank that has something to say speaks for all.
  const auto speaker = std::find_if(lengths.begin(), lengths.end(), [](int l) { return l > 0; });
  if (speaker == lengths.end()) return {};
  std::string text = mine;
  text.resize(static_cast<std::size_t>(*speaker));
  MPI_Bcast(text.data(), *speaker, MPI_CHAR, static_cast<int>(speaker - lengths.begin()), communicator_);
  return text;
}

void RankExchange::finish() {
  const std::string text = gathered_failure();
  if (!is_root()) return;
  if (thrown_) std::rethrow_exception(thrown_);
  if (!text.empty()) throw NumericalError(text);
}

}  // namespace grainstep::dem
