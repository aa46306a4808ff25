#pragma once

#include <httplib.h>

#include <chrono>
#include <cstddef>
#include <string>

#include "live/live_server.h"

namespace uncertainty_identification {

/// A connection on which a client can spend no more than the limits allow. httplib's own stream
/// limits each read and write by itself, so that a client can go on for ever byte by byte; and some
/// headers cost httplib far more than the client: it matches ranges by a recursion that takes
/// megabytes of stack, and compresses on request. So it is given a request that has only a host.
class BoundedStream : public httplib::Stream {
 public:
  BoundedStream(socket_t socket, const LiveServerLimits& limits);

  /// Receives a request up to the end of its headers. False when it is longer, or takes longer,
  /// than the limits say, or the client leaves.
  bool receive();

  /// The request line and the host of what was received.
  ssize_t read(char* data, std::size_t size) override;

  /// Fails when the client has made the server wait for too long.
  ssize_t write(const char* data, std::size_t size) override;

  bool is_readable() const override;
  bool is_writable() const override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool waitFor(short events, Clock::duration patience) const;

  const socket_t socket_;
  const LiveServerLimits limits_;
  const Clock::time_point began_ = Clock::now();
  Clock::duration waited_{};  // by writes since one did not have to wait
  std::string request_;
  std::size_t next_ = 0;  // of the request, to be read
};

}  // namespace uncertainty_identification
