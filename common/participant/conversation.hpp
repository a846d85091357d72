/// @file The part of the conversation that both roles share: from Hello to Start, data with its waiting time, Stop.
#pragma once

#include "participant/serve.hpp"
#include "wire/message_channel.hpp"

namespace grainstep::participant {

/// What one participant says and hears, in order. Throws PeerError when the orchestrator is lost, silent beyond a
/// deadline, or breaks the order. After a Stop every wait returns "stopped" and nothing but Finished is sent.
class Conversation {
 public:
  Conversation(transport::Channel& channel, const ServeOptions& options)
      : messages_(channel, "orchestrator"), options_(options) {}

  /// Hello, Setup, Ready. Returns the Setup; false: stopped.
  [[nodiscard]] bool introduce(wire::Hello hello, wire::Role role, wire::Setup& setup);
  void ready(wire::Ready ready, const wire::Setup& setup);
  /// Waits for Start and begins the clock; false: stopped.
  [[nodiscard]] bool wait_for_start(wire::Start& start);

  /// Waits for the other side's data of this window; false: stopped.
  template <wire::Body Message>
  [[nodiscard]] bool wait_for(Message& message, std::uint64_t window) {
    const wire::Frame* frame = wait_for_data(wire::kind_name(wire::kind_of<Message>), window);
    if (frame == nullptr) {
      return false;
    }
    messages_.take(*frame, message, window);
    return true;
  }

  template <wire::Body Message>
  void send(const Message& message) {
    if (!stopped_) {
      messages_.send(message);
    }
  }
  void send_report(wire::Report& report);
  /// The last message after a bad end; also after Stop.
  void send_error(const wire::Error& error) { messages_.send(error); }

  /// Waits for Stop unless it came already, and answers it.
  void finish();

  /// A protocol error of the orchestrator's, in the words of this conversation.
  [[noreturn]] void refuse(const std::string& text) const;

 private:
  /// The next message; nullptr after Stop.
  const wire::Frame* next(const std::string& expected, double deadline_s);
  const wire::Frame* wait_for_data(const std::string& kind, std::uint64_t window);
  void fill_timing(wire::Timing& timing) const;

  wire::MessageChannel messages_;
  ServeOptions options_;
  transport::Clock::time_point started_{};
  double processor_at_start_ = 0.0;
  transport::Clock::duration waited_{};
  std::uint64_t steps_ = 0;  // as last reported by the backend
  bool preview_ = false;
  bool stopped_ = false;
};

}  // namespace grainstep::participant
