/// @file A lock step between two sides that are played by hand, over each path of data.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "base/error.hpp"
#include "each_path.hpp"
#include "hand_played.hpp"
#include "orchestrator/session/lock_step.hpp"
#include "patience.hpp"

namespace grainstep::orchestrator {

/// Of all paths: what is checked must not depend on the way.
class HandPlayed : public ::testing::TestWithParam<Path> {
 protected:
  HandPlayed() : hub_(*impactor_.near_, *structure_.near_, loop_) {
    hub_.structure().ready.mutable_surface()->set_dimension(2);
    for (Peer* peer : {&hub_.impactor(), &hub_.structure()}) peer->ready.set_ledger(wire::FULL);
    for (const double x : {0.0, 0.0, 1.0, 0.0}) hub_.structure().ready.mutable_surface()->add_position(x);
    start_.set_window(1e-3);
    start_.set_windows(10);
    start_.set_report_every(5);
    if (GetParam() == Path::direct) start_.mutable_direct()->set_endpoint("between them");
    if (GetParam() != Path::shared) return;
    listener_ = std::make_unique<Listener>(4);
    impactor_.share(listener_->file(), transport::SharedPath::Way::forces);
    structure_.share(listener_->file(), transport::SharedPath::Way::kinematics);
  }
  static wire::Forces forces(std::uint64_t window, double value = -1.0) {
    wire::Forces out;
    out.set_window(window);
    for (int i = 0; i < 4; ++i) out.add_impulse(value);
    return out;
  }
  static wire::Kinematics kinematics(std::uint64_t window) {
    wire::Kinematics out;
    out.set_window(window);
    for (const double x : {0.0, 0.0, 1.0, 0.0}) {
      out.add_position(x);
      out.add_velocity(0.0);
    }
    return out;
  }
  static wire::Report report(std::uint64_t window) {
    wire::Report out;
    out.set_window(window);
    wire::Momentum& momentum = *out.mutable_momentum();
    for (auto* vector :
         {momentum.mutable_linear(), momentum.mutable_interface_impulse(), momentum.mutable_support_impulse()}) {
      vector->Resize(2, 0.0);
    }
    return out;
  }
  /// What an exception says; empty: none came.
  template <typename Action>
  static std::string text_of_end(Action&& action) {
    try {
      action();
    } catch (const PeerError& error) {
      return std::string("peer: ") + error.what();
    } catch (const NumericalError& error) {
      return std::string("numerical: ") + error.what();
    }
    return "";
  }
  std::string run(double silence_s = grainstep::testing::patience_s) {
    return text_of_end([&] { LockStep(hub_, witness_, start_, silence_s, listener_.get()).run(); });
  }

  ByHand impactor_{"impactor"};
  ByHand structure_{"structure"};
  EventLoop loop_;
  Hub hub_;
  wire::Start start_;
  Witness witness_;
  std::unique_ptr<Listener> listener_;
};

}  // namespace grainstep::orchestrator
