#include "live/http/bounded_server.h"

#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <string>
#include <utility>

#include "live/http/bounded_stream.h"

namespace uncertainty_identification {
namespace {

/// Gives each connection to a thread that has nothing to do. Where all are busy, the thread that
/// accepts connections handles it, which refuses it: nothing waits, so nothing piles up.
class WaitlessQueue : public httplib::TaskQueue {
 public:
  explicit WaitlessQueue(int threads)
      : threads_(threads), pool_(static_cast<std::size_t>(threads)) {}

  void enqueue(std::function<void()> handle) override {
    if (busy_ >= threads_) return handle();
    ++busy_;
    pool_.enqueue([this, handle = std::move(handle)] {
      handle();
      --busy_;
    });
  }

  void shutdown() override { pool_.shutdown(); }

 private:
  const int threads_;
  std::atomic<int> busy_{0};
  httplib::ThreadPool pool_;
};

/// What the calling thread computes must not delay that the node records. On Linux this holds for
/// the thread, not for the process.
void lowerPriority() {
  constexpr int kNice = 10;
  setpriority(PRIO_PROCESS, 0, kNice);
}

void refuse(socket_t socket) {
  static const std::string kBusy =
      "HTTP/1.1 503 Service Unavailable\r\nRetry-After: 5\r\nConnection: close\r\n"
      "Content-Length: 0\r\n\r\n";
  send(socket, kBusy.data(), kBusy.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  ::close(socket);
}

}  // namespace

BoundedServer::BoundedServer(const LiveServerLimits& limits) : limits_(limits) {
  new_task_queue = [limits] { return new WaitlessQueue(limits.connections); };
  // Not SO_REUSEPORT, httplib's default, with which two nodes would share one port.
  set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
}

int BoundedServer::bind(int port) {
  constexpr const char* kLoopback = "127.0.0.1";
  constexpr int kBacklog = 128;  // connections that wait to be accepted; httplib's own are 5
  if (port == 0) {
    port = bind_to_any_port(kLoopback);
  } else if (!bind_to_port(kLoopback, port)) {
    port = -1;
  }
  if (port > 0) ::listen(svr_sock_, kBacklog);
  return port;
}

void BoundedServer::serve() {
  accepting_ = std::this_thread::get_id();
  lowerPriority();
  listen_after_bind();
}

void BoundedServer::end() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
    for (const socket_t socket : open_) ::shutdown(socket, SHUT_RDWR);
  }
  stop();
}

bool BoundedServer::enter(socket_t socket) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!ended_) open_.insert(socket);
  return !ended_;
}

void BoundedServer::leave(socket_t socket) {
  const std::lock_guard<std::mutex> lock(mutex_);
  open_.erase(socket);
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
}

bool BoundedServer::process_and_close_socket(socket_t socket) {
  if (std::this_thread::get_id() == accepting_ || !enter(socket)) {
    refuse(socket);
    return false;
  }
  lowerPriority();
  BoundedStream stream(socket, limits_);
  bool closed = false;
  const bool served = stream.receive() && process_request(stream, true, closed, {});
  leave(socket);
  return served;
}

}  // namespace uncertainty_identification
