/// @file The part of the conversation that both roles share: from Hello to Start, data with its waiting time, Stop.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <type_traits>

#include "participant/serve.hpp"
#include "wire/message_channel.hpp"

namespace grainstep::participant {

class DataPath;
class DirectDoor;

/// What one participant says and hears, in order. Throws PeerError when the orchestrator is lost, silent beyond a
/// deadline, or breaks the order. After a Stop every wait returns "stopped" and nothing but Finished is sent.
class Conversation {
 public:
  Conversation(transport::Channel& channel, const ServeOptions& options);
  ~Conversation();

  /// Hello, Setup, Ready. Returns the Setup; false: stopped.
  [[nodiscard]] bool introduce(wire::Hello hello, wire::Role role, wire::Setup& setup);
  void ready(wire::Ready ready, const wire::Setup& setup);
  /// Waits for Start and begins the clock; false: stopped.
  [[nodiscard]] bool wait_for_start(wire::Start& start);

  /// Of a run that continues: what came with the Setup.
  [[nodiscard]] const std::optional<std::string>& restored() const { return restored_; }
  /// Whether the state at the end of this window is wanted: its Forces have said so.
  [[nodiscard]] bool wants_state(std::uint64_t window) const { return save_ == window; }
  void send_state(std::uint64_t window, std::string_view state);

  /// Waits for the other side's data of this window; false: stopped.
  template <wire::Body Message>
  [[nodiscard]] bool wait_for(Message& message, std::uint64_t window) {
    const wire::Frame* frame = wait_for_data(wire::kind_name(wire::kind_of<Message>), window);
    if (frame == nullptr) {
      return false;
    }
    data().take(*frame, message, window);
    if constexpr (std::is_same_v<Message, wire::Forces>) {
      if (message.save()) note_save(window);
    }
    return true;
  }

  template <wire::Body Message>
  void send(const Message& message) {
    if (stopped_) return;
    if constexpr (std::is_same_v<Message, wire::Forces>) {
      send_forces(message);
    } else if constexpr (std::is_same_v<Message, wire::Kinematics>) {
      send_data([&](wire::MessageChannel& data) { data.send(message); });
    } else {
      messages_.send(message);
    }
  }
  /// Data will be sent within microseconds: where the other side can wake up for them before, it does.
  void knock();
  void send_report(wire::Report& report);
  /// The last message after a bad end; also after Stop.
  void send_error(const wire::Error& error) { messages_.send(error); }

  /// Waits for Stop unless it came already, and answers it.
  void finish();

  /// A protocol error of the orchestrator's, in the words of this conversation.
  [[noreturn]] void refuse(const std::string& text) const;

 private:
  /// The next message of the orchestrator; nullptr after Stop.
  const wire::Frame* next(const std::string& expected, double deadline_s);
  /// The same of the other side, where data do not come through the orchestrator.
  const wire::Frame* next_on_data_path(const std::string& expected, double deadline_s);
  void open_data_path(const wire::Start& start);
  /// While data do not come through it, the orchestrator says nothing but Stop, which is thrown from here.
  void look_for_stop();
  /// What Forces and Kinematics go over.
  [[nodiscard]] wire::MessageChannel& data();
  void send_data(const std::function<void(wire::MessageChannel&)>& send);
  void offer_data_paths(wire::Hello& hello);
  /// A message that may come at any time and is no answer to anything: Save.
  [[nodiscard]] bool take_aside(const wire::Frame& frame);
  /// Those of the window whose state is to be saved say so to the other side.
  void send_forces(const wire::Forces& forces);
  [[nodiscard]] bool take_state(const wire::Restore& restore);
  void note_save(std::uint64_t window);
  const wire::Frame* wait_for_data(const std::string& kind, std::uint64_t window);
  void fill_timing(wire::Timing& timing) const;

  wire::MessageChannel messages_;
  ServeOptions options_;
  wire::Role role_ = wire::ROLE_UNSET;
  std::unique_ptr<DirectDoor> door_;  ///< of a structure that has such a path to offer, until Start
  std::unique_ptr<DataPath> data_;    ///< none: data go through the orchestrator
  transport::Clock::time_point looked_{};
  transport::Clock::time_point started_{};
  double processor_at_start_ = 0.0;
  transport::Clock::duration waited_{};
  std::uint64_t steps_ = 0;  // as last reported by the backend
  std::optional<std::string> restored_;
  std::uint64_t restored_window_ = 0;
  bool can_save_ = false;
  bool save_wanted_ = false;           ///< an impactor was asked for a state
  std::optional<std::uint64_t> save_;  ///< the window whose state it is to be
  std::uint64_t windows_ = 0;
  bool preview_ = false;
  bool stopped_ = false;
};

}  // namespace grainstep::participant
