/// @file What one exchange costs: microseconds from sending a surface's worth of numbers until the answer is parsed,
/// over every kind of channel, directly and through a forwarding hub like the orchestrator. Serialising, checksums and
/// parsing are included. Prints a Markdown table.
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <thread>
#include <tuple>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"
#include "transport/in_process_channel.hpp"
#include "transport/shared_channel.hpp"
#include "transport/zmq_channel.hpp"
#include "wire/message_channel.hpp"

namespace {

using namespace grainstep;
using transport::Channel;
using transport::Clock;
using transport::ZmqChannel;
using transport::ZmqOptions;

transport::Deadline patient() { return transport::in(std::chrono::seconds(30)); }

/// Answers every Forces by Kinematics of the same size, as a structure without physics.
void answer(Channel& channel) {
  wire::MessageChannel messages(channel, "driver");
  wire::Forces forces;
  wire::Kinematics kinematics;
  try {
    while (const wire::Frame* frame = messages.receive(patient())) {
      messages.take(*frame, forces);
      kinematics.set_window(forces.window() + 1);
      kinematics.mutable_position()->CopyFrom(forces.impulse());
      messages.send(kinematics);
    }
  } catch (const PeerError&) {  // the driver has finished
  }
}

/// Passes messages on as the orchestrator does: without parsing the numbers.
void relay(Channel& first, Channel& second) {
  wire::MessageChannel one(first, "driver");
  wire::MessageChannel other(second, "answerer");
  const auto pass = [](wire::MessageChannel& from, wire::MessageChannel& to) {
    bool any = false;
    while (const wire::Frame* frame = from.receive(Clock::now())) {
      to.forward(*frame);
      any = true;
    }
    return any;
  };
  try {
    while (true) {
      const bool forth = pass(one, other);
      const bool back = pass(other, one);
      if (!forth && !back) {
        pollfd items[] = {{first.wakeup(), POLLIN, 0}, {second.wakeup(), POLLIN, 0}};
        ::poll(items, 2, 30'000);
      }
    }
  } catch (const PeerError&) {  // the driver has finished
  }
}

struct Figures {
  double median_us;
  double p99_us;
};

Figures drive(Channel& channel, int bytes, int samples) {
  wire::MessageChannel messages(channel, "answerer");
  wire::Forces forces;
  for (int i = 0; i < bytes / 8; ++i) {
    forces.add_impulse(1e-3 * i);
  }
  wire::Kinematics kinematics;
  std::vector<double> times;
  const int warm_up = samples / 10;
  for (int i = 0; i < warm_up + samples; ++i) {
    const auto before = Clock::now();
    forces.set_window(static_cast<std::uint64_t>(i));
    messages.send(forces);
    const wire::Frame* frame = messages.receive(patient());
    if (frame == nullptr) {
      throw PeerError("answerer", "silent");
    }
    messages.take(*frame, kinematics);
    if (i >= warm_up) {
      times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - before).count());
    }
  }
  std::sort(times.begin(), times.end());
  return {times[times.size() / 2], times[times.size() * 99 / 100]};
}

/// Tells a forked process where to connect to.
class Line {
 public:
  Line() {
    if (::pipe(ends_) != 0) {
      throw std::runtime_error("pipe");
    }
  }
  void tell(const std::string& text) const {
    if (::write(ends_[1], text.c_str(), text.size() + 1) < 0) {
      throw std::runtime_error("write to a pipe");
    }
  }
  [[nodiscard]] std::string hear() const {
    char text[256] = {};
    if (::read(ends_[0], text, sizeof text - 1) <= 0) {
      throw std::runtime_error("read from a pipe");
    }
    return text;
  }

 private:
  int ends_[2];
};

template <class Work>
pid_t in_process_of_its_own(Work&& work) {
  const pid_t id = ::fork();
  if (id == 0) {
    try {
      work();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    ::_exit(0);
  }
  return id;
}

struct Kind {
  const char* name;
  const char* endpoint;  // %s: a private directory; nullptr: in-process
  bool curve;
};

std::string endpoint_of(const Kind& kind, const std::string& directory, const char* suffix) {
  const std::string text = kind.endpoint;
  return text.rfind("ipc", 0) == 0 ? text + directory + "/" + suffix : text;
}

Figures between_processes(const Kind& kind, const std::string& directory, bool through_hub, int bytes, int samples) {
  ZmqOptions options;
  options.curve_dir = kind.curve ? directory + "/keys" : "";
  const Line to_answerer;
  const Line to_driver;
  std::vector<pid_t> children;  // all forked before this process has a thread
  children.push_back(
      in_process_of_its_own([&] { answer(*ZmqChannel::connect(to_answerer.hear(), patient(), options)); }));
  Figures figures{};
  if (through_hub) {
    children.push_back(in_process_of_its_own([&] {
      const auto first = ZmqChannel::bind(endpoint_of(kind, directory, "driver"), options);
      const auto second = ZmqChannel::bind(endpoint_of(kind, directory, "answerer"), options);
      to_driver.tell(first->endpoint());
      to_answerer.tell(second->endpoint());
      if (first->wait_for_peer(patient()) && second->wait_for_peer(patient())) {
        relay(*first, *second);
      }
    }));
    figures = drive(*ZmqChannel::connect(to_driver.hear(), patient(), options), bytes, samples);
  } else {
    const auto channel = ZmqChannel::bind(endpoint_of(kind, directory, "direct"), options);
    to_answerer.tell(channel->endpoint());
    if (channel->wait_for_peer(patient())) {
      figures = drive(*channel, bytes, samples);
    }
  }
  for (const pid_t child : children) {
    ::waitpid(child, nullptr, 0);
  }
  return figures;
}

Figures between_threads(bool through_hub, int bytes, int samples) {
  std::unique_ptr<Channel> driver;
  std::unique_ptr<Channel> hub_first;
  std::unique_ptr<Channel> hub_second;
  std::unique_ptr<Channel> answerer;
  std::tie(driver, hub_first) = transport::make_in_process_pair();
  std::tie(hub_second, answerer) = transport::make_in_process_pair();
  std::thread answering([&, end = through_hub ? answerer.get() : hub_first.get()] { answer(*end); });
  std::thread relaying([&] {
    if (through_hub) {
      relay(*hub_first, *hub_second);
      hub_second.reset();
    }
  });
  const Figures figures = drive(*driver, bytes, samples);
  driver.reset();
  relaying.join();
  answering.join();
  return figures;
}

/// Parses all that passes, as the orchestrator does.
class Listening {
 public:
  explicit Listening(const transport::SharedPath& path)
      : forces_way_(path, transport::SharedPath::Way::forces, "driver"),
        kinematics_way_(path, transport::SharedPath::Way::kinematics, "answerer") {}

  void hear() {
    while (const wire::Frame* frame = forth_.receive(Clock::now())) forth_.take(*frame, forces_);
    while (const wire::Frame* frame = back_.receive(Clock::now())) back_.take(*frame, kinematics_);
  }

 private:
  transport::SharedChannel forces_way_, kinematics_way_;
  wire::MessageChannel forth_{forces_way_, "driver"};
  wire::MessageChannel back_{kinematics_way_, "answerer"};
  wire::Forces forces_;
  wire::Kinematics kinematics_;
};

/// All three in one thread, one after the other: nobody waits, so that what is executed can be counted.
void exchange_in_turn(int bytes, int samples) {
  using transport::SharedPath;
  const auto nothing = [] {};
  const SharedPath path = SharedPath::create(static_cast<std::uint64_t>(bytes) + 100);
  transport::SharedChannel driver_way(path, SharedPath::Way::forces, "answerer", nothing);
  transport::SharedChannel answerer_way(path, SharedPath::Way::kinematics, "driver", nothing);
  wire::MessageChannel driver(driver_way, "answerer");
  wire::MessageChannel answerer(answerer_way, "driver");
  Listening listening(path);
  wire::Forces sent;
  wire::Forces received;
  wire::Kinematics answer;
  for (int i = 0; i < bytes / 8; ++i) sent.add_impulse(1e-3 * i);
  const auto heard = [](wire::MessageChannel& channel) {
    const wire::Frame* frame = channel.receive(Clock::now());
    return frame != nullptr ? frame : throw PeerError("exchange", "silent");
  };
  for (int i = 0; i < samples; ++i) {
    sent.set_window(static_cast<std::uint64_t>(i));
    driver.send(sent);
    answerer.take(*heard(answerer), received);
    answer.set_window(received.window() + 1);
    answer.mutable_position()->CopyFrom(received.impulse());
    answerer.send(answer);
    driver.take(*heard(driver), answer);
    listening.hear();
  }
}

/// Between two processes, and a third one that listens.
Figures in_shared_memory(int bytes, int samples) {
  using transport::SharedPath;
  const auto nothing = [] {};
  const SharedPath path = SharedPath::create(static_cast<std::uint64_t>(bytes) + 100);
  const pid_t children[] = {in_process_of_its_own([&] {
                              const SharedPath mine = SharedPath::open(path.file());
                              transport::SharedChannel channel(mine, SharedPath::Way::kinematics, "driver", nothing);
                              answer(channel);
                            }),
                            in_process_of_its_own([&] {
                              Listening listening(path);
                              while (true) {
                                listening.hear();
                                std::this_thread::sleep_for(std::chrono::milliseconds(1));
                              }
                            })};
  transport::SharedChannel channel(path, SharedPath::Way::forces, "answerer", nothing);
  const Figures figures = drive(channel, bytes, samples);
  for (const pid_t child : children) {
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  }
  return figures;
}

constexpr int sizes[] = {200, 2'000, 10'000, 100'000};

void print_shared(int samples) {
  for (const int bytes : sizes) {
    const Figures heard = in_shared_memory(bytes, samples);
    std::printf("| shared memory, heard | %d | %.1f | %.1f | - | - |\n", bytes, heard.median_us, heard.p99_us);
    std::fflush(stdout);
  }
}

void print_table(const std::string& directory, int samples) {
  constexpr Kind kinds[] = {{"in-process (threads)", nullptr, false},
                            {"ipc", "ipc://", false},
                            {"tcp loopback", "tcp://127.0.0.1:*", false},
                            {"tcp loopback, CURVE", "tcp://127.0.0.1:*", true}};
  std::printf("| channel | bytes each way | direct: median us | p99 us | through a hub: median us | p99 us |\n");
  std::printf("|---|---|---|---|---|---|\n");
  for (const Kind& kind : kinds) {
    for (const int bytes : sizes) {
      const auto run = [&](bool hub) {
        return kind.endpoint == nullptr ? between_threads(hub, bytes, samples)
                                        : between_processes(kind, directory, hub, bytes, samples);
      };
      const Figures direct = run(false);
      const Figures hub = run(true);
      std::printf("| %s | %d | %.0f | %.0f | %.0f | %.0f |\n", kind.name, bytes, direct.median_us, direct.p99_us,
                  hub.median_us, hub.p99_us);
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Microseconds per exchange");
  int samples = 2000;
  app.add_option("--samples", samples, "Exchanges measured per figure")->capture_default_str();
  int in_turn = 0;
  app.add_option("--in-turn", in_turn,
                 "Only this: so many exchanges of 10 kB in shared memory by one thread, unmeasured");
  CLI11_PARSE(app, argc, argv);
  if (in_turn > 0) {
    exchange_in_turn(10'000, in_turn);
    return 0;
  }
  const TemporaryDirectory directory;
  transport::make_keys(directory.path() / "keys");
  print_table(directory.path().string(), samples);
  print_shared(samples);
  return 0;
}
