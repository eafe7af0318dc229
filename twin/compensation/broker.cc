// The only file that knows Paho MQTT.
#include "twin/compensation/broker.h"

#include <atomic>
#include <charconv>
#include <condition_variable>
#include <deque>
#include <fmt/format.h>
#include <fstream>
#include <mqtt/async_client.h>
#include <mutex>
#include <string_view>
#include <thread>

#include "thermal/error.h"
#include "twin/compensation/outbox.h"

namespace thermotwin::twin {
namespace {

using namespace std::chrono_literals;

constexpr int at_least_once = 1;
constexpr int most_at_paho = int(Outbox::Limits{}.sent) + 10;  ///< and what is announced
constexpr auto patience_at_start = 10s;
constexpr auto patience_at_end = 500ms;
constexpr std::chrono::milliseconds shortest_delay = 250ms, longest_delay = 30s;
constexpr char const* online = "online";
constexpr char const* offline = "offline";

bool is_host(std::string_view host) {
  bool const numeric = host.starts_with('[') && host.ends_with(']');
  auto const allowed = numeric ? host.substr(1, host.size() - 2) : host;
  return !allowed.empty() && allowed.find_first_of(numeric ? "[]/ \t" : "[]:/ \t") == allowed.npos;
}

bool is_port(std::string_view port) {
  int number = -1;
  auto const end = port.data() + port.size();
  return port.size() <= 5 && std::from_chars(port.data(), end, number).ptr == end && number >= 0 && number <= 65535;
}

/// Paho writes tcp and ssl, and takes whatever stands for a port.
std::string paho_url(std::string const& url) {
  bool const secure = url.starts_with("mqtts://");
  auto const rest = std::string_view(url).substr(secure ? 8 : std::min<std::size_t>(7, url.size()));
  auto const host = rest.substr(0, rest.starts_with('[') ? rest.find(']') + 1 : rest.find(':'));
  auto const port = rest.substr(host.size());
  bool const good = (secure || url.starts_with("mqtt://")) && is_host(host) &&
                    (port.empty() || (port.starts_with(':') && is_port(port.substr(1))));
  if (!good)
    throw thermal::InputError(fmt::format("broker '{}': write mqtt://HOST:1883, or mqtts://HOST:8883 for TLS", url));
  return fmt::format("{}{}", secure ? "ssl://" : "tcp://", rest);
}

/// Most failures have the same number at Paho.
std::string reason(mqtt::exception const& error, std::string const& url) {
  if (error.get_return_code() != MQTTASYNC_FAILURE) return error.get_error_str();
  return url.starts_with("mqtts")
             ? "no broker with TLS answers there, or one whose certificate --ca does not vouch for, "
               "or one that wants another --certificate than ours"
             : "no broker answers there, or one with TLS (mqtts://HOST:8883)";
}

std::string first_line(std::filesystem::path const& file) {
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line)) throw thermal::InputError(fmt::format("{}: no password to read", file.string()));
  return line;
}

void require_file(std::filesystem::path const& file) {
  if (!file.empty() && !std::ifstream(file)) throw thermal::InputError(file.string() + ": the file cannot be read");
}

mqtt::ssl_options tls(BrokerOptions const& options) {
  for (auto const& file : {options.ca_file, options.certificate_file, options.key_file}) require_file(file);
  mqtt::ssl_options ssl;
  if (options.ca_file.empty())
    ssl.ca_path("/etc/ssl/certs");
  else
    ssl.set_trust_store(options.ca_file.string());
  if (!options.certificate_file.empty()) ssl.set_key_store(options.certificate_file.string());
  if (!options.key_file.empty()) ssl.set_private_key(options.key_file.string());
  ssl.set_enable_server_cert_auth(true);
  ssl.set_verify(true);
  return ssl;
}

mqtt::connect_options connection(BrokerOptions const& options) {
  mqtt::connect_options connect;
  connect.set_mqtt_version(MQTTVERSION_3_1_1);
  connect.set_connect_timeout(5s);
  connect.set_keep_alive_interval(20s);
  connect.set_max_inflight(most_at_paho);
  if (!options.user.empty()) connect.set_user_name(options.user);
  if (!options.password_file.empty()) connect.set_password(first_line(options.password_file));
  if (options.url.starts_with("mqtts://")) connect.set_ssl(tls(options));
  if (!options.status_topic.empty())
    connect.set_will(mqtt::will_options(options.status_topic, std::string(offline), at_least_once, true));
  return connect;
}

}  // namespace

/// Paho's client serves for one connection: what it would keep of a broken one, the outbox keeps. (1.3.12 was seen to
/// send packets again that a broker calls malformed, for ever.)
class Broker::Client : private mqtt::iaction_listener {
 public:
  Client(BrokerOptions const& options, std::vector<std::string> const& topics);
  ~Client() override;

  bool publish(std::string const& topic, std::string const& payload, bool retained) {
    return outbox_.put(topic, payload, retained);
  }
  std::optional<BrokerMessage> receive(std::chrono::steady_clock::time_point until);
  [[nodiscard]] bool connected() { return outbox_.is_connected(); }
  [[nodiscard]] int reconnections() const { return reconnections_; }
  bool flush(std::chrono::milliseconds patience) { return outbox_.drained(Outbox::Clock::now() + patience); }

 private:
  void open(bool afresh);
  void leave();
  void keep(mqtt::const_message_ptr const& message);
  void serve();
  bool open_again();
  void send(OutgoingMessage const& message);
  void on_success(mqtt::token const& token) override { outbox_.acknowledged(number_of(token)); }
  void on_failure(mqtt::token const&) override {}  // the connection broke: the outbox knows
  static std::uint64_t number_of(mqtt::token const& token) {
    return std::uint64_t(reinterpret_cast<std::uintptr_t>(token.get_user_context()));
  }

  BrokerOptions options_;
  mqtt::const_string_collection_ptr topics_;
  mqtt::iasync_client::qos_collection qualities_;
  std::atomic<int> reconnections_ = 0;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<BrokerMessage> messages_;
  Outbox outbox_{{}};
  std::unique_ptr<mqtt::async_client> client_;
  std::thread server_;  ///< Paho may keep it waiting; who publishes does not
};

Broker::Client::Client(BrokerOptions const& options, std::vector<std::string> const& topics)
    : options_(options), topics_(mqtt::string_collection::create(topics)), qualities_(topics.size(), at_least_once) {
  open(true);
  client_->disconnect()->wait();
  open(false);
  server_ = std::thread([this] { serve(); });
}

Broker::Client::~Client() {
  if (connected()) flush(patience_at_end);
  outbox_.close();
  server_.join();
  try {
    leave();
  } catch (mqtt::exception const&) {
    // it is gone already, and its last will says so
  }
}

void Broker::Client::leave() {
  client_->disable_callbacks();
  if (!client_->is_connected()) return;
  if (!options_.status_topic.empty())
    client_->publish(options_.status_topic, offline, at_least_once, true)->wait_for(patience_at_end);
  if (!topics_->empty()) client_->unsubscribe(topics_)->wait_for(patience_at_end);
  client_->disconnect()->wait_for(patience_at_end);
}

/// `afresh`: what an earlier session left behind is forgotten, and nothing subscribed. Otherwise a broker that lost its
/// sessions is told again what we are waiting for, and whoever is told that we are here is heard.
void Broker::Client::open(bool afresh) {
  auto settings = connection(options_);
  settings.set_clean_session(afresh);
  client_.reset();
  client_ = std::make_unique<mqtt::async_client>(
      paho_url(options_.url), options_.client,
      mqtt::create_options_builder().max_buffered_messages(most_at_paho).finalize(), nullptr);
  client_->set_message_callback([this](mqtt::const_message_ptr const& message) { keep(message); });
  client_->set_connection_lost_handler([this](std::string const&) { outbox_.disconnected(); });
  try {
    if (!client_->connect(settings)->wait_for(patience_at_start))
      throw thermal::InputError(fmt::format("the broker {} does not answer", options_.url));
    if (afresh) return;
    if (!topics_->empty() && !client_->subscribe(topics_, qualities_)->wait_for(patience_at_start))
      throw thermal::InputError(fmt::format("the broker {} does not answer a subscription", options_.url));
    if (!options_.status_topic.empty()) client_->publish(options_.status_topic, online, at_least_once, true);
  } catch (mqtt::exception const& error) {
    throw thermal::InputError(
        fmt::format("the broker {} cannot be reached: {}", options_.url, reason(error, options_.url)));
  }
  outbox_.connected();
  if (!client_->is_connected()) outbox_.disconnected();  // it broke before that
}

void Broker::Client::keep(mqtt::const_message_ptr const& message) {
  auto const now = std::chrono::steady_clock::now();
  {
    std::lock_guard const lock(mutex_);
    messages_.push_back({message->get_topic(), message->to_string(), now});
  }
  arrived_.notify_one();
}

void Broker::Client::serve() {
  do
    while (auto const message = outbox_.next()) send(*message);
  while (open_again());
}

void Broker::Client::send(OutgoingMessage const& message) {
  try {
    auto* const number = reinterpret_cast<void*>(std::uintptr_t(message.number));
    client_->publish(message.topic, message.payload.data(), message.payload.size(), at_least_once, message.retained,
                     number, *this);
  } catch (mqtt::exception const& error) {
    if (error.get_return_code() == MQTTASYNC_DISCONNECTED)
      outbox_.disconnected();
    else
      outbox_.withdraw(message.number);
  }
}

/// False when we are to end.
bool Broker::Client::open_again() {
  for (auto delay = shortest_delay; !outbox_.closed_within(delay); delay = std::min(2 * delay, longest_delay)) try {
      open(false);
      ++reconnections_;
      return true;
    } catch (thermal::InputError const&) {
      // the next attempt
    }
  return false;
}

std::optional<BrokerMessage> Broker::Client::receive(std::chrono::steady_clock::time_point until) {
  std::unique_lock lock(mutex_);
  if (!arrived_.wait_until(lock, until, [this] { return !messages_.empty(); })) return std::nullopt;
  BrokerMessage message = std::move(messages_.front());
  messages_.pop_front();
  return message;
}

Broker::Broker(BrokerOptions const& options, std::vector<std::string> const& topics)
    : client_(std::make_unique<Client>(options, topics)) {}
Broker::~Broker() = default;
bool Broker::publish(std::string const& topic, std::string const& payload, bool retained) {
  return client_->publish(topic, payload, retained);
}
std::optional<BrokerMessage> Broker::receive(std::chrono::steady_clock::time_point until) {
  return client_->receive(until);
}
bool Broker::connected() const { return client_->connected(); }
int Broker::reconnections() const { return client_->reconnections(); }
bool Broker::flush(std::chrono::milliseconds patience) { return client_->flush(patience); }

}  // namespace thermotwin::twin
