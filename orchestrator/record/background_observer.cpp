#include "orchestrator/record/background_observer.hpp"

#include <chrono>
#include <utility>

#include "participant/give_way.hpp"

namespace grainstep::orchestrator {
namespace {

// The observer's idle() shows progress and writes bursts: it wants to be called while a long window passes, too.
constexpr auto idle_interval = std::chrono::milliseconds(200);

template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;  // deduced without it by C++20, but not by clang 14

}  // namespace

BackgroundObserver::BackgroundObserver(StepObserver& observer, std::size_t most_bytes)
    : observer_(observer), most_bytes_(most_bytes), thread_([this] { work(); }) {}

BackgroundObserver::~BackgroundObserver() {
  try {
    finish();
  } catch (...) {  // the run has ended for another reason, which is known already
  }
}

// Forces come every window: waking the thread for each would cost a switch of tasks that the particles wait for.
void BackgroundObserver::forces(const wire::Forces& forces) { put(forces, forces.ByteSizeLong(), Wake::later); }

void BackgroundObserver::kinematics(const wire::Kinematics& kinematics) {
  put(kinematics, kinematics.ByteSizeLong(), Wake::later);
}

void BackgroundObserver::report(wire::Role side, const wire::Report& report) {
  put(Report{side, report}, report.ByteSizeLong(), Wake::now);
}

void BackgroundObserver::snapshot(wire::Role side, wire::Snapshot snapshot) {
  const std::size_t bytes = snapshot.ByteSizeLong();
  put(Snapshot{side, std::move(snapshot)}, bytes, Wake::now);
}

void BackgroundObserver::checkpoint(Checkpoint checkpoint) {
  const std::size_t bytes = checkpoint.impactor.size() + checkpoint.structure.size();
  put(std::move(checkpoint), bytes, Wake::now);
}

void BackgroundObserver::idle() {
  if (failed_) rethrow();
}

void BackgroundObserver::put(Event event, std::size_t bytes, Wake wake) {
  bool notify = false;
  {
    std::unique_lock lock(mutex_);
    if (waiting_bytes_ > most_bytes_) {
      awake_ = true;
      filled_.notify_one();
      emptied_.wait(lock, [this] { return waiting_bytes_ <= most_bytes_ || failed_; });
    }
    if (!failed_) {
      waiting_.push_back(std::move(event));
      waiting_bytes_ += bytes;
      notify = wake == Wake::now && !std::exchange(awake_, true);
    }
  }
  if (notify) filled_.notify_one();
  if (failed_) rethrow();
}

void BackgroundObserver::work() {
  participant::give_way_to_all();  // who is too far behind is waited for: put()
  std::vector<Event> events;
  std::unique_lock lock(mutex_);
  while (true) {
    filled_.wait_for(lock, idle_interval, [this] { return awake_ || closing_; });
    events.swap(waiting_);
    waiting_bytes_ = 0;
    awake_ = false;
    const bool last = closing_;
    lock.unlock();
    emptied_.notify_one();
    try {
      deal_with(events);
      last ? observer_.finish() : observer_.idle();
    } catch (...) {
      lock.lock();
      failure_ = std::current_exception();
      failed_ = true;
      emptied_.notify_one();
      return;
    }
    events.clear();
    lock.lock();
    if (last) return;
  }
}

void BackgroundObserver::deal_with(std::vector<Event>& events) {
  const Overloaded handler{
      [this](const wire::Forces& forces) { observer_.forces(forces); },
      [this](const wire::Kinematics& kinematics) { observer_.kinematics(kinematics); },
      [this](const Report& report) { observer_.report(report.side, report.message); },
      [this](Snapshot& snapshot) { observer_.snapshot(snapshot.side, std::move(snapshot.message)); },
      [this](Checkpoint& checkpoint) { observer_.checkpoint(std::move(checkpoint)); }};
  for (Event& event : events) std::visit(handler, event);
}

void BackgroundObserver::rethrow() {
  std::exception_ptr failure;
  {
    const std::lock_guard lock(mutex_);
    failure = std::exchange(failure_, nullptr);
  }
  if (failure) std::rethrow_exception(failure);
}

void BackgroundObserver::finish() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  filled_.notify_one();
  thread_.join();
  rethrow();
}

}  // namespace grainstep::orchestrator
