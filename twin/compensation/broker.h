#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace thermotwin::twin {

/// How to reach an MQTT broker, and what it shall say when we vanish.
struct BrokerOptions {
  std::string url = "mqtt://127.0.0.1:1883";  ///< mqtts:// for TLS
  std::string client;                         ///< unique at the broker: who comes with the same name ends the other
  std::string user;
  std::filesystem::path password_file;  ///< its first line
  std::filesystem::path ca_file;        ///< that the broker's certificate must come from; default: the system's
  std::filesystem::path certificate_file, key_file;  ///< ours, where the broker wants one
  std::string status_topic;                          ///< "online" while we are there, "offline" after, by our last will
};

struct BrokerMessage {
  std::string topic, payload;
  std::chrono::steady_clock::time_point arrived;
};

/// A connection to a broker: MQTT 3.1.1, quality of service 1 in both directions.
///
/// When it breaks, it is made anew, after ¼, ½, 1, … at most 30 s; what is published meanwhile waits (up to a million
/// messages), and the broker keeps what is sent to us, if it keeps sessions (mosquitto: `persistence true`). What it
/// acknowledged in the last seconds before is published again (Outbox): a message may come twice, and then late. A
/// session from before this connection is discarded.
class Broker {
 public:
  /// Connects and subscribes. InputError that names the broker and the reason: unreachable, refused, certificate.
  Broker(BrokerOptions const& options, std::vector<std::string> const& topics);
  ~Broker();
  Broker(Broker const&) = delete;
  Broker& operator=(Broker const&) = delete;

  /// Hands a message over; it does not wait. False when too many wait already.
  bool publish(std::string const& topic, std::string const& payload, bool retained = false);
  /// The next message, waiting for it no longer than until then.
  std::optional<BrokerMessage> receive(std::chrono::steady_clock::time_point until);

  [[nodiscard]] bool connected() const;
  [[nodiscard]] int reconnections() const;
  /// Waits until the broker has acknowledged everything published; false when the time was too short.
  bool flush(std::chrono::milliseconds patience);

 private:
  class Client;
  std::unique_ptr<Client> client_;
};

}  // namespace thermotwin::twin
