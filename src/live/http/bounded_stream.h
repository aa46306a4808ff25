#pragma once

#include <httplib.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <string>

#include "live/live_server.h"

namespace uncertainty_identification {

/// A connection on which a client can spend no more than the limits allow. httplib's own stream
/// limits each read and write by itself, so that a client can go on for ever byte by byte.
class BoundedStream : public httplib::Stream {
 public:
  BoundedStream(socket_t socket, const LiveServerLimits& limits);

  /// Fails when the request is longer, or takes longer, than the limits say.
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
  std::size_t received_ = 0;  // [bytes]
  std::array<char, 4096> buffer_;
  std::size_t next_ = 0, end_ = 0;  // of what is in the buffer and was not read yet
};

}  // namespace uncertainty_identification
