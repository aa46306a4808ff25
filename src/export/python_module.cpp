#include "export/named_array.h"
#include "export/targets.h"

namespace uncertainty_identification {
namespace {

const char* const kPythonHead = R"(
num and den are coefficients of descending powers of z. They have equal length and num holds the
delay, so they are coefficients of ascending powers of z^-1 as well. Run this file to check it.
"""
import numpy as np

nan, inf = np.nan, np.inf

)";

const char* const kPythonFunctions = R"(
PARTS = {part: prefix for part, prefix in (("plant", ""), ("noise", "noise_"), ("weight", "weight_"),
                                           ("samples", "samples_")) if prefix + "num" in globals()}


def frequency_response(num, den, omega=omega):
    """Responses of num/den, which may hold one system per row, at omega [rad/s]: systems x frequencies."""
    z = np.exp(1j * np.asarray(omega) * sample_time)
    return np.array([np.polyval(n, z) / np.polyval(d, z)
                     for n, d in zip(np.atleast_2d(num), np.atleast_2d(den))])


def systems():
    """The parts as control.TransferFunction, "samples" as a list of them. Needs python-control."""
    import control
    rows = {part: zip(np.atleast_2d(globals()[prefix + "num"]), np.atleast_2d(globals()[prefix + "den"]))
            for part, prefix in PARTS.items()}
    built = {part: [control.TransferFunction(n, d, sample_time) for n, d in pairs]
             for part, pairs in rows.items()}
    return {part: each if part == "samples" else each[0] for part, each in built.items()}


def difference(num, den, response):
    """Largest difference of a response from that of num/den at omega, relative to its magnitude.

    Where the rounding of num(z) or den(z) matters more than a part in 1e5 of that, it counts instead.
    """
    z = np.exp(1j * omega * sample_time)
    num, den, response = np.atleast_2d(num), np.atleast_2d(den), np.atleast_2d(response)
    size = np.abs(response)
    at_den = np.abs([np.polyval(d, z) for d in den])
    rounding = (np.abs(num).sum(1)[:, None] + size * np.abs(den).sum(1)[:, None]) / at_den
    return np.max(np.abs(frequency_response(num, den) - response) / (size + 1e-5 * rounding))


def self_check():
    """Compares all systems with the responses that the library computed."""
    for part, prefix in PARTS.items():
        largest = difference(*(globals()[prefix + name] for name in ("num", "den", "response")))
        print(f"{part}: differs by {largest:.1e} from the library at {len(omega)} frequencies")
        if not largest < 1e-9:
            raise SystemExit(f"{part}: the responses differ")


if __name__ == "__main__":
    self_check()
)";

std::string pythonAssignment(const NamedArray& array) {
  std::string rows;
  for (Eigen::Index i = 0; i < array.values.rows(); ++i) {
    const std::string row = rowText(array.values.row(i), array.is_complex);
    if (array.kind == NamedArray::Kind::scalar) rows = row;
    if (array.kind == NamedArray::Kind::list) rows = "np.array([" + row + "])";
    if (array.kind == NamedArray::Kind::table) rows += (i > 0 ? ",\n    [" : "\n    [") + row + "]";
  }
  if (array.kind == NamedArray::Kind::table) rows = "np.array([" + rows + "])";
  return "# " + array.meaning + "\n" + array.name + " = " + rows + "\n";
}

}  // namespace

std::string pythonModule(const ExportedModel& model) {
  std::string text = "\"\"\"Model " + model.name + ": plant, noise model and uncertainty.\n\n";
  for (const std::string& line : model.about) text += line + "\n";
  for (const std::string& line : model.missing) text += "Missing: " + line + "\n";
  text += kPythonHead;
  for (const NamedArray& array : namedArrays(model)) text += pythonAssignment(array);
  return text + kPythonFunctions;
}

}  // namespace uncertainty_identification
