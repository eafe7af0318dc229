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

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using namespace std::chrono_literals;

constexpr int at_least_once = 1;
constexpr int most_waiting = 1'000'000;
constexpr auto patience_at_start = 10s;
constexpr auto patience_at_end = 500ms;
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
  connect.set_max_inflight(1000);
  if (!options.user.empty()) connect.set_user_name(options.user);
  if (!options.password_file.empty()) connect.set_password(first_line(options.password_file));
  if (options.url.starts_with("mqtts://")) connect.set_ssl(tls(options));
  if (!options.status_topic.empty())
    connect.set_will(mqtt::will_options(options.status_topic, std::string(offline), at_least_once, true));
  return connect;
}

}  // namespace

class Broker::Client {
 public:
  Client(BrokerOptions const& options, std::vector<std::string> const& topics);
  ~Client();

  bool publish(std::string const& topic, std::string const& payload, bool retained);
  std::optional<BrokerMessage> receive(std::chrono::steady_clock::time_point until);
  [[nodiscard]] bool connected() const { return client_.is_connected(); }
  [[nodiscard]] int reconnections() const { return std::max(0, connections_ - 1); }
  bool flush(std::chrono::milliseconds patience);

 private:
  void connect(mqtt::connect_options options);
  void on_connected();
  void announce();
  void keep(mqtt::const_message_ptr const& message);

  mqtt::async_client client_;
  std::string url_, status_topic_;
  mqtt::const_string_collection_ptr topics_;
  mqtt::iasync_client::qos_collection qualities_;
  std::atomic<int> connections_ = 0;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<BrokerMessage> messages_;
};

Broker::Client::Client(BrokerOptions const& options, std::vector<std::string> const& topics)
    : client_(
          paho_url(options.url), options.client,
          mqtt::create_options_builder().send_while_disconnected(true).max_buffered_messages(most_waiting).finalize(),
          nullptr),
      url_(options.url),
      status_topic_(options.status_topic),
      topics_(mqtt::string_collection::create(topics)),
      qualities_(topics.size(), at_least_once) {
  auto settings = connection(options);
  settings.set_clean_session(true);  // forget what an earlier session left behind
  connect(settings);
  client_.disconnect()->wait();
  client_.set_message_callback([this](mqtt::const_message_ptr const& message) { keep(message); });
  client_.set_connected_handler([this](std::string const&) { on_connected(); });
  settings.set_clean_session(false);
  settings.set_automatic_reconnect(1s, 30s);
  connect(settings);
  if (!topics.empty() && !client_.subscribe(topics_, qualities_)->wait_for(patience_at_start))
    throw thermal::InputError(fmt::format("the broker {} does not answer a subscription", url_));
  announce();  // whoever is told that we are here is heard
}

Broker::Client::~Client() {
  try {
    client_.disable_callbacks();
    if (!client_.is_connected()) return;
    if (!status_topic_.empty()) client_.publish(status_topic_, offline, at_least_once, true)->wait_for(patience_at_end);
    if (!topics_->empty()) client_.unsubscribe(topics_)->wait_for(patience_at_end);
    client_.disconnect()->wait_for(patience_at_end);
  } catch (mqtt::exception const&) {
    // it is gone already, and its last will says so
  }
}

void Broker::Client::connect(mqtt::connect_options options) {
  try {
    if (!client_.connect(std::move(options))->wait_for(patience_at_start))
      throw thermal::InputError(fmt::format("the broker {} does not answer", url_));
  } catch (mqtt::exception const& error) {
    throw thermal::InputError(fmt::format("the broker {} cannot be reached: {}", url_, reason(error, url_)));
  }
}

/// A broker that lost its sessions does not know what we are waiting for.
void Broker::Client::on_connected() {
  try {
    if (++connections_ == 1) return;
    if (!topics_->empty()) client_.subscribe(topics_, qualities_);
    announce();
  } catch (mqtt::exception const&) {
    // the connection broke again: the next one will do
  }
}

void Broker::Client::announce() {
  if (!status_topic_.empty()) publish(status_topic_, online, true);
}

void Broker::Client::keep(mqtt::const_message_ptr const& message) {
  auto const now = std::chrono::steady_clock::now();
  {
    std::lock_guard const lock(mutex_);
    messages_.push_back({message->get_topic(), message->to_string(), now});
  }
  arrived_.notify_one();
}

bool Broker::Client::publish(std::string const& topic, std::string const& payload, bool retained) {
  try {
    client_.publish(topic, payload, at_least_once, retained);
    return true;
  } catch (mqtt::exception const&) {
    return false;
  }
}

std::optional<BrokerMessage> Broker::Client::receive(std::chrono::steady_clock::time_point until) {
  std::unique_lock lock(mutex_);
  if (!arrived_.wait_until(lock, until, [this] { return !messages_.empty(); })) return std::nullopt;
  BrokerMessage message = std::move(messages_.front());
  messages_.pop_front();
  return message;
}

bool Broker::Client::flush(std::chrono::milliseconds patience) {
  auto const until = std::chrono::steady_clock::now() + patience;
  for (auto const& token : client_.get_pending_delivery_tokens()) {
    auto const left = until - std::chrono::steady_clock::now();
    try {
      if (left <= 0s || !token->wait_for(std::chrono::duration_cast<std::chrono::milliseconds>(left))) return false;
    } catch (mqtt::exception const&) {
      return false;
    }
  }
  return true;
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
