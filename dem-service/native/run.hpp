/// @file One run of the native engine: moves grains, keeps the lists good, lets contact and driver have their turn.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/archive.hpp"
#include "dem-service/native/contacts.hpp"
#include "dem-service/native/engine.hpp"
#include "dem-service/native/flight.hpp"
#include "dem-service/native/neighbours.hpp"
#include "dem-service/native/pair_law.hpp"
#include "dem-service/slug/step_driver.hpp"
#include "participant/resumed.hpp"

namespace grainstep::dem::native {

using surface::Vec3;

// What grains may move until the list is made anew, over the mean diameter. Longer lists cost in every step, making
// them costs now and then: docs/decisions/0019 has the measurements.
inline constexpr double slow_allowance = 0.35;
inline constexpr double fast_allowance = 1.0;
inline constexpr double inner_share = 0.25;  // of it, until the inner list is
// Sleepers are woken when something is so near, and all of them at once that are no further than this. In one step a
// surface moves by half a diameter at most, or the run ends (StepDriver).
inline constexpr double room_to_wake = 0.75;
inline constexpr double room_awake = 3.0;

template <int D>
class Run {
 public:
  Run(const SlugModel& model, const wire::ImpactorSetup& setup, const wire::Start& start,
      participant::ImpactorLink& link, const Watch& watch, int threads, std::vector<PlacedParticle> particles)
      : watch_(watch),
        team_(std::min(threads, Blocks{static_cast<std::int32_t>(particles.size()),
                                       native::block_size(static_cast<std::int32_t>(particles.size()))}
                                    .count())),
        start_(start),
        dt_(start.window() / start.impactor_steps()),
        diameter_(model.diameter),
        law_(calibrated_pair_law(model, dt_)),
        flight_(model, particles),
        grains_(model, particles, flight_.identities()),
        allowance_{slow_allowance * model.diameter, fast_allowance * model.diameter},
        inner_allowance_{inner_share * allowance_.slow, inner_share * allowance_.fast},
        refreshable_{allowance_.slow - inner_allowance_.slow, allowance_.fast - inner_allowance_.fast},
        neighbours_(sweeps_, allowance_, inner_allowance_),
        block_size_(native::block_size(grains_.count())),
        contacts_(pair_law(law_), features_of<D>(model), grains_, {grains_.count(), block_size_}),
        resumed_(participant::resumed(start, link)),
        exchange_(&link, MovingSurface(setup.surface()).node_count()),
        driver_(model, start, {.dt = dt_, .margin = model.diameter}, MovingSurface(setup.surface()), exchange_) {}

  void run() {
    try {
      const std::uint64_t steps = start_.windows() * start_.impactor_steps();
      for (std::uint64_t n = begin() + 1; n <= steps && !driver_.ended(); ++n) {
        move(n);
        forces(n);
      }
    } catch (...) {
      exchange_.fail_with_current_exception();
    }
    exchange_.finish();
  }

  /// All that decides a bit of what follows.
  template <class Archive>
  void serialize(Archive& archive) {
    archive("flight", flight_);
    archive("grains", grains_);
    archive("neighbours", neighbours_);
    contacts_.serialize(archive, neighbours_, grains_);
    archive("driver", driver_);
    archive("frame", frame_);
    archive("ways", moved_);
    archive("ways used", used_);
    archive("front", front_slow_);
    archive("built at", built_at_);
  }

 private:
  /// The step that is done when this returns: the start, or that at the end of which a state was saved.
  std::uint64_t begin() {
    if (!resumed_) {
      rebuild(0);
      forces(0);
      return 0;
    }
    base::restore(*this, resumed_->state);
    return resumed_->window * start_.impactor_steps();
  }

  [[nodiscard]] double time_of(std::uint64_t step) const { return static_cast<double>(step) * dt_; }
  [[nodiscard]] contact::ParticleArrays arrays() { return grains_.arrays(flight_.awake()); }

  void move(std::uint64_t n) {
    const double kick = n == 1 ? dt_ / 2.0 : dt_;
    const Allowance speed = most(
        [&](std::int32_t first, std::int32_t last) { return grains_.move(sweeps_, first, last, frame_, kick, dt_); });
    used_.slow += dt_ * speed.slow;
    used_.fast += dt_ * speed.fast;
    const Vec3 shift = (time_of(n) - built_at_) * frame_;
    if (something_near_sleepers(n)) return rebuild(n);
    if (used_.within(inner_allowance_) && within_margin(shift)) return;
    // A sum of largest speeds is more than anyone has moved: look. The whole list must hold what the inner one will.
    moved_ =
        most([&](std::int32_t first, std::int32_t last) { return grains_.displaced(sweeps_, first, last, shift); });
    used_ = {};
    if (!moved_.within(refreshable_) || !within_margin(shift)) return rebuild(n);
    neighbours_.refresh(team_, grains_);
  }

  /// The largest value of `of(first, last)` among the slow and the fast grains, block by block.
  template <typename Of>
  Allowance most(Of&& of) {
    const Blocks& blocks = neighbours_.blocks();
    of_blocks_.resize(static_cast<std::size_t>(blocks.count()));
    team_.each(blocks.count(), [&](std::int32_t block) {
      const std::int32_t first = blocks.first(block);
      const std::int32_t last = blocks.last(block);
      const std::int32_t fast = std::clamp(neighbours_.slow(), first, last);
      of_blocks_[static_cast<std::size_t>(block)] = {of(first, fast), of(fast, last)};
    });
    Allowance out;
    for (const Allowance& one : of_blocks_) out = {larger(out.slow, one.slow), larger(out.fast, one.fast)};
    return out;
  }

  /// Not a number where one of them is not.
  static double larger(double a, double b) { return a > b ? a : (std::isnan(a) ? a : b); }

  /// Contact with the surface is looked for among those that were near it when the list was made.
  [[nodiscard]] bool within_margin(const Vec3& shift) const {
    return std::max(moved_.slow + used_.slow, moved_.fast + used_.fast) + norm(shift) <= diameter_;
  }

  [[nodiscard]] bool flies(std::int32_t i) const {
    const double* v = grains_.velocity(i);
    const Vec3& free = flight_.velocity();
    return v[0] == free[0] && v[1] == free[1] && (D == 2 || v[2] == free[2]);
  }

  /// m, of the hindmost of [first, last) that does not fly freely any more.
  [[nodiscard]] double front_of(std::int32_t first, std::int32_t last, double time) const {
    double front = -std::numeric_limits<double>::infinity();
    for (std::int32_t i = first; i < last; ++i) {
      if (!flies(i)) front = std::max(front, flight_.behind(grains_.position(i), time) + grains_.radius(i));
    }
    return front;
  }

  [[nodiscard]] bool something_near_sleepers(std::uint64_t n) const {
    if (flight_.all_awake()) return false;
    const double time = time_of(n);
    const double slow = front_slow_ + moved_.slow + used_.slow + (time - built_at_) * norm(frame_ - flight_.velocity());
    const double front = std::max(slow, front_of(neighbours_.slow(), flight_.awake(), time));
    const double room = room_to_wake * diameter_ + dt_ * norm(flight_.velocity());
    return flight_.near(front, driver_.top_of_surface(), time, room);
  }

  void wake(double time) {
    if (flight_.all_awake()) return;
    const std::int32_t before = flight_.awake();
    const double front = front_of(0, before, time);
    const std::int32_t after = flight_.wake(front, driver_.top_of_surface(), time, room_awake * diameter_);
    place_sleepers(before, after, time);
  }

  void place_sleepers(std::int32_t first, std::int32_t last, double time) {
    for (std::int32_t i = first; i < last; ++i) {
      const Vec3 place = flight_.place(i, time);
      std::copy_n(place.c.begin(), D, grains_.position(i));
    }
  }

  /// The mean velocity of those that do not fly freely any more.
  [[nodiscard]] Vec3 mean_velocity() const {
    Vec3 sum;
    double count = 0.0;
    for (std::int32_t i = 0; i < flight_.awake(); ++i) {
      if (!flight_.all_awake() && flies(i)) continue;
      for (std::size_t c = 0; c < D; ++c) sum[c] += grains_.velocity(i)[c];
      count += 1.0;
    }
    return count > 0.0 ? sum * (1.0 / count) : flight_.velocity();
  }

  void choose_fast() {
    const auto awake = static_cast<std::size_t>(flight_.awake());
    fast_.assign(awake, 0);
    speed_.assign(awake, 0.0);
    double most = 0.0;
    for (std::size_t i = 0; i < awake; ++i) {
      for (std::size_t c = 0; c < D; ++c) {
        const double v = grains_.velocity(static_cast<std::int32_t>(i))[c] - frame_[c];
        speed_[i] += v * v;
      }
      most = std::max(most, speed_[i]);
    }
    constexpr double share = slow_allowance / fast_allowance;
    for (std::size_t i = 0; i < awake; ++i) {
      const bool flying = !flight_.all_awake() && flies(static_cast<std::int32_t>(i));
      fast_[i] = flying || speed_[i] > share * share * most ? 1 : 0;
    }
  }

  void rebuild(std::uint64_t n) {
    const double time = time_of(n);
    wake(time);
    frame_ = mean_velocity();
    choose_fast();
    neighbours_.rebuild(team_, grains_, {flight_.awake(), block_size_}, fast_);
    contacts_.follow(team_, neighbours_, grains_);
    front_slow_ = front_of(0, neighbours_.slow(), time);
    used_ = moved_ = {};
    built_at_ = time;
    driver_.rebuild(arrays());
  }

  void forces(std::uint64_t n) {
    driver_.before_pair_forces(n, arrays());
    if (driver_.ended()) return;
    contacts_.evaluate(team_, grains_, neighbours_, n == 0 ? 0.0 : dt_);
    driver_.after_pair_forces(n, arrays());
    if (driver_.ended()) return;
    if (watch_) show(n);
    end_step(n);
  }

  /// Velocities are kept half a step behind; who is looked at has them at t(n) while it is.
  void end_step(std::uint64_t n) {
    const bool all = driver_.looks_at_all(n);
    looked_at_.clear();
    if (n > 0 && all) {
      for (std::int32_t i = 0; i < flight_.awake(); ++i) look_at(i);
    } else if (n > 0) {
      marked_.resize(static_cast<std::size_t>(grains_.count()));
      driver_.each_touching([this](int i) {
        if (std::exchange(marked_[static_cast<std::size_t>(i)], 1) == 0) look_at(i);
      });
      for (const auto& [i, speeds] : looked_at_) marked_[static_cast<std::size_t>(i)] = 0;
    }
    if (all) place_sleepers(flight_.awake(), grains_.count(), time_of(n));
    driver_.end_of_step(n, all ? grains_.arrays(grains_.count()) : arrays(), contacts_.energy());
    for (const auto& [i, speeds] : looked_at_) grains_.set_speeds(i, speeds);
    if (driver_.state_is_wanted(n)) exchange_.send_state(base::saved(*this));
  }

  void show(std::uint64_t n) {
    place_sleepers(flight_.awake(), grains_.count(), time_of(n));
    const std::vector<Pair> touching = contacts_.touching();
    watch_({n, grains_.arrays(grains_.count()), touching});
  }

  void look_at(std::int32_t i) {
    looked_at_.emplace_back(i, grains_.speeds(i));
    grains_.kick_alone(i, dt_ / 2.0);
  }

  const Sweeps& sweeps_ = *available_sweeps().front();
  const Watch& watch_;
  base::Team team_;
  wire::Start start_;
  double dt_;
  double diameter_;
  ContactLaw law_;  ///< the pair law reads its table
  Flight flight_;
  Grains<D> grains_;
  Allowance allowance_, inner_allowance_, refreshable_;
  Neighbours<D> neighbours_;
  std::int32_t block_size_;
  Contacts<D> contacts_;
  std::optional<participant::Resumed> resumed_;
  Exchange exchange_;
  StepDriver driver_;

  Vec3 frame_;               ///< m/s
  Allowance moved_;          ///< m, by grains in the frame from when the list was made to when the inner one was
  Allowance used_;           ///< m, a bound on what they have moved since then
  double front_slow_ = 0.0;  ///< m, of the slow ones when the list was made
  double built_at_ = 0.0;    ///< s
  std::vector<Allowance> of_blocks_;  ///< slow and fast ones of each
  std::vector<std::uint8_t> fast_, marked_;
  std::vector<double> speed_;  ///< squared, in the frame
  std::vector<std::pair<std::int32_t, typename Grains<D>::Speeds>> looked_at_;
};

}  // namespace grainstep::dem::native
