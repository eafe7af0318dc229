#include "output/page_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "output/error.h"
#include "tests/output/http_request.h"

namespace thermotwin::output {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class Served : public testing::Test {
 protected:
  [[nodiscard]] std::string here() const { return "127.0.0.1:" + std::to_string(server.port()); }
  [[nodiscard]] std::string get(std::string const& target, std::string const& headers = "") const {
    return tests::get(server.port(), target, here(), headers);
  }

  PageServer server{
      0,
      {[] { return "<p>the page</p>"; },
       [](std::uint64_t after) { return after < 7 ? std::optional<std::string>("{\"revision\":7}") : std::nullopt; }}};
};

TEST_F(Served, AnswersWithThePageAndItsNews) {
  auto const page = get("/");
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(page, HasSubstr("<p>the page</p>"));
  EXPECT_THAT(get("/document?after=6"), HasSubstr("{\"revision\":7}"));
  EXPECT_THAT(get("/document?after=7"), StartsWith("HTTP/1.1 204"));
  EXPECT_THAT(get("/document?after=-1e9%00x"), StartsWith("HTTP/1.1 200"));
  for (char const* name : {"localhost", "[::1]"})
    EXPECT_THAT(tests::get(server.port(), "/", name + (":" + std::to_string(server.port()))),
                StartsWith("HTTP/1.1 200"));
}

/// DNS rebinding: the name of a foreign page is made to point here, and its script asks this server.
TEST_F(Served, RefusesOtherHosts) {
  auto const port = std::to_string(server.port());
  for (std::string const& host : std::vector<std::string>{
           "evil.example:" + port, "evil.example", "127.0.0.1", "127.0.0.1:1", "127.0.0.1:" + port + ".evil.example",
           "127.0.0.1.nip.io:" + port, "localhost.evil.example:" + port, "", "0.0.0.0:" + port}) {
    auto const answer = tests::get(server.port(), "/", host);
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 421")) << host;
    EXPECT_THAT(answer, Not(HasSubstr("the page"))) << host;
    EXPECT_THAT(tests::get(server.port(), "/document?after=0", host), StartsWith("HTTP/1.1 421")) << host;
  }
  EXPECT_THAT(tests::ask(server.port(), "GET / HTTP/1.0\r\n\r\n"), StartsWith("HTTP/1.1 421"));
  EXPECT_THAT(get("/", "Host: evil.example\r\n"), StartsWith("HTTP/1.1 421"));
}

TEST_F(Served, RefusesPagesOfOtherSites) {
  EXPECT_THAT(get("/document?after=0", "Sec-Fetch-Site: cross-site\r\n"), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(get("/document?after=0", "Sec-Fetch-Site: same-origin\r\n"), StartsWith("HTTP/1.1 200"));
  auto const page = get("/");
  for (char const* header : {"X-Frame-Options: DENY", "Cross-Origin-Resource-Policy: same-origin",
                             "X-Content-Type-Options: nosniff", "Cache-Control: no-store"})
    EXPECT_THAT(page, HasSubstr(header));
  EXPECT_THAT(page, Not(HasSubstr("Access-Control-Allow")));
}

TEST_F(Served, HasNoOtherPath) {
  for (char const* target : {"/../../../../etc/passwd", "/..%2f..%2f..%2fetc/passwd", "/%2e%2e/%2e%2e/etc/passwd",
                             "//etc/passwd", "/etc/passwd", "/./", "/index.html", "/run.h5",
                             "/document/../../etc/passwd", "/document/", "/\\..\\etc", "file:///etc/passwd", "/%00"}) {
    auto const answer = get(target);
    EXPECT_THAT(answer, testing::AnyOf(StartsWith("HTTP/1.1 404"), StartsWith("HTTP/1.1 400"))) << target;
    EXPECT_THAT(answer, Not(HasSubstr("root:"))) << target;
  }
  for (char const* method : {"POST", "PUT", "DELETE", "OPTIONS"})
    EXPECT_THAT(tests::ask(server.port(), std::string(method) + " / HTTP/1.1\r\nHost: " + here() +
                                              "\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"),
                Not(StartsWith("HTTP/1.1 2")))
        << method;
}

TEST_F(Served, ListensOnLoopbackOnly) {
  EXPECT_EQ(tests::ask(server.port(), "GET / HTTP/1.1\r\n\r\n", "127.0.0.2"), "");
}

TEST_F(Served, SurvivesWhatIsNoRequest) {
  for (std::string const& bytes :
       std::vector<std::string>{"\r\n\r\n", "GET", std::string(70000, 'A'),
                                "GET /" + std::string(20000, 'a') + " HTTP/1.1", "\x16\x03\x01"}) {
    EXPECT_THAT(tests::ask(server.port(), bytes + "\r\n\r\n"), Not(StartsWith("HTTP/1.1 2")));
    EXPECT_THAT(get("/"), HasSubstr("the page"));
  }
}

TEST_F(Served, SaysThatAPortIsTaken) {
  try {
    PageServer const second(server.port(), {});
    FAIL();
  } catch (OutputError const& error) {
    EXPECT_THAT(error.what(), HasSubstr("is it taken?"));
  }
}

}  // namespace
}  // namespace thermotwin::output
