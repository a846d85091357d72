/// A whole run over channels to threads, and what is left of it when something happens that nobody foresaw.
#include "orchestrator/command/conduct.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <cerrno>
#include <fstream>
#include <functional>
#include <future>
#include <new>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>
#include <thread>

#include "base/temporary_directory.hpp"
#include "fake_backends.hpp"
#include "participant/serve.hpp"
#include "patience.hpp"
#include "results/hdf5.hpp"
#include "transport/in_process_channel.hpp"

namespace grainstep::orchestrator {
namespace {

using ::testing::HasSubstr;

constexpr double longest = grainstep::testing::patience_s;
constexpr double end = 0.05;  // s: 50 windows

/// Both fakes in threads, the run in this one. From window 20 on, `what_happens` happens once, in the thread of the
/// run.
class Conducted {
 public:
  explicit Conducted(std::function<void()> what_happens = {}, fake::Trouble structure_trouble = {})
      : impactor_({.window = 20, .act = [this] { now_ = true; }}),
        structure_(std::move(structure_trouble)),
        what_happens_(std::move(what_happens)) {
    scene::Scene& scene = preparation_.scene;
    scene.mutable_output()->set_rows(20);
    scene.set_depth(fake::depth);
    scene.mutable_structure()->set_half_span(fake::width);
    scene.mutable_guards()->set_energy_drift(1e6);  // fakes keep no energy
    scene.mutable_guards()->set_momentum_error(1.0);
    scene.mutable_guards()->set_overlap(1e6);
    preparation_.groups.end = end;
    preparation_.groups.reference_time = end;
    preparation_.groups.loaded_area = fake::width * fake::depth;
    preparation_.yaml = "title: conducted\n";
  }

  Ending run() {
    const results::DirectoryLock lock = directory_.prepare(results::Existing::refuse);
    auto [impactor, impactor_far] = transport::make_in_process_pair({.first = "orchestrator", .second = "impactor"});
    auto [structure, structure_far] = transport::make_in_process_pair({.first = "orchestrator", .second = "structure"});
    std::ostringstream quiet_i;
    std::ostringstream quiet_s;
    std::thread ball([this, far = std::move(impactor_far), &quiet_i] {
      impactor_code_ = participant::serve_impactor(*far, impactor_, {.errors = &quiet_i});
    });
    std::thread spring([this, far = std::move(structure_far), &quiet_s] {
      structure_code_ = participant::serve_structure(*far, structure_, {.errors = &quiet_s});
    });
    EventLoop loop;
    Hub hub(*impactor, *structure, loop, [this] {
      if (now_.exchange(false) && what_happens_) what_happens_();
    });
    const Ending ending = conduct(hub, {.preparation = preparation_,
                                        .directory = directory_,
                                        .deadlines = {.connect_s = longest, .step_s = longest, .stop_s = longest},
                                        .account_of = {}});
    ball.join();
    spring.join();
    return ending;
  }

  [[nodiscard]] nlohmann::json summary() const {
    std::ifstream in(directory_.summary());
    return nlohmann::json::parse(in);
  }
  [[nodiscard]] std::size_t rows() const {
    return results::h5::File::read(directory_.results()).read_doubles("/series/time").size();
  }
  [[nodiscard]] const results::RunDirectory& directory() const { return directory_; }

  int impactor_code_ = -1;
  int structure_code_ = -1;

 private:
  TemporaryDirectory scratch_;
  results::RunDirectory directory_{scratch_.path() / "run"};
  Preparation preparation_;
  fake::BallImpactor impactor_;
  fake::SpringStructure structure_;
  std::function<void()> what_happens_;
  std::atomic<bool> now_ = false;
};

template <class Exception>
std::function<void()> throwing(Exception exception) {
  return [exception] { throw exception; };
}

TEST(Conduct, AWholeRunIsDone) {
  Conducted run;
  const Ending ending = run.run();
  EXPECT_EQ(ending.code, ExitCode::done) << ending.reason;
  EXPECT_EQ(run.summary()["status"], "done");
  EXPECT_GE(run.rows(), 20U);
}

void expect_orderly_end(Conducted& run, const std::string& reason) {
  const Ending ending = run.run();
  EXPECT_EQ(ending.code, ExitCode::unforeseen);
  EXPECT_THAT(ending.reason, HasSubstr(reason));
  const nlohmann::json summary = run.summary();
  EXPECT_EQ(summary["status"], "failed");
  EXPECT_EQ(summary["exit_code"], 1);
  EXPECT_EQ(summary["reason"], ending.reason);
  EXPECT_GE(run.rows(), 1U) << "what was computed is kept";
  EXPECT_EQ(run.impactor_code_, 0) << "both were told to stop, and did";
  EXPECT_EQ(run.structure_code_, 0);
}

TEST(Conduct, ARefusalOfTheSystemInMidRunEndsItInOrder) {
  Conducted run(throwing(std::system_error(EINVAL, std::generic_category(), "poll")));
  expect_orderly_end(run, "poll: Invalid argument");
}

TEST(Conduct, FullMemoryInMidRunEndsItInOrder) {
  Conducted run(throwing(std::bad_alloc()));
  expect_orderly_end(run, "the system gives no more memory");
}

TEST(Conduct, WhatIsNoExceptionOfTheLibraryEndsItInOrder) {
  Conducted run(throwing(42));
  expect_orderly_end(run, "an exception without a text");
}

TEST(Conduct, AReasonOfAnyBytesIsWritten) {
  Conducted run(throwing(std::runtime_error("byte \xff of a log")));
  const Ending ending = run.run();
  EXPECT_EQ(ending.code, ExitCode::unforeseen);
  EXPECT_THAT(run.summary()["reason"].get<std::string>(), HasSubstr("of a log"));
  EXPECT_EQ(run.impactor_code_, 0) << "its Stop could be read";
  EXPECT_EQ(run.structure_code_, 0);
}

TEST(Conduct, ALossAfterAStandstillSaysSo) {
  std::promise<void> over;
  const auto stand_still = [&over] {
    std::this_thread::sleep_for(std::chrono::milliseconds(2500));  // the fault itself
    over.set_value();
  };
  Conducted run(stand_still, {.window = 22, .act = [&over] {
                                over.get_future().wait();
                                throw std::logic_error("gone");
                              }});
  const Ending ending = run.run();
  EXPECT_EQ(ending.code, ExitCode::peer) << ending.reason;
  EXPECT_THAT(ending.reason, HasSubstr("the orchestrator itself stood still for "));
}

}  // namespace
}  // namespace grainstep::orchestrator
