#include "io/csv_lines.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kBlock = 1 << 18;  // [bytes] fits into the cache of a core

}  // namespace

void refuseFile(const std::string& path, const std::string& what) {
  throw FileError("cannot read '" + path + "': " + what);
}

CsvLines::CsvLines(const std::string& path)
    : path_(path), file_(std::fopen(path.c_str(), "rb"), &std::fclose), block_(kBlock) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode))
    refuseFile(path, "it is a folder; give a file in it");
  if (!file_) refuseFile(path, std::strerror(errno));
}

const std::vector<std::string>& CsvLines::first(std::size_t count) {
  while (first_.size() < count && read()) first_.emplace_back(begin_, end_);
  if (first_.empty()) return first_;
  std::string& line = first_.front();
  if (line.compare(0, 3, "\xEF\xBB\xBF") == 0) line.erase(0, 3);
  if (line.find('\0') != std::string::npos || line.compare(0, 2, "\xFF\xFE") == 0)
    refuseFile(path_, "line 1 holds bytes that are no text; save it as CSV in UTF-8");
  const std::size_t carriage_return = line.find('\r');
  if (carriage_return != std::string::npos && carriage_return + 1 < line.size())
    refuseFile(path_, "its lines end in CR alone; save it with line ends LF or CR LF");
  return first_;
}

bool CsvLines::next() {
  if (served_ < first_.size()) {
    const std::string& line = first_[served_++];
    begin_ = line.data();
    end_ = begin_ + line.size();
  } else if (!read()) {
    return false;
  }
  ++number_;
  return true;
}

bool CsvLines::read() {
  std::size_t searched = at_;
  for (;;) {
    char* const start = block_.data();
    const void* found = std::memchr(start + searched, '\n', size_ - searched);
    const bool complete = found != nullptr;
    searched = size_ - at_;
    if (!complete && fill()) continue;
    if (!complete && at_ == size_) return false;
    end_ = complete ? static_cast<const char*>(found) : block_.data() + size_;
    begin_ = block_.data() + at_;
    at_ = static_cast<std::size_t>(end_ - block_.data()) + (complete ? 1 : 0);
    if (!complete) block_[size_] = '\0';
    return true;
  }
}

/// Moves the line that has begun to the front of the block and reads more of the file behind it.
bool CsvLines::fill() {
  std::memmove(block_.data(), block_.data() + at_, size_ - at_);
  size_ -= at_;
  at_ = 0;
  if (size_ + 1 >= block_.size()) block_.resize(2 * block_.size());
  const std::size_t read =
      std::fread(block_.data() + size_, 1, block_.size() - size_ - 1, file_.get());
  if (read == 0 && std::ferror(file_.get()) != 0) refuseFile(path_, std::strerror(errno));
  size_ += read;
  return read > 0;
}

}  // namespace uncertainty_identification
