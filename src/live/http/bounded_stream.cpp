#include "live/http/bounded_stream.h"

#include <poll.h>
#include <strings.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>

namespace uncertainty_identification {
namespace {

/// Of the lines of a request the first one and those of its host, and an empty one.
std::string lineAndHost(const std::string& head) {
  static const std::string kHost = "host:", kEnd = "\r\n";
  std::string kept;
  for (std::size_t begin = 0, end = 0; begin < head.size(); begin = end + kEnd.size()) {
    end = head.find(kEnd, begin);
    const std::string line = head.substr(begin, end - begin);
    const bool host = strncasecmp(line.c_str(), kHost.c_str(), kHost.size()) == 0;
    if (begin == 0 || host) kept += line + kEnd;
  }
  return kept + kEnd;
}

}  // namespace

BoundedStream::BoundedStream(socket_t socket, const LiveServerLimits& limits)
    : socket_(socket), limits_(limits) {}

/// Whether the socket is ready within this time. Also true when the connection has ended, which the
/// next read or write finds.
bool BoundedStream::waitFor(short events, Clock::duration patience) const {
  const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(patience).count();
  pollfd waiting{socket_, events, 0};
  return poll(&waiting, 1, static_cast<int>(std::max<decltype(milliseconds)>(0, milliseconds))) > 0;
}

bool BoundedStream::receive() {
  std::string head;
  std::array<char, 4096> part;
  std::size_t end = 0;
  while ((end = head.find("\r\n\r\n")) == std::string::npos) {
    if (head.size() >= limits_.request_bytes) return false;
    if (!waitFor(POLLIN, limits_.request_time - (Clock::now() - began_))) return false;
    const ssize_t count = recv(socket_, part.data(), part.size(), MSG_DONTWAIT);
    if (count <= 0) return false;
    head.append(part.data(), static_cast<std::size_t>(count));
  }
  request_ = lineAndHost(head.substr(0, end + 2));
  return true;
}

ssize_t BoundedStream::read(char* data, std::size_t size) {
  const std::size_t count = std::min(size, request_.size() - next_);
  std::copy_n(request_.data() + next_, count, data);
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

bool BoundedStream::is_readable() const { return next_ < request_.size(); }

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
