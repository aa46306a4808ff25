#include "live/http/bounded_stream.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>

namespace uncertainty_identification {

BoundedStream::BoundedStream(socket_t socket, const LiveServerLimits& limits)
    : socket_(socket), limits_(limits) {}

/// Whether the socket is ready within this time. Also true when the connection has ended, which the
/// next read or write finds.
bool BoundedStream::waitFor(short events, Clock::duration patience) const {
  const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(patience).count();
  pollfd waiting{socket_, events, 0};
  return poll(&waiting, 1, static_cast<int>(std::max<decltype(milliseconds)>(0, milliseconds))) > 0;
}

ssize_t BoundedStream::read(char* data, std::size_t size) {
  if (next_ == end_) {
    if (received_ >= limits_.request_bytes) return -1;
    if (!waitFor(POLLIN, limits_.request_time - (Clock::now() - began_))) return -1;
    const ssize_t count = recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (count <= 0) return count;
    next_ = 0;
    end_ = static_cast<std::size_t>(count);
    received_ += end_;
  }
  const std::size_t count = std::min(size, end_ - next_);
  std::copy_n(buffer_.data() + next_, count, data);
  next_ += count;
  return static_cast<ssize_t>(count);
}

ssize_t BoundedStream::write(const char* data, std::size_t size) {
  if (waitFor(POLLOUT, {})) {
    waited_ = {};
  } else {
    const auto begin = Clock::now();
    if (!waitFor(POLLOUT, limits_.write_time - waited_)) return -1;
    waited_ += Clock::now() - begin;
  }
  return send(socket_, data, size, MSG_DONTWAIT | MSG_NOSIGNAL);
}

bool BoundedStream::is_readable() const { return next_ < end_ || waitFor(POLLIN, {}); }

bool BoundedStream::is_writable() const { return waitFor(POLLOUT, {}); }

// The addresses are always those of this machine, and nobody asks for them.
void BoundedStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip = "127.0.0.1";
  port = 0;
}

void BoundedStream::get_local_ip_and_port(std::string& ip, int& port) const {
  get_remote_ip_and_port(ip, port);
}

}  // namespace uncertainty_identification
