#include "model/box_jenkins.h"

#include "math/polynomial.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// theta = [b; a; c; d]. output_error and arx have no c; output_error has no d; for arx and armax D
/// equals A.
class BoxJenkins : public NominalModel {
 public:
  explicit BoxJenkins(const NominalModelOptions& options)
      : structure_(options.structure),
        delay_(options.delay),
        nb_(options.nb),
        na_(options.na),
        nc_(hasC() ? options.nc : 0),
        nd_(structure_ == Structure::box_jenkins ? options.nd : 0) {
    if (nb_ < 1 || na_ < 0 || nc_ < 0 || nd_ < 0 || delay_ < 0) {
      throw ConfigurationError(
          "nominal_model: nb must be at least 1 and na, nc, nd, delay at least 0");
    }
  }

  std::string structure() const override {
    switch (structure_) {
      case Structure::output_error:
        return "output_error";
      case Structure::arx:
        return "arx";
      case Structure::armax:
        return "armax";
      default:
        return "box_jenkins";
    }
  }

  std::vector<std::string> names() const override {
    std::vector<std::string> all;
    const auto append = [&all](const char* letter, int count) {
      for (int k = 1; k <= count; ++k) all.push_back(letter + std::to_string(k));
    };
    append("b", nb_);
    append("a", na_);
    append("c", nc_);
    append("d", nd_);
    return all;
  }

  Polynomials polynomials(const Eigen::VectorXd& theta) const override {
    Polynomials p;
    p.delay = delay_;
    p.b = theta.head(nb_);
    p.a = theta.segment(nb_, na_);
    p.c = theta.segment(nb_ + na_, nc_);
    p.d = sharesA() ? p.a : theta.tail(nd_);
    return p;
  }

  Eigen::MatrixXd jacobian(const Eigen::VectorXd& theta) const override {
    const Eigen::Index own = theta.size(), shared = sharesA() ? na_ : 0;
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(own + shared, own);
    all.topRows(own).setIdentity();
    all.block(own, nb_, shared, shared).setIdentity();
    return all;
  }

  Eigen::VectorXd toUnbounded(const Eigen::VectorXd& theta) const override {
    Eigen::VectorXd z = theta;
    z.segment(nb_, na_) = uncertainty_identification::toUnbounded(theta.segment(nb_, na_));
    z.segment(nb_ + na_, nc_) =
        uncertainty_identification::toUnbounded(theta.segment(nb_ + na_, nc_));
    z.tail(nd_) = uncertainty_identification::toUnbounded(theta.tail(nd_));
    return z;
  }

  Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& z) const override {
    Eigen::VectorXd theta = z;
    theta.segment(nb_, na_) = uncertainty_identification::fromUnbounded(z.segment(nb_, na_));
    theta.segment(nb_ + na_, nc_) =
        uncertainty_identification::fromUnbounded(z.segment(nb_ + na_, nc_));
    theta.tail(nd_) = uncertainty_identification::fromUnbounded(z.tail(nd_));
    return theta;
  }

  Eigen::MatrixXd unboundedJacobian(const Eigen::VectorXd& z) const override {
    Eigen::MatrixXd all = Eigen::MatrixXd::Identity(z.size(), z.size()), part;
    for (const auto& [start, size] :
         {std::pair{nb_, na_}, {nb_ + na_, nc_}, {nb_ + na_ + nc_, nd_}}) {
      uncertainty_identification::fromUnbounded(z.segment(start, size), &part);
      all.block(start, start, size, size) = part;
    }
    return all;
  }

  Eigen::VectorXd fromPolynomials(const Polynomials& p) const override {
    Eigen::VectorXd theta(nb_ + na_ + nc_ + nd_);
    theta << resized(p.b, nb_), resized(p.a, na_), resized(p.c, nc_), resized(p.d, nd_);
    return theta;
  }

 private:
  bool hasC() const {
    return structure_ == Structure::armax || structure_ == Structure::box_jenkins;
  }
  bool sharesA() const { return structure_ == Structure::arx || structure_ == Structure::armax; }

  static Eigen::VectorXd resized(const Eigen::VectorXd& from, int size) {
    Eigen::VectorXd to = Eigen::VectorXd::Zero(size);
    const Eigen::Index common = std::min<Eigen::Index>(from.size(), size);
    to.head(common) = from.head(common);
    return to;
  }

  Structure structure_;
  int delay_, nb_, na_, nc_, nd_;
};

}  // namespace

std::shared_ptr<const NominalModel> makeBoxJenkins(const NominalModelOptions& options) {
  return std::make_shared<BoxJenkins>(options);
}

}  // namespace uncertainty_identification
