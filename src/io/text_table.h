#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace uncertainty_identification {

/// A table as text: one line for each row, with aligned columns separated by two spaces. The first
/// row is the heading.
std::string textTable(const std::vector<std::vector<std::string>>& rows);

/// A number with six significant digits; "-" for one that is absent or not finite.
std::string numberText(double value);
std::string numberText(const std::optional<double>& value);

/// An estimate with its standard error, "0.3102 +- 0.0041", both rounded to the second significant
/// digit of the error. The number alone if the error is not a positive number.
std::string estimateText(double value, double standard_error);

/// "(1, 2)"; a single entry without brackets.
std::string vectorText(const Eigen::VectorXd& value);

/// "[1 0.5; 0.5 2]"; a single entry without brackets.
std::string matrixText(const Eigen::MatrixXd& value);

/// "1 + 0.5 q^-1", the terms being coefficients(k) q^-(first + k).
std::string polynomialText(const Eigen::VectorXd& coefficients, int first);

}  // namespace uncertainty_identification
