#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>

#include "live/live_board.h"

namespace uncertainty_identification {

/// What a client of the live page can use at most.
struct LiveServerLimits {
  int connections = 32;               ///< served at a time; further ones are refused (503)
  std::size_t request_bytes = 16384;  ///< of a request; a longer one is not read to its end
  std::chrono::milliseconds request_time{5000};  ///< from the connection to the end of the request
  /// A client that makes the server wait for so long, without catching up meanwhile, is dropped.
  std::chrono::milliseconds write_time{10000};
  std::chrono::milliseconds heartbeat{5000};  ///< silence after which a client is tried
};

/// Serves the live page by HTTP, read-only, on the loopback address 127.0.0.1 to clients of this
/// machine: `/` is the page, `/events` are the parts of a board as server-sent events, an event
/// named as the part. Each connection is for one request and has a thread of low priority.
class LiveServer {
 public:
  LiveServer() = default;
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  /// Closes all connections, also those of clients that send or take nothing, and the board.
  virtual ~LiveServer() = default;

  virtual int port() const = 0;
};

/// Why no page can be served by this build, and what to install; empty when one can be served.
std::string liveServerObstacle();

/// Begins to serve. `port` 0 takes any free one. The board must outlive the server. Throws
/// ConfigurationError that begins with the key live_page.port when there is a liveServerObstacle(),
/// or when the port cannot be had.
std::unique_ptr<LiveServer> startLiveServer(int port, const std::string& page, LiveBoard& board,
                                            const LiveServerLimits& limits = {});

}  // namespace uncertainty_identification
