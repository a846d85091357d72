/// @file What the tests of the conversation share: an observer that keeps everything, and a peer that is played by
/// hand.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "orchestrator/session/listener.hpp"
#include "orchestrator/session/step_observer.hpp"
#include "transport/in_process_channel.hpp"
#include "wire/message_channel.hpp"

namespace grainstep::orchestrator {

/// Keeps everything that passes by.
class Witness final : public StepObserver {
 public:
  void forces(const wire::Forces& forces) override {
    forces_.push_back(forces);
    order_ += "forces ";
  }
  void report(wire::Role side, const wire::Report& report) override {
    (side == wire::IMPACTOR ? impactor_ : structure_).push_back(report);
    order_ += "report ";
  }
  void snapshot(wire::Role side, wire::Snapshot snapshot) override {
    ++(side == wire::IMPACTOR ? particles_ : meshes_);
    EXPECT_GT(snapshot.position_size(), 0);
  }
  void checkpoint(Checkpoint checkpoint) override {
    checkpoints_.push_back(std::move(checkpoint));
    order_ += "checkpoint ";
  }
  void idle() override {}
  void finish() override { ++finished_; }

  std::vector<wire::Forces> forces_;
  std::vector<Checkpoint> checkpoints_;
  std::vector<wire::Report> impactor_;
  std::vector<wire::Report> structure_;
  std::string order_;
  int particles_ = 0;
  int meshes_ = 0;
  int finished_ = 0;
};

/// A peer that is played by hand.
class ByHand {
 public:
  explicit ByHand(const char* name) {
    std::tie(near_, far_) = transport::make_in_process_pair({.first = "orchestrator", .second = name});
    messages_.emplace(*far_, "orchestrator");
  }
  std::unique_ptr<transport::Channel> near_;
  std::unique_ptr<transport::Channel> far_;
  std::optional<wire::MessageChannel> messages_;

  /// From now on its data take the short path.
  void share(const std::filesystem::path& file, transport::SharedPath::Way out) {
    path_.emplace(transport::SharedPath::open(file));
    shared_.emplace(*path_, out, "the other side", [] {});
    data_.emplace(*shared_, "the other side");
  }
  /// What its Forces or Kinematics go over.
  [[nodiscard]] wire::MessageChannel& data() { return data_ ? *data_ : *messages_; }

 private:
  std::optional<transport::SharedPath> path_;
  std::optional<transport::SharedChannel> shared_;
  std::optional<wire::MessageChannel> data_;
};

}  // namespace grainstep::orchestrator
