#pragma once

#include <arpa/inet.h>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <memory>
#include <netinet/in.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace thermotwin::tests {

/// A child process that ends with its owner. Both its streams go to a file.
class Child {
 public:
  Child(std::vector<std::string> const& command, std::string const& output) : pid_(::fork()) {
    if (pid_ != 0) return;
    int const file = ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, 1);
    ::dup2(file, 2);
    std::vector<char*> arguments;
    for (auto const& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
  ~Child() { end(SIGKILL); }
  Child(Child const&) = delete;
  Child& operator=(Child const&) = delete;

  /// Its exit code; −1 when a signal ended it.
  int end(int signal) {
    if (pid_ <= 0) return code_;
    ::kill(pid_, signal);
    return wait();
  }
  int wait() {
    int status = 0;
    if (pid_ > 0 && ::waitpid(pid_, &status, 0) == pid_) code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    pid_ = 0;
    return code_;
  }

 private:
  pid_t pid_;
  int code_ = -1;
};

/// A loopback port that is free now.
inline int free_port() {
  int const socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ::bind(socket, reinterpret_cast<sockaddr*>(&address), size);
  ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  ::close(socket);
  return ntohs(address.sin_port);
}

inline bool answers(int port) {
  int const socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(std::uint16_t(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  bool const there = ::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  ::close(socket);
  return there;
}

/// Mosquitto on a loopback port of its own, with further lines of its configuration.
class BrokerProcess {
 public:
  BrokerProcess(std::string directory, std::string const& lines = "allow_anonymous true\n")
      : directory_(std::move(directory)), port_(free_port()) {
    std::ofstream(directory_ + "/mosquitto.conf")
        << "listener " << port_ << " 127.0.0.1\nmax_queued_messages 0\npersistence true\nautosave_interval 1\n"
        << "persistence_location " << directory_ << "/\n"
        << (::getuid() == 0 ? "user root\n" : "") << lines;
    start();
  }

  void start() {
    process_ = std::make_unique<Child>(
        std::vector<std::string>{"/usr/sbin/mosquitto", "-c", directory_ + "/mosquitto.conf"}, directory_ + "/broker");
    for (int i = 0; i < 500 && !answers(port_); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (!answers(port_)) throw std::runtime_error("mosquitto does not start: " + directory_ + "/broker");
  }
  void kill() { process_->end(SIGKILL); }

  /// Until so many programs have connected, as its log tells.
  void wait_for_clients(int count) const {
    for (int i = 0; i < 1000 && connected() < count; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (connected() < count) throw std::runtime_error("a program does not connect: " + directory_ + "/broker");
  }

  /// Until it has written down twice what it knows: the second time begins after this call.
  void wait_until_saved() const {
    for (int saves = 0; saves < 2; ++saves) {
      auto const before = last_save();
      for (int i = 0; i < 6000 && last_save() == before; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }

  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] std::string url(std::string const& scheme = "mqtt") const {
    return scheme + "://127.0.0.1:" + std::to_string(port_);
  }

 private:
  [[nodiscard]] int connected() const {
    int count = 0;
    std::ifstream log(directory_ + "/broker");
    for (std::string line; std::getline(log, line);) count += int(line.find("New client connected") != line.npos);
    return count;
  }
  [[nodiscard]] std::filesystem::file_time_type last_save() const {
    std::error_code none_yet;
    return std::filesystem::last_write_time(directory_ + "/mosquitto.db", none_yet);
  }

  std::string directory_;
  int port_;
  std::unique_ptr<Child> process_;
};

}  // namespace thermotwin::tests
