#include "transport/in_process_channel.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <condition_variable>
#include <mutex>
#include <system_error>

#include "base/error.hpp"

namespace grainstep::transport {
namespace {

/// One direction. A ring whose slots keep the capacity of the buffers that passed through them.
class Queue {
 public:
  Queue() : ring_(4) {}
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;
  ~Queue() {
    if (event_ >= 0) {
      ::close(event_);
    }
  }

  /// False when the reader is gone.
  bool push(std::span<const std::byte> message) {
    {
      const std::lock_guard lock(mutex_);
      if (reader_gone_) {
        return false;
      }
      if (count_ == ring_.size()) {
        grow();
      }
      ring_[(head_ + count_) % ring_.size()].assign(message.begin(), message.end());
      ++count_;
      signal();
    }
    arrived_.notify_one();
    return true;
  }

  enum class Taken { message, nothing, writer_gone };

  Taken pop(Bytes& message, Deadline deadline) {
    std::unique_lock lock(mutex_);
    clear_signal();
    if (count_ == 0 && !writer_gone_ && Clock::now() < deadline) {  // a mere look costs no system call
      arrived_.wait_until(lock, deadline, [this] { return count_ > 0 || writer_gone_; });
    }
    if (count_ == 0) {
      return writer_gone_ ? Taken::writer_gone : Taken::nothing;
    }
    ring_[head_].swap(message);  // the receiver's old buffer stays in the ring for a later message
    head_ = (head_ + 1) % ring_.size();
    --count_;
    return Taken::message;
  }

  void close_writer() {
    {
      const std::lock_guard lock(mutex_);
      writer_gone_ = true;
      signal();
    }
    arrived_.notify_one();
  }

  void close_reader() {
    const std::lock_guard lock(mutex_);
    reader_gone_ = true;
  }

  /// Made on first use: a system call per message is only paid by those who poll.
  int wakeup() {
    const std::lock_guard lock(mutex_);
    if (event_ < 0) {
      event_ = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
      if (event_ < 0) {
        throw std::system_error(errno, std::generic_category(), "eventfd");
      }
      if (count_ > 0 || writer_gone_) {
        signal();
      }
    }
    return event_;
  }

 private:
  void grow() {
    std::vector<Bytes> larger(2 * ring_.size());
    for (std::size_t i = 0; i < count_; ++i) {
      larger[i].swap(ring_[(head_ + i) % ring_.size()]);
    }
    ring_.swap(larger);
    head_ = 0;
  }

  void signal() const {
    if (event_ >= 0) {
      ::eventfd_write(event_, 1);
    }
  }

  void clear_signal() const {
    if (event_ >= 0) {
      eventfd_t count = 0;
      ::eventfd_read(event_, &count);
    }
  }

  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<Bytes> ring_;
  std::size_t head_ = 0;
  std::size_t count_ = 0;
  bool writer_gone_ = false;
  bool reader_gone_ = false;
  int event_ = -1;
};

class InProcessChannel final : public Channel {
 public:
  InProcessChannel(std::string peer, std::shared_ptr<Queue> outgoing, std::shared_ptr<Queue> incoming)
      : peer_(std::move(peer)), outgoing_(std::move(outgoing)), incoming_(std::move(incoming)) {}

  InProcessChannel(const InProcessChannel&) = delete;
  InProcessChannel& operator=(const InProcessChannel&) = delete;

  ~InProcessChannel() override {
    outgoing_->close_writer();
    incoming_->close_reader();
  }

  void send(std::span<const std::byte> message) override {
    if (!outgoing_->push(message)) {
      throw PeerError(peer_, "closed its channel");
    }
  }

  bool receive(Bytes& message, Deadline deadline) override {
    const auto taken = incoming_->pop(message, deadline);
    if (taken == Queue::Taken::writer_gone) {
      throw PeerError(peer_, "closed its channel");
    }
    return taken == Queue::Taken::message;
  }

  int wakeup() const override { return incoming_->wakeup(); }

 private:
  std::string peer_;
  std::shared_ptr<Queue> outgoing_;
  std::shared_ptr<Queue> incoming_;
};

}  // namespace

std::pair<std::unique_ptr<Channel>, std::unique_ptr<Channel>> make_in_process_pair(PairNames names) {
  auto forth = std::make_shared<Queue>();
  auto back = std::make_shared<Queue>();
  auto first = std::make_unique<InProcessChannel>(std::move(names.second), forth, back);
  auto second = std::make_unique<InProcessChannel>(std::move(names.first), back, forth);
  return {std::move(first), std::move(second)};
}

}  // namespace grainstep::transport
