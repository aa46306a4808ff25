#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <string>

namespace uncertainty_identification {

/// A TCP connection to a port of 127.0.0.1, over which a test sends what it wants.
class HttpConnection {
 public:
  /// Throws std::runtime_error when nobody listens.
  explicit HttpConnection(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) return;
    close(socket_);
    throw std::runtime_error("nobody listens on port " + std::to_string(port));
  }

  ~HttpConnection() { close(socket_); }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  /// Sends all of it, unless the other side has had enough.
  void send(const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
      pollfd writable{socket_, POLLOUT, 0};
      if (poll(&writable, 1, 5000) <= 0) return;
      const ssize_t sent =
          ::send(socket_, text.data() + done, text.size() - done, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (sent <= 0) return;
      done += static_cast<std::size_t>(sent);
    }
  }

  /// Receives until all that came contains `text`, the other side ends, or the time is over;
  /// returns all that came so far.
  const std::string& receiveUntil(const std::string& text,
                                  std::chrono::seconds limit = std::chrono::seconds(60)) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (received_.find(text) == std::string::npos && std::chrono::steady_clock::now() < end) {
      pollfd readable{socket_, POLLIN, 0};
      if (poll(&readable, 1, 100) <= 0) continue;
      char buffer[65536];
      const ssize_t count = recv(socket_, buffer, sizeof buffer, 0);
      ended_ = count <= 0;
      if (ended_) break;
      received_.append(buffer, static_cast<std::size_t>(count));
    }
    return received_;
  }

  /// Receives until the other side ends the connection.
  const std::string& receiveAll() { return receiveUntil(kNever); }

  /// Whether the other side was seen to end the connection.
  bool ended() const { return ended_; }

 private:
  static constexpr const char* kNever = "\1 what no answer contains \1";
  const int socket_;
  bool ended_ = false;
  std::string received_;
};

/// A request as a browser sends it.
inline std::string getRequest(const std::string& path) {
  return "GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
}

/// The whole answer to a request; empty when there was none.
inline std::string answerTo(int port, const std::string& request) {
  HttpConnection connection(port);
  connection.send(request);
  return connection.receiveAll();
}

/// A port that nobody listens on now.
inline int freePort() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const bool bound = bind(socket, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                     getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  close(socket);
  if (!bound) throw std::runtime_error("there is no free port");
  return ntohs(address.sin_port);
}

}  // namespace uncertainty_identification
