#include "support/http_attack.h"

#include <chrono>
#include <random>

namespace uncertainty_identification {
namespace {

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int k = 0; k < count; ++k) all += text;
  return all;
}

const std::vector<std::string>& tricks() {
  static const std::string kHost = "Host: localhost\r\n";
  static const std::vector<std::string> kTricks{
      getRequest("/../etc/passwd"),
      getRequest("/%2e%2e/%2e%2e/etc/passwd"),
      getRequest("//etc/passwd"),
      getRequest("/..%c0%af..%c0%afetc/passwd"),
      getRequest("/events/../../etc/passwd"),
      getRequest("file:///etc/passwd"),
      getRequest("/%00"),
      getRequest("/" + repeated("a", 100000)),
      getRequest("/?" + repeated("a=b&", 20000)),
      "GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n",
      "GET / HTTP/1.1\r\n\r\n",
      "GET / HTTP/9.9\r\n" + kHost + "\r\n",
      "POST / HTTP/1.1\r\n" + kHost + "Content-Length: 1000000000\r\n\r\n" + repeated("x", 1000000),
      "PUT /events HTTP/1.1\r\n" + kHost + "Transfer-Encoding: chunked\r\n\r\nffffffff\r\n",
      "DELETE / HTTP/1.1\r\n" + kHost + "\r\n",
      "OPTIONS * HTTP/1.1\r\n" + kHost + "\r\n",
      "CONNECT evil.example:80 HTTP/1.1\r\n" + kHost + "\r\n",
      "TRACE / HTTP/1.1\r\n" + kHost + "\r\n",
      "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
      "HEAD /events HTTP/1.1\r\n" + kHost + "\r\n",
      "GET / HTTP/1.1\r\n" + kHost + "Range: bytes=" + repeated("0-1,", 1500) + "0-1\r\n\r\n",
      "GET / HTTP/1.1\r\n" + kHost + "Accept-Encoding: br, gzip\r\n\r\n",
      "GET / HTTP/1.1\r\n" + kHost + repeated("A: b\r\n", 100000) + "\r\n",
      "GET / HTTP/1.1\r\n" + kHost + "A: " + repeated("b", 1000000) + "\r\n\r\n",
      "GET / HTTP/1.1\r\n" + kHost + "Expect: 100-continue\r\nContent-Length: -1\r\n\r\n",
      "GET / HTTP/1.1\r\nHost: localhost\r\nHost: evil.example\r\nA\r\n: b\r\n\r\n",
      "GET / HTTP/1.1\n\n",
      "\r\n\r\n\r\n",
      "\x16\x03\x01\x02\x01\x01\xfc\x03\x03",  // TLS
      repeated("\xff", 1000)};
  return kTricks;
}

/// First each of the tricks, then tricks that are cut short and have some bytes changed.
std::string hostileRequest(int number, std::mt19937& draw) {
  const auto place = static_cast<std::size_t>(number);
  std::string request = tricks()[place % tricks().size()];
  if (place < tricks().size()) return request;
  if (draw() % 2 == 0) request.resize(draw() % (request.size() + 1));
  for (auto flips = draw() % 4; flips > 0 && !request.empty(); --flips)
    request[draw() % request.size()] = static_cast<char>(draw() % 256);
  return request;
}

}  // namespace

HttpAttack::HttpAttack(int port, int connections, int requests) : port_(port) {
  threads_.emplace_back([this, connections] { holdConnections(connections); });
  threads_.emplace_back([this, requests] { sendRequests(requests); });
}

HttpAttack::~HttpAttack() {
  stopping_ = true;
  for (std::thread& thread : threads_) thread.join();
}

/// Opens the connections again and again, because the server ends those that are silent.
void HttpAttack::holdConnections(int connections) {
  std::vector<std::unique_ptr<HttpConnection>> open(static_cast<std::size_t>(connections));
  for (std::size_t k = 0; !stopping_; k = (k + 1) % open.size()) {
    if (k == 0) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    open[k] = std::make_unique<HttpConnection>(port_);
    open[k]->send(k % 4 == 0 ? getRequest("/events") : std::string("GET / HT"));
  }
}

void HttpAttack::sendRequests(int requests) {
  std::mt19937 draw(1);
  while (sent_ < requests && !stopping_) {
    HttpConnection connection(port_);
    connection.send(hostileRequest(sent_, draw));
    connection.receiveUntil("\r\n\r\n", std::chrono::seconds(0));
    ++sent_;
  }
}

}  // namespace uncertainty_identification
