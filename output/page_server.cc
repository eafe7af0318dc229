// The only file that knows cpp-httplib.
#include "output/page_server.h"

#include <charconv>
#include <fmt/format.h>
#include <httplib.h>
#include <thread>

#include "output/error.h"

namespace thermotwin::output {
namespace {

using httplib::Request;
using httplib::Response;

constexpr char const* loopback = "127.0.0.1";

/// Piece by piece: a whole text would be packed with Brotli, which takes seconds for what stays on this computer.
void answer(Response& response, int status, std::string text, char const* type = "text/plain; charset=utf-8") {
  response.status = status;
  auto const size = text.size();
  response.set_content_provider(size, type, [text = std::move(text)](std::size_t at, std::size_t n, auto& sink) {
    return sink.write(text.data() + at, n);
  });
}

bool from_here(Request const& request, int port) {
  auto const host = request.get_header_value("Host");
  for (char const* name : {loopback, "localhost", "[::1]"})
    if (host == fmt::format("{}:{}", name, port) || (port == 80 && host == name))
      return request.get_header_value_count("Host") == 1;
  return false;
}

/// Browsers say so when another site's page is behind a request; those that do not say are told apart by Host.
bool from_another_site(Request const& request) {
  auto const site = request.get_header_value("Sec-Fetch-Site");
  return site == "cross-site" || site == "same-site";
}

std::uint64_t revision_of(Request const& request) {
  auto const text = request.get_param_value("after");
  std::uint64_t revision = 0;
  std::from_chars(text.data(), text.data() + text.size(), revision);
  return revision;
}

}  // namespace

struct PageServer::Impl {
  explicit Impl(Source given) : source(std::move(given)) {}

  Source source;
  httplib::Server server;
  std::thread thread;
  int port = 0;

  void arrange() {
    server.set_keep_alive_timeout(1);  // s: how long an idle browser can hold up the end
    server.set_read_timeout(2);
    server.set_socket_options([](socket_t socket) {  // the library's own would let two programs share a port
      int const yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    server.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                                {"X-Frame-Options", "DENY"},
                                {"Cross-Origin-Resource-Policy", "same-origin"},
                                {"Cache-Control", "no-store"},
                                {"Referrer-Policy", "no-referrer"}});
    server.set_pre_routing_handler([this](Request const& request, Response& response) {
      using Handled = httplib::Server::HandlerResponse;
      if (!from_here(request, port))
        answer(response, 421, "This address is served to this computer only.\n");
      else if (from_another_site(request))
        answer(response, 403, "Another site's page may not ask for this.\n");
      else
        return Handled::Unhandled;
      return Handled::Handled;
    });
    server.Get("/", [this](Request const&, Response& response) {
      answer(response, 200, source.page(), "text/html; charset=utf-8");
    });
    server.Get("/document", [this](Request const& request, Response& response) {
      if (auto news = source.news(revision_of(request)))
        answer(response, 200, std::move(*news), "application/json");
      else
        response.status = 204;
    });
  }
};

PageServer::PageServer(int port, Source source) : impl_(std::make_unique<Impl>(std::move(source))) {
  impl_->arrange();
  impl_->port = port;
  bool const bound = port == 0 ? (impl_->port = impl_->server.bind_to_any_port(loopback)) > 0
                               : impl_->server.bind_to_port(loopback, port);
  if (!bound) throw OutputError(fmt::format("port {} of {} cannot be had: is it taken?", port, loopback));
  impl_->thread = std::thread([this] { impl_->server.listen_after_bind(); });
  while (!impl_->server.is_running()) std::this_thread::yield();
}

PageServer::~PageServer() {
  impl_->server.stop();
  impl_->thread.join();
}

std::string PageServer::address() const { return fmt::format("http://{}:{}/", loopback, impl_->port); }

int PageServer::port() const { return impl_->port; }

}  // namespace thermotwin::output
