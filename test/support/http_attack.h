#pragma once

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "support/http_connection.h"

namespace uncertainty_identification {

/// Attacks a live page from threads of its own until it is destroyed or all requests were sent:
/// holds connections open, most of them silent, some with events that nobody takes, and sends
/// requests meanwhile that no browser sends: huge, malformed, with tricks in the path, of other
/// methods, cut short; always the same ones.
class HttpAttack {
 public:
  HttpAttack(int port, int connections, int requests);
  ~HttpAttack();
  HttpAttack(const HttpAttack&) = delete;
  HttpAttack& operator=(const HttpAttack&) = delete;

  /// Number of requests sent so far.
  int sent() const { return sent_; }

 private:
  void holdConnections(int connections);
  void sendRequests(int requests);

  const int port_;
  std::atomic<bool> stopping_{false};
  std::atomic<int> sent_{0};
  std::vector<std::thread> threads_;
};

}  // namespace uncertainty_identification
