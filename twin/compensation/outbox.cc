#include "twin/compensation/outbox.h"

#include <algorithm>
#include <ranges>

namespace thermotwin::twin {
namespace {

auto with_number(std::deque<OutgoingMessage>& messages, std::uint64_t number) {
  return std::ranges::find(messages, number, &OutgoingMessage::number);
}

}  // namespace

bool Outbox::put(std::string topic, std::string payload, bool retained) {
  {
    std::lock_guard const lock(mutex_);
    if (waiting_.size() >= limits_.waiting) return false;
    waiting_.push_back({std::move(topic), std::move(payload), retained, 0});
  }
  changed_.notify_one();
  return true;
}

std::optional<OutgoingMessage> Outbox::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return closed_ || !connected_ || (!waiting_.empty() && sent_.size() < limits_.sent); });
  if (closed_ || !connected_) return std::nullopt;
  sent_.push_back(std::move(waiting_.front()));
  waiting_.pop_front();
  sent_.back().number = ++last_number_;
  return sent_.back();
}

void Outbox::acknowledged(std::uint64_t number, Clock::time_point now) {
  {
    std::lock_guard const lock(mutex_);
    auto const it = with_number(sent_, number);
    if (it == sent_.end()) return;  // of a connection that broke: it waits again
    kept_.push_back({std::move(*it), now});
    sent_.erase(it);
    while (kept_.front().acknowledged < now - limits_.doubt) kept_.pop_front();
    if (waiting_.empty() && sent_.empty()) drained_.notify_all();
  }
  changed_.notify_one();
}

void Outbox::withdraw(std::uint64_t number) {
  std::lock_guard const lock(mutex_);
  if (auto const it = with_number(sent_, number); it != sent_.end()) sent_.erase(it);
  if (waiting_.empty() && sent_.empty()) drained_.notify_all();
}

void Outbox::connected() {
  {
    std::lock_guard const lock(mutex_);
    connected_ = true;
  }
  changed_.notify_one();
}

void Outbox::disconnected(Clock::time_point now) {
  {
    std::lock_guard const lock(mutex_);
    connected_ = false;
    while (!kept_.empty() && kept_.front().acknowledged < now - limits_.doubt) kept_.pop_front();
    for (; !sent_.empty(); sent_.pop_back()) waiting_.push_front(std::move(sent_.back()));
    for (; !kept_.empty(); kept_.pop_back()) waiting_.push_front(std::move(kept_.back().message));
  }
  changed_.notify_all();
}

bool Outbox::is_connected() {
  std::lock_guard const lock(mutex_);
  return connected_;
}

void Outbox::close() {
  {
    std::lock_guard const lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

bool Outbox::closed_within(Clock::duration time) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, time, [this] { return closed_; });
}

bool Outbox::drained(Clock::time_point until) {
  std::unique_lock lock(mutex_);
  return drained_.wait_until(lock, until, [this] { return waiting_.empty() && sent_.empty(); });
}

}  // namespace thermotwin::twin
