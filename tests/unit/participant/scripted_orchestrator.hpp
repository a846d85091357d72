/// @file The orchestrator's end of a conversation, as a test writes it line by line, with the participant in a thread.
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <thread>

#include "base/error.hpp"
#include "participant/serve.hpp"
#include "patience.hpp"
#include "transport/in_process_channel.hpp"
#include "wire/message_channel.hpp"

namespace grainstep::participant::testing {

class ScriptedOrchestrator {
 public:
  /// `participant(channel, options)` serves a backend and returns its exit code.
  template <class Participant>
  explicit ScriptedOrchestrator(Participant participant, ServeOptions options = {}) {
    auto [mine, theirs] = transport::make_in_process_pair({.first = "orchestrator", .second = "participant"});
    channel_ = std::move(mine);
    messages_ = std::make_unique<wire::MessageChannel>(*channel_, "participant");
    options.errors = &errors_;
    thread_ = std::thread([this, participant, options, channel = std::move(theirs)]() mutable {
      exit_code_ = participant(*channel, options);
      channel.reset();
    });
  }
  ScriptedOrchestrator(const ScriptedOrchestrator&) = delete;
  ScriptedOrchestrator& operator=(const ScriptedOrchestrator&) = delete;
  ~ScriptedOrchestrator() { join(); }

  template <class Message>
  void tell(const Message& message) {
    messages_->send(message);
  }

  template <class Message>
  Message hear() {
    Message message;
    messages_->take(next(), message);
    return message;
  }

  template <class Message>
  Message hear(std::uint64_t window) {
    Message message;
    messages_->take(next(), message, window);
    return message;
  }

  /// The orchestrator vanishes.
  void vanish() {
    messages_.reset();
    channel_.reset();
  }

  int exit_code() {
    join();
    return exit_code_;
  }
  std::string error_text() {
    join();
    return errors_.str();
  }

 private:
  const wire::Frame& next() {
    const wire::Frame* frame = messages_->receive(grainstep::testing::soon());
    if (frame == nullptr) {
      throw std::runtime_error("the participant said nothing");
    }
    return *frame;
  }
  void join() {
    if (thread_.joinable()) {
      if (channel_ && ::testing::Test::HasFailure()) {
        vanish();  // do not hang where the conversation has already gone wrong
      }
      thread_.join();
    }
  }

  std::unique_ptr<transport::Channel> channel_;
  std::unique_ptr<wire::MessageChannel> messages_;
  std::ostringstream errors_;
  int exit_code_ = -1;
  std::thread thread_;
};

}  // namespace grainstep::participant::testing
