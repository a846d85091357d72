/// @file A participant whose data come over shared memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <limits>
#include <thread>

#include "one_node.hpp"
#include "patience.hpp"
#include "transport/shared_channel.hpp"

namespace grainstep::participant {
namespace {

class ServeSharedMemory : public ServeStructure {};

TEST_F(ServeSharedMemory, WhatIsNotThereIsSaidWithWhatToDo) {
  auto& talk = orchestrator();
  talk.hear<wire::Hello>();
  talk.tell(setup());
  talk.hear<wire::Ready>();
  auto elsewhere = start();
  elsewhere.mutable_shared_memory()->set_file("/dev/shm/grainstep-of-another-host/data");
  talk.tell(elsewhere);
  const auto error = talk.hear<wire::Error>();
  EXPECT_EQ(error.kind(), wire::Error::BAD_INPUT);
  EXPECT_NE(error.text().find("grainstep-of-another-host"), std::string::npos) << error.text();
  EXPECT_NE(error.text().find("--path hub takes another way"), std::string::npos) << error.text();
  EXPECT_EQ(talk.exit_code(), 2);
}

// The orchestrator has ended the run, the other side goes on and on. Who waits for no data looks at its orchestrator,
// too.
TEST_F(ServeSharedMemory, StopIsHeardWhileDataCome) {
  using Way = transport::SharedPath::Way;
  const transport::SharedPath path = transport::SharedPath::create(1000);
  backend.fail_at = std::numeric_limits<std::uint64_t>::max();
  auto& talk = orchestrator();
  talk.hear<wire::Hello>();
  talk.tell(setup());
  talk.hear<wire::Ready>();
  auto endless = start();
  endless.set_windows(1'000'000'000'000);
  endless.set_report_every(1e12);
  endless.set_snapshot_every(0.0);
  endless.mutable_shared_memory()->set_file(path.file());
  talk.tell(endless);
  std::atomic<std::uint64_t> windows = 0;
  std::jthread other([&](const std::stop_token& ended) {
    transport::SharedChannel impactor(path, Way::forces, "structure", [] {});
    wire::MessageChannel data(impactor, "structure");
    transport::SharedChannel of_impactor(path, Way::forces, "impactor");
    transport::SharedChannel of_structure(path, Way::kinematics, "structure");
    transport::Bytes heard;
    while (!ended.stop_requested()) {
      data.send(forces(windows));
      while (!ended.stop_requested() && data.receive(transport::in(std::chrono::milliseconds(20))) == nullptr) continue;
      while (of_impactor.receive(heard, transport::Clock::now())) continue;
      while (of_structure.receive(heard, transport::Clock::now())) continue;
      ++windows;
    }
  });
  talk.hear<wire::Report>();
  const auto deadline = grainstep::testing::soon();
  while (windows < 1000 && transport::Clock::now() < deadline) std::this_thread::yield();
  talk.tell(stop());
  talk.hear<wire::Finished>();
  EXPECT_EQ(talk.exit_code(), 0);
}

// Nobody need wait for data to look at the orchestrator.
TEST_F(ServeSharedMemory, StopIsHeardBeforeDataThatAreThereAlready) {
  const transport::SharedPath path = transport::SharedPath::create(1000);
  transport::SharedChannel impactor(path, transport::SharedPath::Way::forces, "structure", [] {});
  wire::MessageChannel data(impactor, "structure");
  for (std::uint64_t window = 0; window < 10; ++window) data.send(forces(window));
  std::promise<void> told;
  backend.on_start = [&told] { told.get_future().wait(); };
  auto& talk = orchestrator();
  talk.hear<wire::Hello>();
  talk.tell(setup());
  talk.hear<wire::Ready>();
  auto shared = start();
  shared.set_windows(20);
  shared.set_report_every(20);
  shared.set_snapshot_every(0.0);
  shared.mutable_shared_memory()->set_file(path.file());
  talk.tell(shared);
  talk.tell(stop());
  told.set_value();
  EXPECT_EQ(talk.exit_code(), 0);
  EXPECT_EQ(backend.calls.find("advance"), std::string::npos) << backend.calls;
}

}  // namespace
}  // namespace grainstep::participant
