#include "live/live_page.h"

#include <gtest/gtest.h>

#include <atomic>

#include "io/report.h"
#include "support/core_setup.h"
#include "support/error_message.h"
#include "support/example_explanation.h"
#include "support/http_connection.h"
#include "support/plain_estimate.h"
#include "support/wait_for.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// A page of a node that counts how often it is asked. Skips where none can be served.
class LivePageTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string obstacle = liveServerObstacle() + reportObstacle();
    if (!obstacle.empty()) GTEST_SKIP() << obstacle;
    port_ = freePort();
    LivePage::Source source;
    source.status = [this] {
      ++asked_;
      LiveStatus status;
      status.node.worker.queue = queue_;
      return status;
    };
    source.experiments = [] { return std::vector<ExperimentDigest>{{"run7", 1, 0.1, 50, ""}}; };
    page_ = std::make_unique<LivePage>(port_, source);
  }

  static Result someResult() {
    return {test::plainEstimate(test::vectorOf({1.0}), test::vectorOf({-0.5})), {}};
  }

  static ResultContext numbered(std::uint32_t sequence) {
    ResultContext context;
    context.sequence = sequence;
    return context;
  }

  /// What a browser that comes now is told, up to the end of this text.
  std::string toldUntil(const std::string& text) {
    HttpConnection client(port_);
    client.send(getRequest("/events"));
    return client.receiveUntil(text);
  }

  int port_ = 0;
  std::atomic<int> asked_{0}, queue_{0};
  std::unique_ptr<LivePage> page_;
};

TEST_F(LivePageTest, ServesThePageOfTheReportsFiles) {
  EXPECT_NE(answerTo(port_, getRequest("/")).find(livePageHtml()), std::string::npos);
}

TEST_F(LivePageTest, TellsHowTheNodeIs) {
  page_->start();
  EXPECT_NE(toldUntil("run7").find("event: experiments"), std::string::npos);
  queue_ = 3;
  page_->changed();
  EXPECT_NE(toldUntil("\"waiting_experiments\":3").find("event: status"), std::string::npos);
}

TEST_F(LivePageTest, AsksTheNodeAFewTimesASecondAtMost) {
  page_->start();
  const auto began = std::chrono::steady_clock::now();
  for (int k = 0; k < 100000; ++k) page_->changed(Progress{"optimising", 0.5, {}});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  EXPECT_LE(asked_, 2 + 5 * took.count());
}

TEST_F(LivePageTest, ShowsResultsAndExplanations) {
  page_->show(someResult(), numbered(3));
  page_->show(test::exampleExplanation());
  const std::string told = toldUntil("act_deadzone");
  EXPECT_NE(told.find("event: result"), std::string::npos);
  EXPECT_NE(told.find("\"sequence\":3"), std::string::npos);
}

// A summary that is computed while the node is reset comes after it.
TEST_F(LivePageTest, ForgetsResultsAlsoThoseThatComeLate) {
  page_->show(someResult(), numbered(3));
  page_->forget(4);
  page_->show(someResult(), numbered(4));
  EXPECT_EQ(toldUntil("event: explanation").find("sequence"), std::string::npos);
  page_->show(someResult(), numbered(5));
  EXPECT_NE(toldUntil("\"sequence\":5").find("\"sequence\":5"), std::string::npos);
}

TEST_F(LivePageTest, CanBeToldThingsAfterItsEnd) {
  page_->start();
  page_->stop();
  page_->changed();
  page_->show(someResult(), numbered(1));
  EXPECT_THROW(HttpConnection client(port_), std::runtime_error);
}

TEST_F(LivePageTest, RefusesAPortThatIsTaken) {
  const std::string message = messageOf<ConfigurationError>([this] { LivePage second(port_, {}); });
  EXPECT_EQ(message.rfind("live_page.port: ", 0), 0U) << message;
}

}  // namespace
}  // namespace uncertainty_identification
