// The page over a real socket: what it answers, and what it refuses to spend on a client.
#include "live/live_server.h"

#include <gtest/gtest.h>

#include "support/error_message.h"
#include "support/http_attack.h"
#include "support/http_connection.h"
#include "support/mentions.h"
#include "support/resident_memory.h"
#include "support/wait_for.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kMostGrowth = 15;  // [MB] of this process, which is the attacker's, too
const std::string kPage = "<!DOCTYPE html><title>the page</title>";

bool begins(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

/// Skips where this package was built without the server.
class LiveServerTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!liveServerObstacle().empty()) GTEST_SKIP() << liveServerObstacle();
  }

  void start(const LiveServerLimits& limits = {}) {
    server_ = startLiveServer(0, kPage, board_, limits);
  }

  std::string answer(const std::string& request) { return answerTo(server_->port(), request); }

  LiveBoard board_;
  std::unique_ptr<LiveServer> server_;
};

TEST_F(LiveServerTest, AnswersWithThePage) {
  start();
  const std::string answered = answer(getRequest("/"));
  EXPECT_TRUE(begins(answered, "HTTP/1.1 200 OK\r\n")) << answered;
  EXPECT_NE(answered.find("\r\n\r\n" + kPage), std::string::npos) << answered;
  EXPECT_NE(answered.find("Cache-Control: no-store"), std::string::npos);
  EXPECT_EQ(answer("HEAD / HTTP/1.1\r\nHost: localhost\r\n\r\n").find(kPage), std::string::npos);
}

TEST_F(LiveServerTest, SendsTheBoardAndItsChangesAsEvents) {
  start();
  board_.post("status", "{\"state\":1}");
  HttpConnection client(server_->port());
  client.send(getRequest("/events"));
  EXPECT_NE(client.receiveUntil("{\"state\":1}").find("event: status\ndata: {\"state\":1}\n\n"),
            std::string::npos);
  board_.post("result", "{\"sequence\":7}");
  EXPECT_NE(client.receiveUntil("{\"sequence\":7}").find("event: result\ndata: {\"sequence\":7}"),
            std::string::npos);
  EXPECT_FALSE(client.ended());
}

TEST_F(LiveServerTest, RefusesWhatIsNotRead) {
  start();
  for (const std::string method : {"POST", "PUT", "DELETE", "OPTIONS", "PATCH"})
    EXPECT_TRUE(begins(answer(method + " / HTTP/1.1\r\nHost: localhost\r\n\r\n"), "HTTP/1.1 405 "))
        << method;
  for (const std::string path : {"/../etc/passwd", "/%2e%2e/etc/passwd", "//etc/passwd", "/x"})
    EXPECT_TRUE(begins(answer(getRequest(path)), "HTTP/1.1 404 ")) << path;
}

TEST_F(LiveServerTest, RefusesOtherHostsThanThisMachine) {
  start();
  const auto to = [this](const std::string& host) {
    return answer("GET / HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
  };
  EXPECT_TRUE(begins(to("localhost:8080"), "HTTP/1.1 200 "));
  EXPECT_TRUE(begins(to("evil.example"), "HTTP/1.1 403 ")) << "a name directed to 127.0.0.1";
  EXPECT_TRUE(begins(to("localhost.evil.example:80"), "HTTP/1.1 403 "));
  EXPECT_TRUE(begins(answer("GET / HTTP/1.1\r\n\r\n"), "HTTP/1.1 403 "));
}

TEST_F(LiveServerTest, ServesNeitherRangesNorCompressed) {
  start();
  const std::string answered = answer(
      "GET / HTTP/1.1\r\nHost: localhost\r\nRange: bytes=0-1,3-4\r\n"
      "Accept-Encoding: br, gzip\r\n\r\n");
  EXPECT_TRUE(begins(answered, "HTTP/1.1 200 ")) << answered;
  EXPECT_NE(answered.find(kPage), std::string::npos) << answered;
}

// httplib matches ranges by a recursion over their characters, in each of the threads.
TEST_F(LiveServerTest, SpendsNothingOnCostlyHeaders) {
  start();
  std::string ranges = "0-1";
  while (ranges.size() < 8000) ranges += ",0-1";
  const std::string request =
      "GET / HTTP/1.1\r\nHost: localhost\r\nRange: bytes=" + ranges + "\r\n\r\n";
  answer(getRequest("/"));
  const double before = residentMemory(getpid());
  for (int k = 0; k < 100; ++k) EXPECT_TRUE(begins(answer(request), "HTTP/1.1 200 "));
  EXPECT_LT(residentMemory(getpid()) - before, kMostGrowth);
}

TEST_F(LiveServerTest, EndsConnectionsThatSendTooMuchOrTooSlowly) {
  LiveServerLimits limits;
  limits.request_bytes = 1000;
  limits.request_time = std::chrono::milliseconds(200);
  start(limits);
  const std::string huge =
      answer("GET / HTTP/1.1\r\nHost: localhost\r\nA: " + std::string(6000, 'b') + "\r\n\r\n");
  EXPECT_EQ(huge.find(kPage), std::string::npos);
  HttpConnection slow(server_->port());
  const auto began = Clock::now();
  while (!slow.ended() && Clock::now() - began < std::chrono::seconds(60)) {
    slow.send("x");  // each in time, all together not
    slow.receiveUntil("none", std::chrono::seconds(0));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    slow.receiveUntil("none", std::chrono::seconds(1));
  }
  EXPECT_TRUE(slow.ended());
}

TEST_F(LiveServerTest, DropsAClientThatTakesNoEvents) {
  LiveServerLimits limits;
  limits.connections = 1;
  limits.write_time = std::chrono::milliseconds(200);
  start(limits);
  HttpConnection idle(server_->port());
  idle.send(getRequest("/events"));
  // The only connection is free again once the buffers are full and the time is over.
  int posted = 0;
  EXPECT_TRUE(waitFor([&] {
    board_.post("result", std::string(1000000, 'x') + std::to_string(++posted));
    return begins(answer(getRequest("/")), "HTTP/1.1 200 ");
  }));
  EXPECT_GT(posted, 1);
}

TEST_F(LiveServerTest, RefusesMoreConnectionsThanItServes) {
  LiveServerLimits limits;
  limits.connections = 2;
  start(limits);
  board_.post("status", "1");
  {
    HttpConnection one(server_->port()), other(server_->port());
    one.send(getRequest("/events"));
    other.send(getRequest("/events"));
    one.receiveUntil("data: 1");
    other.receiveUntil("data: 1");
    EXPECT_TRUE(begins(answer(getRequest("/")), "HTTP/1.1 503 "));
  }
  int number = 1;
  EXPECT_TRUE(waitFor([&] {
    board_.post("status", std::to_string(++number));  // finds those that have left
    return begins(answer(getRequest("/")), "HTTP/1.1 200 ");
  }));
}

TEST_F(LiveServerTest, SurvivesHostileRequestsAndOpenConnections) {
  start();
  const double before = residentMemory(getpid());
  {
    const HttpAttack attack(server_->port(), 200, 300);
    EXPECT_TRUE(waitFor([&] { return attack.sent() == 300; }));
  }
  EXPECT_LT(residentMemory(getpid()) - before, kMostGrowth);
  EXPECT_TRUE(waitFor([&] { return begins(answer(getRequest("/")), "HTTP/1.1 200 "); }));
}

TEST_F(LiveServerTest, EndsAtOnceWhateverItsClientsDo) {
  start();
  std::vector<std::unique_ptr<HttpConnection>> clients;
  for (int k = 0; k < 40; ++k) {
    clients.push_back(std::make_unique<HttpConnection>(server_->port()));
    clients.back()->send(k % 2 == 0 ? getRequest("/events") : "GET /");
  }
  board_.post("status", "1");
  clients.front()->receiveUntil("data: 1");
  const auto began = Clock::now();
  server_.reset();
  EXPECT_LT(Clock::now() - began, std::chrono::seconds(2));
  clients.front()->receiveAll();
  EXPECT_TRUE(clients.front()->ended());
}

TEST_F(LiveServerTest, SaysThatAPortIsInUse) {
  start();
  const std::string message =
      messageOf<ConfigurationError>([this] { startLiveServer(server_->port(), kPage, board_); });
  EXPECT_TRUE(
      test::mentions(message, "live_page.port: found " + std::to_string(server_->port()) + ", "))
      << message;
  EXPECT_TRUE(test::mentions(message, "another program uses it")) << message;
}

TEST(LiveServer, SaysWhatIsMissingWhereItCannotServe) {
  if (liveServerObstacle().empty()) GTEST_SKIP() << "nothing is missing";
  LiveBoard board;
  const std::string message =
      messageOf<ConfigurationError>([&board] { startLiveServer(8080, kPage, board); });
  EXPECT_TRUE(test::mentions(message, "live_page.port: found 8080")) << message;
  EXPECT_TRUE(test::mentions(message, "libcpp-httplib-dev")) << message;
}

}  // namespace
}  // namespace uncertainty_identification
