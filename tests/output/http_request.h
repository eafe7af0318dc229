#pragma once

#include <arpa/inet.h>
#include <array>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

namespace thermotwin::tests {

/// What a server at an address of this computer answers to these bytes; "" when nobody listens there.
inline std::string ask(int port, std::string const& bytes, char const* address = "127.0.0.1") {
  int const socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(std::uint16_t(port));
  inet_pton(AF_INET, address, &there.sin_addr);
  std::string answer;
  if (::connect(socket, reinterpret_cast<sockaddr*>(&there), sizeof there) == 0) {
    [[maybe_unused]] auto const sent = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    std::array<char, 4096> buffer{};
    while (ssize_t const n = ::recv(socket, buffer.data(), buffer.size(), 0)) {
      if (n < 0) break;
      answer.append(buffer.data(), std::size_t(n));
    }
  }
  ::close(socket);
  return answer;
}

/// The answer to a GET of exactly this target, as a browser that was led to `host` would ask.
inline std::string get(int port, std::string const& target, std::string const& host, std::string const& headers = "") {
  return ask(port, "GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n" + headers + "\r\n");
}

}  // namespace thermotwin::tests
