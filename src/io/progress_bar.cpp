#include "io/progress_bar.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace uncertainty_identification {
namespace {

constexpr int kWidth = 24;  // [characters] of the bar
const char* const kClearLine = "\r\x1b[K";

}  // namespace

ProgressBar::~ProgressBar() {
  if (enabled_) out_ << kClearLine << std::flush;
}

void ProgressBar::show(const Progress& progress) {
  if (!enabled_) return;
  const double fraction =
      std::isnan(progress.fraction) ? 0 : std::clamp(progress.fraction, 0.0, 1.0);
  const int filled = static_cast<int>(std::lround(kWidth * fraction));
  out_ << kClearLine << '[' << std::string(static_cast<std::size_t>(filled), '#')
       << std::string(static_cast<std::size_t>(kWidth - filled), ' ') << "] "
       << std::lround(100 * fraction) << " % " << progress.phase;
  if (progress.log_likelihood && std::isfinite(*progress.log_likelihood)) {
    char text[48];
    std::snprintf(text, sizeof text, ", log-likelihood %.3f", *progress.log_likelihood);
    out_ << text;
  }
  out_ << std::flush;
}

}  // namespace uncertainty_identification
