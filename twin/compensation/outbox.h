#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

namespace thermotwin::twin {

struct OutgoingMessage {
  std::string topic, payload;
  bool retained = false;
  std::uint64_t number = 0;  ///< of this time of sending: a message that is sent again has another one

  bool operator==(OutgoingMessage const&) const = default;
};

/// What is on its way to a broker, in the order in which it was put: waiting → sent → acknowledged.
///
/// An acknowledgement says that the broker has a message, not that it handed it on: a broker that is killed takes with
/// it what it had not. So a message is kept for `doubt` after its acknowledgement, and when the connection breaks
/// everything that was sent and is still kept waits again, before all else. What arrives may therefore arrive twice.
/// Threads may share it; whoever puts does not wait for the network.
class Outbox {
 public:
  using Clock = std::chrono::steady_clock;

  struct Limits {
    std::size_t waiting = 1'000'000;
    std::size_t sent = 200;                           ///< without an acknowledgement
    Clock::duration doubt = std::chrono::seconds(5);  ///< longer than a broker keeps what it acknowledged to itself
  };

  explicit Outbox(Limits const& limits) : limits_(limits) {}

  /// False when too many wait already.
  bool put(std::string topic, std::string payload, bool retained);
  /// The next one to send, as soon as there is one and room among the sent ones; nothing without a connection or once
  /// closed.
  std::optional<OutgoingMessage> next();

  void acknowledged(std::uint64_t number, Clock::time_point now = Clock::now());
  void withdraw(std::uint64_t number);  ///< it can never be sent
  void connected();
  void disconnected(Clock::time_point now = Clock::now());
  [[nodiscard]] bool is_connected();
  void close();
  /// Waits; true as soon as it is closed.
  bool closed_within(Clock::duration time);

  /// Waits until all is acknowledged; false when the time was too short.
  bool drained(Clock::time_point until);

 private:
  struct Kept {
    OutgoingMessage message;
    Clock::time_point acknowledged;
  };

  Limits limits_;
  std::mutex mutex_;
  std::condition_variable changed_, drained_;
  std::deque<OutgoingMessage> waiting_, sent_;
  std::deque<Kept> kept_;
  std::uint64_t last_number_ = 0;
  bool connected_ = false, closed_ = false;
};

}  // namespace thermotwin::twin
