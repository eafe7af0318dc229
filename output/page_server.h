#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace thermotwin::output {

/// A page served on this computer's loopback address, to this computer's browsers only.
///
/// It answers `GET /` with the page and `GET /document?after=REVISION` with what is newer (200, JSON) or nothing (204),
/// and nothing else: no part of a request ever becomes the name of a file. A request whose Host is not
/// 127.0.0.1, localhost or [::1] with this port is refused (421), so that a foreign page whose name was made to point
/// here (DNS rebinding) reads nothing; so is one that another site's page makes (Sec-Fetch-Site, 403). What is sent may
/// not be framed, sniffed, kept, or read by other origins.
class PageServer {
 public:
  /// Called from threads of the server, at any time until its end.
  struct Source {
    std::function<std::string()> page;                                    ///< HTML
    std::function<std::optional<std::string>(std::uint64_t after)> news;  ///< JSON; none: nothing is newer
  };

  /// Port 0: any that is free. OutputError when the port is taken.
  PageServer(int port, Source source);
  ~PageServer();
  PageServer(PageServer const&) = delete;
  PageServer& operator=(PageServer const&) = delete;

  /// "http://127.0.0.1:40123/"
  [[nodiscard]] std::string address() const;
  [[nodiscard]] int port() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermotwin::output
