#include "io/text_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace uncertainty_identification {
namespace {

constexpr double kMostDecimals = 6;  // an estimate that needs more is written with an exponent

}  // namespace

std::string textTable(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += "  " + row[i] + std::string(widths[i] - row[i].size(), ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string numberText(double value) {
  if (!std::isfinite(value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string numberText(const std::optional<double>& value) {
  return value ? numberText(*value) : "-";
}

std::string estimateText(double value, double standard_error) {
  if (!std::isfinite(value) || !std::isfinite(standard_error) || standard_error <= 0) {
    return numberText(value);
  }
  const double decimals = std::max(0.0, 1 - std::floor(std::log10(standard_error)));
  const bool plain = decimals <= kMostDecimals && std::abs(value) < 1e6 && standard_error < 1e6;
  char text[64];
  std::snprintf(text, sizeof text, plain ? "%.*f +- %.*f" : "%.*e +- %.*e",
                plain ? static_cast<int>(decimals) : 3, value,
                plain ? static_cast<int>(decimals) : 1, standard_error);
  return text;
}

std::string vectorText(const Eigen::VectorXd& value) {
  if (value.size() == 1) return numberText(value(0));
  std::string text;
  for (Eigen::Index i = 0; i < value.size(); ++i)
    text += (i > 0 ? ", " : "") + numberText(value(i));
  return "(" + text + ")";
}

std::string matrixText(const Eigen::MatrixXd& value) {
  if (value.size() == 1) return numberText(value(0, 0));
  std::string text;
  for (Eigen::Index i = 0; i < value.rows(); ++i) {
    if (i > 0) text += "; ";
    for (Eigen::Index j = 0; j < value.cols(); ++j)
      text += (j > 0 ? " " : "") + numberText(value(i, j));
  }
  return "[" + text + "]";
}

std::string polynomialText(const Eigen::VectorXd& coefficients, int first) {
  std::string text;
  for (int k = 0; k < coefficients.size(); ++k) {
    const double value = coefficients(k);
    const std::string sign = value < 0 ? "-" : "+";
    text += text.empty() ? (value < 0 ? "-" : "") : " " + sign + " ";
    text += numberText(std::abs(value));
    if (first + k > 0) text += " q^-" + std::to_string(first + k);
  }
  return text.empty() ? "0" : text;
}

}  // namespace uncertainty_identification
