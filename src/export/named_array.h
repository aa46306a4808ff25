#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "export/exported_model.h"

namespace uncertainty_identification {

/// A number, a list of numbers or a table of an exported model, with the name that it has in every
/// file.
struct NamedArray {
  enum class Kind { scalar, list, table };
  std::string name;
  std::string meaning;  ///< plain text, with the unit
  Kind kind = Kind::table;
  bool is_complex = false;
  Eigen::MatrixXcd values;  ///< a list is a single row
};

/// What the files for Octave, MATLAB and Python hold. Parts that the model lacks are left out.
std::vector<NamedArray> namedArrays(const ExportedModel& model);

/// A number as these languages, C and YAML read it, which keeps every bit: "0.1", "1.0e-05", "nan".
std::string exactText(double value);

/// The numbers of a row separated by commas; complex ones as "1.0-2.0j".
std::string rowText(const Eigen::RowVectorXcd& row, bool is_complex);

/// The real numbers of a vector separated by commas.
std::string listText(const Eigen::VectorXd& list);

}  // namespace uncertainty_identification
