#pragma once

#include <httplib.h>

#include <mutex>
#include <set>
#include <thread>

#include "live/live_server.h"

namespace uncertainty_identification {

/// An HTTP server of httplib 0.11 whose clients can use no more than the limits say: threads,
/// memory and time. Serves one request for each connection.
class BoundedServer : public httplib::Server {
 public:
  explicit BoundedServer(const LiveServerLimits& limits);

  /// Listens on 127.0.0.1 and returns the port; -1 when that is not possible. `port` 0: any.
  int bind(int port);

  /// Serves until end(), in the thread that calls it.
  void serve();

  /// Ends serve() and all connections. To be called once serve() is running.
  void end();

 private:
  bool process_and_close_socket(socket_t socket) override;
  bool enter(socket_t socket);
  void leave(socket_t socket);

  const LiveServerLimits limits_;
  std::thread::id accepting_;  // the thread of serve()
  std::mutex mutex_;           // guards the members below
  std::set<socket_t> open_;
  bool ended_ = false;
};

}  // namespace uncertainty_identification
