#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace uncertainty_identification {

/// Throws FileError "cannot read '<path>': <what>".
[[noreturn]] void refuseFile(const std::string& path, const std::string& what);

/// The lines of a text file, read block by block: a large file is never in memory as a whole.
class CsvLines {
 public:
  /// Throws FileError when the file cannot be opened.
  explicit CsvLines(const std::string& path);

  /// Goes to the next line; false at the end of the file. Throws FileError.
  bool next();

  /// The current line without its line feed. The character at end() is no part of a number.
  const char* begin() const { return begin_; }
  const char* end() const { return end_; }
  long number() const { return number_; }  ///< from 1

  /// The first `count` lines, or all if there are fewer, without a byte order mark. next() begins
  /// with the first of them. To be called before next().
  const std::vector<std::string>& first(std::size_t count);

 private:
  bool read();
  bool fill();

  std::string path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::vector<char> block_;
  std::size_t at_ = 0, size_ = 0;  // in block_: where the next line begins, and what has been read
  std::vector<std::string> first_;
  std::size_t served_ = 0;  // how many of first_ next() has been at
  const char *begin_ = nullptr, *end_ = nullptr;
  long number_ = 0;
};

}  // namespace uncertainty_identification
