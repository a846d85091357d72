/// @file The fix `grainstep/coupling ENDPOINT` of an unmodified LAMMPS: makes a script of one's own the impactor of a
/// run that waits for it (`grainstep run SCENE --external impactor`, impactor.type deck).
///
/// The conversation runs in a thread of rank 0 (serve_impactor owns its loop); LAMMPS's own thread asks it for the
/// start and then talks through its link, while that thread waits. So the link is used by one thread at a time.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "dem-service/deck/deck_model.hpp"
#include "dem-service/lammps/rank_exchange.hpp"
#include "dem-service/lammps/surface_fix.hpp"

namespace grainstep::dem {

/// What both threads hand to each other.
class Rendezvous final : public participant::ImpactorBackend {
 public:
  explicit Rendezvous(const DeckParticles& particles) : particles_(particles) {}

  [[nodiscard]] wire::Hello describe() const override;
  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override;
  void run(const wire::Start& start, participant::ImpactorLink& link) override;

  /// For LAMMPS's thread: waits until the run begins; nullptr when the conversation ended before (closed()).
  participant::ImpactorLink* wait_for_start(wire::Setup& setup, wire::Start& start);
  /// The run is over for LAMMPS, with what was wrong, if anything.
  void leave(std::exception_ptr failure);
  /// The conversation is over.
  void close();

 private:
  DeckParticles particles_;
  std::mutex mutex_;
  std::condition_variable changed_;
  wire::Setup setup_;
  wire::Start start_;
  participant::ImpactorLink* link_ = nullptr;
  bool left_ = false, closed_ = false;
  std::exception_ptr failure_;
};

class CouplingFix final : public SurfaceFix {
 public:
  static constexpr const char* style_name = "grainstep/coupling";

  CouplingFix(lammps::Instance* lammps, int argument_count, char** arguments);
  ~CouplingFix() override;
  CouplingFix(const CouplingFix&) = delete;
  CouplingFix& operator=(const CouplingFix&) = delete;
  CouplingFix(CouplingFix&&) = delete;
  CouplingFix& operator=(CouplingFix&&) = delete;

  void init() override;
  void post_run() override;

 private:
  void meet_orchestrator();
  void end();

  std::string endpoint_;
  std::optional<Rendezvous> rendezvous_;  // rank 0
  std::thread conversation_;              // likewise
  SlugModel model_;
  std::optional<RankExchange> exchange_of_run_;
  std::optional<StepDriver> driver_of_run_;
};

}  // namespace grainstep::dem
