#include "live/live_server.h"

#include <chrono>
#include <thread>
#include <utility>

#include "live/http/bounded_server.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using httplib::Request;
using httplib::Response;

constexpr const char* kText = "text/plain; charset=utf-8";

/// Whether the host of a request is this machine. A page of the internet can direct a name of its
/// own to 127.0.0.1 (DNS rebinding) and would then be allowed to read what it asks for by this
/// name.
bool isThisMachine(const std::string& host) {
  const std::string name = host.substr(0, host.rfind(':'));
  return name == "127.0.0.1" || name == "localhost";
}

/// Clients keep nothing, guess no type, and show the page in no frame of another one.
httplib::Headers headersOfAll() {
  return {{"Cache-Control", "no-store"},
          {"X-Content-Type-Options", "nosniff"},
          {"X-Frame-Options", "DENY"},
          {"Cross-Origin-Resource-Policy", "same-origin"},
          {"Referrer-Policy", "no-referrer"}};
}

std::string eventOf(const LivePart& part) {
  return "event: " + part.name + "\ndata: " + *part.text + "\n\n";
}

class HttpLiveServer : public LiveServer {
 public:
  HttpLiveServer(int port, std::string page, LiveBoard& board, const LiveServerLimits& limits)
      : page_(std::move(page)), board_(board), limits_(limits), server_(limits) {
    server_.set_default_headers(headersOfAll());
    server_.set_pre_routing_handler([this](const Request& request, Response& response) {
      answer(request, response);
      return httplib::Server::HandlerResponse::Handled;
    });
    port_ = server_.bind(port);
    if (port_ < 0)
      throw ConfigurationError("live_page.port: found " + std::to_string(port) +
                               ", which cannot be had, most likely because another program uses "
                               "it; choose another port, or 0 for no page");
    thread_ = std::thread([this] { server_.serve(); });
    while (!server_.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  ~HttpLiveServer() override {
    board_.close();
    server_.end();
    thread_.join();
  }

  int port() const override { return port_; }

 private:
  void answer(const Request& request, Response& response) const {
    if (!isThisMachine(request.get_header_value("Host"))) {
      response.status = 403;
      response.set_content(
          "This page is for this machine only: http://127.0.0.1:" + std::to_string(port_) + "/\n",
          kText);
    } else if (request.method != "GET" && request.method != "HEAD") {
      response.status = 405;
      response.set_header("Allow", "GET, HEAD");
      response.set_content("This page can only be read.\n", kText);
    } else if (request.path == "/") {
      sendPage(response);
    } else if (request.path == "/events") {
      sendEvents(response);
    } else {
      response.status = 404;
      response.set_content("There is only one page: /\n", kText);
    }
  }

  void sendPage(Response& response) const {
    response.set_content_provider(
        page_.size(), "text/html; charset=utf-8",
        [this](std::size_t begin, std::size_t length, httplib::DataSink& sink) {
          return sink.write(page_.data() + begin, length);
        });
  }

  /// Sends what is on the board, and each change, until the client leaves or the board is closed.
  void sendEvents(Response& response) const {
    response.set_chunked_content_provider(
        "text/event-stream",
        [this, seen = std::uint64_t{0}](std::size_t sent, httplib::DataSink& sink) mutable {
          const auto parts = board_.partsAfter(seen, limits_.heartbeat);
          if (board_.closed()) return false;
          std::string text = sent == 0 ? "retry: 2000\n\n" : "";
          for (const LivePart& part : parts) {
            text += eventOf(part);
            seen = part.version;
          }
          if (text.empty()) text = ": still here\n\n";
          return sink.write(text.data(), text.size());
        });
  }

  const std::string page_;
  LiveBoard& board_;
  const LiveServerLimits limits_;
  BoundedServer server_;
  int port_ = -1;
  std::thread thread_;
};

}  // namespace

std::string liveServerObstacle() { return ""; }

std::unique_ptr<LiveServer> startLiveServer(int port, const std::string& page, LiveBoard& board,
                                            const LiveServerLimits& limits) {
  return std::make_unique<HttpLiveServer>(port, page, board, limits);
}

}  // namespace uncertainty_identification
