#include "dem-service/slug/exchange.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace grainstep::dem {
namespace {

int count_of(const std::vector<double>& values) { return static_cast<int>(values.size()); }

}  // namespace

Exchange::Exchange(participant::ImpactorLink* link, std::size_t nodes)
    : link_(link), outgoing_(2 * nodes + 1), incoming_(4 * nodes + 1) {}

void Exchange::hand_over(std::uint64_t window, std::vector<surface::Vec2>& nodal) {
  for (std::size_t i = 0; i < nodal.size(); ++i) {
    outgoing_[2 * i] = nodal[i][0];
    outgoing_[2 * i + 1] = nodal[i][1];
    nodal[i] = {};
  }
  outgoing_.back() = failure_ || thrown_ ? 1.0 : 0.0;
  sum(outgoing_.data(), count_of(outgoing_));
  if (!is_root()) return;
  if (!std::all_of(outgoing_.begin(), outgoing_.end(), [](double x) { return std::isfinite(x); })) {
    fail(
        "the contact force on the structure is not a number: the computation is unstable; take shorter steps "
        "(steps.impactor)");
  }
  failed_somewhere_ = failed_somewhere_ || failure_ || outgoing_.back() > 0.0;
  if (failed_somewhere_) return;
  forces_.set_window(window);
  forces_.mutable_impulse()->Assign(outgoing_.begin(), outgoing_.end() - 1);
  send(static_cast<const wire::Forces&>(forces_));
}

bool Exchange::fetch(std::uint64_t window) {
  if (failed_somewhere_ || failure_ || thrown_) return false;
  try {
    const wire::Kinematics* kinematics = link_->surface(window);
    if (kinematics == nullptr) return false;
    const int expected = count_of(outgoing_) - 1;
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

bool Exchange::receive(std::uint64_t window, MovingSurface& surface) {
  if (is_root()) incoming_.front() = fetch(window) ? 1.0 : 0.0;
  pass_on(incoming_.data(), count_of(incoming_));
  if (incoming_.front() == 0.0) return false;
  surface.aim(incoming_.data() + 1, incoming_.data() + outgoing_.size());
  return true;
}

void Exchange::fail(const std::string& text) {
  if (!failure_) failure_ = text;
}

void Exchange::fail_with_current_exception() {
  if (!thrown_) thrown_ = std::current_exception();
  try {
    throw;
  } catch (const std::exception& error) {
    fail(error.what());
  } catch (...) {
    fail("unknown exception");
  }
}

void Exchange::finish() {
  const std::string text = first_of(failure_.value_or(""));
  if (!is_root()) return;
  if (thrown_) std::rethrow_exception(thrown_);
  if (!text.empty()) throw NumericalError(text);
}

}  // namespace grainstep::dem
