#include "export/named_array.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = NamedArray::Kind;

class ArrayList {
 public:
  void add(const std::string& name, double value, const std::string& meaning) {
    arrays_.push_back(
        {name, meaning, Kind::scalar, false, Eigen::MatrixXcd::Constant(1, 1, value)});
  }
  void add(const std::string& name, const VectorXd& list, const std::string& meaning) {
    arrays_.push_back({name, meaning, Kind::list, false, list.transpose().cast<Complex>()});
  }
  void add(const std::string& name, const MatrixXd& table, const std::string& meaning) {
    arrays_.push_back({name, meaning, Kind::table, false, table.cast<Complex>()});
  }

  /// num, den and response with this prefix.
  void add(const std::string& prefix, const ExportedSystems& systems, Kind kind,
           const std::string& meaning) {
    const auto push = [&](const char* name, bool is_complex, const Eigen::MatrixXcd& values,
                          const std::string& what) {
      arrays_.push_back({prefix + name, what + " of " + meaning, kind, is_complex, values});
    };
    push("num", false, systems.num.cast<Complex>(), "numerator, descending powers of z,");
    push("den", false, systems.den.cast<Complex>(), "denominator, as long as the numerator,");
    push("response", true, systems.response, "response at omega, as the library computes it,");
  }

  std::vector<NamedArray> take() { return std::move(arrays_); }

 private:
  using Complex = std::complex<double>;
  std::vector<NamedArray> arrays_;
};

void addBands(const ExportedBands& bands, ArrayList* list) {
  const std::string rows = ", one row per level";
  list->add("band_levels", bands.levels, "share of the plants that each pointwise band holds");
  list->add("band_omega", bands.omega, "[rad/s] frequencies of the bands");
  list->add("magnitude_lower", bands.magnitude_lower, "lower limit of |G|" + rows);
  list->add("magnitude_upper", bands.magnitude_upper, "upper limit of |G|" + rows);
  list->add("phase_lower", bands.phase_lower, "[rad] lower limit of the phase of G" + rows);
  list->add("phase_upper", bands.phase_upper, "[rad] upper limit of the phase of G" + rows);
  list->add("relative_error_upper", bands.relative_error_upper, "upper limit of |G/Go - 1|" + rows);
}

}  // namespace

std::vector<NamedArray> namedArrays(const ExportedModel& model) {
  ArrayList list;
  list.add("sample_time", model.sample_time, "[s]");
  list.add("delay", model.delay, "[samples] dead time, which num holds as leading zeros");
  list.add("offset_u", model.offset_u, "y = Go (u + offset_u) + offset_y + H w");
  list.add("offset_y", model.offset_y, "see offset_u");
  list.add("noise_variance", model.noise_variance, "of the white noise w");
  list.add("omega", model.omega, "[rad/s] frequencies of all responses");
  list.add("", model.plant, Kind::list, "the nominal plant Go");
  list.add("noise_", model.noise, Kind::list, "the noise model H");
  if (model.weight) {
    list.add("weight_level", model.weight_level,
             "share of the plants with G = Go (1 + W D), |D| <= 1");
    list.add("weight_", *model.weight, Kind::list, "the weight W");
  }
  if (model.samples) {
    list.add("samples_seed", static_cast<double>(model.samples_seed), "of the plants drawn");
    list.add("samples_", *model.samples, Kind::table,
             std::string("the plants drawn, one row each, ") +
                 (model.samples_hold_estimation_errors ? "with" : "without") +
                 " the errors of the estimate");
  }
  if (model.bands) addBands(*model.bands, &list);
  return list.take();
}

std::string exactText(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  std::string text = nlohmann::json(value).dump();
  if (text.find('.') == std::string::npos) text.insert(std::min(text.find('e'), text.size()), ".0");
  return text;
}

std::string rowText(const Eigen::RowVectorXcd& row, bool is_complex) {
  std::string text;
  for (Index k = 0; k < row.size(); ++k) {
    text += (k > 0 ? ", " : "") + exactText(row[k].real());
    if (!is_complex) continue;
    const std::string imaginary = exactText(row[k].imag());
    text += (imaginary[0] == '-' ? "" : "+") + imaginary + "j";
  }
  return text;
}

std::string listText(const VectorXd& list) {
  return rowText(list.transpose().cast<std::complex<double>>(), false);
}

}  // namespace uncertainty_identification
